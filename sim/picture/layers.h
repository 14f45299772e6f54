#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/box.h"
#include "common/image/picture.h"
#include "common/plan/frame_plan.h"

namespace swath::sim {

// Layers to lay over the picture of a frame, each a function from picture to picture. A picture has the size
// of the plan's view, which is CHECKed, and the plan has no problem(). Pure; the same bytes on every run.

// How often each pixel is sent from one server to another, rows bottom-up: the number of transfers whose
// region it lies in.
std::vector<std::uint16_t> transfer_counts(const FramePlan& plan);
// The opacity of the white over a pixel that is transferred `times` times: 0.9 (1 - 0.55^times), that is
// 0.41, 0.63, 0.75, 0.82 and so on, so that the model still shines through where sort-last sends everything.
double whiteness(unsigned times);
// Transferred pixels in transparent white (Samanta 2000, figure 10b and c).
Picture with_transfers(Picture picture, const FramePlan& plan);

// The owner's colour over every tile (figure 14, bottom).
Picture with_tile_tints(Picture picture, const FramePlan& plan, double opacity);
// A line along every border between tiles, on each side in its owner's colour; none along the screen's edge,
// nor between rectangles of one tile. A pixel wide on each side for every 640 of the picture's width.
Picture with_tile_borders(Picture picture, const FramePlan& plan);

struct Ink {
    Rgb colour{255, 255, 255};
    double opacity = 1;  // 0 to 1
};
// The boxes' projected edges (figure 14, top). A box dims what is behind it, also its like, in the order of
// the centres' depths, and its own edges are drawn all twelve.
Picture with_wireframes(Picture picture, std::span<const Box> boxes, const View& view, const Ink& ink);

// Every channel times `brightness`, 0 to 1: room above for white.
Picture dimmed(Picture picture, double brightness);

}  // namespace swath::sim
