#include "common/cull/wide/hierarchy_kernel.h"

#include "common/base/lanes/lanes.h"
#include "common/cull/wide/lane_steps.h"

namespace swath::SWATH_KERNEL {
namespace {

constexpr float kInfinity = __builtin_inff();

// The lanes of a block that hold boxes, on a level of `count` boxes.
inline std::uint32_t lanes_of(std::uint32_t count, std::uint32_t block) {
    const std::uint32_t rest = count - 16 * block;
    return rest >= 16 ? 0xffffu : (1u << rest) - 1;
}

// The block need not exist.
inline void prefetch_block(const float* block) {
    for (int line = 0; line < 6; ++line) __builtin_prefetch(block + 16 * line);
}

// So many blocks fit into a first-level cache, where the second three planes find them again.
constexpr std::uint32_t kTile = 64;

std::uint32_t* scan(const float* blocks, std::uint32_t count, const KernelPlane* planes,
                    std::uint32_t first_id, std::uint32_t* out) {
    const std::uint32_t block_count = count / 16 + (count % 16 != 0 ? 1 : 0);
    const Words lanes = load(kCounting);
    std::uint32_t kept[kTile];
    for (std::uint32_t begin = 0; begin < block_count; begin += kTile) {
        const std::uint32_t end = block_count - begin < kTile ? block_count - begin : kTile;
        const float* const tile = blocks + kBlockFloats * begin;
        {
            const ThreePlanes first(planes);
            for (std::uint32_t i = 0; i < end; ++i)
                kept[i] = ~first.outside(tile + kBlockFloats * i) & 0xffff;
        }
        if (begin + end == block_count) kept[end - 1] &= lanes_of(count, block_count - 1);
        const ThreePlanes second(planes + 3);
        for (std::uint32_t i = 0; i < end; ++i) {
            prefetch_block(tile + kBlockFloats * (i + kTile));
            if (kept[i] == 0) continue;
            const std::uint32_t mask = kept[i] & ~second.outside(tile + kBlockFloats * i);
            out = packed(out, add(all(first_id + 16 * (begin + i)), lanes), mask);
        }
    }
    return out;
}

inline std::uint32_t* walk_leaf(const WideWalk& walk, std::uint32_t block, std::uint32_t planes,
                                std::uint32_t* out) {
    const float* const b = walk.levels[0].blocks + kBlockFloats * block;
    std::uint32_t kept = lanes_of(walk.levels[0].count, block);
    for (; planes != 0; planes &= planes - 1) {
        const KernelPlane& plane = walk.planes[__builtin_ctz(planes)];
        kept &= ~below_zero(distance(plane, b, plane.p));
    }
    return packed(out, add(all(16 * block), load(kCounting)), kept);
}

// The 16 children of an inner block, as tested.
struct Children {
    std::uint32_t kept;                    // a bit for each child that is not outside
    std::uint32_t crossing;                // a bit for each of those that is not inside either
    alignas(64) std::uint32_t planes[16];  // the planes that each crosses, a bit each
};

inline bool test(WideWalk& walk, int level, WidePiece piece, Children& children) {
    ++walk.work.inner_blocks;
    const float* const b = walk.levels[level].blocks + kBlockFloats * piece.block;
    std::uint32_t kept = lanes_of(walk.levels[level].count, piece.block);
    Words crossed = all(0u);
    for (std::uint32_t planes = piece.planes; planes != 0; planes &= planes - 1) {
        const int k = __builtin_ctz(planes);
        const KernelPlane& plane = walk.planes[k];
        kept &= ~below_zero(distance(plane, b, plane.p));
        crossed = set_bits_where(crossed, ~at_least_zero(distance(plane, b, plane.n)) & 0xffff, 1u << k);
    }
    children.kept = kept;
    children.crossing = kept & non_zero(crossed);
    store(children.planes, crossed);
    return kept != 0;
}

// Writes the ids below the children [first, last) on `level`.
inline std::uint32_t* fill_children(const WideWalk& walk, int level, std::uint32_t first, std::uint32_t last,
                                    std::uint32_t* out) {
    const std::uint64_t begin = std::uint64_t{first} << 4 * level;  // 32 bits cannot be shifted by 32
    const std::uint64_t end = std::uint64_t{last} << 4 * level;
    const std::uint32_t count = walk.levels[0].count;
    return fill(static_cast<std::uint32_t>(begin), end < count ? static_cast<std::uint32_t>(end) : count,
                out);
}

// Takes children from `kept`, from the lowest on, as long as they lie inside, and writes the ids below them.
// Takes none if the lowest crosses a plane.
inline std::uint32_t* take_inside(const WideWalk& w, int level, std::uint32_t block, const Children& children,
                                  std::uint32_t& kept, std::uint32_t* out) {
    const auto i = static_cast<std::uint32_t>(__builtin_ctz(kept));
    const auto run = static_cast<std::uint32_t>(__builtin_ctz(~((kept & ~children.crossing) >> i)));
    kept &= ~(((1u << run) - 1) << i);
    return fill_children(w, level, 16 * block + i, 16 * block + i + run, out);
}

inline void prefetch_crossing(const WideWalk& w, int level, std::uint32_t block, const Children& children) {
    for (std::uint32_t ahead = children.crossing; ahead != 0; ahead &= ahead - 1)
        prefetch_block(w.levels[level - 1].blocks +
                       kBlockFloats * (16 * block + static_cast<std::uint32_t>(__builtin_ctz(ahead))));
}

// Walks the blocks below a block on level 1 that was tested.
std::uint32_t* walk_leaves(WideWalk& w, std::uint32_t block, const Children& children, std::uint32_t* out) {
    w.work.leaf_blocks += static_cast<unsigned>(__builtin_popcount(children.crossing));
    std::uint32_t kept = children.kept;
    while (kept != 0) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(kept));
        if ((children.crossing >> i & 1) != 0) {
            out = walk_leaf(w, 16 * block + i, children.planes[i], out);
            kept &= kept - 1;
        } else {
            out = take_inside(w, 1, block, children, kept, out);
        }
    }
    return out;
}

