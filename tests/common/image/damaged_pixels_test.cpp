#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "tests/common/image/frames.h"

// Pixels from a peer may be any bytes: they are refused with a line that says why, or they are pixels.

namespace swath {
namespace {

using namespace test;
using testing::HasSubstr;

struct SpanEntry {
    std::uint32_t skipped, length;
};
struct IdRun {
    std::uint32_t length;
    std::int64_t step;
};

// A body written by hand, so that it can lie.
class Body {
  public:
    Body& pixel(float depth = 0.5f) {
        depths_.push_back(depth);
        return *this;
    }
    Body& row(const std::vector<SpanEntry>& spans) {
        varint(spans_, spans.size());
        for (const SpanEntry& s : spans) {
            varint(spans_, s.skipped);
            varint(spans_, s.length);
        }
        return *this;
    }
    Body& ids(const std::vector<IdRun>& runs) {
        for (const IdRun& r : runs) {
            varint(ids_, r.length);
            varint(ids_, static_cast<std::uint64_t>((r.step << 1) ^ (r.step >> 63)));
        }
        return *this;
    }
    Body& span_bytes(const std::vector<std::uint8_t>& bytes) {
        spans_.insert(spans_.end(), bytes.begin(), bytes.end());
        return *this;
    }
    Body& id_bytes(const std::vector<std::uint8_t>& bytes) {
        ids_.insert(ids_.end(), bytes.begin(), bytes.end());
        return *this;
    }

    // Composites the body; returns the error, or "" for success. The default region has two rows of four
    // pixels.
    std::string composited(const Region& region = {{2, 1, 6, 3}}) const {
        Buffer body;
        const std::vector<std::uint8_t> colours(3 * depths_.size(), 77);
        body.append(depths_.data(), 4 * depths_.size());
        body.append(colours.data(), colours.size());
        body.append(spans_.data(), spans_.size());
        body.append(ids_.data(), ids_.size());
        PixelFrame frame;
        frame.reshape({0, 0, 8, 4});
        frame.clear(frame.rect());
        const Status status = composite_swath(body.bytes(), sizes(), region, kObjectLimit, frame);
        return status ? "" : status.error().message;
    }
    std::string assembled() const {
        Buffer body(3 * depths_.size());
        std::fill(body.data(), body.data() + body.size(), std::uint8_t{77});
        body.append(spans_.data(), spans_.size());
        body.append(ids_.data(), ids_.size());
        Picture picture;
        fill(picture, 8, 4, {});
        const Status status = assemble_tile(body.bytes(), sizes(), {{2, 1, 6, 3}}, picture);
        return status ? "" : status.error().message;
    }

  private:
    BodySizes sizes() const {
        return {static_cast<std::uint32_t>(depths_.size()), static_cast<std::uint32_t>(spans_.size()),
                static_cast<std::uint32_t>(ids_.size())};
    }
    static void varint(std::vector<std::uint8_t>& out, std::uint64_t value) {
        for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::uint8_t>(value | 0x80));
        out.push_back(static_cast<std::uint8_t>(value));
    }
    std::vector<float> depths_;
    std::vector<std::uint8_t> spans_;
    std::vector<std::uint8_t> ids_;
};

Body three_pixels() { return Body().pixel().pixel().pixel(); }
Body with_spans(const std::vector<SpanEntry>& row1, const std::vector<SpanEntry>& row2) {
    return three_pixels().row(row1).row(row2).ids({{3, 0}});
}

TEST(DamagedSwath, IsNotWhatThisTestWritesByHand) {
    EXPECT_EQ(with_spans({{0, 2}}, {{3, 1}}).composited(), "");
    EXPECT_EQ(with_spans({{0, 1}, {0, 1}}, {{3, 1}}).composited(), "");  // spans may touch
}

TEST(DamagedSwath, HasADepthThatIsNone) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float depth : {1.0f, 2.0f, -0.0f, -0.5f, nan, -nan, std::numeric_limits<float>::infinity()})
        EXPECT_EQ(Body().pixel(depth).row({{0, 1}}).row({}).ids({{1, 0}}).composited(),
                  "depths: a value outside [0, 1)")
            << depth;
}

TEST(DamagedSwath, HasSpansThatAreNone) {
    const std::string in = " skipped in a row of 4";
    EXPECT_EQ(with_spans({{0, 0}, {0, 2}}, {{3, 1}}).composited(), "spans: 0 pixels after 0 and 0" + in);
    EXPECT_EQ(with_spans({{3, 2}}, {{3, 1}}).composited(), "spans: 2 pixels after 0 and 3" + in);
    EXPECT_EQ(with_spans({{4, 1}}, {{3, 1}}).composited(), "spans: 1 pixels after 0 and 4" + in);
    EXPECT_EQ(with_spans({{0, 2}, {2, 1}}, {}).composited(), "spans: 1 pixels after 2 and 2" + in);
    EXPECT_EQ(with_spans({{0, 2}, {0xffffffff, 1}}, {}).composited(),
              "spans: 1 pixels after 2 and 4294967295" + in);
    EXPECT_EQ(with_spans({{0, 2}, {1, 0xffffffff}}, {}).composited(),
              "spans: 4294967295 pixels after 2 and 1" + in);
}

