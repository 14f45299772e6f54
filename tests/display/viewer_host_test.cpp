// Viewers over real connections, and their session's side.
#include "display/view/viewer_host.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/web_client.h"
#include "tests/support/wire_peer.h"

namespace swath::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Buffer buffer_of(std::string_view text) {
    Buffer bytes;
    bytes.append(text.data(), text.size());
    return bytes;
}

// A picture that cannot be compressed.
std::shared_ptr<const Picture> noise(int width, int height, unsigned seed) {
    auto picture = std::make_shared<Picture>(Picture{width, height, {}});
    picture->rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::mt19937 random(seed);
    for (std::uint8_t& byte : picture->rgb) byte = static_cast<std::uint8_t>(random());
    return picture;
}

struct GotPicture {
    json head;
    std::string image;
};

class ViewerHostTest : public testing::Test {
  protected:
    void SetUp() override { start({}); }
    void TearDown() override { host_.reset(); }

    void start(const WebServer::Options& options) {
        host_.reset();
        auto made = ViewerHost::make(options, loop_.clock);
        ASSERT_TRUE(made.has_value()) << made.error().message;
        host_ = std::move(*made);
    }
    // Begins a session whose calls are kept in audiences_ and wishes_.
    std::uint32_t begin(bool live = true) {
        ViewerHost::Callbacks callbacks;
        callbacks.on_audience = [this](std::uint32_t viewers) { audiences_.push_back(viewers); };
        callbacks.on_wish = [this](ViewerId viewer, const std::string& wish) {
            wishes_.push_back(fmt::format("{}: {}", viewer, wish));
        };
        return host_->begin(live, loop_.io.get_executor(), std::move(callbacks));
    }
    std::unique_ptr<WebClient> viewer(const WebClient::Options& options = {}) const {
        auto made = WebClient::connect(host_->address(), options);
        EXPECT_TRUE(made.has_value()) << made.error().message;
        return made ? std::move(*made) : nullptr;
    }
    // The next text of that type, or null.
    static json next_text(WebClient& viewer, const std::string& type) {
        while (const auto message = viewer.next()) {
            if (!message->text) continue;
            json text = json::parse(message->bytes, nullptr, false);
            if (text.value("type", "") == type) return text;
        }
        ADD_FAILURE() << "no " << type << " came";
        return nullptr;
    }
    static GotPicture next_picture(WebClient& viewer) {
        while (const auto message = viewer.next()) {
            if (message->text) continue;
            const auto byte = [&](std::size_t i) {
                return std::size_t{static_cast<std::uint8_t>(message->bytes[i])};
            };
            if (message->bytes.size() < 4) break;
            const std::size_t head = byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
            if (message->bytes.size() < 4 + head) break;
            return {json::parse(message->bytes.substr(4, head), nullptr, false),
                    message->bytes.substr(4 + head)};
        }
        ADD_FAILURE() << "no picture came";
        return {};
    }
    static void show(WebClient& viewer, const GotPicture& picture) {
        viewer.send(json{{"type", "shown"},
                         {"frame", picture.head["frame"]},
                         {"stream", picture.head["stream"]},
                         {"format", picture.head["format"]}}
                        .dump());
    }
    // Waits until everything that `leader` has said is read: its last words get it disconnected, which the
    // other viewer sees.
    static void hear_out(WebClient& leader, WebClient& other) {
        leader.send("no JSON");
        while (next_text(other, "audience").value("lead", 0) != 2)
            if (other.close_code()) return;
    }
    static std::string encoded(const Picture& picture, PictureFormat format) {
        const Buffer bytes = encode(picture, format);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    Loop loop_;
    std::unique_ptr<ViewerHost> host_;
    std::vector<std::uint32_t> audiences_;
    std::vector<std::string> wishes_;
};

TEST_F(ViewerHostTest, SaysWhoLooksAndWhetherThereIsARun) {
    const auto one = viewer();
    EXPECT_EQ(one->next()->bytes, R"({"type":"audience","you":1,"lead":1,"viewers":1,"session":false})");
    EXPECT_EQ(begin(), 1u);
    EXPECT_EQ(one->next()->bytes, R"({"type":"audience","you":1,"lead":1,"viewers":1,"session":true})");
    const auto two = viewer();
    EXPECT_EQ(next_text(*two, "audience")["you"], 2);
    loop_.run_until([&] { return audiences_ == std::vector<std::uint32_t>{2}; });
    EXPECT_EQ(next_text(*one, "audience")["viewers"], 2);
    one->close();
    loop_.run_until([&] { return audiences_.size() == 2; });
    EXPECT_THAT(audiences_, ElementsAre(2, 1));
    EXPECT_EQ(next_text(*two, "audience")["lead"], 2);
}

TEST_F(ViewerHostTest, SendsPicturesWithTheirPlansAndThenWithoutLoss) {
    begin();
    const auto one = viewer();
    const auto picture = noise(33, 17, 1);
    ASSERT_TRUE(
        host_->note(NoteTopic::kPlan, 4, buffer_of(R"({"type":"plan","tiles":[[1,2]]})")).has_value());
    host_->announce(4);
    host_->picture(4, 0, picture);
    const GotPicture fast = next_picture(*one);
    EXPECT_EQ(fast.head, json::parse(R"({"frame":4,"stream":0,"format":"jpeg","width":33,"height":17,
                                        "plan":{"type":"plan","tiles":[[1,2]]}})"));
    EXPECT_EQ(fast.image, encoded(*picture, PictureFormat::kJpeg));
    const GotPicture exact = next_picture(*one);
    EXPECT_EQ(exact.head["format"], "png");
    EXPECT_EQ(exact.head["plan"], fast.head["plan"]);
    EXPECT_EQ(exact.image, encoded(*picture, PictureFormat::kPng));

    show(*one, exact);
    host_->picture(5, 1, picture);
    const GotPicture other = next_picture(*one);
    EXPECT_EQ(other.head,
              json::parse(R"({"frame":5,"stream":1,"format":"jpeg","width":33,"height":17,"plan":null})"));
}

TEST_F(ViewerHostTest, EncodesNothingWhileNobodyLooksAndKeepsOnlyTheNewest) {
    begin();
    std::vector<std::weak_ptr<const Picture>> all;
    for (FrameNumber frame = 0; frame < 10; ++frame) {
        auto picture = noise(64, 64, 1);
        all.emplace_back(picture);
        host_->announce(frame);
        host_->picture(frame, 0, std::move(picture));
    }
    EXPECT_EQ(host_->numbers().encoded, 0u);
    EXPECT_FALSE(all.back().expired());
    all.pop_back();
    for (const auto& picture : all) EXPECT_TRUE(picture.expired());
    const auto one = viewer();
    EXPECT_EQ(next_picture(*one).head["frame"], 9);
}

TEST_F(ViewerHostTest, PassesTheLeadersWishesOnAsTheyAre) {
    begin();
    const auto one = viewer();
    const auto two = viewer();
    next_text(*two, "audience");
    const std::string wish = R"({ "type" : "wish", "id" : 7, "camera" : [1, 2.50] })";
    two->send(R"({"type": "wish", "id": 1})");  // it does not lead
    two->send(R"({"type": "lead"})");
    EXPECT_EQ(next_text(*two, "audience")["lead"], 2);
    two->send(wish);
    loop_.run_until([&] { return !wishes_.empty(); });
    EXPECT_THAT(wishes_, ElementsAre("2: " + wish));
    one->send(R"({"type": "wish", "id": 2})");
    one->send(R"({"type": "lead"})");
    EXPECT_EQ(next_text(*two, "audience")["lead"], 1);
    one->send(R"({"type": "wish", "id": 3})");
    loop_.run_until([&] { return wishes_.size() == 2; });
    EXPECT_EQ(wishes_.back(), R"(1: {"type": "wish", "id": 3})");
}

TEST_F(ViewerHostTest, TheNewestWishCountsForASessionThatIsBusy) {
    begin();
    const auto one = viewer();
    next_text(*one, "audience");
    const auto two = viewer();
    for (int i = 0; i < 100; ++i) one->send(fmt::format(R"({{"type": "wish", "id": {}}})", i));
    hear_out(*one, *two);
    loop_.run_until([&] { return !wishes_.empty(); });
    loop_.io.poll();
    EXPECT_THAT(wishes_, ElementsAre(R"(1: {"type": "wish", "id": 99})"));
}

TEST_F(ViewerHostTest, TakesNoWishesForARunThatIsNotLive) {
    begin(false);
    const auto one = viewer();
    next_text(*one, "audience");
    const auto two = viewer();
    one->send(R"({"type": "wish", "id": 1})");
    hear_out(*one, *two);
    loop_.run_until([&] { return !audiences_.empty() && audiences_.back() == 1; });
    loop_.io.poll();
    EXPECT_THAT(wishes_, IsEmpty());
}

TEST_F(ViewerHostTest, RefusesNotesThatAreNoJsonObjects) {
    begin();
    const auto one = viewer();
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("[]"), std::string("1"), std::string("{} {}"),
          std::string("{\"a\":\"\xff\"}"), std::string(100'000, '[')}) {
        const auto status = host_->note(NoteTopic::kState, 0, buffer_of(text));
        ASSERT_FALSE(status.has_value()) << text.substr(0, 100);
        EXPECT_EQ(status.error().message, "Note: not a JSON object");
    }
    std::string large = R"({"type":"state"})";
    large.resize(kMaxNoteBytes + 1, ' ');
    EXPECT_EQ(host_->note(NoteTopic::kState, 0, buffer_of(large)).error().message,
              "Note: 8388609 bytes, the limit is 8388608");
    large.pop_back();
    EXPECT_TRUE(host_->note(NoteTopic::kState, 0, buffer_of(large)).has_value());
    EXPECT_EQ(next_text(*one, "state"), json::parse(R"({"type":"state"})"));
}

TEST_F(ViewerHostTest, ViewersStayFromOneSessionToTheNext) {
    begin();
    const auto one = viewer();
    ASSERT_TRUE(
        host_->note(NoteTopic::kSession, 0, buffer_of(R"({"type":"session","model":"a"})")).has_value());
    host_->picture(0, 0, noise(8, 8, 1));
    EXPECT_EQ(next_text(*one, "session")["model"], "a");
    host_->end();
    EXPECT_EQ(next_text(*one, "audience")["session"], false);
    EXPECT_EQ(begin(), 1u);
    EXPECT_EQ(next_text(*one, "audience")["session"], true);
    const auto picture = noise(8, 8, 2);
    host_->picture(0, 0, picture);
    EXPECT_EQ(next_picture(*one).image, encoded(*picture, PictureFormat::kJpeg));
    const auto two = viewer();
    next_picture(*two);
    host_->end();
    EXPECT_EQ(next_text(*two, "audience")["session"], false);
}

TEST_F(ViewerHostTest, AViewerThatNeverReadsCostsBoundedMemoryAndSlowsNobody) {
    begin();
    WebClient::Options little;
    little.receive_buffer_bytes = 4096;
    const auto stalled = viewer(little);
    const auto good = viewer();
    loop_.run_until([&] { return !audiences_.empty() && audiences_.back() == 2; });
    const std::string note = fmt::format(R"({{"type":"frame","fill":"{}"}})", std::string(200'000, 'x'));
    const auto picture = noise(600, 400, 1);
    for (FrameNumber frame = 0; frame < 100; ++frame) {
        host_->announce(frame);
        host_->picture(frame, 0, picture);
        ASSERT_TRUE(host_->note(NoteTopic::kFrame, frame, buffer_of(note)).has_value());
        // On a slow machine the picture before comes as PNG first.
        GotPicture got;
        do {
            got = next_picture(*good);
            ASSERT_TRUE(got.head.is_object());
            show(*good, got);
        } while (got.head["frame"] != frame);
        EXPECT_LE(host_->numbers().waiting_bytes, 2 * Viewers::kMaxFrameNotes * note.size() + 2'000'000);
    }
    EXPECT_GT(host_->numbers().waiting_bytes, 10 * note.size());  // it does stall
    stalled->close();
    loop_.run_until([&] { return audiences_.back() == 1; });
}

TEST_F(ViewerHostTest, AViewerThatTakesNothingIsDisconnectedHoweverMuchItSays) {
    WebServer::Options options;
    options.limits.silence = std::chrono::milliseconds(200);
    start(options);
    begin();
    WebClient::Options little;
    little.receive_buffer_bytes = 4096;
    const auto stalled = viewer(little);
    const std::string note = fmt::format(R"({{"type":"frame","fill":"{}"}})", std::string(1'000'000, 'x'));
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(host_->note(NoteTopic::kFrame, 0, buffer_of(note)).has_value());
    const Nanoseconds deadline = loop_.clock.now() + std::chrono::seconds(10);
    while (stalled->send(R"({"type": "lead"})") && loop_.clock.now() < deadline) {
    }
    EXPECT_LT(loop_.clock.now(), deadline);
    loop_.run_until([&] { return !audiences_.empty() && audiences_.back() == 0; });
    EXPECT_EQ(host_->numbers().waiting_bytes, 0u);
}

TEST_F(ViewerHostTest, AViewerThatHasFallenSilentIsDisconnected) {
    WebServer::Options options;
    options.limits.silence = std::chrono::milliseconds(200);
    start(options);
    begin();
    const auto silent = viewer();  // it reads nothing, so it does not answer pings
    loop_.run_until([&] { return audiences_ == std::vector<std::uint32_t>{1, 0}; });
    EXPECT_THAT(audiences_, ElementsAre(1, 0));
}

TEST_F(ViewerHostTest, EndsWhileViewersAreThereAndPicturesAreEncoded) {
    for (int i = 0; i < 5; ++i) {
        start({});
        begin();
        const auto one = viewer();
        one->next();
        host_->picture(0, 0, noise(500, 500, 1));
        host_.reset();
        while (one->next()) {
        }
        EXPECT_TRUE(one->close_code().has_value());
    }
}

}  // namespace
}  // namespace swath::test
