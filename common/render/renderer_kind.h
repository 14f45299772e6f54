#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace swath {

// The kinds of renderer: two libraries of OpenGL and our own ray caster. These numbers travel (docs/wire.md).
enum class RendererKind : std::uint32_t { kOsmesa = 1, kEgl = 2, kRaycast = 3 };
inline constexpr std::uint32_t kRendererKindCount = 3;

inline constexpr std::array kRendererKinds{RendererKind::kOsmesa, RendererKind::kEgl, RendererKind::kRaycast};
static_assert(kRendererKinds.size() == kRendererKindCount);

std::string_view name_of(RendererKind kind);
Result<RendererKind> parse_renderer(std::string_view name);
std::string renderer_names();  // "osmesa, egl, ..."

// A list that a cluster's servers take in turn, like "raycast,osmesa". It has at least one name and may
// repeat one.
std::string renderer_list(std::span<const RendererKind> kinds);
bool has_raycast(std::span<const RendererKind> kinds);
Result<std::vector<RendererKind>> parse_renderers(std::string_view names);

}  // namespace swath
