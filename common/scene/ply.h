#pragma once
#include <cstdint>
#include <span>

#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// Reads a PLY file's bytes: ASCII and binary of both byte orders, any property types and order, extra
// properties and elements skipped, polygons triangulated as fans, normals (nx ny nz) and colours (red green
// blue [alpha], uchar or float) taken where present. Without normals the mesh gets computed ones. Nothing in
// the bytes is trusted: counts are checked against the bytes that are there before anything is allocated.
// Errors name the element, the property and the limit; the file's name is the caller's to add.
Result<Mesh> read_ply(std::span<const std::uint8_t> bytes);

}  // namespace swath
