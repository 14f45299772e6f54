#pragma once
#include <cstdint>

namespace swath {

// A node of a stored octree with its box, 96 bytes. It is plain data without glm, so that kernels
// (swath_kernel in cmake/compile_options.cmake) can read it.
struct OctreeNode {
    float box[6];  // min x, y, z, max x, y, z
    std::uint32_t code;
    std::uint32_t level;
    const OctreeNode* children[8];  // all null in a leaf
};

}  // namespace swath
