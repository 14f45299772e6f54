#include <gmock/gmock.h>

#include <numeric>

#include "tests/common/image/frames.h"
#include "tests/server/server_fixture.h"

// Frames: what a task sends out, and what clients and servers may not send.

namespace swath::test {
namespace {

using testing::MatchesRegex;

// The pixels of another server: flat rectangles.
struct Pixels {
    BodySizes sizes;
    Buffer body;
};
Pixels rectangles(const Region& region, float depth, ObjectId id, std::uint32_t colour) {
    Rect rect;
    for (const Rect& r : region) rect = bounding(rect, r);
    PixelFrame frame;
    frame.reshape(rect);
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            *frame.colour(x, y) = 0xff000000 | colour;
            *frame.depth(x, y) = depth;
            *frame.id(x, y) = id;
        }
    Pixels made;
    made.sizes = encode_swath(frame, region, made.body);
    return made;
}
Pixels rectangle(const Rect& rect, float depth, ObjectId id, std::uint32_t colour) {
    return rectangles({rect}, depth, id, colour);
}

class ServerFrames : public ServerTest {
  protected:
    // The red of every pixel of the next tile, which must be of `frame`, as 4 rows of 8 digits, bottom-up.
    std::string tile(FrameNumber frame, const Region& region) {
        const TilePixels pixels = display_->expect<TilePixels>();
        EXPECT_EQ(pixels.frame, frame);
        Picture picture;
        fill(picture, 8, 4, {});
        const Status status = assemble_tile(display_->body.bytes(), pixels.sizes, region, picture);
        EXPECT_TRUE(status.has_value()) << status.error().message;
        std::string text;
        for (std::size_t i = 0; i < 32; ++i) {
            text += static_cast<char>('0' + picture.rgb[3 * i]);
            if (i % 8 == 7) text += ' ';
        }
        return text;
    }
    // Server 0 of 2 draws the left five columns, owns the left four, and awaits two columns from server 1.
    RenderFrame shared_task(FrameNumber frame) const {
        RenderFrame made = task(frame);
        made.content = {0, 0, 5, 4};
        made.final_region = {{0, 0, 4, 4}};
        made.outgoing = {{server_id(1), {{4, 0, 5, 4}}}};
        made.incoming = {{server_id(1), {{2, 0, 4, 4}}}};
        return made;
    }
    void send_swath(FrameNumber frame, const Pixels& pixels) {
        Buffer body;
        body.append(pixels.body.data(), pixels.body.size());
        others_[1]->send(SwathPixels{frame, pixels.sizes}, std::move(body));
    }
};

TEST_F(ServerFrames, OfOneServerGoToTheDisplayAndAreReported) {
    const auto client = connected_client();
    client->send(task(3));
    EXPECT_EQ(tile(3, {{0, 0, 8, 4}}), "11111111 11111111 11111111 11111111 ");
    ServerReport report = client->expect<ServerReport>();
    EXPECT_EQ(report.frame, 3u);
    EXPECT_EQ(report[Counter::kObjects], objects_);
    EXPECT_EQ(report[Counter::kTriangles], 12u);
    EXPECT_EQ(report[Counter::kLeaves], objects_);
    EXPECT_EQ(report.visible.size(), objects_);
    EXPECT_EQ(std::accumulate(report.visible.begin(), report.visible.end(), 0u), 12u);
    EXPECT_EQ(report[Counter::kTilePixels], 32u);
    EXPECT_EQ(report[Counter::kSwapPixels], 0u);
    Nanoseconds end{0};
    for (const Span& span : report.spans) {
        EXPECT_GE(span.begin, end);  // one after another
        end = span.end;
    }
}

TEST_F(ServerFrames, HaveOnlyTheObjectsOfTheirGroup) {
    const auto client = connected_client();
    RenderFrame some = task(0);
    some.group = {1};
    client->send(some);
    EXPECT_EQ(tile(0, some.final_region), "22222222 22222222 22222222 22222222 ");
    RenderFrame none = task(1);
    none.group.clear();
    client->send(none);
    EXPECT_EQ(tile(1, none.final_region), "00000000 00000000 00000000 00000000 ");
}

TEST_F(ServerFrames, AreSwappedAndMergedByDepthThenId) {
    const auto client = connected_client(0, 2);
    client->send(shared_task(0));
    const SwathPixels sent = others_[1]->expect<SwathPixels>();
    EXPECT_EQ(sent.sizes.pixels, 4u);
    send_swath(0, rectangle({2, 0, 4, 4}, 0.25f, 1, 7));  // nearer
    EXPECT_EQ(tile(0, {{0, 0, 4, 4}}), "11770000 11770000 11770000 11770000 ");
    ServerReport report = client->expect<ServerReport>();
    EXPECT_EQ(report[Counter::kReceivedPixels], 8u);
    EXPECT_EQ(report[Counter::kSwapPixels], 4u);

    RenderFrame second = shared_task(1);
    second.group = {1};
    send_swath(1, rectangle({2, 0, 4, 4}, 0.5f, 0, 7));  // before the task; as near, with a smaller id
    client->send(second);
    EXPECT_EQ(tile(1, {{0, 0, 4, 4}}), "22770000 22770000 22770000 22770000 ");
    client->expect<ServerReport>();

    client->send(shared_task(2));
    send_swath(2, rectangle({2, 0, 4, 4}, 0.5f, 1, 7));  // as near, with a larger id
    EXPECT_EQ(tile(2, {{0, 0, 4, 4}}), "11110000 11110000 11110000 11110000 ");
}

TEST_F(ServerFrames, MayConsistOfWhatOthersDraw) {
    const auto client = connected_client(0, 2);
    RenderFrame idle = task(0);
    idle.group.clear();
    idle.content = {};
    idle.final_region = {{1, 1, 3, 3}};
    idle.incoming = {{server_id(1), {{1, 1, 2, 2}}}};
    client->send(idle);
    send_swath(0, rectangle({1, 1, 2, 2}, 0.5f, 0, 5));
    EXPECT_EQ(tile(0, idle.final_region), "00000000 05000000 00000000 00000000 ");
}

TEST_F(ServerFrames, OverlapWithTheOnesBefore) {
    const auto client = connected_client(0, 2);
    client->send(shared_task(0));
    client->send(shared_task(1));
    others_[1]->expect<SwathPixels>();
    others_[1]->expect<SwathPixels>();
    send_swath(1, rectangle({2, 0, 4, 4}, 0.25f, 1, 7));
    EXPECT_EQ(client->expect<ServerReport>().frame, 1u);
    send_swath(0, rectangle({2, 0, 4, 4}, 0.25f, 1, 7));
    EXPECT_EQ(client->expect<ServerReport>().frame, 0u);
}

// In debug and sanitizer builds every pixel that is touched is checked against the frame that it is in.
TEST_F(ServerFrames, KeepToTheirPixelsWhateverTheRegions) {
    const auto client = connected_client(0, 2);
    Random random(3);
    const auto some_rect = [&] {
        const int x = below(random, 8);
        const int y = below(random, 4);
        return Rect{x, y, x + 1 + below(random, 8 - x), y + 1 + below(random, 4 - y)};
    };
    for (FrameNumber number = 0; number < 100; ++number) {
        RenderFrame made = task(number);
        made.content = below(random, 5) == 0 ? Rect{} : some_rect();
        made.final_region = below(random, 5) == 0 ? Region{} : random_region(some_rect(), random);
        Rect cover = made.content;
        for (const Rect& r : made.final_region) cover = bounding(cover, r);
        const Region outgoing = made.content.empty() ? Region{} : random_region(made.content, random);
        const Region incoming = cover.empty() ? Region{} : random_region(cover, random);
        if (!outgoing.empty()) made.outgoing = {{server_id(1), outgoing}};
        if (!incoming.empty()) made.incoming = {{server_id(1), incoming}};
        client->send(made);
        if (!incoming.empty()) send_swath(number, rectangles(incoming, 0.25f, 0, 7));

        ServerReport report = client->expect<ServerReport>();
        ASSERT_EQ(report.frame, number);
        const bool draws = report[Counter::kObjects] > 0;  // nothing covers some contents
        if (!outgoing.empty()) {
            const std::uint32_t sent = others_[1]->expect<SwathPixels>().sizes.pixels;
            ASSERT_EQ(sent, draws ? area(outgoing) : 0) << number;
        }
        if (made.final_region.empty()) continue;
        std::uint32_t active = 0;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 8; ++x)
                active += inside(made.final_region, x, y) &&
                                  ((draws && inside({made.content}, x, y)) || inside(incoming, x, y))
                              ? 1u
                              : 0u;
        ASSERT_EQ(display_->expect<TilePixels>().sizes.pixels, active) << number;
    }
}

