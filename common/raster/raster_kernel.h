#pragma once
#include <cstdint>

namespace swath {

// A meshlet has at most so many vertices and triangles.
inline constexpr int kMeshletVertices = 64;
inline constexpr int kMeshletBits = 7;
inline constexpr int kMeshletTriangles = 1 << kMeshletBits;

// Sixteen vertices of a meshlet, an array for each number. The last vertex fills a block that is not full.
struct alignas(64) VertexBlock {
    float position[3][16];
    std::int16_t normal[3][16];
    std::uint32_t colour[16];  // R in the low byte, then G, B
};
// The motion of as many, of a model that moves.
struct alignas(64) MotionBlock {
    float motion[3][16];
};

// A meshlet as kernels see it.
struct KernelMeshlet {
    const VertexBlock* vertices;
    const MotionBlock* motion;  // null: nothing moves
    const std::uint32_t*
        triangles;         // local vertex numbers, a byte each, first vertex lowest; 16 may be read at once
    std::uint32_t blocks;  // of vertices
    std::uint32_t first;   // triangles to draw: [first, end)
    std::uint32_t end;
    std::uint32_t number;  // of triangle 0, for ties in depth
    bool may_clip;         // as BoundsBlock has it
};

// A vertex with a smaller or larger w is clipped, so that products with 1 / w are neither infinite nor zero.
inline constexpr float kLeastW = 0x1p-60f;
inline constexpr float kMostW = 0x1p100f;

// What vertices are projected with.
struct KernelView {
    float clip_from_model[16];  // column-major
    float to_light[3];
    float pose;
    float half_width;  // pixels
    float half_height;
    float guard;  // a vertex farther than so many pixels from the screen's centre, in x or y, is clipped
};

// A bin is so many pixels. Its buffers have a margin around them, into which triangles that reach beyond it
// are drawn unseen.
inline constexpr int kBinWidth = 128;
inline constexpr int kBinHeight = 64;
inline constexpr int kBinMargin = 8;
inline constexpr int kBinStride = kBinWidth + 2 * kBinMargin;
inline constexpr int kBinRows = kBinHeight + 2 * kBinMargin;

// The pixels of one bin. Pixel (x, y) of the bin is at (y + kBinMargin) * kBinStride + x + kBinMargin.
struct alignas(64) BinPixels {
    float depth[kBinStride * kBinRows];
    std::uint32_t number[kBinStride * kBinRows];  // of the triangle
    std::uint32_t colour[kBinStride * kBinRows];
};

// Where a bin is on the screen. It may be smaller than its buffers.
struct KernelBin {
    BinPixels* pixels;
    int x;  // of its lowest, leftmost pixel
    int y;
    int width;
    int height;
};

// A vertex on the screen.
struct ScreenVertex {
    std::int32_t x;  // 1/256 pixel
    std::int32_t y;
    float z;          // depth, 0 to 1
    float inverse_w;  // positive
    float colour[3];  // shaded, 0 to 255
};
struct ScreenTriangle {
    ScreenVertex corner[3];
    std::uint32_t number;
};

// Sixteen boxes, and where they are on the screen.
struct alignas(64) BoxBlock {
    float low[3][16];
    float high[3][16];
};
struct alignas(64) BoundsBlock {
    std::int32_t x0[16];  // pixels, [x0, x1)
    std::int32_t y0[16];
    std::int32_t x1[16];
    std::int32_t y1[16];
    float nearest[16];      // no fragment has less depth
    std::uint32_t clipped;  // a bit for each box in which vertices may have to be clipped
};

// The kernels of an instruction set; all give the same bits.
struct RasterKernels {
    // Bounds sixteen boxes on the screen.
    void (*project)(const KernelView& view, const BoxBlock& boxes, BoundsBlock& bounds);
    // Makes all pixels of a bin background.
    void (*clear)(BinPixels& pixels);
    // Returns whether all pixels of [x0, x1) x [y0, y1), in the bin, are nearer than `nearest`.
    bool (*hides)(const BinPixels& pixels, int x0, int y0, int x1, int y1, float nearest);
    // Draws what of a meshlet is in the bin, except triangles with vertices that are clipped.
    void (*draw)(const KernelView& view, const KernelMeshlet& meshlet, const KernelBin& bin);
    // Draws what of a triangle is in the bin. Vertices must lie within 16383 pixels of one point.
    void (*draw_triangle)(const ScreenTriangle& triangle, const KernelBin& bin);
    // Copies `n` pixels of a bin's row, from (x, y) on, and looks up the objects of their meshlets.
    void (*read)(const BinPixels& pixels, int x, int y, int n, const std::uint32_t* objects,
                 std::uint32_t* colour, float* depth, std::uint32_t* id);
};

namespace portable {
extern const RasterKernels kRasterKernels;
}
namespace avx2 {
extern const RasterKernels kRasterKernels;
}
namespace avx512 {
extern const RasterKernels kRasterKernels;
}

}  // namespace swath
