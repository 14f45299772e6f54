#include "client/partition/sort_last.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/base/check.h"

namespace swath {
namespace {

// The paper does not give it; 80 reproduces the message counts of its Table 1.
constexpr int kTilePixels = 80;

// The numbers 0..count-1 by ascending key, then number. Keys are gathered first: comparing through two tables
// is several times slower.
template <class Key>
std::vector<ObjectId> ascending(std::size_t count, const Key& key) {
    std::vector<std::pair<float, ObjectId>> keyed(count);
    for (ObjectId id = 0; id < count; ++id) keyed[id] = {key(id), id};
    std::sort(keyed.begin(), keyed.end());
    std::vector<ObjectId> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = keyed[i].second;
    return order;
}

// An odd stride of about sqrt(N) a row keeps a server's squares apart.
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
    glm::length_t axis;
    float upper(ObjectId id) const { return objects[id].box.max[axis]; }
    float lower(ObjectId id) const { return objects[id].box.min[axis]; }
    std::uint64_t work(ObjectId id) const { return objects[id].triangle_count; }
};

SortLast::SortLast(std::span<const Object> objects) : objects_(objects.begin(), objects.end()) {
    CHECK(objects_.size() <= kMaxObjects);
    sorted_.by_id.resize(objects_.size());
    std::iota(sorted_.by_id.begin(), sorted_.by_id.end(), ObjectId{0});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Split split{objects_, static_cast<glm::length_t>(axis)};
        sorted_.from_left[axis] = ascending(objects_.size(), [&](ObjectId id) { return split.upper(id); });
        sorted_.from_right[axis] = ascending(objects_.size(), [&](ObjectId id) { return split.lower(id); });
        std::reverse(sorted_.from_right[axis].begin(), sorted_.from_right[axis].end());
    }
    sides_.resize(objects_.size());
    right_.resize(objects_.size());
}

FramePlan SortLast::partition(const PartitionInput& input) {
    CHECK(input.servers >= 1u);
    CHECK(input.servers <= kMaxServers);
    CHECK(input.objects.size() == objects_.size());
    const Rect viewport = input.view.viewport();
    CHECK(!viewport.empty());

    if (groups_.size() != input.servers) {
        groups_.assign(input.servers, {});
        Orders orders = sorted_;
        divide(orders, 0, objects_.size(), 0, input.servers);
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

void SortLast::divide(Orders& orders, std::size_t begin, std::size_t end, std::size_t first_server,
                      std::size_t servers) {
    const std::span<const ObjectId> group(orders.by_id.data() + begin, end - begin);
    if (servers == 1) {
        groups_[first_server].assign(group.begin(), group.end());
        return;
    }
    Box bounds;
    for (const ObjectId id : group) {
        bounds.extend(objects_[id].box);
        sides_[id] = Side::kNone;
    }
    const auto axis = static_cast<std::size_t>(bounds.longest_axis());
    const Split split{objects_, static_cast<glm::length_t>(axis)};
    const SplitServers halves(servers);
    // Nothing is cut in model space, so the final positions of the lines are not used.
    const SweepLines<float> ends{bounds.min[split.axis], bounds.max[split.axis]};
    sweep(std::span<const ObjectId>(orders.from_left[axis].data() + begin, group.size()),
          std::span<const ObjectId>(orders.from_right[axis].data() + begin, group.size()), split, halves,
          ends, std::span<Side>(sides_));

    const std::size_t middle = separate(orders.by_id, begin, end);
    for (std::size_t a = 0; a < 3; ++a) {
        separate(orders.from_left[a], begin, end);
        separate(orders.from_right[a], begin, end);
    }
    divide(orders, begin, middle, first_server, halves.left);
    divide(orders, middle, end, first_server + halves.left, halves.right);
}

std::size_t SortLast::separate(std::vector<ObjectId>& order, std::size_t begin, std::size_t end) {
    std::size_t left = begin;
    std::size_t right = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const ObjectId id = order[i];
        const bool is_left = sides_[id] == Side::kLeft;
        order[left] = id;
        right_[right] = id;
        left += is_left ? 1 : 0;
        right += is_left ? 0 : 1;
    }
    std::copy_n(right_.begin(), right, order.begin() + static_cast<std::ptrdiff_t>(left));
    return left;
}

}  // namespace swath
