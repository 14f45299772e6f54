#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/render/renderer.h"

namespace swath::test {

// For tests of renderers: scenes, views, and a comparison of two pictures.

ObjectSet builtin_scene(const std::string& model, std::size_t triangles);
// From outside, all of it.
View view_of(const ObjectSet& scene, int width = 97, int height = 61);
std::vector<TriangleRange> all_of(const ObjectSet& scene);

// What draws with OpenGL here: OSMesa, or EGL on systems that have it no longer.
RendererKind gl_here();

// Draws and reads; an error fails the test.
PixelFrame draw(Renderer& renderer, std::span<const TriangleRange> ranges, const View& view,
                const Rect& rect);

struct Difference {
    int pixels = 0;  // that differ
    int active = 0;  // in `a`
};
// Compares bit by bit; of the background only the depth.
Difference compare(const PixelFrame& a, const PixelFrame& b, const Rect& rect);
// Expects that they are equal, and not empty.
void expect_same(const PixelFrame& a, const PixelFrame& b, const Rect& rect);

// Read-back stays inside of what was drawn and of the frame, to the pixel.
void expect_reads_inside_only(Renderer& renderer, std::span<const TriangleRange> ranges, const View& view);

}  // namespace swath::test
