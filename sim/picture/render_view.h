#pragma once
#include "common/base/result.h"
#include "common/geometry/camera.h"
#include "common/image/picture.h"
#include "common/scene/objects.h"

namespace swath::sim {

// The whole scene as `swath-client --single` draws it on this machine, byte for byte. Makes a renderer and
// uploads the scene for this one picture. Blocking; no other renderer may live on the calling thread. The
// program calls tune_allocator() and sets the renderer's threads before. Fails when the scene does not fit.
Result<Picture> render_view(const ObjectSet& scene, const View& view, const Rgb& background);

}  // namespace swath::sim
