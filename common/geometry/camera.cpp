#include "common/geometry/camera.h"

#include <glm/gtc/matrix_transform.hpp>

namespace swath {

View make_view(const Camera& camera, int width, int height) {
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    View view;
    view.clip_from_model = glm::perspective(camera.fov_y, aspect, camera.near, camera.far) *
                           glm::lookAt(camera.eye, camera.target, camera.up);
    view.to_light = glm::normalize(camera.eye - camera.target);
    view.width = width;
    view.height = height;
    return view;
}

}  // namespace swath