TEST(DamagedSwath, HasMoreOrFewerSpansThanPixels) {
    EXPECT_EQ(with_spans({{0, 4}}, {}).composited(), "spans: more pixels than the 3 announced");
    EXPECT_EQ(with_spans({{0, 2}}, {{0, 2}}).composited(), "spans: more pixels than the 3 announced");
    EXPECT_EQ(with_spans({{0, 2}}, {}).composited(), "spans: 2 pixels where 3 were announced");
    EXPECT_EQ(with_spans({{0, 3}}, {}).row({}).composited(), "spans: 1 bytes too many");
    const Body row1 = three_pixels().row({{0, 3}}).ids({{3, 0}});
    EXPECT_EQ(row1.composited(), "spans: the table ends in row 2");
    for (const std::vector<std::uint8_t>& bytes : std::vector<std::vector<std::uint8_t>>{
             {1}, {1, 0}, {0x80}, {0x81, 0x80}, {0xff, 0xff, 0xff, 0xff, 0x0f}})
        EXPECT_EQ(Body(row1).span_bytes(bytes).composited(), "spans: the table ends in row 2");
}

TEST(DamagedSwath, HasIdsThatAreNone) {
    const auto with_ids = [](const std::vector<IdRun>& runs) {
        return three_pixels().row({{0, 3}}).row({}).ids(runs).composited();
    };
    EXPECT_EQ(with_ids({{3, kObjectLimit - 1}}), "");
    EXPECT_EQ(with_ids({{3, kObjectLimit}}), "ids: object 300, the limit is 300");
    EXPECT_EQ(with_ids({{3, -1}}), "ids: object -1, the limit is 300");
    EXPECT_EQ(with_ids({{1, 299}, {2, 1}}), "ids: object 300, the limit is 300");
    EXPECT_EQ(with_ids({{3, 0x7fffffff}}), "ids: object 2147483647, the limit is 300");
    EXPECT_EQ(with_ids({{0, 0}, {3, 0}}), "ids: a run of 0 where 3 pixels are left");
    EXPECT_EQ(with_ids({{4, 0}}), "ids: a run of 4 where 3 pixels are left");
    EXPECT_EQ(with_ids({{3, 0}, {1, 0}}), "ids: a run of 1 where 0 pixels are left");
    EXPECT_EQ(with_ids({{0xffffffff, 0}}), "ids: a run of 4294967295 where 3 pixels are left");
    EXPECT_EQ(with_ids({{2, 0}}), "ids: for 2 of 3 pixels");
    EXPECT_EQ(with_ids({}), "ids: for 0 of 3 pixels");
}

TEST(DamagedSwath, HasNumbersThatAreCutOffOrTooLong) {
    for (const std::vector<std::uint8_t>& bytes : std::vector<std::vector<std::uint8_t>>{
             {3}, {0x83}, {3, 0x80}, {0xff, 0xff, 0xff, 0xff, 0x1f, 0}, {0x83, 0x80, 0x80, 0x80, 0x80, 0, 0}})
        EXPECT_EQ(three_pixels().row({{0, 3}}).row({}).id_bytes(bytes).composited(),
                  "ids: a number is cut off or too long");
}

TEST(DamagedSwath, AnnouncesMorePixelsThanItsRegionHas) {
    EXPECT_EQ(with_spans({{0, 3}}, {}).composited({{2, 1, 4, 2}}), "3 pixels for a region of 2");
}

TEST(DamagedTile, IsRefusedLikeASwath) {
    EXPECT_EQ(three_pixels().row({{0, 2}}).row({{3, 1}}).assembled(), "");
    EXPECT_EQ(three_pixels().row({{0, 2}}).row({{3, 2}}).assembled(),
              "spans: 2 pixels after 0 and 3 skipped in a row of 4");
    EXPECT_EQ(three_pixels().row({{0, 2}}).row({}).assembled(), "spans: 2 pixels where 3 were announced");
    EXPECT_EQ(three_pixels().row({{0, 3}}).row({}).ids({{3, 0}}).assembled(), "a tile with object ids");
}

class DamagedPixels : public testing::Test {
  protected:
    DamagedPixels() : frame_(random_frame({0, 0, 40, 12}, random_, 2)) {
        swath_sizes_ = encode_swath(frame_, region_, swath_);
        tile_sizes_ = encode_tile(frame_, region_, tile_);
    }

