#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "common/base/buffer.h"
#include "common/base/result.h"

namespace swath {

// The whole file, at most `limit` bytes. Errors name the path and the reason.
Result<Buffer> read_file(const std::filesystem::path& path, std::uint64_t limit);

// Writes a neighbour with a temporary name and renames it: the file is there whole or not at all. Makes the
// folder if it is missing.
Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
Status write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace swath
