#pragma once
// The steps that one thread of an SAH build does, on a processor or on a GPU: plain functions over plain
// arrays. All of it is in an unnamed namespace, because two compilers build it for one program.
#include <cstddef>
#include <cstdint>
#include <cstring>
#if defined(__SSE2__) && !defined(__CUDACC__)
#include <emmintrin.h>
#endif

#include "common/octree/sah/sah_settings.h"

#if defined(__CUDACC__)
#define SWATH_BOTH __host__ __device__ inline
#else
#define SWATH_BOTH inline
#endif

namespace swath {
namespace {

// A triangle in a node: the part of the triangle's box that lies in the node's box.
struct SahReference {
    float low[3];
    std::uint32_t triangle;
    float high[3];
    std::uint32_t children;  // scratch while the node is cut: the children that it goes to, a bit each
};
static_assert(sizeof(SahReference) == 32);

struct SahBox {
    float low[3];
    float high[3];
};

// The numbers of boxes that start and that end in each bin of each axis. There is room for one bin more.
struct SahBins {
    std::uint32_t* starts[3];
    std::uint32_t* ends[3];
    std::uint32_t count;  // the same for all axes
};
SWATH_BOTH SahBins bins_at(std::uint32_t* first, std::uint32_t count) {
    SahBins bins;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        bins.starts[axis] = first + 2 * axis * (count + 1);
        bins.ends[axis] = bins.starts[axis] + count + 1;
    }
    bins.count = count;
    return bins;
}
inline constexpr std::size_t kBinWords = 6;  // for each of count + 1 bins

// A sample of an axis is a border between two bins. Counts are taken there and at the samples beside it.
struct SahSample {
    float before;  // positions of the sample before, of this one and of the one after
    float at;
    float after;
    std::uint32_t below_before;  // boxes that start below
    std::uint32_t below;
    std::uint32_t above;  // boxes that end above
    std::uint32_t above_after;
};
// The sides of boxes that are nearest to each axis's sample. (The fourth number fills a vector register.)
struct SahNearest {
    float last_end[4];          // at or below the sample
    float first_start[4];       // at or above the sample before
    float next_last_end[4];     // at or below the sample after
    float next_first_start[4];  // at or above the sample
};

// The best plane across an axis.
struct SahPlane {
    float position;
    float cost;  // of the cut node, traversal included, per area of the node
    bool any;    // whether there is a plane that costs less than a leaf
};

SWATH_BOTH float lower(float a, float b) { return b < a ? b : a; }
SWATH_BOTH float higher(float a, float b) { return a < b ? b : a; }
SWATH_BOTH std::uint32_t higher(std::uint32_t a, std::uint32_t b) { return a < b ? b : a; }

SWATH_BOTH std::uint32_t bins_for(std::uint32_t triangles, const SahSettings& settings) {
    const std::uint32_t bins = triangles / settings.bin_ratio;
    if (bins < settings.min_bins) return settings.min_bins;
    return bins > settings.max_bins ? settings.max_bins : bins;
}

inline constexpr float kHuge = 3e38f;  // beyond any coordinate

SWATH_BOTH std::uint32_t float_bits(float x) {
    std::uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Bins per length, 0 for an axis that cannot be divided.
SWATH_BOTH float bin_scale(const SahBox& box, int axis, std::uint32_t bins) {
    const float scale = static_cast<float>(bins) / (box.high[axis] - box.low[axis]);
    return scale < 3e38f ? scale : 0.0f;
}

// The bins of a point's three coordinates. Rounding may give one beyond the last.
struct ThreeBins {
    std::int32_t of[4];
};
#if defined(__SSE2__) && !defined(__CUDACC__)
struct BinScale {
    __m128 low;
    __m128 scale;
    // The fourth of `low` is 1, so that no denormal number, which would be slow, comes of a reference's
    // fourth word.
    BinScale(const float* lows, const float* scales)
        : low(_mm_setr_ps(lows[0], lows[1], lows[2], 1.0f)),
          scale(_mm_setr_ps(scales[0], scales[1], scales[2], 0.0f)) {}
    ThreeBins operator()(const float* x) const {
        ThreeBins bins;
        _mm_storeu_si128(reinterpret_cast<__m128i*>(bins.of),
                         _mm_cvttps_epi32(_mm_mul_ps(_mm_sub_ps(_mm_loadu_ps(x), low), scale)));
        return bins;
    }
};
#else
struct BinScale {
    float low[3];
    float scale[3];
    SWATH_BOTH BinScale(const float* lows, const float* scales)
        : low{lows[0], lows[1], lows[2]}, scale{scales[0], scales[1], scales[2]} {}
    SWATH_BOTH ThreeBins operator()(const float* x) const {
        ThreeBins bins{};
        for (int axis = 0; axis < 3; ++axis)
            bins.of[axis] = static_cast<std::int32_t>((x[axis] - low[axis]) * scale[axis]);
        return bins;
    }
};
#endif

// With at most so many bins, comparing a box with all samples takes less than finding its bins and counting
// there.
inline constexpr std::uint32_t kFewBins = 8;
#if defined(__SSE2__) && !defined(__CUDACC__)
// Counts, for each sample and axis, the references whose side is below. `sides` is the first reference's low
// or high; the others follow, a reference apart.
template <int kSamples>
void count_below(const float* sides, std::uint32_t count, const float (*samples)[4],
                 std::uint32_t (*below)[4]) {
    __m128 at[kSamples];
    __m128i sum[kSamples];
    for (int i = 0; i < kSamples; ++i) {
        at[i] = _mm_setr_ps(samples[i][0], samples[i][1], samples[i][2], 0.0f);
        sum[i] = _mm_setzero_si128();
    }
    for (std::uint32_t r = 0; r < count; ++r, sides += sizeof(SahReference) / sizeof(float)) {
        const __m128 side = _mm_loadu_ps(sides);
        for (int i = 0; i < kSamples; ++i)
            sum[i] = _mm_sub_epi32(sum[i], _mm_castps_si128(_mm_cmplt_ps(side, at[i])));
    }
    for (int i = 0; i < kSamples; ++i) _mm_storeu_si128(reinterpret_cast<__m128i*>(below[i]), sum[i]);
}
#endif
SWATH_BOTH void compare_with_samples(const SahReference* references, std::uint32_t count, const SahBox& box,
                                     const SahBins& bins) {
    constexpr int kSamples = kFewBins - 1;
    float samples[kSamples][4];
    for (int axis = 0; axis < 3; ++axis) {
        const float width = (box.high[axis] - box.low[axis]) / static_cast<float>(bins.count);
        for (int i = 0; i < kSamples; ++i)
            samples[i][axis] = box.low[axis] + static_cast<float>(i + 1) * width;
    }
    // The numbers of boxes that start, and that end, below each sample.
    std::uint32_t starts[kSamples][4] = {};
    std::uint32_t ends[kSamples][4] = {};
#if defined(__SSE2__) && !defined(__CUDACC__)
    if (bins.count <= kFewBins / 2) {
        count_below<kFewBins / 2 - 1>(references->low, count, samples, starts);
        count_below<kFewBins / 2 - 1>(references->high, count, samples, ends);
    } else {
        count_below<kSamples>(references->low, count, samples, starts);
        count_below<kSamples>(references->high, count, samples, ends);
    }
#else
    for (std::uint32_t r = 0; r < count; ++r)
        for (int i = 0; i < kSamples; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                starts[i][axis] += references[r].low[axis] < samples[i][axis] ? 1u : 0u;
                ends[i][axis] += references[r].high[axis] < samples[i][axis] ? 1u : 0u;
            }
#endif
    for (int axis = 0; axis < 3; ++axis) {
        std::uint32_t before[2] = {0, 0};
        for (std::uint32_t i = 0; i + 1 < bins.count; ++i) {
            bins.starts[axis][i] = starts[i][axis] - before[0];
            bins.ends[axis][i] = ends[i][axis] - before[1];
            before[0] = starts[i][axis];
            before[1] = ends[i][axis];
        }
        bins.starts[axis][bins.count - 1] = count - before[0];
        bins.ends[axis][bins.count - 1] = count - before[1];
    }
}

// Algorithm 1's BIN: one pass over the boxes for all three axes.
SWATH_BOTH void count_bins(const SahReference* references, std::uint32_t count, const SahBox& box,
                           const SahBins& bins) {
    if (bins.count <= kFewBins) return compare_with_samples(references, count, box, bins);
    float scale[3];
    for (int axis = 0; axis < 3; ++axis) scale[axis] = bin_scale(box, axis, bins.count);
    // The six arrays are contiguous.
    for (std::uint32_t i = 0; i < kBinWords * (bins.count + 1); ++i) bins.starts[0][i] = 0;
    const BinScale bins_of(box.low, scale);
    for (std::uint32_t i = 0; i < count; ++i) {
        const ThreeBins start = bins_of(references[i].low);
        const ThreeBins end = bins_of(references[i].high);
        for (int axis = 0; axis < 3; ++axis) {
            ++bins.starts[axis][start.of[axis]];
            ++bins.ends[axis][end.of[axis]];
        }
    }
    // Rounding may put a side beyond the last bin, into which it belongs.
    for (int axis = 0; axis < 3; ++axis) {
        bins.starts[axis][bins.count - 1] += bins.starts[axis][bins.count];
        bins.ends[axis][bins.count - 1] += bins.ends[axis][bins.count];
    }
}

// A node's sides, in units of its longest side, so that no area overflows.
struct SahShape {
    float unit;  // 1 / the longest side
    float side[3];
    SWATH_BOTH explicit SahShape(const SahBox& box) {
        float longest = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            side[axis] = box.high[axis] - box.low[axis];
            longest = higher(longest, side[axis]);
        }
        unit = 1.0f / longest;
        for (int axis = 0; axis < 3; ++axis) side[axis] *= unit;
    }
    SWATH_BOTH float area() const { return side[0] * side[1] + (side[0] + side[1]) * side[2]; }
};
// The cost of cutting a node across an axis, by equation 1.
struct SahAxis {
    float along;  // the node's side along the axis
    float face;   // the area of a plane in the node
    float girth;  // the area per length along the axis
    SWATH_BOTH SahAxis(const SahShape& shape, int axis) : along(shape.side[axis]) {
        const float one = shape.side[axis == 0 ? 1 : 0];
        const float other = shape.side[axis == 2 ? 1 : 2];
        face = one * other;
        girth = one + other;
    }
    // The triangles of both parts, each times the part's area, for a plane at `x` from the lower end.
    SWATH_BOTH float tests(float x, std::uint32_t below, std::uint32_t above) const {
        return static_cast<float>(static_cast<std::int32_t>(below)) * (face + x * girth) +
               static_cast<float>(static_cast<std::int32_t>(above)) * (face + (along - x) * girth);
    }
};
// A cut is cheaper than a leaf if its SahAxis::tests() are below this.
SWATH_BOTH float most_tests(const SahShape& shape, std::uint32_t count, const SahSettings& settings) {
    return (static_cast<float>(count) - settings.traversal_cost / settings.intersection_cost) * shape.area();
}
SWATH_BOTH float cost_of(const SahShape& shape, float tests, const SahSettings& settings) {
    return settings.traversal_cost + settings.intersection_cost * tests / shape.area();
}

// The cheapest sample of an axis, of equal ones the lowest. The numbers below and above a sample follow from
// those at the sample before it (algorithm 1's Found). If the axis cannot be divided there is no sample:
// `after` is not above `before`.
SWATH_BOTH SahSample best_sample(const std::uint32_t* starts, const std::uint32_t* ends, std::uint32_t bins,
                                 std::uint32_t count, const SahBox& box, const SahShape& shape, int axis) {
    SahSample best{};
    if (bin_scale(box, axis, bins) == 0.0f) return best;
    const SahAxis costs(shape, axis);
    const float step = costs.along / static_cast<float>(bins);
    float least = 3e38f;
    std::uint32_t found = 0;
    std::uint32_t below = 0;
    std::uint32_t above = count;
    for (std::uint32_t i = 1; i < bins; ++i) {
        below += starts[i - 1];
        above -= ends[i - 1];
        const float tests = costs.tests(static_cast<float>(i) * step, below, above);
        if (tests < least) {
            least = tests;
            found = i;
            best.below = below;
            best.above = above;
        }
    }
    best.below_before = best.below - starts[found - 1];
    best.above_after = best.above - ends[found];
    const float width = (box.high[axis] - box.low[axis]) / static_cast<float>(bins);
    best.before = box.low[axis] + static_cast<float>(found - 1) * width;
    best.at = box.low[axis] + static_cast<float>(found) * width;
    best.after = box.low[axis] + static_cast<float>(found + 1) * width;
    return best;
}

SWATH_BOTH SahNearest nothing_near() {
    SahNearest near;
    for (int i = 0; i < 4; ++i) {
        near.last_end[i] = near.next_last_end[i] = -kHuge;
        near.first_start[i] = near.next_first_start[i] = kHuge;
    }
    return near;
}
SWATH_BOTH void add_nearest(SahNearest& sum, const SahNearest& more) {
    for (int i = 0; i < 3; ++i) {
        sum.last_end[i] = higher(sum.last_end[i], more.last_end[i]);
        sum.first_start[i] = lower(sum.first_start[i], more.first_start[i]);
        sum.next_last_end[i] = higher(sum.next_last_end[i], more.next_last_end[i]);
        sum.next_first_start[i] = lower(sum.next_first_start[i], more.next_first_start[i]);
    }
}
// Finds the sides nearest to the samples of the three axes, in a second pass over the boxes.
SWATH_BOTH SahNearest nearest(const SahReference* references, std::uint32_t count, const SahSample* samples) {
    SahNearest near = nothing_near();
#if defined(__SSE2__) && !defined(__CUDACC__)
    const auto of = [&](float SahSample::*field) {
        return _mm_setr_ps(samples[0].*field, samples[1].*field, samples[2].*field, 0.0f);
    };
    const auto where = [](__m128 mask, __m128 then, __m128 otherwise) {
        return _mm_or_ps(_mm_and_ps(mask, then), _mm_andnot_ps(mask, otherwise));
    };
    const __m128 before = of(&SahSample::before);
    const __m128 at = of(&SahSample::at);
    const __m128 after = of(&SahSample::after);
    const __m128 huge = _mm_set1_ps(kHuge);
    const __m128 least = _mm_set1_ps(-kHuge);
    __m128 last_end = least;
    __m128 first_start = huge;
    __m128 next_last_end = least;
    __m128 next_first_start = huge;
    for (std::uint32_t i = 0; i < count; ++i) {
        const __m128 start = _mm_loadu_ps(references[i].low);
        const __m128 end = _mm_loadu_ps(references[i].high);
        last_end = _mm_max_ps(last_end, where(_mm_cmple_ps(end, at), end, least));
        next_last_end = _mm_max_ps(next_last_end, where(_mm_cmple_ps(end, after), end, least));
        first_start = _mm_min_ps(first_start, where(_mm_cmpge_ps(start, before), start, huge));
        next_first_start = _mm_min_ps(next_first_start, where(_mm_cmpge_ps(start, at), start, huge));
    }
    _mm_storeu_ps(near.last_end, last_end);
    _mm_storeu_ps(near.first_start, first_start);
    _mm_storeu_ps(near.next_last_end, next_last_end);
    _mm_storeu_ps(near.next_first_start, next_first_start);
#else
    for (std::uint32_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float start = references[i].low[axis];
            const float end = references[i].high[axis];
            if (end <= samples[axis].at) near.last_end[axis] = higher(near.last_end[axis], end);
            if (end <= samples[axis].after) near.next_last_end[axis] = higher(near.next_last_end[axis], end);
            if (start >= samples[axis].before) near.first_start[axis] = lower(near.first_start[axis], start);
            if (start >= samples[axis].at)
                near.next_first_start[axis] = lower(near.next_first_start[axis], start);
        }
    }
#endif
    return near;
}

