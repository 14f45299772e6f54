#pragma once
#include <cstdint>

namespace swath {

inline constexpr int kPacketRays = 16;

// What kernels see of a SahTree and the triangles it is over.
struct KernelNode {  // as SahNode
    float plane[3];
    std::uint32_t link;
};
struct KernelTree {
    const KernelNode* nodes;
    const std::uint32_t* triangles;  // of leaves
    const float* corners;            // nine numbers a triangle
    // Which nodes have anything that is looked for, and which triangles are, a bit each; null: all.
    const std::uint32_t* wanted_nodes;
    const std::uint32_t* wanted_triangles;
    float low[3];
    float high[3];
};

// Sixteen rays, lane by lane. The largest component of a direction must be between 2^-20 and 2^20; everything
// finite.
struct alignas(64) RayPacket {
    float origin[3][kPacketRays];
    float direction[3][kPacketRays];
    // A hit at distance t (in units of the direction) has depth offset - scale / t.
    float depth_offset[kPacketRays];
    float depth_scale;
    std::uint32_t active;  // a bit a lane; other lanes may hold anything finite
};

inline constexpr std::uint32_t kNoTriangle = 0xffff'ffff;

// What they hit first. Lanes without a hit have kNoTriangle; the rest of them means nothing.
struct alignas(64) PacketHits {
    std::uint32_t triangle[kPacketRays];
    float nearness[kPacketRays];   // t, or depth
    float weight[3][kPacketRays];  // of the corners, adding up to anything but 0
};

// What finding it took.
struct PacketWork {
    std::uint64_t packets = 0;
    std::uint64_t steps = 0;  // planes of inner nodes that a packet came to
    std::uint64_t leaves = 0;
    std::uint64_t triangles = 0;  // tested against a packet
    std::uint64_t ray_steps = 0;  // that a ray came to
};

// A ray hits a triangle where Woop, Benthin and Wald's test (2013) says so in single precision, from both
// sides and on edges, at t > 0, and there is in the triangle's box or next to it by rounding: a function of
// ray and triangle alone. What a kernel finds is the best of all triangles by that function, whatever tree,
// packet or instruction set.
struct PacketKernels {
    // The smallest t, of equals the smallest triangle.
    void (*nearest)(const KernelTree& tree, const RayPacket& rays, PacketHits& hits);
    // The smallest depth in [0, 1), of equals the smallest triangle.
    void (*nearest_by_depth)(const KernelTree& tree, const RayPacket& rays, PacketHits& hits);
    // Which rays hit anything but their triangle `but`.
    std::uint32_t (*any)(const KernelTree& tree, const RayPacket& rays, const std::uint32_t* but);
    // nearest, counting.
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
