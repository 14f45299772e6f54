#pragma once
#include <cstddef>
#include <cstdint>

#include "common/cull/wide/kernel_planes.h"

namespace swath {

// A block is 16 boxes as six arrays of 16 numbers: min.x min.y min.z max.x max.y max.z. It begins at a
// multiple of 64 bytes.
inline constexpr std::size_t kBlockBoxes = 16;
inline constexpr std::size_t kBlockFloats = 6 * kBlockBoxes;
inline constexpr int kMaxWideLevels = 8;  // 16^8 boxes

// A level of a WideHierarchy as kernels see it. Child i of block b on level l > 0 is block 16 b + i on level
// l - 1; the boxes on level 0 are those that are culled. A level has `count` boxes; the rest of its last
// block is padding.
struct WideLevel {
    const float* blocks;
    std::uint32_t count;
};

// The work of a walk, from which the next one is planned.
struct WideWork {
    std::uint64_t inner_blocks = 0;  // tested above level 0
    std::uint64_t leaf_blocks = 0;   // tested on level 0
};

// A block that crosses the planes of a mask. Without planes it lies inside.
struct WidePiece {
    std::uint32_t block;
    std::uint32_t planes;
};

struct WideWalk {
    const WideLevel* levels;
    const KernelPlane* planes;
    WideWork work;
};

// The kernels of an instruction set. They write from `out` on, ascending, and return the end. They may
// scribble behind it, but not beyond the places for 16 ids a block.
struct HierarchyKernels {
    // Writes the ids, counted from `first_id`, of those of `count` boxes that are not outside of six planes.
    std::uint32_t* (*scan)(const float* blocks, std::uint32_t count, const KernelPlane* planes,
                           std::uint32_t first_id, std::uint32_t* out);
    // Writes the ids of the boxes below a block on `level` that are not outside of the planes in
    // piece.planes.
    std::uint32_t* (*walk)(WideWalk& walk, int level, WidePiece piece, std::uint32_t* out);
    // Writes the blocks on level `to` < level, below a block on `level`, that are not outside. `out` needs
    // places for all.
    WidePiece* (*pieces)(WideWalk& walk, int level, WidePiece piece, int to, WidePiece* out);
    // Counts the blocks on level 1 below a block on `level` > 1 that cross a plane.
    std::uint32_t (*crossing)(WideWalk& walk, int level, WidePiece piece);
    // Makes the bounds of each block of `count` boxes a box of the next level, `parents`, and pads its last
    // block with the last box. With `of_objects` boxes may be empty, infinite or NaN: their bounds contain
    // all corners of a box, and a coordinate that is not finite counts as both infinities.
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
