#include "sim/picture/layers.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "sim/picture/colours.h"
#include "tests/sim/picture/scenes.h"

namespace swath::sim::test {
namespace {

TEST(LayersTest, a_pixel_counts_as_often_as_it_is_transferred) {
    const std::vector<std::uint16_t> expected = {
        0, 0, 0, 0, 1, 1, 0, 0,  //
        0, 0, 0, 0, 1, 1, 0, 0,  //
        0, 0, 0, 1, 1, 1, 0, 0,  //
        0, 0, 1, 2, 2, 2, 0, 0,  //
        0, 0, 1, 2, 2, 2, 0, 0,  //
        0, 0, 0, 1, 1, 1, 0, 0,  //
        0, 0, 0, 0, 1, 1, 0, 0,  //
        0, 0, 0, 0, 1, 1, 0, 0,
    };
    EXPECT_EQ(transfer_counts(small_plan()), expected);
}

TEST(LayersTest, transferred_pixels_are_whitened_the_more_the_oftener_they_travel) {
    const Picture picture = with_transfers(plain(8, 8, 100), small_plan());
    EXPECT_EQ(pixel(picture, 1, 3), (Rgb{100, 100, 100}));
    EXPECT_EQ(pixel(picture, 6, 3), (Rgb{100, 100, 100}));
    EXPECT_EQ(pixel(picture, 4, 0), (Rgb{163, 163, 163}));
    EXPECT_EQ(pixel(picture, 3, 2), (Rgb{163, 163, 163}));
    EXPECT_EQ(pixel(picture, 3, 3), (Rgb{197, 197, 197}));
    EXPECT_EQ(pixel(picture, 5, 4), (Rgb{197, 197, 197}));
}

TEST(LayersTest, white_grows_with_every_transfer_and_never_hides_the_model) {
    EXPECT_EQ(whiteness(0), 0.0);
    EXPECT_NEAR(whiteness(1), 0.405, 1e-12);
    EXPECT_NEAR(whiteness(2), 0.62775, 1e-12);
    EXPECT_NEAR(whiteness(3), 0.7502625, 1e-12);
    for (unsigned times = 0; times < 30; ++times) EXPECT_GT(whiteness(times + 1), whiteness(times));
    EXPECT_NEAR(whiteness(1'000'000), 0.9, 1e-9);
}

TEST(LayersTest, a_plan_without_transfers_leaves_the_picture_as_it_was) {
    FramePlan plan = small_plan();
    plan.servers[0].content = {0, 0, 4, 8};
    plan.servers[1].content = {4, 0, 8, 8};
    plan.servers[2].content = {};
    EXPECT_EQ(with_transfers(plain(8, 8, 100), plan), plain(8, 8, 100));
}

TEST(LayersTest, borders_lie_on_both_sides_in_their_owners_colours_and_nowhere_else) {
    const Picture picture = with_tile_borders(plain(8, 8, 9), small_plan());
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const Rgb expected = x == 3   ? server_colour(server_id(0))
                                 : x == 4 ? server_colour(server_id(1))
                                          : Rgb{9, 9, 9};
            EXPECT_EQ(pixel(picture, x, y), expected) << x << ' ' << y;
        }
}

TEST(LayersTest, a_tile_of_adjoining_rectangles_has_no_border_within) {
    FramePlan plan = small_plan();
    plan.servers[0].tile = {{0, 0, 4, 3}, {0, 3, 4, 8}};
    EXPECT_EQ(with_tile_borders(plain(8, 8, 9), plan), with_tile_borders(plain(8, 8, 9), small_plan()));
}

TEST(LayersTest, a_tint_mixes_in_the_owners_colour) {
    const Picture picture = with_tile_tints(plain(8, 8, 40), small_plan(), 0.25);
    EXPECT_EQ(pixel(picture, 0, 0), blend({40, 40, 40}, server_colour(server_id(0)), 0.25));
    EXPECT_EQ(pixel(picture, 3, 7), pixel(picture, 0, 0));
    EXPECT_EQ(pixel(picture, 4, 7), blend({40, 40, 40}, server_colour(server_id(1)), 0.25));
}

TEST(LayersTest, dimming_scales_every_channel) {
    EXPECT_EQ(dimmed(plain(2, 2, 201), 0.5), plain(2, 2, 101));
    EXPECT_EQ(dimmed(plain(2, 2, 201), 0), plain(2, 2, 0));
}

TEST(LayersTest, a_picture_of_another_size_is_our_own_mistake) {
    EXPECT_THROW(with_transfers(plain(8, 7, 0), small_plan()), CheckFailed);
    EXPECT_THROW(with_tile_borders(plain(7, 8, 0), small_plan()), CheckFailed);
}

}  // namespace
}  // namespace swath::sim::test
