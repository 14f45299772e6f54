#include "common/geometry/box.h"

#include <cmath>

namespace swath {
namespace {

// A point's place at p is (1 - p) x + p (x + m), and with u = 2^-24 half a unit in the last place of 1,
// - `end` is around the rounded x + m, which is off by u |e| at most, e being its place there;
// - the product p m is off by u |p m|, and |m| by no more than u more than |x| + |e|;
// - the sum is off by u times itself, which is no larger than |x| + |e| and the error of the product.
// Together that is below 3 u (|x| + |e|) and what is of the order of u squared. Where numbers have no full
// precision any more, or machines make zeros of them, two operands and two results are off by the smallest
// that has, at most.
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
        // Nothing leaves what is between its two ends: rounding is monotone.
        box.min[axis] = std::max(round_down(between(start.min[axis], end.min[axis]) - loss),
                                 std::min(start.min[axis], end.min[axis]));
        box.max[axis] = std::min(-round_down(-between(start.max[axis], end.max[axis]) - loss),
                                 std::max(start.max[axis], end.max[axis]));
    }
    return box;
}

}  // namespace swath
