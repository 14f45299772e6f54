#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/octree/sah/sah_builder.h"
#include "common/published/octree/sah_kd_tree.h"
#include "tests/support/triangles.h"

// A builder that is given bad input returns an error that says why, and stays usable.

namespace swath {
namespace {

using test::Triangles;
using testing::HasSubstr;

class SahInput : public testing::Test {
  protected:
    std::string error_of(const SahTriangles& triangles, const SahSettings& settings = kDefaultSah) {
        const auto tree = builder_.build(triangles, settings);
        return tree ? "" : tree.error().message;
    }
    // Whatever came before, it builds a good tree.
    void TearDown() override {
        const auto tree = builder_.build(good_.view(), kDefaultSah);
        ASSERT_TRUE(tree.has_value()) << tree.error().message;
        SahBuilder other(1);
        const auto expected = other.build(good_.view(), kDefaultSah);
        ASSERT_TRUE(expected.has_value());
        EXPECT_EQ(tree->triangles, expected->triangles);
        EXPECT_EQ(tree->nodes.size(), expected->nodes.size());
    }
    SahBuilder builder_{2};
    const Triangles good_ = test::soup(5000, 0.1f, 1);
};

TEST_F(SahInput, WithoutTrianglesIsRefused) {
    EXPECT_THAT(error_of({}), HasSubstr("no triangles"));
    Triangles two_corners = good_;
    two_corners.indices.resize(2);
    EXPECT_THAT(error_of(two_corners.view()), HasSubstr("no triangles"));
    EXPECT_FALSE(build_sah_kd_tree({}, kDefaultSah).has_value());
}

TEST_F(SahInput, WithACoordinateThatCannotBeIsRefused) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const std::size_t count : {1u, 100u, 5000u})
        for (const float bad : {std::nanf(""), -std::nanf(""), kInfinity, -kInfinity, 1e30f, -1e30f, 1.1e18f,
                                std::numeric_limits<float>::max()})
            for (int axis = 0; axis < 3; ++axis)
                for (const std::size_t corner : {0u, 1u, 2u}) {
                    Triangles triangles = good_;
                    triangles.indices.resize(3 * count);
                    triangles.positions[3 * (count / 2) + corner][axis] = bad;
                    EXPECT_THAT(error_of(triangles.view()), HasSubstr("coordinate")) << bad;
                    EXPECT_FALSE(build_sah_kd_tree(triangles.view(), kDefaultSah).has_value()) << bad;
                }
    // A vertex that no triangle uses does not matter.
    Triangles triangles = good_;
    triangles.positions.push_back(glm::vec3(kInfinity));
    EXPECT_EQ(error_of(triangles.view()), "");
}

TEST_F(SahInput, AtTheLargestCoordinatesIsBuilt) {
    for (const float size : {1e18f, 1e-18f, 1e-30f, 1e-38f, 1e-42f}) {
        const Triangles triangles = test::moved(test::soup(3000, 0.1f, 2), size / 1.1f);
        const auto tree = builder_.build(triangles.view(), kDefaultSah);
        ASSERT_TRUE(tree.has_value()) << size;
        if (size > 1e-20f) {
            EXPECT_GT(tree->nodes.size(), 100u) << size;
        }
        EXPECT_GE(tree->triangles.size(), triangles.count());
    }
}