// The cheapest plane at or beside a sample. Candidates are the sample, the last end in the bin before it and
// the first start in the bin after it. Where all boxes that end in one of these bins do so before any starts
// in it, as at the flat sides of what people build, both ends of the gap are candidates: a plane there cuts
// nothing of that bin in two.
SWATH_BOTH SahPlane best_plane(const SahSample& sample, const SahNearest& near, std::uint32_t count,
                               const SahBox& box, const SahShape& shape, int axis,
                               const SahSettings& settings) {
    SahPlane best{0.0f, 0.0f, false};
    if (!(sample.before < sample.after)) return best;
    const SahAxis costs(shape, axis);
    float least = most_tests(shape, count, settings);
    const float last_end = near.last_end[axis];
    const float first_start = near.first_start[axis];
    const float next_last_end = near.next_last_end[axis];
    const float next_first_start = near.next_first_start[axis];
    const bool gap_before = last_end <= first_start;
    const bool gap_after = next_last_end <= next_first_start;
    const float places[5] = {sample.at, last_end, first_start, next_last_end, next_first_start};
    const std::uint32_t below[5] = {sample.below, gap_before ? sample.below_before : sample.below,
                                    sample.below_before, sample.below, sample.below};
    const std::uint32_t above[5] = {sample.above, sample.above, sample.above, sample.above_after,
                                    gap_after ? sample.above_after : sample.above};
    const bool fits[5] = {true, last_end >= sample.before, gap_before && first_start <= sample.at,
                          gap_after && next_last_end >= sample.at, next_first_start <= sample.after};
    for (int i = 0; i < 5; ++i) {
        if (!fits[i] || !(places[i] > box.low[axis] && places[i] < box.high[axis])) continue;
        const float tests = costs.tests((places[i] - box.low[axis]) * shape.unit, below[i], above[i]);
        if (!(tests < least)) continue;
        least = tests;
        best.position = places[i];
        best.any = true;
    }
    best.cost = cost_of(shape, least, settings);
    return best;
}

