#pragma once
#include <cstdint>
#include <span>

namespace swath {

inline constexpr int kMaxJsonDepth = 64;

// Whether the bytes are one JSON object (RFC 8259): well-formed, in UTF-8, nested at most kMaxJsonDepth deep.
// It keeps nothing of it, and so takes a tenth of what parsing does: a session asks this of every note.
bool is_json_object(std::span<const std::uint8_t> bytes);

}  // namespace swath
