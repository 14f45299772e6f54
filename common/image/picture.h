#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/base/buffer.h"
#include "common/base/names.h"
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

// The limits of a run's picture. encode() and decode_png() check the side only.
inline constexpr int kMaxPictureSide = 16384;
// A message with depth and colour of so many pixels stays below half a gibibyte.
inline constexpr std::int64_t kMaxPicturePixels = std::int64_t{1} << 26;

enum class PictureFormat { kNone, kPng, kJpeg };
template <>
inline constexpr auto kNames<PictureFormat> = names_of<PictureFormat>(
    "format", {{PictureFormat::kNone, "none"}, {PictureFormat::kPng, "png"}, {PictureFormat::kJpeg, "jpeg"}});

// Makes a file's bytes: PNG (lossless and fast; equal pictures give equal bytes) or JPEG (quality 90, 4:2:0).
// Rows are top-down in the file. CHECKs that `format` is not kNone, that both sides are 1 to kMaxPictureSide
// and that rgb has their bytes. Throws std::runtime_error if a codec fails (memory). Any thread.
Buffer encode(const Picture& picture, PictureFormat format);
std::string file_extension(PictureFormat format);  // "png", "jpg"; CHECKs that format is not kNone

// Reads a PNG of any colour type, for tests and comparisons. 16 bits become 8, transparency is laid over
// black. Fails on damaged files and on sides over kMaxPictureSide.
Result<Picture> decode_png(std::span<const std::uint8_t> bytes);

}  // namespace swath
