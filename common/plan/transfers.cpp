#include <algorithm>
#include <cstdint>

#include "common/plan/frame_plan.h"

namespace swath {
namespace {

// The rectangles of all tiles, in horizontal bands of the screen, so that a content looks at few of them.
class TileIndex {
  public:
    explicit TileIndex(const FramePlan& plan) : screen_(plan.view.viewport()) {
        for (std::size_t s = 0; s < plan.servers.size(); ++s)
            for (const Rect& rect : plan.servers[s].tile)
                if (!rect.empty()) pieces_.push_back({intersect(rect, screen_), server_id(s)});
        for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
            const Rect& rect = pieces_[p].rect;
            if (rect.empty()) continue;
            for (std::size_t b = band(rect.y0); b <= band(rect.y1 - 1); ++b) bands_[b].push_back(p);
        }
    }

    struct Piece {
        Rect rect;
        ServerId owner;
    };

    // Finds the pieces that share pixels with `content`, ascending by owner and index in its tile.
    void find(const Rect& content, std::vector<std::uint32_t>& found) const {
        found.clear();
        const Rect area = intersect(content, screen_);
        if (area.empty()) return;
        const std::size_t first = band(area.y0);
        for (std::size_t b = first; b <= band(area.y1 - 1); ++b)
            for (const std::uint32_t p : bands_[b])
                // A piece in several bands is taken in the first of them that the content reaches.
                if (!intersect(pieces_[p].rect, area).empty() &&
                    b == std::max(first, band(pieces_[p].rect.y0)))
                    found.push_back(p);
        std::sort(found.begin(), found.end());
    }

    const Piece& operator[](std::uint32_t piece) const { return pieces_[piece]; }

  private:
    static constexpr std::size_t kBands = 32;
    std::size_t band(int y) const {
        return static_cast<std::size_t>(std::int64_t{y} * std::int64_t{kBands} / screen_.y1);
    }

    Rect screen_;
    std::vector<Piece> pieces_;
    std::vector<std::uint32_t> bands_[kBands];
};

}  // namespace

std::vector<Transfer> transfers(const FramePlan& plan) {
    std::vector<Transfer> all;
    const TileIndex index(plan);
    std::vector<std::uint32_t> found;
    for (std::size_t s = 0; s < plan.servers.size(); ++s) {
        const ServerId from = server_id(s);
        const Rect& content = plan.servers[s].content;
        index.find(content, found);
        for (const std::uint32_t p : found) {
            const TileIndex::Piece& piece = index[p];
            if (piece.owner == from) continue;
            if (all.empty() || all.back().from != from || all.back().to != piece.owner)
                all.push_back({from, piece.owner, {}});
            all.back().region.push_back(intersect(piece.rect, content));
        }
    }
    return all;
}

Region final_region(const FramePlan& plan, ServerId id) {
    Region region;
    for (const Rect& rect : plan.servers.at(index(id)).tile) {
        Rect bounds;
        for (const ServerShare& share : plan.servers)
            bounds = bounding(bounds, intersect(rect, share.content));
        if (!bounds.empty()) region.push_back(bounds);
    }
    return region;
}

}  // namespace swath
