#include "client/cost/pricer.h"

#include <gtest/gtest.h>

namespace swath {
namespace {

// Round numbers: an operation on a buffer takes 100 s; a pixel of colour takes 1 s to read and 2 s to write,
// of depth twice that; a polygon takes 3 s, a pixel of the display 5 s.
Hardware slow(Compositing compositing) {
    Hardware hardware;
    hardware.server.compositing = compositing;
    hardware.server.polygon_s = 3;
    hardware.server.fill_pixels_per_s = 0.1;
    hardware.server.colour = {100, 1, 0.5};
    hardware.server.depth = {100, 0.5, 0.25};
    hardware.server.pack_pixels_per_s = 0.1;
    hardware.server.merge_pixels_per_s = 0.05;
    hardware.display.colour = {100, 1, 0.2};
    hardware.network.active_share = 0.5;
    hardware.network.tile_active_share = 0.25;
    hardware.network.swath_bytes_per_pixel = 8;
    hardware.network.tile_bytes_per_pixel = 4;
    return hardware;
}

const Region kTwo{{0, 0, 4, 5}, {10, 0, 12, 10}};  // 20 pixels each

TEST(Pricer, DrawsForTheLongerOfPolygonsAndPixels) {
    const Hardware hardware = slow(Compositing::kHost);
    EXPECT_DOUBLE_EQ(Pricer(hardware).render_s(100, {0, 0, 2, 5}), 300);
    EXPECT_DOUBLE_EQ(Pricer(hardware).render_s(10, {0, 0, 2, 5}), 100);
}

TEST(Pricer, AddsWhatEveryFrameCostsWhereSomethingIsDrawn) {
    Hardware hardware = slow(Compositing::kHost);
    hardware.server.frame_s = 7;
    EXPECT_DOUBLE_EQ(Pricer(hardware).render_s(100, {0, 0, 2, 5}), 307);
    EXPECT_DOUBLE_EQ(Pricer(hardware).render_s(1, {}), 10);
    EXPECT_EQ(Pricer(hardware).render_s(0, {}), 0);
}

TEST(Pricer, OnTheCardTakesAnOperationOnEachBufferForEachRectangle) {
    const Hardware hardware = slow(Compositing::kGraphics);
    const Pricer price(hardware);
    EXPECT_EQ(price.readback_s(kTwo[0]), 0);
    EXPECT_DOUBLE_EQ(price.send_swath_s(kTwo), 2 * ((100 + 20) + (100 + 2 * 20)));
    EXPECT_DOUBLE_EQ(price.merge_swath_s(kTwo), 2 * ((100 + 2 * 20) + (100 + 4 * 20)));
    EXPECT_DOUBLE_EQ(price.read_tile_s(kTwo), 2 * (100 + 20));
}

TEST(Pricer, InHostMemoryReadsAllOnceAndMovesWhatIsActive) {
    const Hardware hardware = slow(Compositing::kHost);
    const Pricer price(hardware);
    EXPECT_DOUBLE_EQ(price.readback_s(kTwo[0]), (100 + 20) + (100 + 2 * 20));
    EXPECT_EQ(price.readback_s({}), 0);
    EXPECT_DOUBLE_EQ(price.send_swath_s(kTwo), 10 * 0.5 * 40);
    EXPECT_DOUBLE_EQ(price.merge_swath_s(kTwo), 20 * 0.5 * 40);
    EXPECT_DOUBLE_EQ(price.read_tile_s(kTwo), 10 * 0.25 * 40);
}

TEST(Pricer, GathersTilesAtTheirOwnRateWhereThatIsKnown) {
    Hardware hardware = slow(Compositing::kHost);
    hardware.server.gather_pixels_per_s = 2;
    const Pricer price(hardware);
    EXPECT_DOUBLE_EQ(price.read_tile_s(kTwo), 0.25 * 40 / 2);
    EXPECT_DOUBLE_EQ(price.send_swath_s(kTwo), 10 * 0.5 * 40);
}

TEST(Pricer, SendsActivePixelsAndTheDisplayWritesThemRectangleByRectangle) {
    const Hardware hardware = slow(Compositing::kHost);
    const Pricer price(hardware);
    EXPECT_DOUBLE_EQ(price.swath_bytes(kTwo), 8 * 0.5 * 40);
    EXPECT_DOUBLE_EQ(price.tile_bytes(kTwo), 4 * 0.25 * 40);
    EXPECT_DOUBLE_EQ(price.display_tile_s(kTwo), 2 * 100 + 5 * 0.25 * 40);
}

}  // namespace
}  // namespace swath
