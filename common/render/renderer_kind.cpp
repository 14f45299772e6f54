#include "common/render/renderer_kind.h"

#include <algorithm>

#include "common/base/ids.h"

namespace swath {

std::string renderer_list(std::span<const RendererKind> kinds) {
    std::string names;
    for (const RendererKind kind : kinds)
        names += fmt::format("{}{}", names.empty() ? "" : ",", name_of(kind));
    return names;
}

bool has_raycast(std::span<const RendererKind> kinds) {
    return std::ranges::find(kinds, RendererKind::kRaycast) != kinds.end();
}

Result<std::vector<RendererKind>> parse_renderers(std::string_view names) {
    std::vector<RendererKind> kinds;
    for (bool more = true; more;) {
        const std::size_t comma = names.find(',');
        SWATH_TRY(const RendererKind kind, parse<RendererKind>(names.substr(0, comma)));
        if (kinds.size() == kMaxServers) return fail("renderers: more than {}", kMaxServers);
        kinds.push_back(kind);
        more = comma != std::string_view::npos;
        if (more) names.remove_prefix(comma + 1);
    }
    return kinds;
}

}  // namespace swath
