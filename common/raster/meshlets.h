#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/ids.h"
#include "common/geometry/box.h"
#include "common/raster/raster_kernel.h"
#include "common/scene/objects.h"

namespace swath {

// Consecutive triangles of one object, of few enough vertices that a byte numbers them.
struct Meshlet {
    std::uint32_t first_triangle = 0;  // of the model
    std::uint32_t triangle_count = 0;
    std::uint32_t first_block = 0;  // of its vertices
    std::uint32_t block_count = 0;
    Box box = {};
    Box end_box = {};  // at pose 1; empty if the model does not move
};

// A model's triangles as the rasteriser reads them: about 24 bytes a triangle. Immutable.
class Meshlets {
  public:
    // Cuts every object greedily, in the order of its triangles. Deterministic; reads `scene` only here.
    explicit Meshlets(const ObjectSet& scene);

    const std::vector<Meshlet>& all() const { return meshlets_; }
    // The object of each meshlet.
    const std::uint32_t* objects() const { return objects_.data(); }
    // The meshlet that has a triangle.
    std::uint32_t of_triangle(ObjectId object, std::uint32_t triangle) const;
    // What of a meshlet a kernel draws: its triangles [first, end).
    KernelMeshlet kernel(std::uint32_t meshlet, std::uint32_t first, std::uint32_t end, bool may_clip) const;
    // The memory that all of it takes.
    std::size_t bytes() const;

  private:
    std::vector<Meshlet> meshlets_;
    std::vector<ObjectId> objects_;               // of each
    std::vector<std::uint32_t> first_of_object_;  // and the end
    std::vector<VertexBlock> vertices_;
    std::vector<MotionBlock> motion_;
    std::vector<std::uint32_t> triangles_;  // of all meshlets, and what may be read beyond the last
};

}  // namespace swath
