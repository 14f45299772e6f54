#include "common/published/cull/walks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "common/published/cull/member_lists.h"
#include "tests/common/published/cull/frusta.h"

namespace swath {
namespace {

// Boxes with faces on planes up to rounding, where one bit decides.
TEST(WalkTable, TestsABoxAsTheOnePlaneExpressionDoesInEveryInstructionSet) {
    std::mt19937 random(4);
    const auto number = [&] { return static_cast<float>(random() % 2001) / 1000.0f - 1.0f; };
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (int round = 0; round < 200; ++round) {
        Frustum frustum = everything();
        for (std::size_t i = 0; i < 2; ++i) frustum.planes[i] = {number(), number(), number(), number()};
        if (round % 5 == 0) frustum.planes[0].x = -0.0f;
        if (round % 7 == 0) frustum.planes[1].y = std::numeric_limits<float>::quiet_NaN();
        std::vector<WalkBox> boxes;
        std::vector<std::uint32_t> ids;
        std::vector<std::uint32_t> expected;
        for (std::uint32_t id = 0; id < 200; ++id) {
            glm::vec3 corner(number(), number(), number());
            const glm::vec4& p = frustum.planes[0];
            if (p.z != 0) corner.z = -(p.x * corner.x + p.y * corner.y + p.w) / p.z;  // on the plane
            Box box{corner, corner};
            if (id % 3 == 0) box.extend(glm::vec3(number(), number(), number()));
            if (id % 50 == 0) box.min.x = -kInfinity;
            if (id % 60 == 0) box = Box{};
            boxes.push_back(walk_box(box));
            ids.push_back(1000 + id);
            if (!outside(frustum, box)) expected.push_back(1000 + id);
        }
        const CellBoxes of{nullptr, boxes.data(), ids.data()};
        for (const InstructionSet set : instruction_sets()) {
            OwnedList<WalkList<std::uint32_t>> visible;
            walk_table(set).cull_boxes(walk_planes(frustum), of, 0, boxes.size(), *visible);
            EXPECT_THAT(contents(*visible), testing::ElementsAreArray(expected)) << name(set);
        }
    }
}

TEST(WalkTable, WalksATreeAlikeInEveryInstructionSet) {
    const UniformOctree shape(4);
    const ComputedNode root = computed_node(shape, 0, 0);
    for (const Frustum& frustum : all_sorts_of_frusta(shape.edge(), 5, 6)) {
        const WalkPlanes planes = walk_planes(frustum);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t code = 0; code < shape.leaf_count(); ++code)
            if (!outside(frustum, shape.box_of(4, code))) expected.push_back(code);
        for (const InstructionSet set : instruction_sets())
            for (const auto walk_from : {walk_table(set).computed.in_place, walk_table(set).computed.in_lanes,
                                         walk_table(set).computed.depth_first}) {
                MemberWalk walk{&planes, 4, {}, 0};
                walk_from(walk, &root, 1);
                EXPECT_THAT(contents(walk.leaves), testing::ElementsAreArray(expected)) << name(set);
                std::free(walk.leaves.at);
            }
    }
}

}  // namespace
}  // namespace swath