// With at most so many triangles, trying all sides of all boxes is less work than bins.
inline constexpr std::uint32_t kExactTriangles = 8;
SWATH_BOTH SahPlane exact_plane(const SahReference* references, std::uint32_t count, const SahBox& box,
                                const SahShape& shape, int axis, const SahSettings& settings) {
    constexpr int kPlaces = 2 * kExactTriangles;
    SahPlane best{0.0f, 0.0f, false};
    float at[kPlaces];
    std::uint32_t below[kPlaces];
    std::uint32_t above[kPlaces];
    for (int i = 0; i < kPlaces; ++i) {
        at[i] = box.low[axis];
        below[i] = above[i] = 0;
    }
    for (std::uint32_t r = 0; r < count; ++r) {
        at[2 * r] = references[r].low[axis];
        at[2 * r + 1] = references[r].high[axis];
    }
    for (std::uint32_t r = 0; r < count; ++r) {
        const float low = references[r].low[axis];
        const float high = references[r].high[axis];
        for (int i = 0; i < kPlaces; ++i) {
            below[i] += (low < at[i] ? 1u : 0u) | (high <= at[i] ? 1u : 0u);
            above[i] += high > at[i] ? 1u : 0u;
        }
    }
    const SahAxis costs(shape, axis);
    float tests[kPlaces];
    for (int i = 0; i < kPlaces; ++i)
        tests[i] = costs.tests((at[i] - box.low[axis]) * shape.unit, below[i], above[i]);
    float least = most_tests(shape, count, settings);
    for (std::uint32_t i = 0; i < 2 * count; ++i) {
        if (!(tests[i] < least && at[i] > box.low[axis] && at[i] < box.high[axis])) continue;
        least = tests[i];
        best.position = at[i];
        best.any = true;
    }
    best.cost = cost_of(shape, least, settings);
    return best;
}

