#pragma once
#include <cstdint>

#include "common/cull/wide/kernel_planes.h"

namespace swath {

// Nodes of one level of a UniformOctree, as kernels take them: Morton codes, and cells (see octree_cell)
// packed into a word: x, y and z in 10 bits each, x lowest.
struct OctreeNodes {
    std::uint32_t* codes;
    std::uint32_t* cells;
};

struct OctreeWalk {
    const KernelPlane* planes;
    int height;
    std::uint64_t tested;  // nodes against planes
};

// None tests the nodes given, which are above the leaves; all test what is below. Leaves are written
// ascending from `out`, which is returned as it is afterwards; like the kernels of the hierarchy they may
// scribble over places of the nodes' own leaves, not beyond.
struct OctreeKernels {
    // The children of `count` nodes of `level` that are not outside, each tested against all six planes.
    // Returns how many. `children` has places for 8 * count.
    std::uint32_t (*expand)(OctreeWalk& walk, int level, OctreeNodes nodes, std::uint32_t count,
                            OctreeNodes children);
    // The leaves below them that are not outside. Every child of a node that is not outside is tested against
    // all six planes.
    std::uint32_t* (*same_nodes)(OctreeWalk& walk, int level, OctreeNodes nodes, std::uint32_t count,
                                 std::uint32_t* out);
    // The same leaves below one node that crosses `planes`.
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
