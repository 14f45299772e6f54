#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "common/geometry/box.h"
#include "common/geometry/camera.h"
#include "common/geometry/rect.h"

namespace swath::sim {

// The part of each pixel that lines cover, 0 to 1, rows bottom-up. Where lines meet the greater coverage
// counts, so that corners and edges drawn twice are not brighter than the rest.
struct Coverage {
    Coverage(int w, int h)
        : width(w), height(h), of(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    int width;
    int height;
    std::vector<float> of;
};

// The ends of a line in pixels; (0, 0) is the lower left corner of the picture.
using Segment = std::array<glm::dvec2, 2>;

// The visible part of the line from `a` to `b`, points of the model. It is cut at all six planes of the
// view's frustum, so it lies in the viewport. Nothing if the line is outside.
std::optional<Segment> project_segment(const glm::vec3& a, const glm::vec3& b, const View& view);

// Draws an anti-aliased line of `width` pixels with round ends, in the pixels of `clip`.
void draw_line(Coverage& coverage, const Segment& line, double width, const Rect& clip);

// A box on the screen: the visible parts of its twelve edges, hidden ones too, and its screen_bounds.
struct Wireframe {
    std::vector<Segment> edges;
    Rect bounds;
};
Wireframe project_wireframe(const Box& box, const View& view);

// Draws the edges, only in pixels of the bounds.
void draw(Coverage& coverage, const Wireframe& frame, double width);
// Multiplies the coverage between the edges by `remains`.
void fade_behind(Coverage& coverage, const Wireframe& frame, float remains);

}  // namespace swath::sim