// The sides of a plane that an interval lies on: bit 0 below, bit 1 above. An interval that only touches the
// plane is on one side, one that lies in the plane is below.
SWATH_BOTH std::uint32_t sides(float low, float high, float plane) {
    return (low < plane || high <= plane ? 1u : 0u) | (high > plane ? 2u : 0u);
}

// The planes that cut a node, at most one across each axis.
struct SahCut {
    SahPlane planes[3];
};
// Drops planes that gain less than settings.least_gain of what the best one gains.
SWATH_BOTH void drop_poor(SahCut& cut, std::uint32_t count, const SahSettings& settings) {
    const float leaf = settings.intersection_cost * static_cast<float>(count);
    float best = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        if (cut.planes[axis].any) best = higher(best, leaf - cut.planes[axis].cost);
    for (int axis = 0; axis < 3; ++axis)
        if (leaf - cut.planes[axis].cost < settings.least_gain * best) cut.planes[axis].any = false;
}
SWATH_BOTH std::uint32_t axes_of(const SahCut& cut) {
    return (cut.planes[0].any ? 1u : 0u) | (cut.planes[1].any ? 2u : 0u) | (cut.planes[2].any ? 4u : 0u);
}
// The positions of the planes. An axis without one gets a position beyond all coordinates.
SWATH_BOTH void positions_of(const SahCut& cut, float* positions) {
    for (int axis = 0; axis < 3; ++axis)
        positions[axis] = cut.planes[axis].any ? cut.planes[axis].position : kHuge;
}
// Keeps the cheapest of several planes, and none if there is only one.
SWATH_BOTH void keep_best(SahCut& cut) {
    int best = -1;
    int planes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!cut.planes[axis].any) continue;
        ++planes;
        if (best < 0 || cut.planes[axis].cost < cut.planes[best].cost) best = axis;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (axis != best || planes == 1) cut.planes[axis].any = false;
}

