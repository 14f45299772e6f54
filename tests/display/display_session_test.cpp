#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "display/session/display.h"
#include "tests/support/web_client.h"
#include "tests/support/wire_peer.h"

namespace swath::test {
namespace {

using testing::MatchesRegex;

// A display in this process, with a client and servers that talk to it. Pictures are 4 x 2.
class DisplayTest : public testing::Test {
  protected:
    DisplayTest() { display_ = std::move(*make_display(loop_.io, {}, loop_.clock)); }

    // Starts a display that viewers can look at.
    void view() {
        viewers_ = std::move(*ViewerHost::make({}, loop_.clock));
        DisplayOptions options;
        options.viewers = viewers_.get();
        display_ = std::move(*make_display(loop_.io, options, loop_.clock));
    }
    // Connects a viewer, who is told so.
    std::unique_ptr<WebClient> viewer() {
        auto made = std::move(*WebClient::connect(viewers_->address()));
        EXPECT_TRUE(made->next().has_value());
        return made;
    }
    // Runs the display until a message that begins like this, text or not.
    std::string next(WebClient& viewer, std::string_view begin, bool text = true) {
        std::string found;
        loop_.run_until([&] {
            const auto message = viewer.next(std::chrono::milliseconds(1));
            if (message && message->text == text && message->bytes.starts_with(begin)) found = message->bytes;
            return !found.empty();
        });
        return found;
    }
    static Buffer buffer_of(std::string_view text) {
        Buffer bytes;
        bytes.append(text.data(), text.size());
        return bytes;
    }

    std::unique_ptr<Peer> come(const Hello& hello) {
        return std::make_unique<Peer>(loop_, connect(loop_, display_->address()), hello);
    }
    std::unique_ptr<Peer> client() { return come(hello_of(Role::kClient)); }
    std::unique_ptr<Peer> ready_client(std::uint32_t servers, PictureFormat format = PictureFormat::kNone) {
        auto made = client();
        made->send(DisplaySetup{kSession, format, 2});
        made->expect<Ready>();
        servers_.clear();
        for (std::uint32_t i = 0; i < servers; ++i) {
            servers_.push_back(come(hello_of(Role::kServer, kSession, i)));
            // The answer to its Ping shows that the display has accepted it.
            loop_.run_until([&] { return servers_.back()->connection->has_clock_offset(); });
        }
        return made;
    }
    // A client of a live run, with a viewer.
    std::unique_ptr<Peer> live_client() {
        auto made = client();
        made->send(DisplaySetup{kSession, PictureFormat::kNone, 2, true});
        made->expect<Ready>();
        made->expect<Audience>();
        return made;
    }
    static AssembleFrame task(FrameNumber frame, const std::vector<Exchange>& tiles) {
        return {frame, 4, 2, {9, 9, 9}, tiles};
    }
    // Sends a tile with every pixel of the region in one colour.
    void send_tile(std::size_t server, FrameNumber frame, const Region& region, std::uint32_t colour) {
        PixelFrame pixels;
        pixels.reshape({0, 0, 4, 2});
        pixels.clear(pixels.rect());
        for (const Rect& r : region)
            for (int y = r.y0; y < r.y1; ++y)
                for (int x = r.x0; x < r.x1; ++x) {
                    *pixels.colour(x, y) = colour;
                    *pixels.depth(x, y) = 0;
                }
        Buffer body;
        const BodySizes sizes = encode_tile(pixels, region, body);
        servers_[server]->send(TilePixels{frame, sizes}, std::move(body));
    }

