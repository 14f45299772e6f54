#pragma once
#include <cstddef>
#include <cstdint>

#include "common/cull/wide/kernel_planes.h"

namespace swath {

// A block is 16 boxes in the layout that kernels read: six arrays of 16 numbers, in this order:
// min.x min.y min.z max.x max.y max.z. Blocks begin at multiples of 64 bytes.
inline constexpr std::size_t kBlockBoxes = 16;
inline constexpr std::size_t kBlockFloats = 6 * kBlockBoxes;
inline constexpr int kMaxWideLevels = 8;  // 16^8 boxes

// What kernels see of a WideHierarchy. Child i of block b at level l > 0 is block 16 b + i at level l - 1;
// the boxes of level 0 are the objects. `count` numbers of each level are real, the rest of its last block is
// not.
struct WideLevel {
    const float* blocks;
    std::uint32_t count;
};

// What a walk did, for those who plan the next one.
struct WideWork {
    std::uint64_t inner_blocks = 0;  // tested, above level 0
    std::uint64_t leaf_blocks = 0;   // tested, at level 0
};

// A block that crosses the planes of a mask, or (no planes) that lies inside.
struct WidePiece {
    std::uint32_t block;
    std::uint32_t planes;
};

struct WideWalk {
    const WideLevel* levels;
    const KernelPlane* planes;
    WideWork work;
};

// Each writes ids ascending from `out` and returns the place after the last. They may scribble over the rest
// of the walked blocks' own places, never beyond: places for 16 ids a block are enough.
struct HierarchyKernels {
    // The boxes [0, count) of `blocks`, each numbered from `first_id`, that are not outside of the six
    // planes.
    std::uint32_t* (*scan)(const float* blocks, std::uint32_t count, const KernelPlane* planes,
                           std::uint32_t first_id, std::uint32_t* out);
    // The objects below a block of `level` that are not outside of the planes in piece.planes.
    std::uint32_t* (*walk)(WideWalk& walk, int level, WidePiece piece, std::uint32_t* out);
    // The blocks of level `to` < level below a block of `level` that are not outside. `out` needs places for
    // all.
    WidePiece* (*pieces)(WideWalk& walk, int level, WidePiece piece, int to, WidePiece* out);
    // How many blocks of level 1 below a block of `level` > 1 cross a plane.
    std::uint32_t (*crossing)(WideWalk& walk, int level, WidePiece piece);
    // The bounds of `count` boxes' blocks become boxes of the next level, `parents`: the last is repeated to
    // the end of its block. `of_objects`: the boxes may be empty, infinite or no numbers; their bounds then
    // hold whatever the box's corners hold, and a coordinate that is not finite counts as both infinities.
    void (*bound)(const float* blocks, std::uint32_t count, bool of_objects, float* parents);
};

namespace portable {
extern const HierarchyKernels kHierarchyKernels;
}
namespace avx2 {
extern const HierarchyKernels kHierarchyKernels;
}
namespace avx512 {
extern const HierarchyKernels kHierarchyKernels;
}

}  // namespace swath
