#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <vector>

namespace swath {

// A rectangle of pixels, [x0, x1) by [y0, y1), with the origin at the lower left as in OpenGL. All rectangles
// without pixels mean the same.
struct Rect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    bool empty() const { return x0 >= x1 || y0 >= y1; }
    int width() const { return empty() ? 0 : x1 - x0; }
    int height() const { return empty() ? 0 : y1 - y0; }
    std::int64_t area() const { return std::int64_t{width()} * height(); }
    bool contains(const Rect& inner) const {
        return inner.empty() || (x0 <= inner.x0 && inner.x1 <= x1 && y0 <= inner.y0 && inner.y1 <= y1);
    }
    bool operator==(const Rect&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Rect& r) {
    return out << '[' << r.x0 << ',' << r.x1 << ")x[" << r.y0 << ',' << r.y1 << ')';
}

inline Rect intersect(const Rect& a, const Rect& b) {
    const Rect r{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
    return r.empty() ? Rect{} : r;
}

// The smallest rectangle around both.
inline Rect bounding(const Rect& a, const Rect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// The part of `a` outside of `b`, as at most four rectangles that do not overlap.
inline std::vector<Rect> subtract(const Rect& a, const Rect& b) {
    const Rect hole = intersect(a, b);
    if (hole.empty()) return a.empty() ? std::vector<Rect>{} : std::vector<Rect>{a};
    std::vector<Rect> rest;
    for (const Rect& r :
         std::array<Rect, 4>{Rect{a.x0, a.y0, a.x1, hole.y0}, Rect{a.x0, hole.y1, a.x1, a.y1},
                             Rect{a.x0, hole.y0, hole.x0, hole.y1}, Rect{hole.x1, hole.y0, a.x1, hole.y1}})
        if (!r.empty()) rest.push_back(r);
    return rest;
}

// Rectangles that do not overlap.
using Region = std::vector<Rect>;

inline std::int64_t area(const Region& region) {
    std::int64_t sum = 0;
    for (const Rect& r : region) sum += r.area();
    return sum;
}

}  // namespace swath
