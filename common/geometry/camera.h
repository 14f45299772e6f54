#pragma once
#include <glm/glm.hpp>

#include "common/geometry/rect.h"

namespace swath {

// An eye and what it looks at. Lengths are in the model's units, the angle in radians.
struct Camera {
    glm::vec3 eye{0, 0, 1};
    glm::vec3 target{0, 0, 0};
    glm::vec3 up{0, 1, 0};
    float fov_y = 0.5f;
    float near = 0.01f;
    float far = 100.0f;
    bool operator==(const Camera&) const = default;
};

// A camera and viewport, reduced to what rendering needs. The client makes it and sends these numbers, so
// that every machine projects with the same bits whatever its math library.
struct View {
    glm::mat4 clip_from_model{1.0f};  // column-major, OpenGL clip space (z from -w to w)
    glm::vec3 to_light{0, 0, 1};      // unit vector in model space; the light is at the eye
    int width = 0;                    // pixels
    int height = 0;
    float pose = 0;  // of a moving model, 0 to 1 (see Mesh)
    Rect viewport() const { return {0, 0, width, height}; }
    bool operator==(const View&) const = default;
};

View make_view(const Camera& camera, int width, int height);

}  // namespace swath
