#include "sim/picture/render_view.h"

#include <numeric>

#include "common/image/pixel_codec.h"
#include "common/image/pixel_frame.h"
#include "common/renderers/make_renderer.h"

namespace swath::sim {

Result<Picture> render_view(const ObjectSet& scene, const View& view, const Rgb& background) {
    auto renderer = make_renderer(RendererSetup{}, scene);
    if (!renderer) return tl::unexpected(renderer.error());
    std::vector<ObjectId> all(scene.objects.size());
    std::iota(all.begin(), all.end(), ObjectId{0});
    if (const auto status = (*renderer)->draw(whole_objects(scene.objects, all), view, view.viewport());
        !status)
        return tl::unexpected(status.error());
    PixelFrame pixels;
    pixels.reshape(view.viewport());
    if (const auto status = (*renderer)->read(view.viewport(), pixels); !status)
        return tl::unexpected(status.error());
    return to_picture(pixels, background);
}

}  // namespace swath::sim
