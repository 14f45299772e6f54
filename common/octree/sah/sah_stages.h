#pragma once
// The stages of an SAH build. Each is a function object that is called for every chunk of references, every
// node or every subtree of a level, in parallel and in any order. No call writes what another call of the
// same stage reads or writes.
#include <cstddef>
#include <cstdint>

#include "common/octree/sah/sah_kernels.h"
#include "common/octree/sah/sah_subtree.h"

namespace swath {
namespace {

// An octree node that is to be cut: its references and its place in the tree.
struct Open {
    SahBox box;
    std::uint32_t first;
    std::uint32_t count;
    std::uint32_t allowed;  // the most triangles in its leaves
    std::uint32_t node;
    std::uint32_t depth;
    std::uint32_t first_chunk;
    std::uint32_t chunks;
};
// The references of one node that one thread works on.
struct Chunk {
    std::uint32_t open;
    std::uint32_t first;
    std::uint32_t count;
};
// A child that one thread builds, and where its nodes and triangles go among those of all subtrees.
struct Subtree {
    Open at;
    std::size_t first_node;
    std::size_t first_triangle;
};
struct SubtreeSizes {
    std::uint32_t nodes;
    std::uint32_t triangles;
};

struct MakeReferences {
    const unsigned char* positions;
    std::size_t stride;
    std::uint32_t position_count;
    const std::uint32_t* indices;
    SahReference* references;
    SWATH_BOTH void operator()(std::uint32_t triangle) const {
        const std::uint32_t* const corner = indices + 3 * std::size_t{triangle};
        SahReference r;
        if (corner[0] < position_count && corner[1] < position_count && corner[2] < position_count) {
            const float* const a = reinterpret_cast<const float*>(positions + stride * corner[0]);
            const float* const b = reinterpret_cast<const float*>(positions + stride * corner[1]);
            const float* const c = reinterpret_cast<const float*>(positions + stride * corner[2]);
            float sum = 0.0f;  // NaN if a coordinate is no finite number
            for (int axis = 0; axis < 3; ++axis) {
                // Adding 0 makes -0 a 0: no bit may depend on which of two equal zeros is taken.
                r.low[axis] = lower(lower(a[axis], b[axis]), c[axis]) + 0.0f;
                r.high[axis] = higher(higher(a[axis], b[axis]), c[axis]) + 0.0f;
                sum += (a[axis] + b[axis] + c[axis]) * 0.0f;
            }
            if (sum != 0.0f) r.low[0] = r.high[0] = -kHuge;  // make_references() refuses it
        } else {
            r.low[0] = r.high[0] = -kHuge;
        }
        r.triangle = triangle;
        r.children = 0;
        references[triangle] = r;
    }
};
struct BoxOf {
    SWATH_BOTH SahBox operator()(const SahReference& r) const {
        return {{r.low[0], r.low[1], r.low[2]}, {r.high[0], r.high[1], r.high[2]}};
    }
};
struct Bounding {
    SWATH_BOTH SahBox operator()(const SahBox& a, const SahBox& b) const {
        SahBox box;
        for (int axis = 0; axis < 3; ++axis) {
            box.low[axis] = lower(a.low[axis], b.low[axis]);
            box.high[axis] = higher(a.high[axis], b.high[axis]);
        }
        return box;
    }
};

SWATH_BOTH SahBins bins_of_chunk(std::uint32_t* bins, std::uint32_t chunk, std::uint32_t count,
                                 std::uint32_t max_bins) {
    return bins_at(bins + kBinWords * (std::size_t{max_bins} + 1) * chunk, count);
}

struct BinChunk {
    const Open* opens;
    const Chunk* chunks;
    const SahReference* references;
    std::uint32_t* bins;
    SahSettings settings;
    SWATH_BOTH void operator()(std::uint32_t chunk) const {
        const Chunk c = chunks[chunk];
        const Open& open = opens[c.open];
        count_bins(references + c.first, c.count, open.box,
                   bins_of_chunk(bins, chunk, bins_for(open.count, settings), settings.max_bins));
    }
};

// Adds up the bins of a node's chunks along one axis, into the first chunk's, and finds the best sample.
struct FindSample {
    const Open* opens;
    std::uint32_t* bins;
    SahSample* samples;  // three a node
    SahSettings settings;
    SWATH_BOTH void operator()(std::uint32_t work) const {
        const Open& open = opens[work / 3];
        const int axis = static_cast<int>(work % 3);
        const std::uint32_t count = bins_for(open.count, settings);
        const SahBins sum = bins_of_chunk(bins, open.first_chunk, count, settings.max_bins);
        for (std::uint32_t chunk = 1; chunk < open.chunks; ++chunk) {
            const SahBins more = bins_of_chunk(bins, open.first_chunk + chunk, count, settings.max_bins);
            for (std::uint32_t bin = 0; bin < count; ++bin) {
                sum.starts[axis][bin] += more.starts[axis][bin];
                sum.ends[axis][bin] += more.ends[axis][bin];
            }
        }
        samples[work] = best_sample(sum.starts[axis], sum.ends[axis], count, open.count, open.box,
                                    SahShape(open.box), axis);
    }
};

struct FindNearest {
    const Chunk* chunks;
    const SahReference* references;
    const SahSample* samples;
    SahNearest* nears;  // of each chunk
    bool refine;
    SWATH_BOTH void operator()(std::uint32_t chunk) const {
        const Chunk c = chunks[chunk];
        nears[chunk] = refine ? nearest(references + c.first, c.count, samples + 3 * std::size_t{c.open})
                              : nothing_near();
    }
};

struct FindCut {
    const Open* opens;
    const SahSample* samples;
    const SahNearest* nears;
    SahCut* cuts;
    SahSettings settings;
    SWATH_BOTH void operator()(std::uint32_t i) const {
        const Open& open = opens[i];
        SahNearest near = nears[open.first_chunk];
        for (std::uint32_t chunk = 1; chunk < open.chunks; ++chunk)
            add_nearest(near, nears[open.first_chunk + chunk]);
        for (int axis = 0; axis < 3; ++axis)
            cuts[i].planes[axis] = best_plane(samples[3 * std::size_t{i} + static_cast<std::size_t>(axis)],
                                              near, open.count, open.box, SahShape(open.box), axis, settings);
        if (open.depth >= kMaxSahDepth)
            for (SahPlane& plane : cuts[i].planes) plane.any = false;
        drop_poor(cuts[i], open.count, settings);
    }
};

// A level's counts are in the order of nodes, then children, then chunks.
SWATH_BOTH std::size_t count_at(const Open& open, std::uint32_t child, std::uint32_t chunk) {
    return std::size_t{8} * open.first_chunk + std::size_t{child} * open.chunks + (chunk - open.first_chunk);
}

struct CountChildren {
    const Open* opens;
    const Chunk* chunks;
    const SahCut* cuts;
    const SahReference* references;
    unsigned char* children;  // of each reference
    std::uint32_t* counts;
    SWATH_BOTH void operator()(std::uint32_t chunk) const {
        const Chunk c = chunks[chunk];
        float positions[3];
        positions_of(cuts[c.open], positions);
        ChildCounts counted;
        for (std::uint32_t i = c.first; i < c.first + c.count; ++i) {
            const std::uint32_t to = children_of(references[i], positions);
            children[i] = static_cast<unsigned char>(to);
            counted.add(to);
        }
        counted.empty();
        for (std::uint32_t child = 0; child < 8; ++child)
            counts[count_at(opens[c.open], child, chunk)] = counted.of[child];
    }
};

struct Scatter {
    const Open* opens;
    const Chunk* chunks;
    const SahCut* cuts;
    const SahReference* references;
    const unsigned char* children;
    const std::uint32_t* begins;
    SahReference* parts;
    SWATH_BOTH void operator()(std::uint32_t chunk) const {
        const Chunk c = chunks[chunk];
        float positions[3];
        positions_of(cuts[c.open], positions);
        std::uint32_t at[8];
        for (std::uint32_t child = 0; child < 8; ++child)
            at[child] = begins[count_at(opens[c.open], child, chunk)];
        for (std::uint32_t i = c.first; i < c.first + c.count; ++i) {
            const SahReference& r = references[i];
            std::uint32_t to = children[i];
            if ((to & (to - 1)) == 0) {
                parts[at[lowest_bit(to)]++] = r;
                continue;
            }
            for (; to != 0; to &= to - 1) {
                const std::uint32_t child = lowest_bit(to);
                SahReference& part = parts[at[child]++];
                part = r;
                clip_to_child(part, child, positions);
            }
        }
    }
};

// Worker w of W builds every W-th subtree.
struct BuildSubtrees {
    const Subtree* subtrees;
    std::uint32_t count;
    std::uint32_t workers;
    const SahReference* references;
    SahReference* scratch;
    std::uint32_t scratch_each;
    std::uint32_t* bins;
    std::uint32_t* nodes;  // 4 words each
    std::uint32_t* triangles;
    SubtreeSizes* sizes;
    SahSettings settings;
    SWATH_BOTH void operator()(std::uint32_t worker) const {
        SahScratch mine{scratch + std::size_t{scratch_each} * worker, scratch_each,
                        bins + kBinWords * (std::size_t{settings.max_bins} + 1) * worker};
        for (std::uint32_t i = worker; i < count; i += workers) {
            const Open& at = subtrees[i].at;
            SahSubtreeOutput out{nodes + 4 * subtrees[i].first_node, triangles + subtrees[i].first_triangle,
                                 0, 0};
            if (at.count > settings.grain) {
                // No cut was worth it, so it becomes a leaf.
                out.nodes[0] = out.nodes[2] = out.nodes[3] = 0;
                out.nodes[1] = out.triangle_count = at.count;
                out.node_count = 1;
                for (std::uint32_t r = 0; r < at.count; ++r)
                    out.triangles[r] = references[at.first + r].triangle;
            } else {
                for (std::uint32_t r = 0; r < at.count; ++r) mine.references[r] = references[at.first + r];
                build_subtree({at.box, 0, 0, at.count, at.allowed, at.depth}, settings, mine, out);
            }
            sizes[i] = {out.node_count, out.triangle_count};
        }
    }
};

// Copies a subtree to its place: its root to the roots, its other nodes and its triangles to the tree.
struct PlaceSubtree {
    const Subtree* subtrees;
    const SubtreeSizes* sizes;
    const SubtreeSizes* begins;  // in the tree, of the nodes but the root and of the triangles
    const std::uint32_t* nodes;
    const std::uint32_t* triangles;
    std::uint32_t* roots;
    std::uint32_t* to_nodes;  // at the first subtree's begin, like to_triangles
    std::uint32_t* to_triangles;
    SWATH_BOTH void operator()(std::uint32_t i) const {
        const Subtree& s = subtrees[i];
        const SubtreeSizes begin = begins[i];
        const std::uint32_t* from = nodes + 4 * s.first_node;
        std::uint32_t* const behind = to_nodes + 4 * std::size_t{begin.nodes - begins[0].nodes};
        for (std::uint32_t n = 0; n < sizes[i].nodes; ++n, from += 4) {
            std::uint32_t* to = n == 0 ? roots + 4 * std::size_t{i} : behind + 4 * (std::size_t{n} - 1);
            const std::uint32_t axes = from[3] & 7;
            to[0] = from[0] + (axes == 0 ? begin.triangles : 0);
            to[1] = from[1];
            to[2] = from[2];
            // begin.nodes is where node 1 goes, the first behind the root.
            to[3] = axes == 0 ? 0 : ((from[3] >> 3) - 1 + begin.nodes) << 3 | axes;
        }
        std::uint32_t* const of = to_triangles + (begin.triangles - begins[0].triangles);
        for (std::uint32_t t = 0; t < sizes[i].triangles; ++t) of[t] = triangles[s.first_triangle + t];
    }
};

}  // namespace
}  // namespace swath