TEST_F(ServerFrames, OfImpossibleTasksAreRefused) {
    const auto ending_after = [&](const std::function<void(RenderFrame&)>& change) {
        const auto client = connected_client(0, 2);
        RenderFrame bad = shared_task(4);
        change(bad);
        client->send(bad);
        return client->ending();
    };
    const std::string unknown = ending_after([&](RenderFrame& m) {
        m.group = {0, static_cast<ObjectId>(objects_)};
    });
    EXPECT_EQ(unknown, fmt::format("RenderFrame: object {}, this model has {}", objects_, objects_));
    EXPECT_EQ(ending_after([](RenderFrame& m) { m.incoming[0].server = server_id(2); }),
              "RenderFrame: an exchange with server 2");
    EXPECT_EQ(ending_after([](RenderFrame& m) { m.outgoing[0].server = server_id(0); }),
              "RenderFrame: an exchange with server 0");
    EXPECT_EQ(ending_after([](RenderFrame& m) {
                  m.incoming[0].region = {{5, 0, 6, 1}};
              }),
              "a garbled render_frame message: incoming: a rectangle outside the content and final region");
}

TEST_F(ServerFrames, MustComeInOrderAndNotTooMany) {
    const auto one = connected_client(0, 2);
    one->send(shared_task(4));
    one->send(shared_task(4));
    EXPECT_EQ(one->ending(), "frame 4 is announced after frame 4");
    const auto two = connected_client(0, 2);
    for (FrameNumber frame = 0; frame < 3; ++frame) two->send(shared_task(frame));
    EXPECT_EQ(two->ending(), "frame 2: more than 2 frames in flight");
}