    static constexpr std::uint64_t kSession = 42;
    const Exchange left_{server_id(0), {{0, 0, 2, 2}}};
    const Exchange right_{server_id(1), {{3, 0, 4, 2}}};
    Loop loop_;
    std::unique_ptr<ViewerHost> viewers_;
    std::unique_ptr<SessionHost> display_;
    std::vector<std::unique_ptr<Peer>> servers_;
};

TEST_F(DisplayTest, AssemblesAPictureAndSendsItEncoded) {
    const auto one = ready_client(2, PictureFormat::kPng);
    EXPECT_EQ(servers_[0]->hello, hello_of(Role::kDisplay, kSession));
    one->send(task(0, {left_, right_}));
    send_tile(1, 0, right_.region, 0x030201);
    send_tile(0, 0, left_.region, 0x060504);
    const DisplayReport report = one->expect<DisplayReport>();
    EXPECT_EQ(report.frame, 0u);
    const auto picture = decode_png(one->body.bytes());
    ASSERT_TRUE(picture.has_value()) << picture.error().message;
    EXPECT_EQ(*picture, (Picture{4, 2, {4, 5, 6, 4, 5, 6, 9, 9, 9, 1, 2, 3,  //
                                        4, 5, 6, 4, 5, 6, 9, 9, 9, 1, 2, 3}}));
    Nanoseconds end{0};
    for (const Span& span : report.spans) {
        EXPECT_GE(span.begin, end);  // one after another
        end = span.end;
    }
    EXPECT_EQ(report.spans.back().phase, Phase::kEncode);
}

TEST_F(DisplayTest, SendsNoPictureThatNobodyWants) {
    const auto one = ready_client(1);
    one->send(task(0, {left_}));
    send_tile(0, 0, left_.region, 1);
    EXPECT_EQ(one->expect<DisplayReport>().frame, 0u);
    EXPECT_EQ(one->body.size(), 0u);
}

TEST_F(DisplayTest, CompletesAPictureWithoutTilesAtOnce) {
    const auto one = ready_client(1, PictureFormat::kPng);
    one->send(task(5, {}));
    one->expect<DisplayReport>();
    const auto picture = decode_png(one->body.bytes());
    ASSERT_TRUE(picture.has_value());
    EXPECT_EQ(picture->rgb, std::vector<std::uint8_t>(24, 9));
}

TEST_F(DisplayTest, KeepsTilesThatComeBeforeTheirTask) {
    const auto one = ready_client(2);
    send_tile(0, 0, left_.region, 1);
    send_tile(0, 1, left_.region, 1);
    loop_.run_until([&] { return servers_[0]->connection->has_clock_offset(); });
    one->send(task(0, {left_}));
    EXPECT_EQ(one->expect<DisplayReport>().frame, 0u);
    one->send(task(1, {left_, right_}));
    send_tile(1, 1, right_.region, 1);
    EXPECT_EQ(one->expect<DisplayReport>().frame, 1u);
}

TEST_F(DisplayTest, ReusesItsPicturesAndForgetsWhatWasInThem) {
    const auto one = ready_client(1, PictureFormat::kPng);
    one->send(task(0, {left_}));
    send_tile(0, 0, left_.region, 0x111111);
    one->expect<DisplayReport>();
    AssembleFrame larger = task(1, {});
    larger.width = 5;
    one->send(larger);
    one->expect<DisplayReport>();
    EXPECT_EQ(decode_png(one->body.bytes())->rgb, std::vector<std::uint8_t>(30, 9));
}

TEST_F(DisplayTest, RefusesMessagesOutOfTurn) {
    const auto ending_after = [&](const Message& message) {
        const auto one = client();
        one->send(message);
        return one->ending();
    };
    EXPECT_EQ(ending_after(task(0, {})), "AssembleFrame before DisplaySetup");
    EXPECT_EQ(ending_after(Connect{}), "Connect is not expected from a client");
    const auto twice = ready_client(1);
    twice->send(DisplaySetup{});
    EXPECT_EQ(twice->ending(), "DisplaySetup came twice");
}

TEST_F(DisplayTest, RefusesImpossibleTasks) {
    const auto two = ready_client(1);
    two->send(task(3, {left_}));
    two->send(task(3, {left_}));
    EXPECT_EQ(two->ending(), "frame 3 is announced after frame 3");
    const auto three = ready_client(1);
    for (FrameNumber frame = 0; frame < 3; ++frame) three->send(task(frame, {left_}));
    EXPECT_EQ(three->ending(), "frame 2: more than 2 frames in flight");
}

TEST_F(DisplayTest, TurnsAwayServersThatItDoesNotExpect) {
    const auto turned_away = [&](std::uint64_t session, std::size_t server) {
        return come(hello_of(Role::kServer, session, server))->ending();
    };
    EXPECT_EQ(turned_away(kSession, 0), "this display is in no session");
    const auto early = client();
    loop_.run_until([&] { return early->connection->has_clock_offset(); });
    EXPECT_EQ(turned_away(0, 0), "this display is in another session");  // it has no number yet
    early->connection->finish();
    loop_.run_until([&] { return early->connection.use_count() == 1; });
    const auto one = ready_client(2);
    EXPECT_EQ(turned_away(41, 0), "this display is in another session");
    EXPECT_EQ(turned_away(kSession, 0), "server 0 is not expected here");  // it is there already
    EXPECT_EQ(client()->ending(), "this display is busy with another client");
    EXPECT_FALSE(one->closed.has_value());
}

TEST_F(DisplayTest, TakesNoTilesFromAProbe) {
    const auto one = ready_client(1);
    const auto probe = come(hello_of(Role::kProbe));
    probe->send(TilePixels{});
    EXPECT_EQ(probe->ending(), "TilePixels is not expected here");
    EXPECT_FALSE(one->closed.has_value());
}

TEST_F(DisplayTest, TakesServersThatJoinLaterAndForgetsThoseThatLeave) {
    const auto one = ready_client(1, PictureFormat::kPng);
    servers_.push_back(come(hello_of(Role::kServer, kSession, 1)));
    one->send(task(0, {left_, right_}));
    send_tile(0, 0, left_.region, 1);
    send_tile(1, 0, right_.region, 2);
    one->expect<DisplayReport>();
    servers_[0]->connection->finish();
    one->send(task(1, {right_}));
    send_tile(1, 1, right_.region, 2);
    one->expect<DisplayReport>();
    EXPECT_FALSE(one->closed.has_value());
}

TEST_F(DisplayTest, TellsTheClientThatItIsStopped) {
    const auto one = ready_client(1);
    bool left = false;
    display_->leave([&] { left = true; });
    EXPECT_EQ(one->ending(), "it was stopped");
    EXPECT_EQ(servers_[0]->ending(), "");
    EXPECT_TRUE(loop_.run_until([&] { return left; }));
}

TEST_F(DisplayTest, TellsTheClientWhichServerIsLost) {
    const auto one = ready_client(2);
    servers_[1]->connection->close();
    const Lost lost = one->expect<Lost>();
    EXPECT_EQ(lost.server, server_id(1));
    EXPECT_THAT(lost.why, MatchesRegex("closed the connection|.*reset.*"));
    servers_[0]->connection->fail_with({"out of memory"});
    EXPECT_EQ(one->expect<Lost>(), (Lost{server_id(0), "out of memory"}));
    EXPECT_FALSE(one->closed.has_value());
}

TEST_F(DisplayTest, NamesTheServerThatSendsWhatNobodyAwaits) {
    const auto one = ready_client(1);
    for (FrameNumber frame = 4; frame < 7; ++frame) send_tile(0, frame, left_.region, 1);
    EXPECT_EQ(one->expect<Lost>(), (Lost{server_id(0), "pixels for frame 6, more than 2 frames ahead"}));
    one->connection->finish();
    loop_.run_until([&] { return one->connection.use_count() == 1; });
    const auto two = ready_client(1);
    servers_[0]->send(Connect{});
    EXPECT_EQ(two->expect<Lost>(), (Lost{server_id(0), "Connect is not expected from a server"}));
}

TEST_F(DisplayTest, NamesTheServerWhoseTileIsGarbled) {
    for (const bool early : {false, true}) {
        const auto one = ready_client(1);
        if (!early) one->send(task(0, {left_}));
        loop_.run_until([&] { return servers_[0]->hello.has_value(); });
        servers_[0]->send(TilePixels{0, {1, 2, 0}}, Buffer(7));
        if (early) one->send(task(0, {left_}));
        loop_.run_until([&] { return !one->inbox.empty() || one->closed; });
        const std::string said = one->inbox.empty() ? one->ending() : one->expect<Lost>().why;
        EXPECT_THAT(
            said, testing::HasSubstr("garbled tile from server 0: a body of 7 bytes where its head says 5"));
        one->connection->finish();
        loop_.run_until([&] { return one->connection.use_count() == 1; });
    }
}

TEST_F(DisplayTest, ServesTheNextClientAfterOneThatVanished) {
    {
        const auto one = ready_client(2);
        one->send(task(0, {left_, right_}));
        send_tile(0, 0, left_.region, 1);
    }
    EXPECT_EQ(servers_[0]->ending(), "");  // a Bye
    EXPECT_EQ(servers_[1]->ending(), "");
    const auto two = ready_client(1);
    two->send(task(0, {left_}));
    send_tile(0, 0, left_.region, 1);
    two->expect<DisplayReport>();
}

// Viewers.

TEST_F(DisplayTest, SaysWhereItsPageIsAndHowManyLook) {
    const auto plain = client();
    plain->send(DisplaySetup{kSession, PictureFormat::kNone, 2});
    EXPECT_EQ(plain->expect<Ready>().description, "");
    plain->connection->finish();
    view();
    const auto early = viewer();
    const auto one = client();
    one->send(DisplaySetup{kSession, PictureFormat::kNone, 2});
    EXPECT_EQ(one->expect<Ready>().description, viewers_->url());
    EXPECT_EQ(one->expect<Audience>(), Audience{1});
    const auto late = viewer();
    EXPECT_EQ(one->expect<Audience>(), Audience{2});
    early->close();
    EXPECT_EQ(one->expect<Audience>(), Audience{1});
}

TEST_F(DisplayTest, ShowsViewersThePicturesThatTheClientGets) {
    view();
    const auto looks = viewer();
    const auto one = ready_client(2, PictureFormat::kPng);
    EXPECT_EQ(one->expect<Audience>(), Audience{1});
    const std::string plan = R"({"type":"plan","tiles":[]})";
    one->send(Note{NoteTopic::kPlan, 0}, buffer_of(plan));
    one->send(task(0, {left_, right_}));
    send_tile(0, 0, left_.region, 0x060504);
    send_tile(1, 0, right_.region, 0x030201);
    one->expect<DisplayReport>();
    const std::string file(reinterpret_cast<const char*>(one->body.data()), one->body.size());
    EXPECT_THAT(next(*looks, "", false),
                testing::HasSubstr(R"("format":"jpeg","width":4,"height":2,"plan":)" + plan));
    const std::string exact = next(*looks, "", false);
    EXPECT_THAT(exact, testing::HasSubstr(R"({"frame":0,"stream":0,"format":"png")"));
    EXPECT_TRUE(exact.ends_with(file));
}

TEST_F(DisplayTest, PassesWishesAndNotesBetweenClientAndViewers) {
    view();
    const auto looks = viewer();
    const auto one = live_client();
    const std::string wish = R"({"type": "wish", "id": 3})";
    looks->send(wish);
    EXPECT_EQ(one->expect<Wish>(), Wish{1});
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(one->body.data()), one->body.size()), wish);
    one->send(Note{NoteTopic::kState, 0}, buffer_of(R"({"type":"state","wish":3})"));
    EXPECT_EQ(next(*looks, R"({"type":"state")"), R"({"type":"state","wish":3})");
}

