#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/box.h"
#include "common/image/picture.h"
#include "common/plan/frame_plan.h"

namespace swath::sim {

// Layers over the picture of a frame. Each is a pure function from picture to picture, with the same bytes on
// every run. The picture must have the size of the plan's view (CHECKed), and the plan no problem().

// Counts, for each pixel, the transfers whose region it lies in: how often it is sent from one server to
// another. Rows bottom-up.
std::vector<std::uint16_t> transfer_counts(const FramePlan& plan);
// The opacity of the white over a pixel that is transferred `times` times: 0.9 (1 - 0.55^times), that is
// 0.41, 0.63, 0.75, 0.82 and so on, so that the model still shines through where sort-last sends everything.
double whiteness(unsigned times);
// Shows transferred pixels in transparent white (Samanta 2000, figure 10b and c).
Picture with_transfers(Picture picture, const FramePlan& plan);

// Tints every tile with its owner's colour (figure 14, bottom).
Picture with_tile_tints(Picture picture, const FramePlan& plan, double opacity);
// Draws a line along every border between tiles, on each side in its owner's colour; none along the screen's
// edge, nor between rectangles of one tile. A side is a pixel wide for every 640 of the picture's width.
Picture with_tile_borders(Picture picture, const FramePlan& plan);

struct Ink {
    Rgb colour{255, 255, 255};
    double opacity = 1;  // 0 to 1
};
// Draws the projected edges of the boxes, all twelve of each (figure 14, top). A box dims the lines of boxes
// behind it, in the order of the centres' depths.
Picture with_wireframes(Picture picture, std::span<const Box> boxes, const View& view, const Ink& ink);

// Multiplies every channel by `brightness`, 0 to 1, to make room for white above.
Picture dimmed(Picture picture, double brightness);

}  // namespace swath::sim
