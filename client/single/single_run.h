#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/cull/cull_algorithm.h"
#include "common/geometry/camera.h"
#include "common/image/picture.h"
#include "common/render/renderer.h"
#include "common/scene/objects.h"
#include "common/timeline/timeline.h"

namespace swath {

// The reference: one renderer in this process draws every frame whole, without plan or network. Every picture
// of a cluster equals these byte for byte. Blocking.
struct SingleJob {
    const ObjectSet* scene = nullptr;
    RendererSetup renderer;  // its threads also cull
    CullAlgorithm cull = CullAlgorithm::kWide;
    std::vector<Camera> cameras;
    std::optional<float> pose = 0;      // of all frames; none: path_pose() of each frame
    std::optional<glm::vec3> to_light;  // unit, model space; none: a head-light
    int width = 1280;
    int height = 960;
    Rgb background{};
    PictureFormat format = PictureFormat::kNone;
};
Result<std::vector<FrameTimeline>> render_single(
    const SingleJob& job, const Clock& clock,
    const std::function<Status(FrameNumber, const Buffer&)>& on_picture);

}  // namespace swath