TEST_F(DisplayTest, PassesTheNewestWishWhenTheClientHasTakenTheLastOne) {
    view();
    const auto looks = viewer();
    const auto one = live_client();
    for (int id = 1; id <= 5; ++id) looks->send(fmt::format(R"({{"type":"wish","id":{}}})", id));
    one->expect<Wish>();
    // Messages after a wish are not read before it.
    looks->send(R"({"type":"wish","id":6})");
    const auto second = viewer();
    EXPECT_EQ(one->expect<Audience>(), Audience{2});
    one->send(Note{NoteTopic::kState, 0}, buffer_of(R"({"type":"state"})"));
    for (std::string text; text.find(R"("id":6)") == std::string::npos;) {
        ASSERT_EQ(one->expect<Wish>(), Wish{1});
        text.assign(reinterpret_cast<const char*>(one->body.data()), one->body.size());
        one->send(Note{NoteTopic::kState, 0}, buffer_of(R"({"type":"state"})"));
    }
}

TEST_F(DisplayTest, EndsAClientWhoseNotesAreNone) {
    view();
    const auto looks = viewer();
    const auto early = client();
    early->send(Note{NoteTopic::kState, 0}, buffer_of("{}"));
    EXPECT_EQ(early->ending(), "Note before DisplaySetup");
    const auto one = ready_client(1);
    one->send(Note{NoteTopic::kState, 0}, buffer_of("{"));
    EXPECT_EQ(one->ending(), "Note: not a JSON object");
    const auto two = ready_client(1);
    two->send(Note{NoteTopic::kState, 0}, Buffer(kMaxNoteBytes + 1));
    EXPECT_EQ(two->ending(), "Note: 8388609 bytes, the limit is 8388608");
    EXPECT_EQ(looks->close_code(), std::nullopt);
}

