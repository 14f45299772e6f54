#include "common/published/octree/uniform_octree.h"

#include <gtest/gtest.h>

#include <random>

#include "common/base/check.h"

namespace swath {
namespace {

// "7 levels": A2SSB, section 3.8. "8 levels": ADSB, section 9. 9 levels: A2SSB, before equation 28.
TEST(UniformOctree, HasAsManyNodesAsThePapersSay) {
    EXPECT_EQ(UniformOctree(6).node_count(), 299'593u);
    EXPECT_EQ(UniformOctree(7).node_count(), 2'396'745u);
    EXPECT_EQ(UniformOctree(8).node_count(), 19'173'961u);
    EXPECT_EQ(UniformOctree(0).node_count(), 1u);
    EXPECT_EQ(UniformOctree(0).leaf_count(), 1u);
    EXPECT_EQ(UniformOctree(10).leaf_count(), 1u << 30);
}

TEST(UniformOctree, NumbersChildrenAsInFigure37) {
    const UniformOctree tree(1);
    EXPECT_EQ(tree.box_of(0, 0), (Box{glm::vec3(0), glm::vec3(2)}));
    EXPECT_EQ(tree.box_of(1, 0), (Box{{0, 0, 0}, {1, 1, 1}}));
    EXPECT_EQ(tree.box_of(1, 1), (Box{{1, 0, 0}, {2, 1, 1}}));
    EXPECT_EQ(tree.box_of(1, 2), (Box{{0, 0, 1}, {1, 1, 2}}));
    EXPECT_EQ(tree.box_of(1, 4), (Box{{0, 1, 0}, {1, 2, 1}}));
    EXPECT_EQ(tree.box_of(1, 7), (Box{{1, 1, 1}, {2, 2, 2}}));
}

TEST(UniformOctree, CutsEveryBoxIntoItsChildren) {
    const UniformOctree tree(5);
    std::mt19937 random(1);
    for (int level = 0; level < 5; ++level)
        for (int round = 0; round < 50; ++round) {
            const auto code = static_cast<std::uint32_t>(random() % (1u << 3 * level));
            Box all;
            for (std::uint32_t child = 0; child < 8; ++child) {
                const Box box = tree.box_of(level + 1, 8 * code + child);
                EXPECT_EQ(box.size(), 0.5f * tree.box_of(level, code).size());
                all.extend(box);
            }
            EXPECT_EQ(all, tree.box_of(level, code));
        }
}

TEST(UniformOctree, FindsACellsCodeAndBack) {
    std::mt19937 random(2);
    for (int round = 0; round < 10'000; ++round) {
        const auto code = static_cast<std::uint32_t>(random() % (1u << 30));
        EXPECT_EQ(octree_code(octree_cell(code)), code);
    }
    EXPECT_EQ(octree_cell(0b100'010'001), (OctreeCell{1, 4, 2}));
    EXPECT_EQ(octree_code({1023, 1023, 1023}), (1u << 30) - 1);
    const UniformOctree tree(10);
    EXPECT_EQ(tree.box_of(10, octree_code({1023, 7, 512})), (Box{{1023, 7, 512}, {1024, 8, 513}}));
}

TEST(UniformOctree, RefusesAHeightThatItsCodesCannotHold) {
    EXPECT_THROW(UniformOctree(-1), CheckFailed);
    EXPECT_THROW(UniformOctree(11), CheckFailed);
}

}  // namespace
}  // namespace swath
