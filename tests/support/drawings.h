#pragma once
#include <span>
#include <string>
#include <vector>

#include "common/render/renderer.h"

namespace swath::test {

// What tests of renderers share: something to draw, from somewhere, and whether two pictures are the same.

ObjectSet builtin_scene(const std::string& model, std::size_t triangles);
// From outside, all of it.
View view_of(const ObjectSet& scene, int width = 97, int height = 61);
std::vector<DrawRun> all_of(const ObjectSet& scene);

// Draws and reads; what fails is a failure of the test.
PixelFrame draw(Renderer& renderer, std::span<const DrawRun> runs, const View& view, const Rect& rect);

struct Difference {
    int pixels = 0;  // that differ
    int active = 0;  // of `a`
};
// Bit by bit; background has a depth only.
Difference compare(const PixelFrame& a, const PixelFrame& b, const Rect& rect);
// And not empty.
void expect_same(const PixelFrame& a, const PixelFrame& b, const Rect& rect);

}  // namespace swath::test
