#include "sim/picture/lines.h"

#include <gtest/gtest.h>

#include <numeric>

#include "common/geometry/frustum.h"
#include "tests/client/partition/scenes.h"

namespace swath::sim {
namespace {

using swath::test::front_view;

float at(const Coverage& coverage, int x, int y) {
    return coverage.of[static_cast<std::size_t>(y) * static_cast<std::size_t>(coverage.width) +
                       static_cast<std::size_t>(x)];
}

double total(const Coverage& coverage) {
    return std::accumulate(coverage.of.begin(), coverage.of.end(), 0.0);
}

// The smallest rectangle around all covered pixels.
Rect covered(const Coverage& coverage) {
    Rect rect;
    for (int y = 0; y < coverage.height; ++y)
        for (int x = 0; x < coverage.width; ++x)
            if (at(coverage, x, y) > 0) rect = bounding(rect, {x, y, x + 1, y + 1});
    return rect;
}

TEST(LineTest, a_level_line_through_pixel_centres_covers_them_whole) {
    Coverage coverage(8, 4);
    draw_line(coverage, {glm::dvec2{1.5, 2.5}, glm::dvec2{5.5, 2.5}}, 1, {0, 0, 8, 4});
    for (int x = 1; x <= 5; ++x) EXPECT_EQ(at(coverage, x, 2), 1.0f) << x;
    EXPECT_EQ(covered(coverage), (Rect{1, 2, 6, 3}));
}

TEST(LineTest, a_line_between_two_rows_covers_half_of_each) {
    Coverage coverage(8, 4);
    draw_line(coverage, {glm::dvec2{1.5, 2}, glm::dvec2{5.5, 2}}, 1, {0, 0, 8, 4});
    EXPECT_EQ(at(coverage, 3, 1), 0.5f);
    EXPECT_EQ(at(coverage, 3, 2), 0.5f);
}

TEST(LineTest, steep_and_flat_lines_cover_about_length_times_width) {
    for (const glm::dvec2& to : {glm::dvec2{90, 50}, {50, 90}, {10, 90}, {90, 10}, {10, 10.001}}) {
        Coverage coverage(100, 100);
        const glm::dvec2 from{50, 50};
        draw_line(coverage, {from, to}, 2, {0, 0, 100, 100});
        EXPECT_NEAR(total(coverage), 2 * glm::distance(from, to), 0.15 * 2 * glm::distance(from, to));
    }
}

TEST(LineTest, drawing_twice_changes_nothing) {
    Coverage once(50, 50);
    const Segment line{glm::dvec2{3.2, 4.7}, glm::dvec2{40.1, 31}};
    draw_line(once, line, 1.5, {0, 0, 50, 50});
    Coverage twice = once;
    draw_line(twice, line, 1.5, {0, 0, 50, 50});
    EXPECT_EQ(once.of, twice.of);
}

TEST(LineTest, what_lies_outside_the_clip_or_the_picture_is_cut_off) {
    Coverage coverage(20, 10);
    draw_line(coverage, {glm::dvec2{-1e12, 5.5}, glm::dvec2{1e12, 5.5}}, 1, {4, 0, 400, 400});
    EXPECT_EQ(covered(coverage), (Rect{4, 5, 20, 6}));
    draw_line(coverage, {glm::dvec2{-50, -9}, glm::dvec2{-2, 300}}, 1, {0, 0, 20, 10});
    draw_line(coverage, {glm::dvec2{3, 3}, glm::dvec2{6, 6}}, 1, {});
    EXPECT_EQ(covered(coverage), (Rect{4, 5, 20, 6}));
}

TEST(LineTest, a_point_is_a_dot) {
    Coverage coverage(9, 9);
    draw_line(coverage, {glm::dvec2{4.5, 4.5}, glm::dvec2{4.5, 4.5}}, 1, {0, 0, 9, 9});
    EXPECT_EQ(covered(coverage), (Rect{4, 4, 5, 5}));
}

TEST(SegmentTest, the_middle_of_the_view_is_the_middle_of_the_picture) {
    const auto segment = project_segment({0, 0, 0}, {0, 0, 1}, front_view(640, 480));
    ASSERT_TRUE(segment);
    for (const glm::dvec2& end : *segment) {
        EXPECT_NEAR(end.x, 320, 1e-3);
        EXPECT_NEAR(end.y, 240, 1e-3);
    }
}

TEST(SegmentTest, a_line_out_of_the_picture_ends_at_its_edge) {
    const auto segment = project_segment({-100, 0, 0}, {0, 0, 0}, front_view(640, 480));
    ASSERT_TRUE(segment);
    EXPECT_NEAR((*segment)[0].x, 0, 1e-9);
    EXPECT_NEAR((*segment)[0].y, 240, 1e-3);
    EXPECT_NEAR((*segment)[1].x, 320, 1e-3);
}

TEST(SegmentTest, a_line_that_runs_behind_the_eye_is_cut_in_front_of_it) {
    const auto segment = project_segment({0.1f, 0.1f, 0}, {0.1f, 0.1f, 400}, front_view(640, 480));
    ASSERT_TRUE(segment);
    for (const glm::dvec2& end : *segment) {
        EXPECT_GE(end.x, -1e-6);
        EXPECT_LE(end.x, 640 + 1e-6);
        EXPECT_GE(end.y, -1e-6);
        EXPECT_LE(end.y, 480 + 1e-6);
    }
}

TEST(SegmentTest, nothing_is_left_of_a_line_behind_the_eye_or_beside_the_picture) {
    EXPECT_FALSE(project_segment({0, 0, 5}, {1, 1, 9}, front_view()));
    EXPECT_FALSE(project_segment({-90, 0, 0}, {-90, 1, 0}, front_view()));
    EXPECT_FALSE(project_segment({-90, 0, 0}, {0, 90, 0}, front_view()));
    EXPECT_FALSE(project_segment({0, 0, -1000}, {0, 1, -1000}, front_view()));
}

TEST(WireframeTest, lies_within_the_objects_screen_bounds_and_reaches_their_sides) {
    const View view = front_view(320, 240);
    const Box box = swath::test::cube({0.3f, 0.2f, 0.1f}, 0.3f, 1).box;
    const Rect bounds = screen_bounds(box, view);
    Coverage coverage(320, 240);
    draw(coverage, project_wireframe(box, view), 1.5);
    EXPECT_TRUE(bounds.contains(covered(coverage)));
    EXPECT_GE(covered(coverage).width(), bounds.width() - 2);
    EXPECT_GE(covered(coverage).height(), bounds.height() - 2);
    // Lines, not a filled box.
    EXPECT_LT(total(coverage), 0.25 * static_cast<double>(bounds.area()));
}

TEST(WireframeTest, no_awkward_box_is_drawn_outside_its_bounds) {
    const View view = front_view(160, 120);
    for (const auto& scene : swath::test::awkward_scenes())
        for (std::size_t i = 0; i < std::min<std::size_t>(scene.objects.size(), 60); ++i) {
            Coverage coverage(160, 120);
            draw(coverage, project_wireframe(scene.objects[i].box, view), 1);
            EXPECT_TRUE(screen_bounds(scene.objects[i].box, view).contains(covered(coverage)))
                << scene.name << ' ' << i;
        }
}

TEST(WireframeTest, boxes_behind_the_camera_and_empty_ones_draw_nothing) {
    const View view = front_view(64, 48);
    for (const Box& box : {swath::test::cube({0, 0, 9}, 1, 1).box, Box{}}) {
        EXPECT_TRUE(project_wireframe(box, view).edges.empty());
        Coverage coverage(64, 48);
        draw(coverage, project_wireframe(box, view), 1);
        EXPECT_EQ(total(coverage), 0);
    }
}

TEST(WireframeTest, fades_what_lies_between_its_edges_and_nothing_else) {
    const View view = front_view(320, 240);
    const Wireframe frame = project_wireframe(swath::test::cube({0, 0, 0}, 0.3f, 1).box, view);
    Coverage coverage(320, 240);
    for (float& of : coverage.of) of = 1;
    fade_behind(coverage, frame, 0.25f);
    EXPECT_EQ(at(coverage, 160, 120), 0.25f);
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            // From the front the cube's near face covers all of it, up to the rounding of its bounds.
            const Rect& b = frame.bounds;
            const float of = at(coverage, x, y);
            if (x < b.x0 || x >= b.x1 || y < b.y0 || y >= b.y1) {
                EXPECT_EQ(of, 1.0f) << x << ' ' << y;
            } else if (x > b.x0 && x < b.x1 - 1 && y > b.y0 && y < b.y1 - 1) {
                EXPECT_EQ(of, 0.25f) << x << ' ' << y;
            }
        }
}

}  // namespace
}  // namespace swath::sim
