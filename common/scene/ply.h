#pragma once
#include <cstdint>
#include <span>

#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// Reads a PLY file's bytes: ASCII or binary of either byte order, with properties of any type and order.
// Skips other properties and elements, makes fans of polygons, and takes normals (nx ny nz) and colours (red
// green blue [alpha]) where they are present, else it computes normals. Trusts nothing: it checks counts
// against the bytes that are there before it allocates. Errors name the element, the property and the limit;
// the caller adds the file's name.
Result<Mesh> read_ply(std::span<const std::uint8_t> bytes);

}  // namespace swath
