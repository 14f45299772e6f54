#pragma once
#include <glm/glm.hpp>

#include "common/base/result.h"
#include "common/geometry/camera.h"
#include "common/raycast/packet_kernel.h"

namespace swath {

// The rays of a view, from its matrix's eye through the centres of pixels, for a model whose coordinates are
// multiplied by `scale`. A hit's depth is that of its point by the same matrix. A value.
class Pinhole {
  public:
    // Fails if the matrix is no perspective, has no inverse, or sees so wide that rays differ too much in
    // length (see RayPacket).
    static Result<Pinhole> of(const View& view, float scale);

    // The rays of pixels (x, y) to (x + 3, y + 3), row by row, with all lanes active. A pixel's ray has the
    // same bits in every packet.
    RayPacket packet(int x, int y) const;

    const glm::vec3& eye() const { return eye_; }

  private:
    // A linear function of the pixel.
    struct Linear {
        double at_zero = 0;
        double per_x = 0;
        double per_y = 0;
        float at(int x, int y) const { return static_cast<float>(at_zero + x * per_x + y * per_y); }
    };
    glm::vec3 eye_{0};
    Linear direction_[3];
    Linear depth_offset_;
    float depth_scale_ = 1;
};

}  // namespace swath
