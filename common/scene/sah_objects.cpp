#include "common/scene/sah_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numeric>
#include <queue>

#include "common/geometry/morton.h"
#include "common/octree/sah/sah_builder.h"

namespace swath {
namespace {

constexpr int kCodeCells = 1 << kMortonDepth;  // the cells of Morton codes along an axis

// The tree is built over a sample of at most so many triangles for each object wanted. Its planes are about
// those of a tree over all triangles, and a larger model takes no longer.
constexpr std::size_t kSampled = 64;
// A node with less than this part of an object's share of triangles is not worth a cut.
constexpr float kSmallestNode = 0.125f;

// An octree over the boxes of a sample of the triangles.
SahTree build_tree(std::span<const SahTriangle> triangles, std::size_t objects) {
    const std::size_t sample = kSampled * objects;
    const std::size_t step = (triangles.size() + sample - 1) / sample;
    // The builder uses a triangle's box only, so a triangle from corner to corner and back stands for a box.
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < triangles.size(); i += step) {
        const auto low = static_cast<std::uint32_t>(corners.size());
        corners.push_back(triangles[i].box.min);
        corners.push_back(triangles[i].box.max);
        indices.insert(indices.end(), {low, low + 1, low});
    }
    SahSettings settings = kFastSah;
    settings.kd_triangles = 0;
    settings.least_gain = kDefaultSah.least_gain;
    settings.traversal_cost =
        kSmallestNode * static_cast<float>(indices.size() / 3) / static_cast<float>(objects);
    SahBuilder builder(1);
    auto tree = builder.build(
        {reinterpret_cast<const std::byte*>(corners.data()), sizeof(glm::vec3), corners.size(), indices},
        settings);
    // A valid mesh is within the builder's other limits, so only memory can be missing.
    if (!tree) throw std::bad_alloc();
    return std::move(*tree);
}

// The planes that cut a node, in cells of codes: along each axis the first cell above the plane.
using Planes = std::array<int, 3>;

struct Cell {
    std::size_t begin = 0;  // in the cut's order
    std::size_t end = 0;
    std::uint32_t node = 0;  // in the tree
    std::size_t objects = 1;
    double cost = 0;

    // The queue's first cell costs most; of equal ones it is first in the tree's order.
    bool operator<(const Cell& other) const {
        return cost != other.cost ? cost < other.cost : begin > other.begin;
    }
};

// Keeps the triangles in an order in which those of every cell are contiguous.
class CellCut {
  public:
    CellCut(std::span<const SahTriangle> triangles, const Box& bounds, std::size_t objects)
        : triangles_(triangles),
          bounds_(bounds),
          tree_(build_tree(triangles, objects)),
          at_(triangles.size()),
          order_(triangles.size()),
          spare_(triangles.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        for (std::size_t i = 0; i < at_.size(); ++i) at_[i] = code_cell(triangles[i].code);
        number_materials();
    }

    const std::vector<std::uint32_t>& order() const { return order_; }

    Cell all() { return cell(0, order_.size(), 0); }

    // Cuts a cell and returns the parts that hold triangles, in the tree's order. Cuts a leaf of the tree in
    // the middle. Returns nothing if the cell cannot be cut.
    std::vector<Cell> cut(const Cell& cell) {
        const SahNode& node = tree_.nodes[cell.node];
        const Planes planes = node.is_leaf() ? middle(cell) : planes_of(node);
        std::vector<Cell> parts;
        if (node.is_leaf() && planes == kNoPlanes) return parts;
        std::array<std::size_t, 9> begins{};
        for (std::size_t i = cell.begin; i < cell.end; ++i) ++begins[part_of(order_[i], planes) + 1];
        begins[0] = cell.begin;
        for (std::size_t part = 0; part < 8; ++part) begins[part + 1] += begins[part];
        std::array<std::size_t, 9> next = begins;
        for (std::size_t i = cell.begin; i < cell.end; ++i)
            spare_[next[part_of(order_[i], planes)]++] = order_[i];
        for (std::size_t i = cell.begin; i < cell.end; ++i) order_[i] = spare_[i];
        std::uint32_t child = node.first_child();
        for (std::uint32_t part = 0; part < 8; ++part) {
            if (!node.is_leaf() && (part & ~node.axes()) != 0) continue;
            const std::uint32_t of = node.is_leaf() ? cell.node : child++;
            if (begins[part] < begins[part + 1])
                parts.push_back(this->cell(begins[part], begins[part + 1], of));
        }
        return parts;
    }

  private:
    using CodeCell = std::array<std::uint16_t, 3>;
    static constexpr Planes kNoPlanes{kCodeCells, kCodeCells, kCodeCells};

    static CodeCell code_cell(std::uint32_t code) {
        CodeCell at{};
        for (int bit = 0; bit < kMortonBits; ++bit)
            at[static_cast<std::size_t>(bit % 3)] |= static_cast<std::uint16_t>((code >> bit & 1) << bit / 3);
        return at;
    }

