#include "common/geometry/rect.h"

#include <gtest/gtest.h>

#include <random>

#include "common/geometry/box.h"

namespace swath {
namespace {

bool covers(const Rect& r, int x, int y) { return r.x0 <= x && x < r.x1 && r.y0 <= y && y < r.y1; }

Rect random_rect(std::mt19937& random) {
    const auto at = [&] { return static_cast<int>(random() % 12) - 2; };
    return {at(), at(), at(), at()};  // often empty, also inside out
}

TEST(Rect, WithoutPixelsIsEmptyAndHasNoArea) {
    EXPECT_TRUE((Rect{}).empty());
    EXPECT_TRUE((Rect{3, 0, 3, 9}).empty());
    EXPECT_TRUE((Rect{5, 0, 2, 9}).empty());
    EXPECT_EQ((Rect{5, 0, 2, 9}).area(), 0);
    EXPECT_EQ((Rect{5, 0, 2, 9}).height(), 0);
    EXPECT_EQ((Rect{-1, 2, 4, 4}).area(), 10);
}

TEST(Rect, AreaOfAHugeRectDoesNotOverflow) {
    EXPECT_EQ((Rect{0, 0, 1 << 30, 1 << 30}).area(), std::int64_t{1} << 60);
}

TEST(Rect, IntersectionBoundingContainmentAndDifferenceAgreeWithPixels) {
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
        const Rect a = random_rect(random);
        const Rect b = random_rect(random);
        const Rect both = intersect(a, b);
        const Rect around = bounding(a, b);
        const std::vector<Rect> rest = subtract(a, b);
        bool contained = true;
        Rect tight;
        for (int y = -3; y < 12; ++y)
            for (int x = -3; x < 12; ++x) {
                const bool in_a = covers(a, x, y);
                const bool in_b = covers(b, x, y);
                EXPECT_EQ(covers(both, x, y), in_a && in_b);
                if (in_a || in_b) tight = bounding(tight, {x, y, x + 1, y + 1});
                contained = contained && (in_a || !in_b);
                int pieces = 0;
                for (const Rect& r : rest) pieces += covers(r, x, y) ? 1 : 0;
                EXPECT_EQ(pieces, in_a && !in_b ? 1 : 0);
            }
        EXPECT_EQ(a.contains(b), contained);
        EXPECT_TRUE(tight.empty() ? around.empty() : around == tight);
    }
}

TEST(Box, IsEmptyUntilItIsExtended) {
    Box box;
    EXPECT_TRUE(box.empty());
    box.extend(Box{});
    EXPECT_TRUE(box.empty());
    box.extend(glm::vec3(1, 2, 3));
    EXPECT_FALSE(box.empty());
    EXPECT_EQ(box.min, box.max);
    box.extend(glm::vec3(-1, 5, 3));
    EXPECT_EQ(box.size(), glm::vec3(2, 3, 0));
    EXPECT_EQ(box.longest_axis(), 1);
    EXPECT_EQ(box.corner(0), glm::vec3(-1, 2, 3));
    EXPECT_EQ(box.corner(3), glm::vec3(1, 5, 3));
}

}  // namespace
}  // namespace swath
