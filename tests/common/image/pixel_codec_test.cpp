#include "common/image/pixel_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "common/base/check.h"
#include "tests/common/image/frames.h"

namespace swath {
namespace {

using namespace test;

std::vector<std::uint8_t> bytes_of(const Buffer& body) { return {body.bytes().begin(), body.bytes().end()}; }

Rect random_rect(Random& random, int width) {
    const int x = below(random, 50);
    const int y = below(random, 50);
    return {x, y, x + width, y + 1 + below(random, 9)};
}

void composite(const PixelFrame& from, const Region& region, PixelFrame& to) {
    Buffer body;
    const BodySizes sizes = encode_swath(from, region, body);
    const Status status = composite_swath(body.bytes(), sizes, region, kObjectLimit, to);
    ASSERT_TRUE(status.has_value()) << status.error().message;
}

// The example of docs/wire.md.
class WorkedExample : public testing::Test {
  protected:
    WorkedExample() {
        frame_.reshape({0, 0, 16, 8});
        frame_.clear(frame_.rect());
        put(frame_, 9, 4, {0xff102030, 0.5f, 300});
        put(frame_, 10, 4, {0xff112131, 0.25f, 300});
        put(frame_, 11, 5, {0xffc0b0a0, 0.75f, 5});
        put(frame_, 12, 4, {0xffffffff, 0.5f, 9});  // outside of the region
    }
    const Region region_{{8, 4, 12, 6}};
    PixelFrame frame_;
};

TEST_F(WorkedExample, OfASwathHasTheseBytes) {
    Buffer body;
    EXPECT_EQ(encode_swath(frame_, region_, body), (BodySizes{3, 6, 6}));
    EXPECT_EQ(bytes_of(body), (std::vector<std::uint8_t>{
                                  0x00, 0x00, 0x00, 0x3f, 0x00, 0x00, 0x80, 0x3e, 0x00,
                                  0x00, 0x40, 0x3f, 0x30, 0x20, 0x10, 0x31, 0x21, 0x11,
                                  0xa0, 0xb0, 0xc0, 0x01, 0x01, 0x02,  // row 4: one span, 1 skipped, 2 pixels
                                  0x01, 0x03, 0x01,                    // row 5: one span, 3 skipped, 1 pixel
                                  0x02, 0xd8, 0x04,                    // 2 of object 0 + 300
                                  0x01, 0xcd, 0x04,                    // 1 of object 300 - 295
                              }));
}

TEST_F(WorkedExample, OfATileHasTheseBytes) {
    Buffer body;
    EXPECT_EQ(encode_tile(frame_, region_, body), (BodySizes{3, 6, 0}));
    EXPECT_EQ(bytes_of(body),
              (std::vector<std::uint8_t>{0x30, 0x20, 0x10, 0x31, 0x21, 0x11, 0xa0, 0xb0, 0xc0,  //
                                         0x01, 0x01, 0x02, 0x01, 0x03, 0x01}));
}

TEST(Swath, ThatIsCompositedEqualsMergingPixelByPixel) {
    Random random(1);
    for (int round = 0; round < 400; ++round) {
        // Widths around the number that the span search treats together, and a single column.
        const int width = 1 + (round % 5 == 0 ? 0 : below(random, 70));
        const Rect rect = random_rect(random, width);
        const PixelFrame theirs = random_frame(rect, random, round % 4);
        PixelFrame ours = random_frame(rect, random, below(random, 4));
        PixelFrame expected = copy(ours);
        const Region region = random_region(rect, random);
        merge_by_hand(theirs, region, expected);
        composite(theirs, region, ours);
        ASSERT_EQ(pixels(ours), pixels(expected)) << "round " << round;
    }
}

TEST(Swath, GoesBetweenFramesThatCoverDifferentRectangles) {
    Random random(2);
    const PixelFrame theirs = random_frame({10, 20, 40, 30}, random, 1);
    PixelFrame ours = random_frame({0, 0, 25, 25}, random, 0);
    const Region region{{10, 20, 25, 25}};
    composite(theirs, region, ours);
    EXPECT_EQ(pixel(ours, 10, 20), pixel(theirs, 10, 20));
    EXPECT_EQ(pixel(ours, 24, 24), pixel(theirs, 24, 24));
    EXPECT_EQ(pixel(ours, 9, 20), Pixel{});
}

TEST(Swath, CostsSevenBytesAPixelAndItsSpansAndIds) {
    Random random(3);
    for (int round = 0; round < 100; ++round) {
        const Rect rect = random_rect(random, 1 + below(random, 60));
        const PixelFrame frame = random_frame(rect, random, round % 4);
        std::uint32_t active = 0;
        std::uint32_t spans = 0;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                if (pixel(frame, x, y) == Pixel{}) continue;
                ++active;
                if (x == rect.x0 || pixel(frame, x - 1, y) == Pixel{}) ++spans;
            }
        Buffer body;
        const BodySizes sizes = encode_swath(frame, {rect}, body);
        EXPECT_EQ(sizes.pixels, active);
        // All numbers of rows this short take a byte.
        EXPECT_EQ(sizes.span_bytes, static_cast<std::uint32_t>(rect.height()) + 2 * spans);
        EXPECT_EQ(body.size(), 7 * active + sizes.span_bytes + sizes.id_bytes);
        Buffer tile;
        EXPECT_EQ(encode_tile(frame, {rect}, tile), (BodySizes{active, sizes.span_bytes, 0}));
        EXPECT_EQ(tile.size(), 3 * active + sizes.span_bytes);
    }
}

TEST(Swath, OfOneObjectSendsItsIdOnce) {
    PixelFrame frame;
    frame.reshape({0, 0, 100, 100});
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) put(frame, x, y, {0xff000001, 0.5f, 299});
    Buffer body;
    // 10,000 takes two bytes, and so does 2 * 299.
    EXPECT_EQ(encode_swath(frame, {frame.rect()}, body).id_bytes, 4u);
}

