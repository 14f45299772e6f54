#include "client/partition/sort_last.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "client/partition/sweep.h"
#include "common/base/check.h"

namespace swath {
namespace {

// The paper does not say; 80 reproduces the message counts of its Table 1.
constexpr int kTilePixels = 80;

// 0..count-1 by ascending key, then number. Keys are gathered first: comparing through two tables is several
// times slower.
template <class Key>
std::vector<std::uint32_t> ascending(std::size_t count, const Key& key) {
    std::vector<std::pair<float, std::uint32_t>> keyed(count);
    for (std::uint32_t i = 0; i < count; ++i) keyed[i] = {key(i), i};
    std::sort(keyed.begin(), keyed.end());
    std::vector<std::uint32_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = keyed[i].second;
    return order;
}

// Interleaved squares; an odd stride of about sqrt(N) a row keeps a server's squares apart.
void deal_tiles(const View& view, std::span<ServerShare> servers) {
    const auto root = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(servers.size()))));
    const std::size_t stride = root | 1;
    std::size_t row = 0;
    for (int y = 0; y < view.height; y += std::min(kTilePixels, view.height - y), ++row) {
        std::size_t column = 0;
        for (int x = 0; x < view.width; x += std::min(kTilePixels, view.width - x), ++column) {
            const Rect tile{x, y, x + std::min(kTilePixels, view.width - x),
                            y + std::min(kTilePixels, view.height - y)};
            servers[(column + row * stride) % servers.size()].tile.push_back(tile);
        }
    }
}

}  // namespace

struct SortLast::Split {
    const std::vector<Object>& objects;
    const std::vector<ObjectId>& group;
    glm::length_t axis;
    float upper(std::uint32_t i) const { return objects[group[i]].box.max[axis]; }
    float lower(std::uint32_t i) const { return objects[group[i]].box.min[axis]; }
    std::uint64_t work(std::uint32_t i) const { return objects[group[i]].triangle_count; }
};

SortLast::SortLast(std::span<const Object> objects) : objects_(objects.begin(), objects.end()) {
    CHECK(objects_.size() <= kMaxObjects);
}

FramePlan SortLast::partition(const PartitionInput& input) {
    CHECK(input.servers >= 1u);
    CHECK(input.servers <= kMaxServers);
    CHECK(input.objects.size() == objects_.size());
    const Rect viewport = input.view.viewport();
    CHECK(!viewport.empty());

    if (groups_.size() != input.servers) {
        groups_.assign(input.servers, {});
        std::vector<ObjectId> all(objects_.size());
        std::iota(all.begin(), all.end(), ObjectId{0});
        divide(std::move(all), 0, input.servers);
    }
    FramePlan plan;
    plan.frame = input.frame;
    plan.view = input.view;
    plan.servers.resize(input.servers);
    deal_tiles(input.view, plan.servers);
    for (std::size_t s = 0; s < input.servers; ++s) {
        ServerShare& share = plan.servers[s];
        share.group = groups_[s];
        for (const ObjectId id : share.group)
            if (input.objects[id].visible) share.content = bounding(share.content, input.objects[id].box);
        CHECK(viewport.contains(share.content));
    }
    return plan;
}

void SortLast::divide(std::vector<ObjectId> group, std::size_t first_server, std::size_t servers) {
    if (servers == 1) {
        groups_[first_server] = std::move(group);
        return;
    }
    Box bounds;
    for (const ObjectId id : group) bounds.extend(objects_[id].box);
    const Split split{objects_, group, static_cast<glm::length_t>(bounds.longest_axis())};

    const std::vector<std::uint32_t> from_left =
        ascending(group.size(), [&](std::uint32_t i) { return split.upper(i); });
    std::vector<std::uint32_t> from_right =
        ascending(group.size(), [&](std::uint32_t i) { return split.lower(i); });
    std::reverse(from_right.begin(), from_right.end());
    std::vector<Side> sides(group.size(), Side::kNone);
    const SplitServers halves(servers);
    // Groups only: nothing is cut in model space, so where the lines end does not matter.
    const SweepLines<float> ends{bounds.min[split.axis], bounds.max[split.axis]};
    sweep(std::span<const std::uint32_t>(from_left), std::span<const std::uint32_t>(from_right), split,
          halves, ends, std::span<Side>(sides));

    std::vector<ObjectId> left;
    std::vector<ObjectId> right;
    for (std::size_t i = 0; i < group.size(); ++i)
        (sides[i] == Side::kLeft ? left : right).push_back(group[i]);
    divide(std::move(left), first_server, halves.left);
    divide(std::move(right), first_server + halves.left, halves.right);
}

}  // namespace swath
