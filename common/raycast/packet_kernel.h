#pragma once
#include <cstdint>

namespace swath {

inline constexpr int kPacketRays = 16;

// A SahTree and its triangles as kernels see them.
struct KernelNode {  // the same as SahNode
    float plane[3];
    std::uint32_t link;
};
struct KernelTree {
    const KernelNode* nodes;
    const std::uint32_t* triangles;  // of leaves
    const float* corners;            // nine numbers a triangle
    // A bit for each node, set if it has a wanted triangle, and for each triangle. Null: all are wanted.
    const std::uint32_t* wanted_nodes;
    const std::uint32_t* wanted_triangles;
    float low[3];
    float high[3];
};

// Sixteen rays, one a lane. All numbers must be finite, a direction's largest component 2^-20 to 2^20.
struct alignas(64) RayPacket {
    float origin[3][kPacketRays];
    float direction[3][kPacketRays];
    // A hit at distance t (in units of the direction) has depth depth_offset - depth_scale / t.
    float depth_offset[kPacketRays];
    float depth_scale;
    std::uint32_t active;  // a bit a lane; other lanes may hold any finite numbers
};

inline constexpr std::uint32_t kNoTriangle = 0xffff'ffff;

// The rays' first hits. A lane without a hit has kNoTriangle, and its other numbers mean nothing.
struct alignas(64) PacketHits {
    std::uint32_t triangle[kPacketRays];
    float nearness[kPacketRays];   // t, or depth
    float weight[3][kPacketRays];  // of the corners; they add up to any number but 0
};

// The work of finding hits.
struct PacketWork {
    std::uint64_t packets = 0;
    std::uint64_t steps = 0;  // planes of inner nodes that a packet came to
    std::uint64_t leaves = 0;
    std::uint64_t triangles = 0;  // tested against a packet
    std::uint64_t ray_steps = 0;  // planes of inner nodes that a ray came to
};

// The kernels of an instruction set. A ray hits a triangle if the test of Woop, Benthin and Wald (2013) says
// so in single precision, from both sides and on edges, at t > 0, and that point is in the triangle's box but
// for rounding: a function of ray and triangle alone. A kernel finds the best of all triangles by that
// function, whatever the tree, the packet or the instruction set.
struct PacketKernels {
    // Finds the smallest t, of equal ones the smallest triangle.
    void (*nearest)(const KernelTree& tree, const RayPacket& rays, PacketHits& hits);
    // Finds the smallest depth in [0, 1), of equal ones the smallest triangle. All rays have one origin.
    void (*nearest_by_depth)(const KernelTree& tree, const RayPacket& rays, PacketHits& hits);
    // Returns a bit for each ray that hits any triangle except its `but`.
    std::uint32_t (*any)(const KernelTree& tree, const RayPacket& rays, const std::uint32_t* but);
    // Does the same as `nearest` and counts the work.
    void (*count)(const KernelTree& tree, const RayPacket& rays, PacketHits& hits, PacketWork& work);
};

namespace portable {
extern const PacketKernels kPacketKernels;
}
namespace avx2 {
extern const PacketKernels kPacketKernels;
}
namespace avx512 {
extern const PacketKernels kPacketKernels;
}

}  // namespace swath
