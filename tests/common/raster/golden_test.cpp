#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "common/raster/raster_renderer.h"
#include "tests/support/drawings.h"

// Pictures are the same bits on every machine. These come of integers and of single sums and products alone: no
// mathematics library takes part.

namespace swath {
namespace {

// Triangles of about `size`, in a cube from -1 to 1.
ObjectSet golden_scene(std::uint32_t seed, float size, int triangles) {
    std::mt19937 random(seed);
    const auto number = [&] {
        return static_cast<float>(static_cast<int>(random() % 4097) - 2048) * 0x1p-11f;
    };
    const auto point = [&] {
        const float x = number();
        const float y = number();
        return glm::vec3(x, y, number());
    };
    Mesh mesh;
    for (int t = 0; t < triangles; ++t) {
        const glm::vec3 middle = point();
        for (int k = 0; k < 3; ++k) {
            Vertex vertex;
            vertex.position = middle + size * point();
            for (std::size_t i = 0; i < 3; ++i) {
                vertex.normal[i] = static_cast<std::int16_t>(static_cast<int>(random() % 36000) - 18000);
                vertex.colour[i] = static_cast<std::uint8_t>(random() % 256);
            }
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            mesh.vertices.push_back(vertex);
        }
    }
    return build_objects(std::move(mesh), {.depth = 2});
}

// From (0, 0, distance), with the near plane at 1/8.
View golden_view(float distance, int width, int height) {
    View view;
    view.clip_from_model = {{1.5f, 0, 0, 0},
                            {0, 2, 0, 0},
                            {0, 0, -1.0625f, -1},
                            {0, 0, 1.0625f * distance - 0.2578125f, distance}};
    view.to_light = {0.25f, 0.5f, 0.8125f};
    view.width = width;
    view.height = height;
    return view;
}

// FNV-1a over the drawn pixels.
std::uint64_t hash(const PixelFrame& frame) {
    std::uint64_t value = 0xcbf29ce484222325;
    const auto add = [&](std::uint32_t word) {
        for (int i = 0; i < 4; ++i) value = (value ^ (word >> 8 * i & 0xff)) * 0x100000001b3;
    };
    const Rect& rect = frame.rect();
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            const float depth = *frame.depth(x, y);
            add(std::bit_cast<std::uint32_t>(depth));
            if (depth == kFarDepth) continue;
            add(*frame.id(x, y));
            add(*frame.colour(x, y));
        }
    return value;
}

struct Golden {
    float size;
    int triangles;
    float distance;
    int width;
    int height;
    std::uint64_t hash;
};

TEST(RasterGolden, PicturesAreTheSameBitsEverywhere) {
    constexpr Golden kGolden[] = {
        {0.01f, 20000, 3, 640, 480, 0x798c0b980b77f4ff},        // smaller than a pixel, and a few pixels
        {0.05f, 5000, 3, 640, 480, 0x0d659761e54cd622},         // tens of pixels
        {1, 300, 3, 640, 480, 0x079ae99d9c52dff6},              // large ones, over one another
        {0.5f, 2000, 0.5f, 640, 480, 0x6b10931aa0ddbf13},       // some through the eye
        {2, 200, 0, 2000, 300, 0xf4ce4aa2b73e15d1},             // most through the eye
        {0.25f, 3000, 2, 16384, 16, 0x0adca27603537120},        // the widest picture
        {0.001f, 30000, 2.5f, 1920, 1080, 0xf3e411e94be44492},  // most without a sample
    };
    for (const Golden& golden : kGolden) {
        const ObjectSet scene = golden_scene(7, golden.size, golden.triangles);
        const View view = golden_view(golden.distance, golden.width, golden.height);
        for (const InstructionSet set : instruction_sets()) {
            const auto renderer =
                make_raster_renderer({.kind = RendererKind::kRaster, .threads = 2}, scene, set);
            ASSERT_TRUE(renderer.has_value());
            const PixelFrame frame = test::draw(**renderer, test::all_of(scene), view, view.viewport());
            EXPECT_EQ(fmt::format("{:016x}", hash(frame)), fmt::format("{:016x}", golden.hash))
                << name(set) << ", " << golden.triangles << " triangles";
            EXPECT_GT(test::compare(frame, frame, view.viewport()).active, 1000);
        }
    }
}

}  // namespace
}  // namespace swath
