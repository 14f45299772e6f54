#pragma once
#include <glm/glm.hpp>

#include "common/base/result.h"
#include "common/geometry/camera.h"
#include "common/raycast/packet_kernel.h"

namespace swath {

// The rays of a view: from the eye that its matrix has through the centres of pixels, in a model whose
// coordinates are multiplied with `scale`. A ray's depth is that of its hit's point by the same matrix. A
// value.
class Pinhole {
  public:
    // Fails where the matrix is no perspective, has no inverse, or sees so much that rays differ by more than
    // 2^20 in length.
    static Result<Pinhole> of(const View& view, float scale);

    // The rays of pixels (x, y) to (x + 3, y + 3), row by row, as the kernels take them; all lanes active.
    // The same bits for a pixel whatever (x, y).
    RayPacket packet(int x, int y) const;

    const glm::vec3& eye() const { return eye_; }

  private:
    // Linear in the pixel's place.
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
