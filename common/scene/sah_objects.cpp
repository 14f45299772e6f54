#include "common/scene/sah_objects.h"

#include <algorithm>
#include <queue>

#include "common/geometry/morton.h"

namespace swath {
namespace {

// For the time being without the heuristic: the cell with the most triangles is cut in the middle, along all
// three axes.

struct Cell {
    std::size_t begin = 0;  // of the keys
    std::size_t end = 0;
    int depth = 0;
    std::size_t objects = 1;

    std::size_t triangles() const { return end - begin; }
    // The queue's first is the largest; of equal ones the first in the order of the tree.
    bool operator<(const Cell& other) const {
        return triangles() != other.triangles() ? triangles() < other.triangles() : begin > other.begin;
    }
};

}  // namespace

std::vector<std::uint32_t> sah_cells(std::span<const SahTriangle> triangles, const Box& /*bounds*/,
                                     std::size_t objects) {
    std::vector<MortonKey> keys(triangles.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i] = {triangles[i].code, static_cast<std::uint32_t>(i)};
    sort_by_code(keys);

    std::vector<std::uint32_t> materials;
    const auto make_cell = [&](std::size_t begin, std::size_t end, int depth) {
        materials.clear();
        for (std::size_t i = begin; i < end; ++i) materials.push_back(triangles[keys[i].index].material);
        std::ranges::sort(materials);
        const auto repeated = std::ranges::unique(materials);
        return Cell{begin, end, depth, materials.size() - repeated.size()};
    };
    std::priority_queue<Cell> open;
    std::vector<Cell> done;  // that cannot be cut further
    open.push(make_cell(0, keys.size(), 0));
    std::size_t count = open.top().objects;
    while (count < objects && !open.empty()) {
        const Cell cell = open.top();
        open.pop();
        if (cell.depth == kMortonDepth || cell.triangles() == 1) {
            done.push_back(cell);
            continue;
        }
        count -= cell.objects;
        const int shift = kMortonBits - 3 * (cell.depth + 1);
        for (std::size_t begin = cell.begin, end = begin; begin < cell.end; begin = end) {
            while (end < cell.end && keys[end].code >> shift == keys[begin].code >> shift) ++end;
            const Cell child = make_cell(begin, end, cell.depth + 1);
            count += child.objects;
            open.push(child);
        }
    }
    for (; !open.empty(); open.pop()) done.push_back(open.top());
    std::ranges::sort(done, {}, &Cell::begin);

    std::vector<std::uint32_t> cells(triangles.size());
    for (std::size_t number = 0; number < done.size(); ++number)
        for (std::size_t i = done[number].begin; i < done[number].end; ++i)
            cells[keys[i].index] = static_cast<std::uint32_t>(number);
    return cells;
}

}  // namespace swath