// Walks the blocks below a block on level 2 that was tested. It tests a child before it walks the leaves of
// the child before, so that there is time to fetch the new child's leaves.
std::uint32_t* walk_pairs(WideWalk& w, std::uint32_t block, const Children& children, std::uint32_t* out) {
    Children tested[2];
    std::uint32_t turn = 0;
    std::uint32_t waiting = 0;  // the block whose children are in tested[turn]
    bool waits = false;
    std::uint32_t kept = children.kept;
    while (kept != 0) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(kept));
        const bool crosses = (children.crossing >> i & 1) != 0;
        bool found = false;
        if (crosses) {
            found = test(w, 1, {16 * block + i, children.planes[i]}, tested[1 - turn]);
            if (found) prefetch_crossing(w, 1, 16 * block + i, tested[1 - turn]);
            kept &= kept - 1;
        }
        if (waits) out = walk_leaves(w, waiting, tested[turn], out);
        waits = found;
        waiting = 16 * block + i;
        turn = 1 - turn;
        if (!crosses) out = take_inside(w, 2, block, children, kept, out);
    }
    return waits ? walk_leaves(w, waiting, tested[turn], out) : out;
}

std::uint32_t* walk(WideWalk& w, int level, WidePiece piece, std::uint32_t* out) {
    if (piece.planes == 0) return fill_children(w, level + 1, piece.block, piece.block + 1, out);
    if (level == 0) {
        ++w.work.leaf_blocks;
        return walk_leaf(w, piece.block, piece.planes, out);
    }
    Children children;
    if (!test(w, level, piece, children)) return out;
    prefetch_crossing(w, level, piece.block, children);
    if (level == 1) return walk_leaves(w, piece.block, children, out);
    if (level == 2) return walk_pairs(w, piece.block, children, out);
    std::uint32_t kept = children.kept;
    while (kept != 0) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(kept));
        if ((children.crossing >> i & 1) != 0) {
            out = walk(w, level - 1, {16 * piece.block + i, children.planes[i]}, out);
            kept &= kept - 1;
        } else {
            out = take_inside(w, level, piece.block, children, kept, out);
        }
    }
    return out;
}

WidePiece* pieces(WideWalk& w, int level, WidePiece piece, int to, WidePiece* out) {
    if (level == to) {
        *out++ = piece;
        return out;
    }
    Children children;
    if (piece.planes == 0) {
        children.kept = lanes_of(w.levels[level].count, piece.block);
        store(children.planes, all(0u));
    } else if (!test(w, level, piece, children)) {
        return out;
    }
    for (std::uint32_t rest = children.kept; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(rest));
        out = pieces(w, level - 1, {16 * piece.block + i, children.planes[i]}, to, out);
    }
    return out;
}

std::uint32_t crossing(WideWalk& w, int level, WidePiece piece) {
    Children children;
    if (!test(w, level, piece, children)) return 0;
    if (level == 2) return static_cast<std::uint32_t>(__builtin_popcount(children.crossing));
    std::uint32_t sum = 0;
    for (std::uint32_t rest = children.crossing; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(rest));
        sum += crossing(w, level - 1, {16 * piece.block + i, children.planes[i]});
    }
    return sum;
}

void bound(const float* blocks, std::uint32_t count, bool of_objects, float* parents) {
    const std::uint32_t parent_count = (count + 15) / 16;
    for (std::uint32_t block = 0; block < parent_count; ++block) {
        const float* const b = blocks + kBlockFloats * block;
        float* const parent = parents + kBlockFloats * (block / 16) + block % 16;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Floats low = load(b + 16 * axis);
            Floats high = load(b + 48 + 16 * axis);
            if (of_objects) {
                const std::uint32_t finite =
                    at_least_zero(multiply(low, all(0.0f))) & at_least_zero(multiply(high, all(0.0f)));
                const Floats other = low;
                low = where(finite, lower_of(low, high), all(-kInfinity));
                high = where(finite, higher_of(other, high), all(kInfinity));
            }
            parent[16 * axis] = lowest(low);
            parent[48 + 16 * axis] = highest(high);
        }
    }
    if (parent_count == 0) return;
    const std::uint32_t last = (parent_count - 1) % 16;
    float* const tail = parents + kBlockFloats * ((parent_count - 1) / 16);
    for (std::uint32_t i = last + 1; i < 16; ++i)
        for (std::uint32_t array = 0; array < 6; ++array) tail[16 * array + i] = tail[16 * array + last];
}

}  // namespace

const HierarchyKernels kHierarchyKernels{scan, walk, pieces, crossing, bound};

}  // namespace swath::SWATH_KERNEL