    // Decodes whatever the sizes say, and expects that nothing outside of the region changes.
    void decode_both(const Buffer& swath, const BodySizes& swath_sizes, const Buffer& tile,
                     const BodySizes& tile_sizes) {
        PixelFrame frame = copy(frame_);
        swath_status_ = composite_swath(swath.bytes(), swath_sizes, region_, kObjectLimit, frame);
        Picture picture;
        fill(picture, 40, 12, {1, 2, 3});
        tile_status_ = assemble_tile(tile.bytes(), tile_sizes, region_, picture);
        for (const Status& status : {swath_status_, tile_status_})
            EXPECT_TRUE(status.has_value() || !status.error().message.empty());
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 40; ++x) {
                if (inside(region_, x, y)) continue;
                ASSERT_EQ(pixel(frame, x, y), pixel(frame_, x, y));
                ASSERT_EQ(picture.rgb[3 * static_cast<std::size_t>(40 * y + x)], 1);
            }
    }
    static Buffer first(const Buffer& body, std::size_t count) {
        Buffer start;
        start.append(body.data(), count);
        return start;
    }

    const Region region_{{1, 1, 20, 11}, {23, 3, 39, 7}};
    Random random_{7};
    PixelFrame frame_;
    Buffer swath_, tile_;
    BodySizes swath_sizes_, tile_sizes_;
    Status swath_status_, tile_status_;
};

TEST_F(DamagedPixels, AreRefusedAfterEveryTruncation) {
    for (std::size_t length = 0; length < swath_.size(); ++length) {
        decode_both(first(swath_, length), swath_sizes_, first(tile_, std::min(length, tile_.size() - 1)),
                    tile_sizes_);
        ASSERT_FALSE(swath_status_.has_value());
        ASSERT_FALSE(tile_status_.has_value());
        EXPECT_THAT(swath_status_.error().message, HasSubstr("where its head says"));
    }
}

// The head tells the truth about a body that lacks its end.
TEST_F(DamagedPixels, AreRefusedWhenTheirTablesAreCutShort) {
    for (std::uint32_t cut = 1; cut <= swath_sizes_.id_bytes; ++cut) {
        BodySizes sizes = swath_sizes_;
        sizes.id_bytes -= cut;
        decode_both(first(swath_, swath_.size() - cut), sizes, tile_, tile_sizes_);
        ASSERT_FALSE(swath_status_.has_value()) << cut;
        EXPECT_THAT(swath_status_.error().message, HasSubstr("ids: "));
    }
    for (std::uint32_t cut = 1; cut <= tile_sizes_.span_bytes; ++cut) {
        BodySizes sizes = tile_sizes_;
        sizes.span_bytes -= cut;
        decode_both(swath_, swath_sizes_, first(tile_, tile_.size() - cut), sizes);
        ASSERT_FALSE(tile_status_.has_value()) << cut;
        EXPECT_THAT(tile_status_.error().message, HasSubstr("spans: "));
    }
}

TEST_F(DamagedPixels, NeverCrashTheirReader) {
    for (int round = 0; round < 3000; ++round) {
        Buffer swath = first(swath_, swath_.size());
        Buffer tile = first(tile_, tile_.size());
        const std::size_t flips = 1 + random_() % 4;
        for (std::size_t i = 0; i < flips; ++i) {
            // Mostly changes the tables, since any colour is valid.
            const std::size_t at = random_() % 2 == 0 ? random_() % swath.size()
                                                      : swath.size() - 1 - random_() % (swath.size() / 4);
            swath.data()[at] = static_cast<std::uint8_t>(random_());
            tile.data()[random_() % tile.size()] ^= static_cast<std::uint8_t>(1u << random_() % 8);
        }
        decode_both(swath, swath_sizes_, tile, tile_sizes_);
    }
}

TEST_F(DamagedPixels, NeverCrashTheirReaderWithSizesThatLie) {
    for (int round = 0; round < 3000; ++round) {
        const auto lie = [&](BodySizes sizes) {
            std::uint32_t* const fields[] = {&sizes.pixels, &sizes.span_bytes, &sizes.id_bytes};
            // Moves bytes from one part to another, so that the sum is right.
            const auto moved = static_cast<std::uint32_t>(random_() % 64);
            *fields[random_() % 3] += moved;
            *fields[random_() % 3] -= random_() % 4 == 0 ? static_cast<std::uint32_t>(random_()) : moved;
            return sizes;
        };
        decode_both(swath_, lie(swath_sizes_), tile_, lie(tile_sizes_));
    }
}

}  // namespace
}  // namespace swath