    // Numbers the materials that there are from 0 without gaps. A single one gets no numbers.
    void number_materials() {
        std::vector<std::uint32_t> there;
        for (const SahTriangle& triangle : triangles_)
            if (there.empty() || there.back() != triangle.material) there.push_back(triangle.material);
        std::ranges::sort(there);
        there.erase(std::unique(there.begin(), there.end()), there.end());
        if (there.size() == 1) return;
        materials_.resize(triangles_.size());
        for (std::size_t i = 0; i < materials_.size(); ++i)
            materials_[i] = static_cast<std::uint32_t>(
                std::ranges::lower_bound(there, triangles_[i].material) - there.begin());
        last_cell_.assign(there.size(), 0);
    }

    // Large cells with many triangles cost most. Area counts for more, as the simulator finds best
    // (docs/simulator.md): swaths grow with objects' sizes, not with their triangles.
    Cell cell(std::size_t begin, std::size_t end, std::uint32_t node) {
        Box box;
        for (std::size_t i = begin; i < end; ++i) box.extend(triangles_[order_[i]].box);
        const glm::dvec3 size(box.size());
        const double area = size.x * size.y + (size.x + size.y) * size.z;
        return {begin, end, node, count_materials(begin, end),
                area * area * static_cast<double>(end - begin)};
    }

    std::size_t count_materials(std::size_t begin, std::size_t end) {
        if (materials_.empty()) return 1;
        ++cells_;
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
            std::size_t& last = last_cell_[materials_[order_[i]]];
            count += last != cells_ ? 1 : 0;
            last = cells_;
        }
        return count;
    }

    // A code's cell is on the side of a plane that its middle is on.
    Planes planes_of(const SahNode& node) const {
        Planes planes = kNoPlanes;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double min = bounds_.min[axis];
            const double size = bounds_.max[axis] - min;
            if (!node.cuts(axis) || !(size > 0)) continue;
            const double at = (node.plane[i] - min) / size * kCodeCells - 0.5;
            planes[i] = static_cast<int>(std::ceil(std::clamp(at, 0.0, double{kCodeCells})));
        }
        return planes;
    }

    // The planes through the middle of the cell's triangles, and none across an axis on which all are equal.
    Planes middle(const Cell& cell) const {
        CodeCell first = at_[order_[cell.begin]];
        CodeCell last = first;
        for (std::size_t i = cell.begin; i < cell.end; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                first[axis] = std::min(first[axis], at_[order_[i]][axis]);
                last[axis] = std::max(last[axis], at_[order_[i]][axis]);
            }
        Planes planes = kNoPlanes;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (first[axis] < last[axis]) planes[axis] = (first[axis] + last[axis] + 1) / 2;
        return planes;
    }

    // The part's number has a bit for each axis, set above its plane, as children are numbered.
    std::size_t part_of(std::uint32_t triangle, const Planes& planes) const {
        const CodeCell& at = at_[triangle];
        return std::size_t{at[0] >= planes[0]} | std::size_t{at[1] >= planes[1]} << 1 |
               std::size_t{at[2] >= planes[2]} << 2;
    }

    std::span<const SahTriangle> triangles_;
    Box bounds_;
    SahTree tree_;
    std::vector<CodeCell> at_;  // of each triangle's code
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> spare_;      // for sorting
    std::vector<std::uint32_t> materials_;  // the number of each triangle's; empty if there is only one
    std::vector<std::size_t> last_cell_;    // of each material: the last cell that had it, counted by cells_
    std::size_t cells_ = 0;                 // counted so far
};

}  // namespace

std::vector<std::uint32_t> sah_cells(std::span<const SahTriangle> triangles, const Box& bounds,
                                     std::size_t objects) {
    CellCut cut(triangles, bounds, objects);
    std::priority_queue<Cell> open;
    std::vector<Cell> done;
    open.push(cut.all());
    std::size_t count = open.top().objects;
    while (count < objects && !open.empty()) {
        const Cell cell = open.top();
        open.pop();
        const std::vector<Cell> parts = cut.cut(cell);
        if (parts.empty()) {
            done.push_back(cell);
            continue;
        }
        count -= cell.objects;
        for (const Cell& part : parts) {
            count += part.objects;
            open.push(part);
        }
    }
    for (; !open.empty(); open.pop()) done.push_back(open.top());
    std::ranges::sort(done, {}, &Cell::begin);

    std::vector<std::uint32_t> cells(triangles.size());
    for (std::size_t number = 0; number < done.size(); ++number)
        for (std::size_t i = done[number].begin; i < done[number].end; ++i)
            cells[cut.order()[i]] = static_cast<std::uint32_t>(number);
    return cells;
}

}  // namespace swath
