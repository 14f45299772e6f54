#pragma once
#include <cstdint>

#include "common/cull/wide/kernel_planes.h"

namespace swath {

// Nodes on one level of a UniformOctree as kernels take them: Morton codes, and cells (see octree_cell)
// packed into words with x, y and z in 10 bits each, x lowest.
struct OctreeNodes {
    std::uint32_t* codes;
    std::uint32_t* cells;
};

struct OctreeWalk {
    const KernelPlane* planes;
    int height;
    std::uint64_t tested;  // nodes
};

// The kernels of an instruction set. They test what is below the given nodes, which are above the leaves, but
// not these nodes themselves. They write leaves ascending from `out` on and return the end. They may scribble
// over the places of the nodes' own leaves, not beyond.
struct OctreeKernels {
    // Writes the children of `count` nodes on `level` that are not outside, each tested against all six
    // planes, and returns their number. `children` needs places for 8 * count.
    std::uint32_t (*expand)(OctreeWalk& walk, int level, OctreeNodes nodes, std::uint32_t count,
                            OctreeNodes children);
    // Writes the leaves below `count` nodes that are not outside. Tests every child of a node that is not
    // outside against all six planes.
    std::uint32_t* (*same_nodes)(OctreeWalk& walk, int level, OctreeNodes nodes, std::uint32_t count,
                                 std::uint32_t* out);
    // Writes the same leaves below one node, which crosses `planes`.
    std::uint32_t* (*early_out)(OctreeWalk& walk, int level, std::uint32_t code, std::uint32_t cell,
                                std::uint32_t planes, std::uint32_t* out);
};

namespace portable {
extern const OctreeKernels kOctreeKernels;
}
namespace avx2 {
extern const OctreeKernels kOctreeKernels;
}
namespace avx512 {
extern const OctreeKernels kOctreeKernels;
}

}  // namespace swath
