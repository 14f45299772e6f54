#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/octree/sah/sah_triangles.h"
#include "common/raycast/packet_kernel.h"
#include "common/scene/objects.h"
#include "tests/bench/figures.h"

namespace swath::bench {

// The primary rays of a picture, in tiles of 4 x 4. Width and height are whole numbers of tiles.
struct RayView {
    int width = 0;
    int height = 0;
    glm::vec3 eye{0};
    glm::vec3 first{0};  // direction of the upper left pixel's centre; its component forward is 1
    glm::vec3 right{0};  // one pixel to the right
    glm::vec3 down{0};   // one row down
    // Nothing is hit nearer or farther than these, along the view.
    float near = 0;
    float far = 0;

    std::size_t rays() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};
inline constexpr int kTile = 4;
static_assert(kTile * kTile == kPacketRays);

// Makes the rays of a tile; all casters use it.
class TileRays {
  public:
    explicit TileRays(const RayView& view) : view_(view) {
        for (int lane = 0; lane < kPacketRays; ++lane)
            for (int axis = 0; axis < 3; ++axis)
                offset_[axis][lane] = static_cast<float>(lane % kTile) * view.right[axis] +
                                      static_cast<float>(lane / kTile) * view.down[axis];
    }
    // `x`, `y` is the tile's upper left pixel.
    void directions(int x, int y, float (&x_of)[kPacketRays], float (&y_of)[kPacketRays],
                    float (&z_of)[kPacketRays]) const {
        const glm::vec3 corner =
            view_.first + static_cast<float>(x) * view_.right + static_cast<float>(y) * view_.down;
        for (int lane = 0; lane < kPacketRays; ++lane) {
            x_of[lane] = corner.x + offset_[0][lane];
            y_of[lane] = corner.y + offset_[1][lane];
            z_of[lane] = corner.z + offset_[2][lane];
        }
    }

  private:
    const RayView& view_;
    float offset_[3][kPacketRays];
};

// A model and views of it. Its triangles are in the order of build_objects, for all casters.
struct OctreeScene {
    std::string name;
    bool has_bars = false;  // it gives figures
    ObjectSet set;
    std::vector<float> corners;  // in the form that kernels read
    std::vector<RayView> views;

    SahTriangles triangles() const;
    std::size_t rays() const;  // of all views
};

// The Bunny, the Conference and the Dragon if they are there (a note names missing ones), and all built-in
// models, of 200,000 triangles. Errors: a model cannot be read.
Result<std::vector<OctreeScene>> octree_scenes(Figures& figures, const Effort& effort);

}  // namespace swath::bench
