#include "client/partition/mahd.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "common/base/check.h"

namespace swath {
namespace {

// Loads stay below 2^53, so that times kMaxServers they fit in 64 bits.
constexpr int kLoadBits = 53;

constexpr int kCellPixels = Mahd::kCellPixels;

Rect cells_of(const Rect& pixels) {
    return {pixels.x0 / kCellPixels, pixels.y0 / kCellPixels, (pixels.x1 - 1) / kCellPixels + 1,
            (pixels.y1 - 1) / kCellPixels + 1};
}

// Makes of every number the sum of all numbers left of and below it, itself included.
void sum_up(std::vector<std::uint64_t>& table, std::size_t stride) {
    for (std::size_t i = 0; i < table.size(); ++i)
        if (i % stride != 0) table[i] += table[i - 1];
    for (std::size_t i = stride; i < table.size(); ++i) table[i] += table[i - stride];
}

}  // namespace

Rect Mahd::first_region(const PartitionInput& input) {
    const Rect viewport = input.view.viewport();
    const Rect mesh = cells_of(viewport);
    stride_ = static_cast<std::size_t>(mesh.x1) + 2;
    sums_.assign(stride_ * (static_cast<std::size_t>(mesh.y1) + 2), 0);
    std::uint64_t work = 0;
    for (const ProjectedObject& object : input.objects) work += object.work;
    const int unit = std::max(0, kLoadBits - static_cast<int>(std::bit_width(work)));

    // Each object adds its load where it begins and takes it away where it ends, in x and y. Summed up once,
    // the table holds the cells' loads; twice, their sums. Unsigned numbers wrap around and come back.
    Rect touched;
    for (const ProjectedObject& object : input.objects) {
        if (object.work == 0) continue;
        const Rect cells = cells_of(object.box);
        CHECK(!cells.empty());  // since an object is at least one pixel
        const std::uint64_t share = (object.work << unit) / static_cast<std::uint64_t>(cells.area());
        const auto at = [&](int x, int y) -> std::uint64_t& {
            return sums_[static_cast<std::size_t>(x + 1) + static_cast<std::size_t>(y + 1) * stride_];
        };
        at(cells.x0, cells.y0) += share;
        at(cells.x1, cells.y0) -= share;
        at(cells.x0, cells.y1) -= share;
        at(cells.x1, cells.y1) += share;
        touched = bounding(touched, cells);
    }
    sum_up(sums_, stride_);
    sum_up(sums_, stride_);
    if (touched.empty()) return viewport;
    return intersect({touched.x0 * kCellPixels, touched.y0 * kCellPixels, touched.x1 * kCellPixels,
                      touched.y1 * kCellPixels},
                     viewport);
}

int Mahd::cut(std::span<const Item> /*items*/, const Rect& region, std::size_t axis,
              const SplitServers& servers) {
    if (region.empty()) return high_of(region, axis);
    const Rect cells = cells_of(region);
    const std::uint64_t all = load(cells);
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    int best = high_of(region, axis);
    for (int line = low_of(cells, axis) + 1; line < high_of(cells, axis); ++line) {
        const std::uint64_t left = load(Halves(cells, axis, line).left);
        // The larger of left / servers.left and (all - left) / servers.right, without rounding.
        const std::uint64_t larger = std::max(left * servers.right, (all - left) * servers.left);
        if (larger < least) {
            least = larger;
            best = line * kCellPixels;
        }
    }
    return best;
}

std::uint64_t Mahd::load(const Rect& cells) const {
    const auto below = [&](int x, int y) {
        return sums_[static_cast<std::size_t>(x) + static_cast<std::size_t>(y) * stride_];
    };
    return below(cells.x1, cells.y1) - below(cells.x0, cells.y1) - below(cells.x1, cells.y0) +
           below(cells.x0, cells.y0);
}

}  // namespace swath
