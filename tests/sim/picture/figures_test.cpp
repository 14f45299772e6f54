#include "sim/picture/figures.h"

#include <gtest/gtest.h>

#include "common/geometry/frustum.h"
#include "sim/picture/layers.h"
#include "tests/client/partition/scenes.h"
#include "tests/sim/picture/scenes.h"

namespace swath::sim::test {
namespace {

// A sponge of 700 objects and its plan.
struct Example {
    std::vector<Object> objects = swath::test::awkward_scenes()[2].objects;
    View view = swath::test::front_view(320, 240);
    FramePlan plan(std::size_t servers) const {
        const auto projected = project(objects, view);
        return make_partitioner(Algorithm::kHybrid, objects)
            ->partition(swath::test::input_of(projected, view, servers));
    }
};

TEST(FiguresTest, objects_in_more_than_one_group_are_found) {
    EXPECT_EQ(replicated_objects(small_plan(), 5), (std::vector<ObjectId>{1}));
    EXPECT_EQ(replicated_objects(Example().plan(8), 700), std::vector<ObjectId>{});
}

TEST(FiguresTest, only_replicated_objects_are_highlighted) {
    const Example example;
    FramePlan plan;
    plan.view = example.view;
    plan.servers = {{{0, 1}, {{0, 0, 160, 240}}, {0, 0, 160, 240}},
                    {{1, 2}, {{160, 0, 320, 240}}, {160, 0, 320, 240}}};
    const Picture before = with_tile_borders(dimmed(plain(320, 240, 0), 1), plan);
    const Picture after = replication_figure(plain(320, 240, 0), plan, example.objects);
    const Rect bounds = screen_bounds(example.objects[1].box, example.view);
    int changed = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            if (pixel(before, x, y) == pixel(after, x, y)) continue;
            ++changed;
            EXPECT_TRUE(bounds.contains({x, y, x + 1, y + 1})) << x << ' ' << y;
        }
    EXPECT_GT(changed, 20);
}

TEST(FiguresTest, every_figure_has_the_same_bytes_on_every_run) {
    const Example example;
    const FramePlan plan = example.plan(16);
    const auto all = [&] {
        const Picture frame = plain(320, 240, 120);
        return std::vector<Picture>{
            replication_figure(frame, plan, example.objects), transfer_figure(frame, plan),
            boxes_figure(frame, plan.view, example.objects), overlap_figure(frame, plan)};
    };
    const std::vector<Picture> once = all();
    EXPECT_EQ(once, all());
    for (std::size_t a = 0; a < once.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(once[a], once[b]) << a << ' ' << b;
}

TEST(FiguresTest, a_transferred_pixel_is_brighter_than_the_same_pixel_that_is_not) {
    const Example example;
    const FramePlan plan = example.plan(16);
    const std::vector<std::uint16_t> counts = transfer_counts(plan);
    const Picture picture = transfer_figure(plain(320, 240, 200), plan);
    const Picture borders = with_tile_borders(plain(320, 240, 0), plan);
    int seen[2] = {};
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            if (pixel(borders, x, y) != Rgb{0, 0, 0}) continue;
            const bool sent = counts[static_cast<std::size_t>(y) * 320 + static_cast<std::size_t>(x)] > 0;
            ++seen[sent ? 1 : 0];
            EXPECT_EQ(pixel(picture, x, y)[0] > 160, sent) << x << ' ' << y;
        }
    EXPECT_GT(seen[0], 1000);
    EXPECT_GT(seen[1], 1000);
}

}  // namespace
}  // namespace swath::sim::test
