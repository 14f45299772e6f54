#include "sim/picture/colours.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swath::sim {
namespace {

// Relative luminance without gamma: good enough to tell light from dark.
double grey(const Rgb& c) { return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2]; }

double distance(const Rgb& a, const Rgb& b) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return std::sqrt(sum);
}

TEST(ServerColourTest, sixty_four_servers_have_colours_that_can_be_told_apart) {
    for (std::size_t a = 0; a < 64; ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_GT(distance(server_colour(server_id(a)), server_colour(server_id(b))), 8)
                << a << " and " << b;
}

TEST(ServerColourTest, servers_with_close_numbers_differ_a_lot_and_in_lightness_too) {
    for (std::size_t a = 0; a < 63; ++a) {
        const Rgb mine = server_colour(server_id(a));
        const Rgb next = server_colour(server_id(a + 1));
        EXPECT_GT(distance(mine, next), 60) << a;
        EXPECT_GT(std::abs(grey(mine) - grey(next)), 8) << a;
    }
}

TEST(ServerColourTest, no_colour_is_mistaken_for_white_or_the_dark_background) {
    for (std::size_t a = 0; a < 1024; ++a) {
        const Rgb colour = server_colour(server_id(a));
        EXPECT_GT(grey(colour), 90) << a;
        EXPECT_GT(distance(colour, {255, 255, 255}), 60) << a;
    }
}

TEST(BlendTest, mixes_by_opacity_and_rounds_to_the_nearest) {
    EXPECT_EQ(blend({100, 0, 255}, {255, 255, 255}, 0.5), (Rgb{178, 128, 255}));
    EXPECT_EQ(blend({100, 0, 255}, {0, 10, 0}, 0), (Rgb{100, 0, 255}));
    EXPECT_EQ(blend({100, 0, 255}, {0, 10, 0}, 1), (Rgb{0, 10, 0}));
    EXPECT_EQ(blend({100, 0, 255}, {0, 10, 0}, 0.25), (Rgb{75, 3, 191}));
}

}  // namespace
}  // namespace swath::sim