TEST_F(DisplayTest, DropsNotesWhereNobodyCanLook) {
    const auto one = ready_client(1);
    one->send(Note{NoteTopic::kState, 0}, buffer_of("{}"));
    one->send(task(0, {}));
    one->expect<DisplayReport>();
}

TEST_F(DisplayTest, ViewersOutliveClientsThatVanishAndSeeTheNext) {
    view();
    const auto looks = viewer();
    for (const char* model : {"a", "b", "c"}) {
        const auto one = ready_client(1);
        const std::string note = fmt::format(R"({{"type":"session","model":"{}"}})", model);
        one->send(Note{NoteTopic::kSession, 0}, buffer_of(note));
        one->send(task(0, {left_}));
        send_tile(0, 0, left_.region, 1);
        one->expect<Audience>();
        one->expect<DisplayReport>();
        EXPECT_EQ(next(*looks, R"({"type":"session")"), note);
        looks->send(R"({"type": "wish"})");  // there may be no session to take it
        one->connection->close();
        loop_.run_until([&] { return viewers_->numbers().waiting_bytes == 0 && servers_[0]->closed; });
        EXPECT_EQ(next(*looks, R"({"type":"audience","you":1,"lead":1,"viewers":1,"session":false})").empty(),
                  false);
    }
}

}  // namespace
}  // namespace swath::test
