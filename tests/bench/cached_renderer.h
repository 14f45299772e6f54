#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/render/renderer.h"

namespace swath::bench {

// Draws a view once and then returns the same pixels: this leaves a server only swap, composite and gather.
// Plans depend on the reports that have arrived, so a later plan may ask for other ranges or another rectangle
// of the same view. The view is then drawn again.
class CachedRenderer final : public Renderer {
  public:
    explicit CachedRenderer(std::unique_ptr<Renderer> renderer) : renderer_(std::move(renderer)) {}

    Status draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) override;
    Status read(const Rect& rect, PixelFrame& frame) override;
    std::string description() const override { return "cached " + renderer_->description(); }

  private:
    struct Drawn {
        std::vector<TriangleRange> ranges;
        PixelFrame pixels;  // none: it has to be drawn
    };

    std::unique_ptr<Renderer> renderer_;
    std::map<std::string, Drawn> drawn_;  // by the bytes of the view's matrix
    const Drawn* last_ = nullptr;         // of drawn_
};

}  // namespace swath::bench