TEST_F(SahInput, WithAnIndexOutOfRangeIsRefused) {
    for (const std::uint32_t bad : {15'000u, 15'001u, 0x7fff'ffffu, 0xffff'ffffu})
        for (const std::size_t at : {0u, 7u, 14'999u}) {
            Triangles triangles = good_;
            triangles.indices[at] = bad;
            EXPECT_THAT(error_of(triangles.view()), HasSubstr("corner")) << bad;
            EXPECT_FALSE(build_sah_kd_tree(triangles.view(), kDefaultSah).has_value()) << bad;
        }
}

TEST_F(SahInput, WithPositionsThatCannotBeIsRefused) {
    for (const std::size_t stride : {0u, 4u, 8u, 13u, 14u}) {
        SahTriangles triangles = good_.view();
        triangles.stride = stride;
        EXPECT_THAT(error_of(triangles), HasSubstr("bytes apart")) << stride;
    }
    SahTriangles triangles = good_.view();
    triangles.position_count = 0;
    EXPECT_THAT(error_of(triangles), HasSubstr("positions"));
}

TEST_F(SahInput, WithSettingsOutOfRangeIsRefused) {
    const float nan = std::nanf("");
    const auto expect_refused = [&](const char* what, auto change) {
        SahSettings settings = kDefaultSah;
        change(settings);
        EXPECT_THAT(error_of(good_.view(), settings), HasSubstr(what));
        const auto kd_tree = build_sah_kd_tree(good_.view(), settings);
        ASSERT_FALSE(kd_tree.has_value());
        EXPECT_THAT(kd_tree.error().message, HasSubstr(what));
    };
    expect_refused("bins", [](SahSettings& s) { s.min_bins = 1; });
    expect_refused("bins", [](SahSettings& s) { s.max_bins = kMaxBins + 1; });
    expect_refused("bins", [](SahSettings& s) { s.max_bins = s.min_bins - 1; });
    expect_refused("bin ratio", [](SahSettings& s) { s.bin_ratio = 0; });
    expect_refused("grain", [](SahSettings& s) { s.kd_triangles = 2049; });
    expect_refused("grain", [](SahSettings& s) { s.grain = kMaxGrain + 1; });
    expect_refused("grain", [](SahSettings& s) { s.grain = s.kd_triangles - 1; });
    expect_refused("least gain", [](SahSettings& s) { s.least_gain = -0.1f; });
    expect_refused("least gain", [](SahSettings& s) { s.least_gain = 1.1f; });
    expect_refused("least gain", [&](SahSettings& s) { s.least_gain = nan; });
    expect_refused("costs", [](SahSettings& s) { s.traversal_cost = -1; });
    expect_refused("costs", [](SahSettings& s) { s.traversal_cost = 1e7f; });
    expect_refused("costs", [&](SahSettings& s) { s.traversal_cost = nan; });
    expect_refused("costs", [](SahSettings& s) { s.intersection_cost = 0; });
    expect_refused("costs", [](SahSettings& s) { s.intersection_cost = 1e7f; });
    expect_refused("costs", [&](SahSettings& s) { s.intersection_cost = nan; });
    expect_refused("duplication", [](SahSettings& s) { s.max_duplication = 0; });
    expect_refused("limit of", [](SahSettings& s) { s.max_duplication = 0xffff'ffff; });
}

TEST_F(SahInput, OfTooManyTrianglesIsRefusedBeforeTheyAreLookedAt) {
    const std::span<const std::uint32_t> too_many(good_.indices.data(), 3 * (std::size_t{1} << 27));
    SahTriangles triangles = good_.view();
    triangles.indices = too_many;
    EXPECT_THAT(error_of(triangles), HasSubstr("beyond the limit"));
}

// Any number of triangles in one place makes one leaf, at once.
TEST_F(SahInput, OfTrianglesThatCannotBeToldApartIsALeaf) {
    for (const bool point : {false, true}) {
        Triangles triangles;
        triangles.positions = {{1, 2, 3}, {2, 2, 3}, {1, 3, 4}};
        for (int i = 0; i < 100'000; ++i)
            for (const std::uint32_t corner : {0u, 1u, 2u}) triangles.indices.push_back(point ? 0 : corner);
        for (const SahSettings& settings : {kDefaultSah, kFastSah}) {
            const auto tree = builder_.build(triangles.view(), settings);
            ASSERT_TRUE(tree.has_value());
            ASSERT_EQ(tree->nodes.size(), 1u);
            EXPECT_EQ(tree->nodes[0].count(), 100'000u);
            for (std::uint32_t i = 0; i < 100'000; ++i) ASSERT_EQ(tree->triangles[i], i);
        }
        const auto kd_tree = build_sah_kd_tree(triangles.view(), kDefaultSah);
        ASSERT_TRUE(kd_tree.has_value());
        EXPECT_EQ(kd_tree->nodes.size(), 1u);
    }
}

// All triangles go through one point, so every plane crosses many of them: the bound on duplication is for
// this.
TEST_F(SahInput, OfTrianglesThatAllCrossStaysWithinItsDuplication) {
    Triangles star;
    test::Numbers numbers(3);
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec3 tip = numbers.point();
        star.add(tip, -tip, -tip + 0.01f * numbers.point());
    }
    for (const std::uint32_t most : {1u, 2u, 8u}) {
        SahSettings settings = kDefaultSah;
        settings.max_duplication = most;
        settings.traversal_cost = 0;
        const auto tree = builder_.build(star.view(), settings);
        ASSERT_TRUE(tree.has_value());
        EXPECT_LE(tree->triangles.size(), std::size_t{most} * star.count());
    }
}

TEST_F(SahInput, OfOneOrTwoTrianglesIsBuilt) {
    for (const std::size_t count : {1u, 2u}) {
        Triangles triangles;
        for (std::size_t t = 0; t < count; ++t) {
            const glm::vec3 at(10.0f * static_cast<float>(t), 0, 0);
            triangles.add(at, at + glm::vec3(1, 0, 0), at + glm::vec3(0, 1, 1));
        }
        SahSettings settings = kDefaultSah;
        settings.traversal_cost = 0.1f;
        const auto tree = builder_.build(triangles.view(), settings);
        ASSERT_TRUE(tree.has_value());
        EXPECT_EQ(tree->triangles.size(), count);
        EXPECT_GE(tree->nodes.size(), 2 * count - 1);
    }
}

// With a limit from 0 to enough there is an error that names the limit, or the tree.
TEST_F(SahInput, ThatTakesTooMuchMemoryIsRefused) {
    const Triangles triangles = test::soup(30'000, 0.1f, 4);
    const auto expected = builder_.build(triangles.view(), kDefaultSah);
    ASSERT_TRUE(expected.has_value());
    int refused = 0;
    SahSettings settings = kDefaultSah;
    for (settings.max_bytes = 0; settings.max_bytes < (std::size_t{1} << 30);
         settings.max_bytes = settings.max_bytes * 5 / 4 + 1000) {
        SahBuilder builder(2);
        const auto tree = builder.build(triangles.view(), settings);
        if (tree) {
            EXPECT_EQ(tree->triangles, expected->triangles);
            EXPECT_GT(settings.max_bytes, tree->bytes());
            break;
        }
        ++refused;
        EXPECT_THAT(tree.error().message, HasSubstr(std::to_string(settings.max_bytes) + " bytes"));
        EXPECT_TRUE(builder.build(good_.view(), kDefaultSah).has_value());
    }
    EXPECT_GT(refused, 10);
    EXPECT_LT(settings.max_bytes, 30'000u * 2000);
}

// The limit is for one build: the memory of an earlier one must not count.
TEST_F(SahInput, FitsInAsMuchMemoryAfterALargerBuild) {
    SahSettings settings = kDefaultSah;
    settings.max_bytes = 0;
    for (; settings.max_bytes < (std::size_t{1} << 30); settings.max_bytes += 100'000) {
        SahBuilder builder(2);
        if (builder.build(good_.view(), settings)) break;
    }
    SahBuilder builder(2);
    ASSERT_TRUE(builder.build(test::soup(100'000, 0.05f, 5).view(), kDefaultSah).has_value());
    const auto tree = builder.build(good_.view(), settings);
    EXPECT_TRUE(tree.has_value()) << tree.error().message;
}

}  // namespace
}  // namespace swath
