#include "sim/picture/layers.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "common/base/check.h"
#include "sim/picture/colours.h"
#include "sim/picture/lines.h"

namespace swath::sim {
namespace {

// A box leaves this much of the lines behind it.
constexpr float kBehind = 0.3f;

std::size_t place(const View& view, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width) + static_cast<std::size_t>(x);
}

void check_size(const Picture& picture, const View& view) {
    CHECK(picture.width == view.width);
    CHECK(picture.height == view.height);
    CHECK(picture.rgb.size() == 3 * place(view, 0, view.height));
}

void blend_at(Picture& picture, std::size_t pixel, const Rgb& colour, double opacity) {
    std::uint8_t* rgb = &picture.rgb[3 * pixel];
    const Rgb mixed = blend({rgb[0], rgb[1], rgb[2]}, colour, opacity);
    std::copy(mixed.begin(), mixed.end(), rgb);
}

// The owner of each pixel.
std::vector<ServerId> owners(const FramePlan& plan) {
    std::vector<ServerId> owner(place(plan.view, 0, plan.view.height));
    for (std::size_t s = 0; s < plan.servers.size(); ++s)
        for (const Rect& rect : plan.servers[s].tile)
            for (int y = rect.y0; y < rect.y1; ++y)
                std::fill_n(owner.begin() + static_cast<std::ptrdiff_t>(place(plan.view, rect.x0, y)),
                            rect.width(), server_id(s));
    return owner;
}

}  // namespace

std::vector<std::uint16_t> transfer_counts(const FramePlan& plan) {
    static_assert(kMaxServers <= std::numeric_limits<std::uint16_t>::max());
    std::vector<std::uint16_t> counts(place(plan.view, 0, plan.view.height));
    for (const Transfer& transfer : transfers(plan))
        for (const Rect& rect : transfer.region)
            for (int y = rect.y0; y < rect.y1; ++y)
                for (int x = rect.x0; x < rect.x1; ++x) ++counts[place(plan.view, x, y)];
    return counts;
}

double whiteness(unsigned times) {
    double left = 1;
    for (unsigned i = 0; i < std::min(times, 64u); ++i) left *= 0.55;
    return 0.9 * (1 - left);
}

Picture with_transfers(Picture picture, const FramePlan& plan) {
    check_size(picture, plan.view);
    const std::vector<std::uint16_t> counts = transfer_counts(plan);
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0) blend_at(picture, i, {255, 255, 255}, whiteness(counts[i]));
    return picture;
}

Picture with_tile_tints(Picture picture, const FramePlan& plan, double opacity) {
    check_size(picture, plan.view);
    const std::vector<ServerId> owner = owners(plan);
    for (std::size_t i = 0; i < owner.size(); ++i) blend_at(picture, i, server_colour(owner[i]), opacity);
    return picture;
}

Picture with_tile_borders(Picture picture, const FramePlan& plan) {
    const View& view = plan.view;
    check_size(picture, view);
    const std::vector<ServerId> owner = owners(plan);
    const int thickness = std::max(1, (view.width + 320) / 640);
    const auto foreign = [&](int x, int y, ServerId mine) {
        return x >= 0 && x < view.width && y >= 0 && y < view.height && owner[place(view, x, y)] != mine;
    };
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const std::size_t pixel = place(view, x, y);
            bool border = false;
            for (int d = 1; d <= thickness && !border; ++d)
                border = foreign(x - d, y, owner[pixel]) || foreign(x + d, y, owner[pixel]) ||
                         foreign(x, y - d, owner[pixel]) || foreign(x, y + d, owner[pixel]);
            if (border) blend_at(picture, pixel, server_colour(owner[pixel]), 1);
        }
    return picture;
}

Picture with_wireframes(Picture picture, std::span<const Box> boxes, const View& view, const Ink& ink) {
    check_size(picture, view);
    const double width = std::max(1.0, view.width / 900.0);
    // Draws boxes from far to near, by the depth of their centres; equal ones in their order.
    const auto depth = [&](std::size_t i) {
        return (view.clip_from_model * glm::vec4(boxes[i].centre(), 1)).w;
    };
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return depth(a) > depth(b); });
    Coverage coverage(view.width, view.height);
    for (const std::size_t i : order) {
        const Wireframe frame = project_wireframe(boxes[i], view);
        fade_behind(coverage, frame, kBehind);
        draw(coverage, frame, width);
    }
    for (std::size_t i = 0; i < coverage.of.size(); ++i)
        if (coverage.of[i] > 0) blend_at(picture, i, ink.colour, ink.opacity * coverage.of[i]);
    return picture;
}

Picture dimmed(Picture picture, double brightness) {
    for (std::uint8_t& channel : picture.rgb) channel = static_cast<std::uint8_t>(channel * brightness + 0.5);
    return picture;
}

}  // namespace swath::sim