TEST_F(ServerFrames, ThatCannotBeDrawnEndTheSession) {
    const auto client = connected_client();
    RenderFrame unlucky = task(0);
    unlucky.view.height = 13;
    client->send(unlucky);
    EXPECT_EQ(client->ending(), "13 rows bring bad luck");
}

TEST_F(ServerFrames, ThatNobodyAnnouncedEndTheSessionAndNameTheServer) {
    const auto client = connected_client(0, 2);
    for (FrameNumber frame = 7; frame < 10; ++frame) send_swath(frame, rectangle({2, 0, 4, 4}, 0.25f, 1, 7));
    EXPECT_EQ(others_[1]->ending(), "pixels for frame 9, more than 2 frames ahead");
    EXPECT_EQ(client->expect<Lost>(), (Lost{server_id(1), "pixels for frame 9, more than 2 frames ahead"}));
}

TEST_F(ServerFrames, WithGarbledPixelsEndTheSessionAndNameTheServer) {
    const auto said_after = [&](bool before_task) -> std::string {
        const auto client = connected_client(0, 2);
        Pixels garbled = rectangle({2, 0, 4, 4}, 0.25f, static_cast<ObjectId>(objects_), 7);
        if (before_task) send_swath(0, garbled);
        client->send(shared_task(0));
        others_[1]->expect<SwathPixels>();
        if (!before_task) send_swath(0, garbled);
        loop_.run_until([&] { return !client->inbox.empty() || client->closed; });
        if (client->inbox.empty()) return client->ending();
        const Lost lost = client->expect<Lost>();
        EXPECT_EQ(lost.server, server_id(1));
        return lost.why;
    };
    const std::string line = "garbled pixels from server 1: ids: object [0-9]+, the limit is [0-9]+";
    EXPECT_THAT(said_after(true), MatchesRegex(line));
    EXPECT_THAT(said_after(false), MatchesRegex(line));
}

TEST_F(ServerFrames, TakeNothingButPixelsFromServersAndNothingFromTheDisplay) {
    const auto one = connected_client(0, 2);
    others_[1]->send(Connect{});
    EXPECT_EQ(others_[1]->ending(), "Connect is not expected from a server");
    EXPECT_EQ(one->expect<Lost>(), (Lost{server_id(1), "Connect is not expected from a server"}));
    one->connection->finish();
    EXPECT_EQ(display_->ending(), "");
    const auto two = connected_client(0, 2);
    display_->send(Connect{});
    EXPECT_THAT(two->ending(),
                MatchesRegex("lost the display at .*: Connect is not expected from a display"));
}

}  // namespace
}  // namespace swath::test
