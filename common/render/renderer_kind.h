#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "common/base/result.h"

namespace swath {

// The libraries that can draw. The numbers travel (docs/wire.md).
enum class RendererKind : std::uint32_t { kOsmesa = 1, kEgl = 2 };

inline constexpr std::array kRendererKinds{RendererKind::kOsmesa, RendererKind::kEgl};

constexpr std::string_view name_of(RendererKind kind) {
    return kind == RendererKind::kOsmesa ? "osmesa" : "egl";
}

inline Result<RendererKind> parse_renderer(std::string_view name) {
    for (const RendererKind kind : kRendererKinds)
        if (name_of(kind) == name) return kind;
    return fail("renderer '{}' is not known; there are: osmesa, egl", name);
}

}  // namespace swath
