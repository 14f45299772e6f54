#include "client/partition/partitioner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/check.h"
#include "tests/client/partition/scenes.h"

namespace swath {
namespace {

using test::awkward_scenes;
using test::front_view;
using test::input_of;
using testing::HasSubstr;

// Expects of every share what the partitioners promise besides problem().
void expect_sound(const FramePlan& plan, const std::vector<ProjectedObject>& objects, Grouping grouping) {
    const bool sort_first = grouping == Grouping::kAtLeastOnce;
    for (const ServerShare& share : plan.servers) {
        for (const Rect& rect : share.tile) ASSERT_FALSE(rect.empty());
        Rect visible;
        for (const ObjectId id : share.group)
            if (objects[id].visible) visible = bounding(visible, objects[id].box);
        if (!sort_first) {
            ASSERT_EQ(share.content, visible);
            continue;
        }
        ASSERT_LE(share.tile.size(), 1u);
        const Rect tile = share.tile.empty() ? Rect{} : share.tile.front();
        std::vector<ObjectId> on_tile;
        Rect visible_on_tile;
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const Rect part = intersect(objects[i].box, tile);
            if (part.empty()) continue;
            on_tile.push_back(static_cast<ObjectId>(i));
            if (objects[i].visible) visible_on_tile = bounding(visible_on_tile, part);
        }
        ASSERT_EQ(share.group, on_tile);
        ASSERT_EQ(share.content, visible_on_tile);
    }
    if (sort_first) {
        ASSERT_TRUE(transfers(plan).empty());
    }
}

class EveryPartitioner : public testing::TestWithParam<Algorithm> {};

TEST_P(EveryPartitioner, MakesAValidPlanOfAnySceneForAnyServersOnAnyScreen) {
    for (const test::Scene& scene : awkward_scenes()) {
        const auto partitioner = make_partitioner(GetParam(), scene.objects);
        for (const auto& [width, height] : {std::pair{640, 480}, {1, 1}, {641, 3}, {2, 300}, {1280, 960}}) {
            const View view = front_view(width, height);
            for (const Accounting accounting : {Accounting::kCluster, Accounting::kPaper}) {
                const std::vector<ProjectedObject> objects = project(scene.objects, view, accounting);
                for (const std::size_t servers : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 13u, 64u, 100u, 513u, 1024u}) {
                    SCOPED_TRACE(testing::Message()
                                 << scene.name << ", " << servers << " servers, " << width << 'x' << height);
                    const FramePlan plan = partitioner->partition(input_of(objects, view, servers));
                    ASSERT_EQ(problem(plan, objects.size(), grouping_of(GetParam())), std::nullopt);
                    ASSERT_EQ(plan.frame, 42u);
                    ASSERT_EQ(plan.view, view);
                    ASSERT_EQ(plan.servers.size(), servers);
                    ASSERT_NO_FATAL_FAILURE(expect_sound(plan, objects, grouping_of(GetParam())));
                }
            }
        }
    }
}

// Boxes anywhere on screens of any shape, one scene for every possible number of servers.
TEST_P(EveryPartitioner, MakesAValidPlanForEveryNumberOfServers) {
    std::mt19937 random(2000);
    const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
    for (std::size_t servers = 1; servers <= kMaxServers; ++servers) {
        SCOPED_TRACE(servers);
        View view;
        view.width = 1 + below(1 << (1 + below(11)));
        view.height = 1 + below(1 << (1 + below(11)));
        const int largest = 1 + below(1 << (1 + below(11)));
        std::vector<ProjectedObject> objects(static_cast<std::size_t>(below(1 << below(10))));
        for (ProjectedObject& object : objects) {
            const int x = below(view.width);
            const int y = below(view.height);
            object.box = intersect({x, y, x + 1 + below(largest), y + 1 + below(largest)}, view.viewport());
            object.visible = below(5) > 0;
            object.work = object.visible ? random() % (1u << below(32)) : 0;
            if (!object.visible) object.box = {x, y, x + 1, y + 1};
        }
        const std::vector<Object> model(objects.size(), test::cube({0, 0, 0}, 1, 1));
        const FramePlan plan =
            make_partitioner(GetParam(), model)->partition(input_of(objects, view, servers));
        ASSERT_EQ(plan.servers.size(), servers);
        ASSERT_EQ(problem(plan, objects.size(), grouping_of(GetParam())), std::nullopt);
        ASSERT_NO_FATAL_FAILURE(expect_sound(plan, objects, grouping_of(GetParam())));
    }
}

TEST_P(EveryPartitioner, MakesAValidPlanOfNoObjectsAtAll) {
    const auto partitioner = make_partitioner(GetParam(), {});
    for (const std::size_t servers : {1u, 5u, 1024u}) {
        const FramePlan plan = partitioner->partition(input_of({}, front_view(), servers));
        EXPECT_EQ(problem(plan, 0, grouping_of(GetParam())), std::nullopt);
        EXPECT_TRUE(transfers(plan).empty());
    }
}

