#include "common/published/cull/octree_kernel.h"

#include "common/base/lanes/lanes.h"
#include "common/cull/wide/lane_steps.h"

namespace swath::SWATH_KERNEL {
namespace {

constexpr std::uint32_t kCoordinate = 0x3ff;  // the bits of a coordinate in a packed cell

// In a child's number bit 0 is x, bit 1 is z and bit 2 is y.
constexpr std::uint32_t child_x(std::uint32_t child) { return child & 1; }
constexpr std::uint32_t child_y(std::uint32_t child) { return child >> 2 & 1; }
constexpr std::uint32_t child_z(std::uint32_t child) { return child >> 1 & 1; }
constexpr std::uint32_t child_cell(std::uint32_t child) {
    return child_x(child) | child_y(child) << 10 | child_z(child) << 20;
}

// The numbers and cells of the children of two nodes, in lanes 0 to 7 and 8 to 15.
struct TwoFamilies {
    alignas(64) std::uint32_t codes[16];
    alignas(64) std::uint32_t cells[16];
};
constexpr TwoFamilies kTwoFamilies = [] {
    TwoFamilies made{};
    for (std::uint32_t i = 0; i < 16; ++i) {
        made.codes[i] = i & 7;
        made.cells[i] = child_cell(i & 7);
    }
    return made;
}();

inline float edge_at(int height, int level) { return static_cast<float>(1u << (height - level)); }

// Nodes are tested in batches, so that their children stay in a first-level cache.
constexpr std::uint32_t kBatch = 32;

// The children of up to kBatch nodes, in pairs of families with 16 children.
struct Batch {
    std::uint32_t pairs;
    std::uint32_t kept[kBatch / 2];  // the children that are not outside of any plane
    alignas(64) float blocks[kBatch / 2 * 96];
};

inline Words cells_of(OctreeNodes nodes, std::uint32_t count, std::uint32_t i) {
    return add(shift_left<1>(halves(nodes.cells[i], nodes.cells[i + 1 < count ? i + 1 : i])),
               load(kTwoFamilies.cells));
}
inline Words codes_of(OctreeNodes nodes, std::uint32_t count, std::uint32_t i) {
    return add(shift_left<3>(halves(nodes.codes[i], nodes.codes[i + 1 < count ? i + 1 : i])),
               load(kTwoFamilies.codes));
}

// Tests all children, which are on `level`.
inline void test(OctreeWalk& walk, int level, OctreeNodes nodes, std::uint32_t count, Batch& batch) {
    walk.tested += 8 * std::uint64_t{count};
    batch.pairs = (count + 1) / 2;
    const Floats edge = all(edge_at(walk.height, level));
    for (std::uint32_t pair = 0; pair < batch.pairs; ++pair) {
        const Words cells = cells_of(nodes, count, 2 * pair);
        const Floats x = to_floats(both(cells, all(kCoordinate)));
        const Floats y = to_floats(both(shift_right<10>(cells), all(kCoordinate)));
        const Floats z = to_floats(shift_right<20>(cells));
        // All sums and products are exact.
        float* const block = batch.blocks + 96 * pair;
        store(block, multiply(x, edge));
        store(block + 16, multiply(y, edge));
        store(block + 32, multiply(z, edge));
        store(block + 48, fused(x, edge, edge));
        store(block + 64, fused(y, edge, edge));
        store(block + 80, fused(z, edge, edge));
    }
    const ThreePlanes first(walk.planes);
    for (std::uint32_t pair = 0; pair < batch.pairs; ++pair)
        batch.kept[pair] = ~first.outside(batch.blocks + 96 * pair) & 0xffff;
    const ThreePlanes second(walk.planes + 3);
    for (std::uint32_t pair = 0; pair < batch.pairs; ++pair)
        batch.kept[pair] &= ~second.outside(batch.blocks + 96 * pair);
    if (count % 2 != 0) batch.kept[batch.pairs - 1] &= 0xff;
}

// Does what packed() does, but writes no more than the own places of a family without a second one.
inline std::uint32_t* pack_pair(std::uint32_t* out, Words a, std::uint32_t kept, bool pair) {
    return pair ? packed(out, a, kept) : packed8(out, a, kept);
}

std::uint32_t expand(OctreeWalk& walk, int level, OctreeNodes nodes, std::uint32_t count,
                     OctreeNodes children) {
    std::uint32_t* codes = children.codes;
    std::uint32_t* cells = children.cells;
    Batch batch;
    for (std::uint32_t first = 0; first < count; first += kBatch) {
        const OctreeNodes some{nodes.codes + first, nodes.cells + first};
        const std::uint32_t some_count = count - first < kBatch ? count - first : kBatch;
        test(walk, level + 1, some, some_count, batch);
        for (std::uint32_t pair = 0; pair < batch.pairs; ++pair) {
            const bool whole = 2 * pair + 1 < some_count;
            codes = pack_pair(codes, codes_of(some, some_count, 2 * pair), batch.kept[pair], whole);
            cells = pack_pair(cells, cells_of(some, some_count, 2 * pair), batch.kept[pair], whole);
        }
    }
    return static_cast<std::uint32_t>(codes - children.codes);
}

// Expands parents of leaves, which need no cells any more.
std::uint32_t* expand_to_leaves(OctreeWalk& walk, OctreeNodes nodes, std::uint32_t count,
                                std::uint32_t* out) {
    Batch batch;
    for (std::uint32_t first = 0; first < count; first += kBatch) {
        const OctreeNodes some{nodes.codes + first, nodes.cells + first};
        const std::uint32_t some_count = count - first < kBatch ? count - first : kBatch;
        test(walk, walk.height, some, some_count, batch);
        for (std::uint32_t pair = 0; pair < batch.pairs; ++pair)
            out = pack_pair(out, codes_of(some, some_count, 2 * pair), batch.kept[pair],
                            2 * pair + 1 < some_count);
    }
    return out;
}

std::uint32_t* same_nodes(OctreeWalk& walk, int level, OctreeNodes nodes, std::uint32_t count,
                          std::uint32_t* out) {
    if (level + 1 == walk.height) return expand_to_leaves(walk, nodes, count, out);
    std::uint32_t codes[8 * kBatch];
    std::uint32_t cells[8 * kBatch];
    const OctreeNodes children{codes, cells};
    for (std::uint32_t i = 0; i < count; i += kBatch) {
        const std::uint32_t batch = count - i < kBatch ? count - i : kBatch;
        const std::uint32_t found = expand(walk, level, {nodes.codes + i, nodes.cells + i}, batch, children);
        out = same_nodes(walk, level + 1, children, found, out);
    }
    return out;
}

// The p-vertices (lanes 0 to 7) and the n-vertices (8 to 15) of a node's children, from the node's low
// corner, in children's edges. They have a block's layout, so that a plane's p[] says which to take.
struct Family {
    alignas(64) float vertices[96];
};
constexpr Family kFamily = [] {
    Family made{};
    for (std::uint32_t i = 0; i < 16; ++i) {
        const std::uint32_t low[3] = {child_x(i & 7), child_y(i & 7), child_z(i & 7)};
        const std::uint32_t p = i < 8 ? 1 : 0;
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            made.vertices[16 * axis + i] = static_cast<float>(low[axis] + 1 - p);
            made.vertices[48 + 16 * axis + i] = static_cast<float>(low[axis] + p);
        }
    }
    return made;
}();

// The low corners of the 64 leaves two levels below a node, in their order. 16 consecutive leaves have the
// same second bits of y and z, so it is enough to store one such group, to whose y and z 0 or 2 is added.
struct Brick {
    alignas(64) float x[16];
    alignas(64) float y[16];
    alignas(64) float z[16];
};
constexpr Brick kBrick = [] {
    Brick made{};
    for (std::uint32_t i = 0; i < 16; ++i) {
        made.x[i] = static_cast<float>(2 * (i >> 3) + child_x(i & 7));
        made.y[i] = static_cast<float>(child_y(i & 7));
        made.z[i] = static_cast<float>(child_z(i & 7));
    }
    return made;
}();

struct Corner {
    float x, y, z;  // leaf edges
};
inline Corner corner_of(std::uint32_t cell, float edge) {
    return {static_cast<float>(cell & kCoordinate) * edge,
            static_cast<float>(cell >> 10 & kCoordinate) * edge, static_cast<float>(cell >> 20) * edge};
}

// Writes the leaves, of 64, below a node two levels above them.
inline std::uint32_t* leaves_of_brick(const OctreeWalk& walk, std::uint32_t code, std::uint32_t cell,
                                      std::uint32_t planes, std::uint32_t* out) {
    const Corner low = corner_of(cell, 4);
    std::uint32_t gone[4] = {};
    for (; planes != 0; planes &= planes - 1) {
        const KernelPlane& plane = walk.planes[__builtin_ctz(planes)];
        const float up[3] = {plane.p[0] >= 48 ? 1.0f : 0.0f, plane.p[1] >= 48 ? 1.0f : 0.0f,
                             plane.p[2] >= 48 ? 1.0f : 0.0f};
        const Floats x = add(all(low.x + up[0]), load(kBrick.x));
        for (std::uint32_t right = 0; right < 2; ++right) {
            const Floats z = add(all(low.z + up[2] + static_cast<float>(2 * right)), load(kBrick.z));
            const Floats of_z = fused(all(plane.z), z, all(plane.w));
            for (std::uint32_t top = 0; top < 2; ++top) {
                const Floats y = add(all(low.y + up[1] + static_cast<float>(2 * top)), load(kBrick.y));
                gone[right + 2 * top] |= below_zero(fused(all(plane.x), x, fused(all(plane.y), y, of_z)));
            }
        }
    }
    for (std::uint32_t i = 0; i < 4; ++i)
        out = packed(out, add(all(64 * code + 16 * i), load(kCounting)), ~gone[i] & 0xffff);
    return out;
}

std::uint32_t* early_out(OctreeWalk& walk, int level, std::uint32_t code, std::uint32_t cell,
                         std::uint32_t planes, std::uint32_t* out) {
    const int below = walk.height - level;
    if (below == 2) {
        walk.tested += 64;
        return leaves_of_brick(walk, code, cell, planes, out);
    }
    walk.tested += 8;
    const float edge = edge_at(walk.height, level + 1);
    const Corner low = corner_of(cell, 2 * edge);
    std::uint32_t kept = 0xff;
    Words crossed = all(0u);
    for (std::uint32_t rest = planes; rest != 0; rest &= rest - 1) {
        const int k = __builtin_ctz(rest);
        const KernelPlane& plane = walk.planes[k];
        const Floats x = fused(load(kFamily.vertices + plane.p[0]), all(edge), all(low.x));
        const Floats y = fused(load(kFamily.vertices + plane.p[1]), all(edge), all(low.y));
        const Floats z = fused(load(kFamily.vertices + plane.p[2]), all(edge), all(low.z));
        const Floats to =
            fused(all(plane.x), x, fused(all(plane.y), y, fused(all(plane.z), z, all(plane.w))));
        kept &= ~below_zero(to);
        crossed = set_bits_where(crossed, ~(at_least_zero(to) >> 8) & 0xff, 1u << k);
    }
    if (below == 1) return packed8(out, add(all(8 * code), load(kCounting)), kept);
    const std::uint32_t crossing = kept & non_zero(crossed);
    alignas(64) std::uint32_t child_planes[16];
    store(child_planes, crossed);
    while (kept != 0) {
        const auto i = static_cast<std::uint32_t>(__builtin_ctz(kept));
        if ((crossing >> i & 1) != 0) {
            out = early_out(walk, level + 1, 8 * code + i, (cell << 1) + child_cell(i), child_planes[i], out);
            kept &= kept - 1;
            continue;
        }
        // The number of consecutive children that are inside.
        const auto run = static_cast<std::uint32_t>(__builtin_ctz(~((kept & ~crossing) >> i)));
        const int shift = 3 * (below - 1);
        out = fill((8 * code + i) << shift, (8 * code + i + run) << shift, out);
        kept &= ~(((1u << run) - 1) << i);
    }
    return out;
}

}  // namespace

const OctreeKernels kOctreeKernels{expand, same_nodes, early_out};

}  // namespace swath::SWATH_KERNEL
