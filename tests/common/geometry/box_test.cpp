#include "common/geometry/box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace swath {
namespace {

bool contains(const Box& outer, const glm::vec3& point) {
    return glm::all(glm::lessThanEqual(outer.min, point)) && glm::all(glm::lessThanEqual(point, outer.max));
}
bool contains(const Box& outer, const Box& inner) {
    return contains(outer, inner.min) && contains(outer, inner.max);
}

// Points that move, of one order of magnitude or of all.
class RandomPoints {
  public:
    explicit RandomPoints(std::uint32_t seed) : random_(seed) {}

    float pose() {
        const float low = std::ldexp(unit(), -static_cast<int>(random_() % 30));
        return random_() % 2 == 0 ? low : 1 - low;
    }
    void make(int round) {
        at_.clear();
        motion_.clear();
        start_ = {};
        end_ = {};
        const bool wild = round % 3 == 0;
        const float scale = std::ldexp(1.0f, static_cast<int>(random_() % 180) - 125);
        const glm::vec3 home = 1000.0f * scale * vector(false);
        for (int i = 0; i < 20; ++i) {
            at_.push_back(wild ? vector(true) : home + scale * vector(false));
            motion_.push_back(wild ? vector(true) : scale * vector(false));
            // Some end near the origin, where all digits cancel.
            if (i % 5 == 4) motion_.back() = -at_.back() * (1 + 1e-7f * unit());
            start_.extend(at_.back());
            end_.extend(at_.back() + motion_.back());
        }
    }

    const std::vector<glm::vec3>& at() const { return at_; }
    const std::vector<glm::vec3>& motion() const { return motion_; }
    const Box& start() const { return start_; }
    const Box& end() const { return end_; }

  private:
    float unit() { return static_cast<float>(random_() >> 8) / 16777216.0f; }
    float number(bool wild) {
        const float x = 2 * unit() - 1;
        return wild ? std::ldexp(x, static_cast<int>(random_() % 200) - 141) : x;
    }
    glm::vec3 vector(bool wild) { return {number(wild), number(wild), number(wild)}; }

    std::mt19937 random_;
    std::vector<glm::vec3> at_;
    std::vector<glm::vec3> motion_;
    Box start_;
    Box end_;
};

TEST(MovingBoxTest, HoldsEveryPointAtEveryPoseHoweverItWasRounded) {
    RandomPoints points(1);
    for (int round = 0; round < 20'000; ++round) {
        points.make(round);
        const float pose = points.pose();
        const Box box = box_at(points.start(), points.end(), pose);
        for (std::size_t i = 0; i < points.at().size(); ++i) {
            const glm::vec3& at = points.at()[i];
            const glm::vec3& by = points.motion()[i];
            const glm::vec3 fused(std::fma(pose, by.x, at.x), std::fma(pose, by.y, at.y),
                                  std::fma(pose, by.z, at.z));
            ASSERT_TRUE(contains(box, at + pose * by)) << round << " " << pose;
            ASSERT_TRUE(contains(box, fused)) << round << " " << pose;
        }
    }
}

TEST(MovingBoxTest, IsExactAtBothEndsAndWhereNothingMoves) {
    const Box start{{0, 1, 2}, {3, 4, 5}};
    const Box end{{10, -1, 2}, {11, 0, 5}};
    EXPECT_EQ(box_at(start, end, 0), start);
    EXPECT_EQ(box_at(start, end, 1), end);
    EXPECT_EQ(box_at(start, {}, 0.3f), start);
    EXPECT_EQ(box_at(start, start, 0.3f), start);
}

TEST(MovingBoxTest, IsHardlyLargerThanNeedBe) {
    const Box box = box_at({{0, 0, 0}, {1, 1, 1}}, {{10, 0, 0}, {12, 1, 1}}, 0.25f);
    EXPECT_NEAR(box.min.x, 2.5f, 1e-5f);
    EXPECT_NEAR(box.max.x, 3.75f, 1e-5f);
    EXPECT_EQ(box.min.y, 0);
    EXPECT_EQ(box.max.z, 1);
}

TEST(MovingBoxTest, IsAroundTheBoxesOfPartsAndWithinThatOfBothEnds) {
    RandomPoints points(2);
    for (int round = 0; round < 5000; ++round) {
        points.make(round);
        const float pose = points.pose();
        const Box whole = box_at(points.start(), points.end(), pose);
        Box swept = points.start();
        swept.extend(points.end());
        ASSERT_TRUE(contains(swept, whole));
        for (std::size_t first = 0; first < points.at().size(); first += 4) {
            Box start;
            Box end;
            for (std::size_t i = first; i < first + 4; ++i) {
                start.extend(points.at()[i]);
                end.extend(points.at()[i] + points.motion()[i]);
            }
            ASSERT_TRUE(contains(whole, box_at(start, end, pose)));
        }
    }
}

}  // namespace
}  // namespace swath
