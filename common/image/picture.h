#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/base/buffer.h"
#include "common/base/result.h"

namespace swath {

using Rgb = std::array<std::uint8_t, 3>;

// A finished picture: 8-bit RGB, rows bottom-up without padding, 3 * width * height bytes.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
    bool operator==(const Picture&) const = default;
};

inline constexpr int kMaxPictureSide = 16384;
// ... and pixels: a message of all of them, with depth, stays below half a gibibyte.
inline constexpr std::int64_t kMaxPicturePixels = std::int64_t{1}
                                                  << 26;  // pixels, of what encode and decode_png take

enum class PictureFormat { kNone, kPng, kJpeg };

// The file's bytes: PNG (lossless, fast settings; the same picture always gives the same bytes) or JPEG
// (quality 90, 4:2:0). Top-down in the file, as viewers expect. CHECKs that format is not kNone, that both
// sides are 1 to kMaxPictureSide and that rgb has their bytes. Throws std::runtime_error when a codec fails
// (memory). Any thread.
Buffer encode(const Picture& picture, PictureFormat format);
std::string file_extension(PictureFormat format);  // "png", "jpg"; CHECKs that format is not kNone

// For tests and comparisons: a PNG's pixels as a Picture, whatever its colour type; 16 bits become 8,
// transparency is laid over black. Fails on anything damaged and on sides over kMaxPictureSide.
Result<Picture> decode_png(std::span<const std::uint8_t> bytes);

}  // namespace swath
