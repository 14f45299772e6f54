#include "sim/picture/lines.h"

#include <algorithm>
#include <cmath>

#include "common/geometry/frustum.h"

namespace swath::sim {
namespace {

double distance(const glm::dvec2& point, const Segment& line) {
    const glm::dvec2 along = line[1] - line[0];
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::clamp(glm::dot(point - line[0], along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(point, line[0] + t * along);
}

}  // namespace

std::optional<Segment> project_segment(const glm::vec3& a, const glm::vec3& b, const View& view) {
    const glm::dmat4 matrix(view.clip_from_model);
    const std::array<glm::dvec4, 2> ends{matrix * glm::dvec4(a, 1.0), matrix * glm::dvec4(b, 1.0)};
    double first = 0;  // the part of the line that is inside, from 0 to 1
    double last = 1;
    for (const int axis : {0, 1, 2})
        for (const double sign : {-1.0, 1.0}) {
            const double from = ends[0].w + sign * ends[0][axis];
            const double to = ends[1].w + sign * ends[1][axis];
            if (from < 0 && to < 0) return {};
            if (from < 0) first = std::max(first, from / (from - to));
            if (to < 0) last = std::min(last, from / (from - to));
        }
    if (!(first <= last)) return {};
    Segment segment;
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec4 at = ends[0] + (i == 0 ? first : last) * (ends[1] - ends[0]);
        if (!(at.w > 0)) return {};
        segment[i] = {(at.x / at.w * 0.5 + 0.5) * view.width, (at.y / at.w * 0.5 + 0.5) * view.height};
    }
    return segment;
}

void draw_line(Coverage& coverage, const Segment& line, double width, const Rect& clip) {
    const Rect area = intersect(clip, {0, 0, coverage.width, coverage.height});
    if (area.empty()) return;
    const glm::dvec2 along = line[1] - line[0];
    // Walks the pixels along the axis in which the line is longer; across it the line covers few.
    const int major = std::abs(along.x) >= std::abs(along.y) ? 0 : 1;
    const int minor = 1 - major;
    const double slope = along[major] != 0 ? along[minor] / along[major] : 0.0;
    const double reach = 0.5 * width + 0.5;
    const double across = reach * std::sqrt(1 + slope * slope);
    const std::array<int, 2> low{area.x0, area.y0};
    const std::array<int, 2> high{area.x1 - 1, area.y1 - 1};
    // Clamps before it converts: an end may lie farther away than an int reaches.
    const auto pixel = [&](double at, int axis) {
        const auto a = static_cast<std::size_t>(axis);
        return static_cast<int>(std::floor(std::clamp(at, low[a] - 1.0, high[a] + 1.0)));
    };
    const auto m = static_cast<std::size_t>(major);
    const auto n = static_cast<std::size_t>(minor);
    const int begin = std::max(low[m], pixel(std::min(line[0][major], line[1][major]) - reach, major));
    const int end = std::min(high[m], pixel(std::max(line[0][major], line[1][major]) + reach, major));
    for (int i = begin; i <= end; ++i) {
        const double middle = line[0][minor] + slope * (i + 0.5 - line[0][major]);
        const int to = std::min(high[n], pixel(middle + across, minor));
        for (int j = std::max(low[n], pixel(middle - across, minor)); j <= to; ++j) {
            const int x = major == 0 ? i : j;
            const int y = major == 0 ? j : i;
            const double covered = reach - distance({x + 0.5, y + 0.5}, line);
            float& of = coverage.of[static_cast<std::size_t>(y) * static_cast<std::size_t>(coverage.width) +
                                    static_cast<std::size_t>(x)];
            of = std::max(of, static_cast<float>(std::clamp(covered, 0.0, 1.0)));
        }
    }
}

Wireframe project_wireframe(const Box& box, const View& view) {
    Wireframe frame;
    frame.bounds = screen_bounds(box, view);
    if (frame.bounds.empty()) return frame;
    for (int corner = 0; corner < 8; ++corner)
        for (const int axis : {1, 2, 4}) {
            if ((corner & axis) != 0) continue;
            const auto edge = project_segment(box.corner(corner), box.corner(corner | axis), view);
            if (edge) frame.edges.push_back(*edge);
        }
    return frame;
}

void draw(Coverage& coverage, const Wireframe& frame, double width) {
    for (const Segment& edge : frame.edges) draw_line(coverage, edge, width, frame.bounds);
}

void fade_behind(Coverage& coverage, const Wireframe& frame, float remains) {
    const Rect area = intersect(frame.bounds, {0, 0, coverage.width, coverage.height});
    for (int y = area.y0; y < area.y1; ++y) {
        // A box is convex: in a row it lies between the outermost crossings of its edges.
        const double at = y + 0.5;
        double low = area.x1;
        double high = area.x0;
        for (const auto& [a, b] : frame.edges) {
            if ((a.y <= at) == (b.y <= at)) continue;
            const double x = a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        for (int x = std::max(area.x0, static_cast<int>(std::ceil(low - 0.5)));
             x < area.x1 && x + 0.5 <= high; ++x)
            coverage.of[static_cast<std::size_t>(y) * static_cast<std::size_t>(coverage.width) +
                        static_cast<std::size_t>(x)] *= remains;
    }
}

}  // namespace swath::sim
