#include "common/geometry/box.h"

#include <cmath>

namespace swath {
namespace {

// The margin of box_at(). Let a point be at x at pose 0, move by m, and be at e = x + m at pose 1. At pose p
// it is at (1 - p) x + p e. With u = 2^-24, half a unit in the last place of 1:
// - `end` contains the rounded e, which is off by at most u |e|;
// - the product p m is off by at most u |p m|, where |m| is below (1 + u) (|x| + |e|);
// - the sum is off by at most u times itself, and it is below |x| + |e| plus the product's error.
// All of it is below 3 u (|x| + |e|) plus terms of order u^2, which the fourth u covers. Denormal numbers,
// which some machines flush to zero, put two operands and two results off by at most the smallest normal
// number each: kTiniest.
constexpr double kLoss = 4 * 0x1p-24;
constexpr double kTiniest = 4 * double{std::numeric_limits<float>::min()};

float round_down(double x) {
    const auto rounded = static_cast<float>(x);
    return rounded > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}

}  // namespace

Box box_at(const Box& start, const Box& end, float pose) {
    if (pose <= 0 || end.empty()) return start;
    if (pose >= 1) return end;
    const double p{pose};
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto magnitude = [axis](const Box& of) {
            return std::max(std::abs(double{of.min[axis]}), std::abs(double{of.max[axis]}));
        };
        const double loss = kLoss * (magnitude(start) + magnitude(end)) + kTiniest;
        const auto between = [p](float from, float to) { return (1 - p) * from + p * to; };
        // No point leaves the range between its two ends, since rounding is monotone.
        box.min[axis] = std::max(round_down(between(start.min[axis], end.min[axis]) - loss),
                                 std::min(start.min[axis], end.min[axis]));
        box.max[axis] = std::min(-round_down(-between(start.max[axis], end.max[axis]) - loss),
                                 std::max(start.max[axis], end.max[axis]));
    }
    return box;
}

}  // namespace swath
