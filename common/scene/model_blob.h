#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "common/base/buffer.h"
#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// A mesh as one run of bytes: what travels to a server that lacks the file, and what the model cache stores.
// Layout, little-endian: "SWMB", u32 version 3, u64 vertices, u64 indices, u64 material numbers (0 or one a
// triangle), u64 motions (0 or one a vertex), the vertices (24 bytes each), the indices and the material
// numbers (u32 each) and the motions (three floats each). Identity is the SHA-256 of these bytes, that is of
// the mesh as loaded and not of the file, so two loaders that read a file differently are told apart.
using Digest = std::array<std::uint8_t, 32>;
std::string to_hex(const Digest& digest);

Buffer write_blob(const Mesh& mesh);
Digest digest(std::span<const std::uint8_t> bytes);

// Checks everything, including validate(mesh).
Result<Mesh> read_blob(std::span<const std::uint8_t> bytes);

}  // namespace swath