#if defined(__SSE2__) && !defined(__CUDACC__)
// of[sides] has a bit for each child that a reference goes to. `sides` tells the axes along which the
// reference is below a plane (bits 0 to 2) and above it (bits 3 to 5).
struct ChildrenTable {
    std::uint8_t of[64];
    constexpr ChildrenTable() : of{} {
        for (int sides = 0; sides < 64; ++sides)
            for (int child = 0; child < 8; ++child) {
                bool goes = true;
                for (int axis = 0; axis < 3; ++axis) {
                    const int bit = (child >> axis & 1) != 0 ? 3 + axis : axis;
                    goes = goes && (sides >> bit & 1) != 0;
                }
                if (goes) of[sides] = static_cast<std::uint8_t>(of[sides] | 1 << child);
            }
    }
};
inline constexpr ChildrenTable kChildren;
#endif

// The children that a reference goes to, a bit for each of eight. All are below along an axis that is not
// cut.
SWATH_BOTH std::uint32_t children_of(const SahReference& r, const float* positions) {
#if defined(__SSE2__) && !defined(__CUDACC__)
    const __m128 plane = _mm_setr_ps(positions[0], positions[1], positions[2], 0.0f);
    const __m128 low = _mm_loadu_ps(r.low);
    const __m128 high = _mm_loadu_ps(r.high);
    const auto below = static_cast<std::uint32_t>(
        _mm_movemask_ps(_mm_or_ps(_mm_cmplt_ps(low, plane), _mm_cmple_ps(high, plane))));
    const auto above = static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpgt_ps(high, plane)));
    return kChildren.of[(below & 7) | (above & 7) << 3];
