#pragma once
#include <cstdint>
#include <span>

#include "common/base/buffer.h"
#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/geometry/rect.h"
#include "common/image/picture.h"
#include "common/image/pixel_frame.h"

namespace swath {

// Only active pixels (depth below 1) travel, in spans, without alpha, which is always opaque. Numbers are
// little-endian; varints have seven bits a byte, the low ones first. docs/wire.md has an example.
//
//   swath (server to server)   f32 depth per pixel | u8 R, G, B per pixel | spans | ids
//   tile (server to display)   u8 R, G, B per pixel | spans
//
//   spans   for each row of each rectangle of the region, bottom-up:
//             varint count of spans, then for each span
//               varint pixels skipped since the rectangle's left edge or the span before
//               varint length > 0
//   ids     runs over the pixels in the order of spans, for each run
//             varint length > 0
//             varint zigzag(id - id of the run before); the first counts from id 0
//
// The region itself does not travel, because both ends know it from the plan.
struct BodySizes {
    std::uint32_t pixels = 0;
    std::uint32_t span_bytes = 0;
    std::uint32_t id_bytes = 0;  // 0 for a tile
    bool operator==(const BodySizes&) const = default;
};

// Fills `body` with the active pixels of `region`, which must lie in frame.rect().
BodySizes encode_swath(const PixelFrame& frame, const Region& region, Buffer& body);
BodySizes encode_tile(const PixelFrame& frame, const Region& region, Buffer& body);

// Composites a peer's pixels into `frame`: the smaller depth wins, of equal depths the smaller id
// (docs/design.md, "Exactness"). Trusts nothing in `body`: it checks sizes, spans, ids (below `object_limit`)
// and depths (in [0, 1)), and the error says which was wrong; some pixels may be composited by then. `body`
// must start at a multiple of 4. `region` is the caller's own and must lie in frame.rect().
Status composite_swath(std::span<const std::uint8_t> body, const BodySizes& sizes, const Region& region,
                       ObjectId object_limit, PixelFrame& frame);

// Writes a server's pixels into the picture, in which `region` must lie. Checks like composite_swath.
Status assemble_tile(std::span<const std::uint8_t> body, const BodySizes& sizes, const Region& region,
                     Picture& picture);

// The inner loop of composite_swath, for benchmarks: n pixels of each plane.
void composite_pixels(std::size_t n, const std::uint32_t* colour_in, const float* depth_in,
                      const ObjectId* id_in, std::uint32_t* colour, float* depth, ObjectId* id);

// Makes a picture of that size in one colour.
void fill(Picture& picture, int width, int height, const Rgb& background);

// The picture of a frame that one renderer has drawn whole.
Picture to_picture(const PixelFrame& frame, const Rgb& background);

}  // namespace swath