TEST_P(EveryPartitioner, DecidesTheSameWhateverItDecidedBefore) {
    const std::vector<test::Scene> scenes = awkward_scenes();
    const test::Scene& scene = scenes[2];
    const View view = front_view();
    const std::vector<ProjectedObject> objects = project(scene.objects, view);
    const View other_view = front_view(99, 1000);
    const std::vector<ProjectedObject> other_objects = project(scene.objects, other_view);

    const auto fresh = make_partitioner(GetParam(), scene.objects);
    const auto used = make_partitioner(GetParam(), scene.objects);
    for (const std::size_t servers : {9u, 3u, 64u}) {
        used->partition(input_of(other_objects, other_view, servers + 1));
        used->partition(input_of(other_objects, other_view, servers));
        EXPECT_EQ(used->partition(input_of(objects, view, servers)),
                  fresh->partition(input_of(objects, view, servers)));
    }
}

TEST_P(EveryPartitioner, BalancesManyEqualObjects) {
    std::vector<Object> grid;
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 80; ++x)
            grid.push_back(
                test::cube({-1 + 0.025f * static_cast<float>(x), -1 + 0.025f * static_cast<float>(y),
                            0.01f * static_cast<float>((x * 7 + y * 3) % 11)},
                           0.02f, 100));
    const View view = front_view(1280, 960);
    const std::vector<ProjectedObject> objects = project(grid, view);
    const auto partitioner = make_partitioner(GetParam(), grid);
    // Sort-first counts an object on several tiles on each; MAHD cuts only along lines of its mesh.
    const bool sort_first = grouping_of(GetParam()) == Grouping::kAtLeastOnce;
    const double limit = GetParam() == Algorithm::kMahd ? 0.1 : sort_first ? 0.05 : 0.03;
    double last_overlap = 1;
    for (const std::size_t servers : {2u, 3u, 8u, 11u, 64u}) {
        const FramePlan plan = partitioner->partition(input_of(objects, view, servers));
        EXPECT_LT(test::imbalance(plan, objects), limit) << servers;
        const double overlap = test::overlap(plan, objects);
        if (sort_first) {
            EXPECT_GT(overlap, last_overlap) << servers;
            EXPECT_LT(overlap, 1.5) << servers;
        } else {
            EXPECT_EQ(overlap, 1) << servers;
        }
        last_overlap = overlap;
    }
}

TEST_P(EveryPartitioner, GivesOneServerEverything) {
    const std::vector<test::Scene> scenes = awkward_scenes();
    const View view = front_view();
    const std::vector<ProjectedObject> objects = project(scenes[2].objects, view);
    const FramePlan plan =
        make_partitioner(GetParam(), scenes[2].objects)->partition(input_of(objects, view, 1));
    EXPECT_EQ(plan.servers[0].group.size(), objects.size());
    EXPECT_EQ(area(plan.servers[0].tile), view.viewport().area());
    EXPECT_TRUE(transfers(plan).empty());
}

TEST_P(EveryPartitioner, RefusesMoreServersThanItsLimit) {
    const auto partitioner = make_partitioner(GetParam(), {});
    EXPECT_THROW(partitioner->partition(input_of({}, front_view(), 0)), CheckFailed);
    EXPECT_THROW(partitioner->partition(input_of({}, front_view(), kMaxServers + 1)), CheckFailed);
}

INSTANTIATE_TEST_SUITE_P(Algorithms, EveryPartitioner,
                         testing::ValuesIn(kAll<Algorithm>.begin(), kAll<Algorithm>.end()),
                         [](const auto& instance) {
                             std::string name(name_of(instance.param));
                             std::erase(name, '-');
                             return name;
                         });

TEST(AlgorithmName, IsReadBack) {
    for (const Algorithm algorithm : kAll<Algorithm>)
        EXPECT_EQ(parse<Algorithm>(name_of(algorithm)), algorithm);
    EXPECT_EQ(kAll<Algorithm>.size(), 4u);
    EXPECT_EQ(name_of(Algorithm::kKdSplit), "kd-split");
    EXPECT_EQ(name_of(Algorithm::kSortLast), "sort-last");
}

TEST(AlgorithmName, ThatIsUnknownIsAnErrorThatListsTheKnownOnes) {
    const Result<Algorithm> parsed = parse<Algorithm>("sort-middle");
    ASSERT_FALSE(parsed);
    EXPECT_THAT(parsed.error().message, HasSubstr("'sort-middle'"));
    EXPECT_THAT(parsed.error().message, HasSubstr("hybrid, mahd, kd-split, sort-last"));
}

}  // namespace
}  // namespace swath
