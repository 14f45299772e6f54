#pragma once
// One thread builds all below a small node. See sah_kernels.h.
#include "common/octree/sah/sah_kernels.h"

namespace swath {
namespace {

// The memory that a subtree is written to, as much as it may need. nodes[0] is the root.
struct SahSubtreeOutput {
    std::uint32_t* nodes;      // 4 words a node, as in SahNode; links count from nodes[0]
    std::uint32_t* triangles;  // of the leaves, which count from triangles[0]
    std::uint32_t node_count;
    std::uint32_t triangle_count;
};

// A thread's memory: a stack of references, which holds the lists of all waiting nodes, and bins.
struct SahScratch {
    SahReference* references;
    std::uint32_t max_references;
    std::uint32_t* bins;  // kBinWords * (max_bins + 1)
};

struct SahPending {
    SahBox box;
    std::uint32_t node;
    std::uint32_t first;  // in the scratch's references
    std::uint32_t count;
    std::uint32_t allowed;  // the most triangles in its leaves
    std::uint32_t depth;
};

SWATH_BOTH void put_leaf(SahSubtreeOutput& out, const SahScratch& scratch, const SahPending& at) {
    std::uint32_t* node = out.nodes + 4 * std::size_t{at.node};
    node[0] = out.triangle_count;
    node[1] = at.count;
    node[2] = 0;
    node[3] = 0;
    for (std::uint32_t i = 0; i < at.count; ++i)
        out.triangles[out.triangle_count++] = scratch.references[at.first + i].triangle;
}

SWATH_BOTH SahCut find_cut(const SahPending& at, const SahSettings& settings, const SahScratch& scratch) {
    const SahReference* const references = scratch.references + at.first;
    const SahShape shape(at.box);
    SahCut cut;
    if (at.count <= kExactTriangles) {
        for (int axis = 0; axis < 3; ++axis)
            cut.planes[axis] = exact_plane(references, at.count, at.box, shape, axis, settings);
        return cut;
    }
    const SahBins bins = bins_at(scratch.bins, bins_for(at.count, settings));
    count_bins(references, at.count, at.box, bins);
    SahSample samples[3];
    for (int axis = 0; axis < 3; ++axis)
        samples[axis] =
            best_sample(bins.starts[axis], bins.ends[axis], bins.count, at.count, at.box, shape, axis);
    const SahNearest near = settings.refine ? nearest(references, at.count, samples) : nothing_near();
    for (int axis = 0; axis < 3; ++axis)
        cut.planes[axis] = best_plane(samples[axis], near, at.count, at.box, shape, axis, settings);
    return cut;
}

// Cuts a node across one axis. References above the plane stay in the node's list, those below go on top of
// the stack. Returns the number of children, 0 if the cut would need too many triangles or too much scratch.
SWATH_BOTH std::uint32_t cut_in_two(const SahPending& at, int axis, const SahPlane& plane,
                                    SahScratch& scratch, SahSubtreeOutput& out, SahPending* children) {
    std::uint32_t counts[2] = {};
    for (std::uint32_t i = at.first; i < at.first + at.count; ++i) {
        const std::uint32_t of =
            sides(scratch.references[i].low[axis], scratch.references[i].high[axis], plane.position);
        counts[0] += of & 1;
        counts[1] += of >> 1;
    }
    const std::uint32_t needed = higher(counts[0], 1u) + higher(counts[1], 1u);
    // One more, because a reference that goes above only is written to *low, too.
    if (needed > at.allowed || at.first + at.count + counts[0] + 1 > scratch.max_references) return 0;
    const SahReference* from = scratch.references + at.first;
    SahReference* high = scratch.references + at.first;
    SahReference* low = high + at.count;
    for (std::uint32_t i = 0; i < at.count; ++i) {
        const SahReference r = *from++;
        const float bottom = r.low[axis];
        const float top = r.high[axis];
        const std::uint32_t of = sides(bottom, top, plane.position);
        *low = r;
        low->high[axis] = lower(top, plane.position);
        low += of & 1;
        *high = r;
        high->low[axis] = higher(bottom, plane.position);
        high += of >> 1;
    }
    for (std::uint32_t above = 0; above < 2; ++above) {
        SahPending& child = children[1 - above];
        child = at;
        child.depth = at.depth + 1;
        child.node = out.node_count + above;
        (above != 0 ? child.box.low : child.box.high)[axis] = plane.position;
        if (above == 0) child.first = at.first + at.count;
        child.count = counts[above];
        child.allowed = share_of(at.allowed, needed, child.count);
    }
    std::uint32_t* node = out.nodes + 4 * std::size_t{at.node};
    node[0] = node[1] = node[2] = 0;
    node[axis] = float_bits(plane.position);
    node[3] = out.node_count << 3 | 1u << axis;
    out.node_count += 2;
    return 2;
}

// Cuts a node across all axes of `cut`. The children's lists go on top of the stack. Returns like
// cut_in_two().
SWATH_BOTH std::uint32_t cut_in_eight(const SahPending& at, const SahCut& cut, SahScratch& scratch,
                                      SahSubtreeOutput& out, SahPending* children) {
    SahReference* const references = scratch.references + at.first;
    const std::uint32_t axes = axes_of(cut);
    float positions[3];
    positions_of(cut, positions);
    ChildCounts counted;
    for (std::uint32_t i = 0; i < at.count; ++i) {
        references[i].children = children_of(references[i], positions);
        counted.add(references[i].children);
    }
    counted.empty();
    const std::uint32_t* const counts = counted.of;
    std::uint32_t needed = 0;
    std::uint32_t begins[8];
    std::uint32_t end = at.first + at.count;
    for (std::uint32_t child = 0; child < 8; ++child) {
        if ((child & ~axes) == 0) needed += higher(counts[child], 1u);
        begins[child] = end;
        end += counts[child];
    }
    if (needed > at.allowed || end > scratch.max_references) return 0;
    std::uint32_t* node = out.nodes + 4 * std::size_t{at.node};
    for (int axis = 0; axis < 3; ++axis)
        node[axis] = cut.planes[axis].any ? float_bits(cut.planes[axis].position) : 0;
    node[3] = out.node_count << 3 | axes;
    std::uint32_t made = 0;
    for (std::uint32_t child = 0; child < 8; ++child) {
        if ((child & ~axes) != 0) continue;
        children[made++] = {box_of_child(at.box, child, cut),
                            out.node_count++,
                            begins[child],
                            counts[child],
                            share_of(at.allowed, needed, counts[child]),
                            at.depth + 1};
    }
    for (std::uint32_t i = 0; i < at.count; ++i) {
        const SahReference& r = references[i];
        std::uint32_t to = r.children;
        if ((to & (to - 1)) == 0) {
            scratch.references[begins[lowest_bit(to)]++] = r;
            continue;
        }
        for (; to != 0; to &= to - 1) {
            const std::uint32_t child = lowest_bit(to);
            SahReference& part = scratch.references[begins[child]++];
            part = r;
            clip_to_child(part, child, positions);
        }
    }
    return made;
}

// Builds depth first: an octree down to settings.kd_triangles, below it a kd-tree, cut across the axis that
// costs least. `root`'s references are the first in the scratch memory.
SWATH_BOTH void build_subtree(const SahPending& root, const SahSettings& settings, SahScratch& scratch,
                              SahSubtreeOutput& out) {
    SahPending stack[7 * kMaxSahDepth + 1];
    std::uint32_t waiting = 1;
    stack[0] = root;
    out.node_count = 1;
    out.triangle_count = 0;
    while (waiting > 0) {
        const SahPending at = stack[--waiting];
        std::uint32_t made = 0;
        if (at.count > 1 && at.depth < kMaxSahDepth) {
            SahCut cut = find_cut(at, settings, scratch);
            if (at.count > settings.kd_triangles) drop_poor(cut, at.count, settings);
            if (at.count > settings.kd_triangles && axes_of(cut) != 0)
                made = cut_in_eight(at, cut, scratch, out, stack + waiting);
            if (made == 0) {
                int best = -1;
                for (int axis = 0; axis < 3; ++axis)
                    if (cut.planes[axis].any && (best < 0 || cut.planes[axis].cost < cut.planes[best].cost))
                        best = axis;
                if (best >= 0) made = cut_in_two(at, best, cut.planes[best], scratch, out, stack + waiting);
            }
        }
        if (made == 0) put_leaf(out, scratch, at);
        waiting += made;
    }
}

}  // namespace
}  // namespace swath
