#pragma once
#include <cstdint>

namespace swath {

// The libraries that can draw. The numbers travel (docs/wire.md).
enum class RendererKind : std::uint32_t { kOsmesa = 1, kEgl = 2 };

}  // namespace swath