#else
    constexpr std::uint32_t kOf[3][4] = {{0, 0x55, 0xaa, 0xff}, {0, 0x33, 0xcc, 0xff}, {0, 0x0f, 0xf0, 0xff}};
    return kOf[0][sides(r.low[0], r.high[0], positions[0])] &
           kOf[1][sides(r.low[1], r.high[1], positions[1])] &
           kOf[2][sides(r.low[2], r.high[2], positions[2])];
#endif
}
// Cuts a reference to the part that lies in a child.
SWATH_BOTH void clip_to_child(SahReference& r, std::uint32_t child, const float* positions) {
    for (int axis = 0; axis < 3; ++axis) {
        if ((child >> axis & 1) != 0)
            r.low[axis] = higher(r.low[axis], positions[axis]);
        else
            r.high[axis] = lower(r.high[axis], positions[axis]);
    }
}
SWATH_BOTH SahBox box_of_child(SahBox box, std::uint32_t child, const SahCut& cut) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!cut.planes[axis].any) continue;
        ((child >> axis & 1) != 0 ? box.low : box.high)[axis] = cut.planes[axis].position;
    }
    return box;
}
SWATH_BOTH std::uint32_t lowest_bit(std::uint32_t bits) {
#if defined(__CUDA_ARCH__)
    return static_cast<std::uint32_t>(__ffs(static_cast<int>(bits)) - 1);
#else
    return static_cast<std::uint32_t>(__builtin_ctz(bits));
#endif
}

// Counts references by child, in eight counters of a byte each, which are emptied before one is full.
struct ChildCounts {
    std::uint32_t of[8] = {};
    SWATH_BOTH void add(std::uint32_t children) {
        // Adds bit i to byte i.
        bytes_ += ((children & 0x7f) * 0x0002040810204081ull & 0x0001010101010101ull) |
                  static_cast<std::uint64_t>(children >> 7) << 56;
        if (++pending_ == 255) empty();
    }
    SWATH_BOTH void empty() {
        for (int child = 0; child < 8; ++child)
            of[child] += static_cast<std::uint32_t>(bytes_ >> 8 * child & 0xff);
        bytes_ = 0;
        pending_ = 0;
    }

  private:
    std::uint64_t bytes_ = 0;
    std::uint32_t pending_ = 0;
};

// The most triangles that the leaves of a child with `count` may have, if its parent's leaves may have
// `allowed` and all children together need `needed` or more.
SWATH_BOTH std::uint32_t share_of(std::uint32_t allowed, std::uint32_t needed, std::uint32_t count) {
    const std::uint32_t least = count > 0 ? count : 1;
    return least + static_cast<std::uint32_t>(static_cast<std::uint64_t>(allowed - needed) * least / needed);
}
// Room for the nodes of a tree whose leaves have `allowed` triangles, an empty leaf counting as having one.
SWATH_BOTH std::uint32_t nodes_for(std::uint32_t allowed) { return 2 * allowed; }

}  // namespace
}  // namespace swath
