#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "common/base/buffer.h"
#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// A blob is a mesh as bytes: it travels to a server that lacks the file, and the model cache stores it.
// Little-endian:
//
//   "SWMB"  u32 version = 3
//   u64 vertices  u64 indices  u64 materials (0 or one per triangle)  u64 motions (0 or one per vertex)
//   vertices, 24 bytes each | indices, u32 | materials, u32 | motions, 3 floats
//
// A model's identity is the SHA-256 of these bytes: of the mesh as loaded and not of the file, so that two
// loaders that read a file differently are told apart.
using Digest = std::array<std::uint8_t, 32>;
std::string to_hex(const Digest& digest);

Buffer write_blob(const Mesh& mesh);
Digest digest(std::span<const std::uint8_t> bytes);

// Reads a blob from outside. Checks the header's counts against the limits and the size before allocating,
// and the mesh with validate().
Result<Mesh> read_blob(std::span<const std::uint8_t> bytes);

}  // namespace swath