TEST(Swath, CarriesEveryObjectIdThereCanBe) {
    const std::vector<ObjectId> ids{0, 1, 63, 64, 8191, 1u << 28, kMaxObjects - 1, 0, kMaxObjects - 1, 5};
    PixelFrame frame;
    frame.reshape({0, 0, static_cast<int>(ids.size()), 1});
    for (std::size_t i = 0; i < ids.size(); ++i)
        put(frame, static_cast<int>(i), 0, {0xff000007, 0.5f, ids[i]});
    Buffer body;
    const BodySizes sizes = encode_swath(frame, {frame.rect()}, body);
    PixelFrame back;
    back.reshape(frame.rect());
    back.clear(back.rect());
    ASSERT_TRUE(composite_swath(body.bytes(), sizes, {frame.rect()}, kMaxObjects, back).has_value());
    EXPECT_EQ(pixels(back), pixels(frame));
}

TEST(Swath, WithoutActivePixelsIsACountARow) {
    Random random(4);
    const PixelFrame frame = random_frame({0, 0, 33, 5}, random, 0);
    Buffer body;
    EXPECT_EQ(encode_swath(frame, {frame.rect()}, body), (BodySizes{0, 5, 0}));
    EXPECT_EQ(encode_swath(frame, {}, body), (BodySizes{}));
    EXPECT_EQ(body.size(), 0u);
    PixelFrame ours = copy(frame);
    composite(frame, {}, ours);
}

TEST(Swath, MustLieInTheFrame) {
    PixelFrame frame;
    frame.reshape({0, 0, 4, 4});
    frame.clear(frame.rect());
    Buffer body;
    EXPECT_THROW(encode_swath(frame, {{0, 0, 5, 4}}, body), CheckFailed);
    EXPECT_THROW(encode_tile(frame, {{-1, 0, 4, 4}}, body), CheckFailed);
    PixelFrame larger;
    larger.reshape({0, 0, 5, 4});
    larger.clear(larger.rect());
    const BodySizes sizes = encode_swath(larger, {larger.rect()}, body);
    EXPECT_THROW((void)composite_swath(body.bytes(), sizes, {larger.rect()}, kObjectLimit, frame),
                 CheckFailed);
    Picture picture;
    fill(picture, 4, 4, {});
    const BodySizes tile = encode_tile(larger, {larger.rect()}, body);
    EXPECT_THROW((void)assemble_tile(body.bytes(), tile, {larger.rect()}, picture), CheckFailed);
}

TEST(Composite, OfEqualDepthsKeepsTheSmallerIdInBothOrders) {
    PixelFrame low;
    low.reshape({0, 0, 1, 1});
    put(low, 0, 0, {0xff000111, 0.5f, 3});
    PixelFrame high = copy(low);
    put(high, 0, 0, {0xff000222, 0.5f, 4});
    PixelFrame first = copy(low);
    composite(high, {low.rect()}, first);
    EXPECT_EQ(pixel(first, 0, 0), (Pixel{0xff000111, 0.5f, 3}));
    PixelFrame second = copy(high);
    composite(low, {low.rect()}, second);
    EXPECT_EQ(pixel(second, 0, 0), (Pixel{0xff000111, 0.5f, 3}));
}

TEST(Composite, DoesNotDependOnTheOrderOfPeers) {
    Random random(5);
    for (int round = 0; round < 100; ++round) {
        const Rect rect = random_rect(random, 1 + below(random, 60));
        std::vector<PixelFrame> peers;
        const std::size_t count = 3 + random() % 3;
        for (std::size_t i = 0; i < count; ++i) peers.push_back(random_frame(rect, random, below(random, 4)));
        std::vector<std::size_t> order(count);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::vector<Pixel> expected;
        do {
            PixelFrame frame = copy(peers[order[0]]);
            for (std::size_t i = 1; i < count; ++i) composite(peers[order[i]], {rect}, frame);
            if (expected.empty()) expected = pixels(frame);
            ASSERT_EQ(pixels(frame), expected) << "round " << round;
        } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST(Tile, WritesActivePixelsIntoThePictureAndNothingElse) {
    Random random(6);
    for (int round = 0; round < 200; ++round) {
        const Rect rect{0, 0, 1 + below(random, 60), 1 + below(random, 9)};
        const PixelFrame frame = random_frame(rect, random, round % 4);
        const Region region = random_region(rect, random);
        Buffer body;
        const BodySizes sizes = encode_tile(frame, region, body);
        Picture picture;
        fill(picture, rect.width(), rect.height(), {9, 8, 7});
        PixelFrame visible = copy(frame);
        for (int y = 0; y < rect.y1; ++y)
            for (int x = 0; x < rect.x1; ++x)
                if (!inside(region, x, y)) visible.clear({x, y, x + 1, y + 1});
        const Status status = assemble_tile(body.bytes(), sizes, region, picture);
        ASSERT_TRUE(status.has_value()) << status.error().message;
        ASSERT_EQ(picture, to_picture(visible, {9, 8, 7})) << "round " << round;
    }
}

TEST(ToPicture, ShowsTheBackgroundWhereNothingIsActive) {
    PixelFrame frame;
    frame.reshape({0, 0, 2, 1});
    put(frame, 0, 0, {0xff030201, 0.5f, 0});
    put(frame, 1, 0, {0xffffffff, kFarDepth, 0});
    EXPECT_EQ(to_picture(frame, {10, 20, 30}), (Picture{2, 1, {1, 2, 3, 10, 20, 30}}));
}

}  // namespace
}  // namespace swath
