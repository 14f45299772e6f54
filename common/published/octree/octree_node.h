#pragma once
#include <cstdint>

namespace swath {

// A node of an octree that is stored, box and all: 96 bytes. Plain data without glm, so that kernels (see
// swath_kernel in cmake/compile_options.cmake) can read it.
struct OctreeNode {
    float box[6];  // min x, y, z, max x, y, z
    std::uint32_t code;
    std::uint32_t level;
    const OctreeNode* children[8];  // of a leaf: null
};

}  // namespace swath
