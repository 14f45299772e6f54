#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "common/base/buffer.h"
#include "common/base/result.h"

namespace swath {

// Reads a whole regular file of at most `limit` bytes. Errors name the path and the reason.
Result<Buffer> read_file(const std::filesystem::path& path, std::uint64_t limit);

// Writes a file under a temporary name beside `path` and renames it, so that it is there whole or not at all.
// Makes the folder if it is missing. Errors name the path and the reason.
Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
Status write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace swath
