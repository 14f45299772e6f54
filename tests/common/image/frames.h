#pragma once
#include <random>
#include <vector>

#include "common/image/pixel_codec.h"
#include "common/image/pixel_frame.h"

namespace swath::test {

inline constexpr ObjectId kObjectLimit = 300;

using Random = std::mt19937;  // its numbers are the same everywhere, unlike those of distributions

inline int below(Random& random, int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
}

struct Pixel {
    std::uint32_t colour = 0;
    float depth = kFarDepth;
    ObjectId id = 0;
    bool operator==(const Pixel&) const = default;
};

inline Pixel pixel(const PixelFrame& frame, int x, int y) {
    const Pixel p{*frame.colour(x, y), *frame.depth(x, y), *frame.id(x, y)};
    return p.depth < kFarDepth ? p : Pixel{};  // background has neither colour nor id
}

inline void put(PixelFrame& frame, int x, int y, const Pixel& p) {
    *frame.colour(x, y) = p.colour;
    *frame.depth(x, y) = p.depth;
    *frame.id(x, y) = p.id;
}

inline std::vector<Pixel> pixels(const PixelFrame& frame) {
    std::vector<Pixel> all;
    const Rect& r = frame.rect();
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x) all.push_back(pixel(frame, x, y));
    return all;
}

// A frame of runs of active and background pixels. Few depths make ties; the colour names the object.
// `coverage`: 0 none active, 1 all, 2 runs, 3 noise.
inline PixelFrame random_frame(const Rect& rect, Random& random, int coverage) {
    static constexpr float kDepths[] = {0.0f, 1e-40f, 0.25f, 0.5f, 0.99999994f};
    PixelFrame frame;
    frame.reshape(rect);
    int run = 0;
    bool on = false;
    ObjectId id = 0;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            if (run-- == 0) {
                run = coverage == 3 ? 0 : below(random, 40);
                on = coverage == 1 || (coverage >= 2 && random() % 2 == 0);
                id = static_cast<ObjectId>(random() % kObjectLimit);
            }
            if (random() % 8 == 0) id = static_cast<ObjectId>(random() % kObjectLimit);
            Pixel p{static_cast<std::uint32_t>(random()), kFarDepth, static_cast<ObjectId>(random())};
            if (on) {
                // Two peers that draw an object at the same depth draw the same pixel.
                p.depth = kDepths[random() % 5];
                p.id = id;
                p.colour = 0xff000000u | static_cast<std::uint32_t>(y * 65536 + x * 512) | (id & 0xff);
            }
            put(frame, x, y, p);
        }
    return frame;
}

inline PixelFrame copy(const PixelFrame& from) {
    PixelFrame to;
    to.reshape(from.rect());
    for (int y = from.rect().y0; y < from.rect().y1; ++y)
        for (int x = from.rect().x0; x < from.rect().x1; ++x)
            put(to, x, y, {*from.colour(x, y), *from.depth(x, y), *from.id(x, y)});
    return to;
}

// Some of the fields of a random grid over `rect`: disjoint rectangles, down to a pixel wide.
inline Region random_region(const Rect& rect, Random& random) {
    Region region;
    const int step_x = 1 + below(random, rect.width());
    const int step_y = 1 + below(random, rect.height());
    for (int y = rect.y0; y < rect.y1; y += step_y)
        for (int x = rect.x0; x < rect.x1; x += step_x)
            if (random() % 4 != 0) region.push_back(intersect({x, y, x + step_x, y + step_y}, rect));
    return region;
}

inline bool inside(const Region& region, int x, int y) {
    for (const Rect& r : region)
        if (r.contains({x, y, x + 1, y + 1})) return true;
    return false;
}

// Composites pixel by pixel.
inline void merge_by_hand(const PixelFrame& from, const Region& region, PixelFrame& to) {
    for (int y = to.rect().y0; y < to.rect().y1; ++y)
        for (int x = to.rect().x0; x < to.rect().x1; ++x) {
            if (!inside(region, x, y)) continue;
            const Pixel theirs = pixel(from, x, y);
            const Pixel ours = pixel(to, x, y);
            if (theirs.depth == kFarDepth) continue;
            if (theirs.depth < ours.depth || (theirs.depth == ours.depth && theirs.id < ours.id))
                put(to, x, y, theirs);
        }
}

}  // namespace swath::test
