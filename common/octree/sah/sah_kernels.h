#pragma once
// What one thread of an SAH build does, on a processor or on a GPU: plain functions over plain arrays.
// Everything is in an unnamed namespace, because two compilers build it for one program.
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

// A triangle in a node: the part of its box that lies in the node's.
struct SahReference {
    float low[3];
    std::uint32_t triangle;
    float high[3];
    std::uint32_t children;  // scratch of the thread that cuts the node: those it goes to, a bit each
};
static_assert(sizeof(SahReference) == 32);

struct SahBox {
    float low[3];
    float high[3];
};

// How many boxes start and how many end in each bin of each axis. There is room for one bin more.
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
inline constexpr std::size_t kBinWords = 6;  // for each bin, the one more included

// A sample of an axis, between two bins, and what is counted there and at the samples beside it.
struct SahSample {
    float before;  // where the samples are
    float at;
    float after;
    std::uint32_t below_before;  // boxes that start below
    std::uint32_t below;
    std::uint32_t above;  // boxes that end above
    std::uint32_t above_after;
};
// What is nearest to a sample of each axis. (Four numbers, so that they can be had at once.)
struct SahNearest {
    float last_end[4];          // below the sample
    float first_start[4];       // above the one before
    float next_last_end[4];     // below the one after
    float next_first_start[4];  // above the sample
};

// Where an axis is best cut.
struct SahPlane {
    float position;
    float cost;  // of the cut node, traversal included; in units of the node's area
    bool any;    // whether there is a place that costs less than a leaf
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

// The bins' factor from a length to a bin, 0 for an axis that cannot be divided.
SWATH_BOTH float bin_scale(const SahBox& box, int axis, std::uint32_t bins) {
    const float scale = static_cast<float>(bins) / (box.high[axis] - box.low[axis]);
    return scale < 3e38f ? scale : 0.0f;
}

// Three numbers' bins, not limited to the last one.
struct ThreeBins {
    std::int32_t of[4];
};
#if defined(__SSE2__) && !defined(__CUDACC__)
struct BinScale {
    __m128 low;
    __m128 scale;
    // The fourth of `low` is 1, so that what stands in a reference's fourth makes no denormal numbers, which
    // are slow.
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

// Of few bins: a box is compared with all samples between them, which takes less than finding its bins and
// counting there.
inline constexpr std::uint32_t kFewBins = 8;
#if defined(__SSE2__) && !defined(__CUDACC__)
// `sides` is the first reference's; the others' follow, a reference apart.
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
    // How many start, and how many end, below each sample.
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
    // All six stand together.
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
    // What rounding took beyond the last bin belongs there.
    for (int axis = 0; axis < 3; ++axis) {
        bins.starts[axis][bins.count - 1] += bins.starts[axis][bins.count];
        bins.ends[axis][bins.count - 1] += bins.ends[axis][bins.count];
    }
}

// A node's sides, in units of its longest side, so that no area overflows.
struct SahShape {
    float unit;  // of length
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
// What it costs to cut it along an axis, by equation 1.
struct SahAxis {
    float along;  // the axis
    float face;   // area of the face that a plane makes
    float girth;  // area a length
    SWATH_BOTH SahAxis(const SahShape& shape, int axis) : along(shape.side[axis]) {
        const float one = shape.side[axis == 0 ? 1 : 0];
        const float other = shape.side[axis == 2 ? 1 : 2];
        face = one * other;
        girth = one + other;
    }
    // Triangles times the areas that they are met with, for a plane at x from the lower end.
    SWATH_BOTH float tests(float x, std::uint32_t below, std::uint32_t above) const {
        return static_cast<float>(static_cast<std::int32_t>(below)) * (face + x * girth) +
               static_cast<float>(static_cast<std::int32_t>(above)) * (face + (along - x) * girth);
    }
};
// What a cut must be below to be cheaper than a leaf.
SWATH_BOTH float most_tests(const SahShape& shape, std::uint32_t count, const SahSettings& settings) {
    return (static_cast<float>(count) - settings.traversal_cost / settings.intersection_cost) * shape.area();
}
SWATH_BOTH float cost_of(const SahShape& shape, float tests, const SahSettings& settings) {
    return settings.traversal_cost + settings.intersection_cost * tests / shape.area();
}

// Algorithm 1's Found: the numbers below and above each sample follow from those before it; the cheapest one,
// the lowest of equals. There is none (`after` is not above `before`) where the axis cannot be divided.
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
// A second pass: what is nearest to the samples of the three axes.
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

// The cheapest place at or beside a sample: the sample, the last end before it and the first start after it,
// and, where everything of a bin beside it ends before anything starts, as at the flat sides of what people
// build, the ends of that gap, where a plane cuts nothing of that bin in two.
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

// Of few triangles all sides of all boxes are candidates, and bins would be more work.
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

// On which sides of a plane an interval lies: bit 0 below, bit 1 above. What only touches it is on its own
// side, and what lies in it is below.
SWATH_BOTH std::uint32_t sides(float low, float high, float plane) {
    return (low < plane || high <= plane ? 1u : 0u) | (high > plane ? 2u : 0u);
}

// Where a node is cut: up to three planes. An axis without one has a plane beyond everything.
struct SahCut {
    SahPlane planes[3];
};
// Leaves out planes that gain much less than the best one.
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
SWATH_BOTH void positions_of(const SahCut& cut, float* positions) {
    for (int axis = 0; axis < 3; ++axis)
        positions[axis] = cut.planes[axis].any ? cut.planes[axis].position : kHuge;
}
// Leaves the cheapest plane; if there is one only, none.
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
// For the axes along which a reference goes below (bits 0 to 2) and above (3 to 5).
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

// The children, of eight, that a reference goes to: along an axis that is not cut all are below.
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
// The part of a reference that lies in child `child`.
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

// Counts references by their children: eight counters of a byte each, emptied before one is full.
struct ChildCounts {
    std::uint32_t of[8] = {};
    SWATH_BOTH void add(std::uint32_t children) {
        // Bit i to the lowest bit of byte i.
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

// How many triangles the leaves of a child may have, if its parent's may have `allowed` and all children
// together need at least `needed` of them.
SWATH_BOTH std::uint32_t share_of(std::uint32_t allowed, std::uint32_t needed, std::uint32_t count) {
    const std::uint32_t least = count > 0 ? count : 1;
    return least + static_cast<std::uint32_t>(static_cast<std::uint64_t>(allowed - needed) * least / needed);
}
// The nodes of a tree whose leaves have so many.
SWATH_BOTH std::uint32_t nodes_for(std::uint32_t allowed) { return 2 * allowed; }

}  // namespace
}  // namespace swath
