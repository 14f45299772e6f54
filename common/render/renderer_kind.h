#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/names.h"
#include "common/base/result.h"

namespace swath {

// The kinds of renderer: two libraries of OpenGL, our own ray caster and our own rasteriser. These numbers travel
// (docs/wire.md).
enum class RendererKind : std::uint32_t { kOsmesa = 1, kEgl = 2, kRaycast = 3, kRaster = 4 };
template <>
inline constexpr auto kNames<RendererKind> = names_of<RendererKind>("renderer",
                                                                    {{RendererKind::kRaster, "raster"},
                                                                     {RendererKind::kOsmesa, "osmesa"},
                                                                     {RendererKind::kEgl, "egl"},
                                                                     {RendererKind::kRaycast, "raycast"}});

// A list that a cluster's servers take in turn, like "raycast,osmesa". It has at least one name and may
// repeat one.
std::string renderer_list(std::span<const RendererKind> kinds);
bool has_raycast(std::span<const RendererKind> kinds);
Result<std::vector<RendererKind>> parse_renderers(std::string_view names);

}  // namespace swath
