#include "sim/hardware/quantity.h"

#include <gtest/gtest.h>

namespace swath::sim {
namespace {

double value_of(std::string_view text, Unit unit) {
    const Result<double> value = parse_quantity(text, unit);
    EXPECT_TRUE(value) << value.error().message;
    return value.value_or(-1);
}

TEST(Quantity, IsANumberTimesItsUnit) {
    EXPECT_DOUBLE_EQ(value_of("20 us", Unit::kTime), 20e-6);
    EXPECT_DOUBLE_EQ(value_of("20us", Unit::kTime), 20e-6);
    EXPECT_DOUBLE_EQ(value_of("  2.5e1   ns ", Unit::kTime), 25e-9);
    EXPECT_DOUBLE_EQ(value_of("1 s", Unit::kTime), 1);
    EXPECT_DOUBLE_EQ(value_of("3 ms", Unit::kTime), 3e-3);
    EXPECT_DOUBLE_EQ(value_of("100 MB/s", Unit::kBandwidth), 100e6);
    EXPECT_DOUBLE_EQ(value_of("10 Gbit/s", Unit::kBandwidth), 1.25e9);
    EXPECT_DOUBLE_EQ(value_of("800 Mbit/s", Unit::kBandwidth), 100e6);
    EXPECT_DOUBLE_EQ(value_of("2 Gpixel/s", Unit::kPixelRate), 2e9);
    EXPECT_DOUBLE_EQ(value_of("1.33 us/polygon", Unit::kPolygonTime), 1.33e-6);
    EXPECT_DOUBLE_EQ(value_of("130 ns/object/server", Unit::kServerTime), 130e-9);
    EXPECT_DOUBLE_EQ(value_of("12 ns/object/level", Unit::kLevelTime), 12e-9);
    EXPECT_DOUBLE_EQ(value_of("7.46 B/pixel", Unit::kBytesPerPixel), 7.46);
    EXPECT_DOUBLE_EQ(value_of("0.5", Unit::kShare), 0.5);
}

TEST(Quantity, TakesNoUnitForAnother) {
    for (const auto& [text, unit] : {std::pair{"20 us", Unit::kPolygonTime},
                                     {"20 us/polygon", Unit::kTime},
                                     {"20 us/object", Unit::kServerTime},
                                     {"20 us/object/server", Unit::kObjectTime},
                                     {"20 us/object/level", Unit::kServerTime},
                                     {"1 MB/s", Unit::kPixelRate},
                                     {"1 Mpixel/s", Unit::kBandwidth},
                                     {"1 B", Unit::kBytesPerPixel},
                                     {"0.5 s", Unit::kShare},
                                     {"50 %", Unit::kShare},
                                     {"1 mb/s", Unit::kBandwidth}})
        EXPECT_FALSE(parse_quantity(text, unit)) << text;
}

TEST(Quantity, IsShownAsAPersonWouldWriteItAndReadsBack) {
    EXPECT_EQ(to_text(20e-6, Unit::kTime), "20 us");
    EXPECT_EQ(to_text(1e-3, Unit::kTime), "1 ms");
    EXPECT_EQ(to_text(0, Unit::kTime), "0 ns");
    EXPECT_EQ(to_text(117.5e6, Unit::kBandwidth), "117.5 MB/s");
    EXPECT_EQ(to_text(1.25e9, Unit::kBandwidth), "1.25 GB/s");
    EXPECT_EQ(to_text(300e6, Unit::kPixelRate), "300 Mpixel/s");
    EXPECT_EQ(to_text(1.33e-6, Unit::kPolygonTime), "1.33 us/polygon");
    EXPECT_EQ(to_text(7.46, Unit::kBytesPerPixel), "7.46 B/pixel");
    EXPECT_EQ(to_text(0.25, Unit::kShare), "0.25");
    for (const double value : {1e-9, 3.21e-7, 9.99e-4, 5.0}) {
        const std::string text = to_text(value, Unit::kTime);
        EXPECT_NEAR(value_of(text, Unit::kTime), value, value * 1e-5) << text;
    }
}

}  // namespace
}  // namespace swath::sim
