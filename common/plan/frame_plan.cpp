#include "common/plan/frame_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace swath {
namespace {

std::string text(const Rect& r) { return fmt::format("[{},{})x[{},{})", r.x0, r.x1, r.y0, r.y1); }

// A rectangle of a server's tile.
struct Piece {
    Rect rect;
    std::size_t server;
};

// Sweeps a line in x over the pieces. Those that it crosses, ordered by y, do not overlap, so a new piece
// needs to be compared with its two neighbours only. O(n log n) comparisons.
std::optional<std::string> overlap_problem(std::vector<Piece> pieces) {
    std::vector<std::size_t> ends(pieces.size());
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return a.rect.x0 != b.rect.x0 ? a.rect.x0 < b.rect.x0 : a.rect.y0 < b.rect.y0;
    });
    for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = i;
    std::sort(ends.begin(), ends.end(),
              [&](std::size_t a, std::size_t b) { return pieces[a].rect.x1 < pieces[b].rect.x1; });

    std::vector<const Piece*> crossed;  // by y0
    const auto place_of = [&](int y) {
        return std::lower_bound(crossed.begin(), crossed.end(), y,
                                [](const Piece* p, int value) { return p->rect.y0 < value; });
    };
    auto end = ends.begin();
    for (const Piece& piece : pieces) {
        for (; pieces[*end].rect.x1 <= piece.rect.x0; ++end) crossed.erase(place_of(pieces[*end].rect.y0));
        const auto above = place_of(piece.rect.y0);
        const Piece* other = nullptr;
        if (above != crossed.end() && (*above)->rect.y0 < piece.rect.y1) other = *above;
        if (above != crossed.begin() && (*std::prev(above))->rect.y1 > piece.rect.y0)
            other = *std::prev(above);
        if (other != nullptr)
            return fmt::format("tiles: {} of server {} and {} of server {} overlap", text(other->rect),
                               other->server, text(piece.rect), piece.server);
        crossed.insert(above, &piece);
    }
    return std::nullopt;
}

std::optional<std::string> tile_problem(const FramePlan& plan) {
    const Rect viewport = plan.view.viewport();
    std::vector<Piece> pieces;
    std::int64_t covered = 0;
    for (std::size_t s = 0; s < plan.servers.size(); ++s) {
        for (const Rect& rect : plan.servers[s].tile) {
            if (rect.empty()) continue;
            // This comes before any arithmetic: the numbers may come from a peer, and differences may
            // overflow.
            if (!viewport.contains(rect))
                return fmt::format("tile of server {}: {} leaves the viewport {}", s, text(rect),
                                   text(viewport));
            covered += rect.area();
            pieces.push_back({rect, s});
        }
    }
    if (auto overlap = overlap_problem(std::move(pieces))) return overlap;
    // The pieces lie in the viewport and do not overlap, so the sum of areas says whether they cover it.
    if (covered != viewport.area())
        return fmt::format("tiles: cover {} of {} pixels", covered, viewport.area());
    return std::nullopt;
}

std::optional<std::string> group_problem(const FramePlan& plan, std::size_t object_count, Grouping grouping) {
    std::vector<bool> seen(object_count, false);
    std::size_t distinct = 0;
    for (std::size_t s = 0; s < plan.servers.size(); ++s) {
        const std::vector<ObjectId>& group = plan.servers[s].group;
        for (std::size_t k = 0; k < group.size(); ++k) {
            const ObjectId id = group[k];
            if (id >= object_count)
                return fmt::format("group of server {}: object {} of {}", s, id, object_count);
            if (k > 0 && group[k - 1] >= id)
                return fmt::format("group of server {}: object {} after {} is not ascending", s, id,
                                   group[k - 1]);
            if (!seen[id]) {
                seen[id] = true;
                ++distinct;
            } else if (grouping == Grouping::kExactlyOnce) {
                return fmt::format("group of server {}: object {} is in another group too", s, id);
            }
        }
    }
    if (distinct == object_count) return std::nullopt;
    const auto missing = std::find(seen.begin(), seen.end(), false) - seen.begin();
    return fmt::format("groups: {} of {} objects in no group, the first is {}", object_count - distinct,
                       object_count, missing);
}

}  // namespace

std::optional<std::string> problem(const FramePlan& plan, std::size_t object_count, Grouping grouping) {
    const Rect viewport = plan.view.viewport();
    if (viewport.empty()) return fmt::format("viewport: {} has no pixels", text(viewport));
    if (plan.servers.empty()) return "servers: the plan has none";
    for (std::size_t s = 0; s < plan.servers.size(); ++s)
        if (!viewport.contains(plan.servers[s].content))
            return fmt::format("content of server {}: {} leaves the viewport {}", s,
                               text(plan.servers[s].content), text(viewport));
    if (auto found = tile_problem(plan)) return found;
    return group_problem(plan, object_count, grouping);
}

}  // namespace swath
