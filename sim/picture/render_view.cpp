#include "sim/picture/render_view.h"

#include <numeric>

#include "common/image/pixel_codec.h"
#include "common/image/pixel_frame.h"
#include "common/renderers/make_renderer.h"

namespace swath::sim {

Result<Picture> render_view(const ObjectSet& scene, const View& view, const Rgb& background) {
    SWATH_TRY(auto renderer, make_renderer({.kind = default_renderer().kind}, scene));
    std::vector<ObjectId> all(scene.objects.size());
    std::iota(all.begin(), all.end(), ObjectId{0});
    SWATH_TRY_VOID(renderer->draw(whole_objects(scene.objects, all), view, view.viewport()));
    PixelFrame pixels;
    pixels.reshape(view.viewport());
    SWATH_TRY_VOID(renderer->read(view.viewport(), pixels));
    return to_picture(pixels, background);
}

}  // namespace swath::sim
