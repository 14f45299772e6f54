#include "common/published/octree/sah_kd_tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/octree/sah/sah_check.h"

namespace swath {
namespace {

// A box's begin or end along an axis, or (planar) both at once. At the same position ends come first.
enum EventKind : std::uint32_t { kEnds = 0, kPlanar = 1, kStarts = 2 };
struct Event {
    float at;
    std::uint32_t reference_and_kind;
    std::uint32_t reference() const { return reference_and_kind >> 2; }
    std::uint32_t kind() const { return reference_and_kind & 3; }
    bool operator<(const Event& other) const {
        return at != other.at ? at < other.at : kind() < other.kind();
    }
};
using Events = std::array<std::vector<Event>, 3>;  // of each axis, sorted

struct Reference {
    Box box;
    std::uint32_t triangle;
    std::uint32_t above;  // of one that is cut: the part above the plane
};
enum class Side : std::uint8_t { kBoth, kBelow, kAbove };

struct Plane {
    int axis = -1;
    float at = 0;
    bool planar_below = true;  // whether boxes that lie in the plane go below
    double cost = 0;
};

double half_area(const Box& box) {
    const glm::dvec3 s = glm::dvec3(box.max) - glm::dvec3(box.min);
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

class KdBuild {
  public:
    explicit KdBuild(const SahSettings& settings) : settings_(settings) {}

    Result<SahTree> build(const SahTriangles& triangles) {
        references_.reserve(4 * triangles.count());
        for (std::size_t t = 0; t < triangles.count(); ++t) {
            Reference& reference = references_.emplace_back();
            reference.triangle = static_cast<std::uint32_t>(t);
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t index = triangles.indices[3 * t + corner];
                if (index >= triangles.position_count) return fail("triangle {}: no position {}", t, index);
                std::array<float, 3> at{};
                std::memcpy(at.data(), triangles.positions + triangles.stride * index, sizeof at);
                const glm::vec3 position(at[0], at[1], at[2]);
                for (int axis = 0; axis < 3; ++axis)
                    if (!(std::abs(position[axis]) <= kMaxSahCoordinate))
                        return fail("triangle {}: a coordinate is not a number or beyond {:g}", t,
                                    kMaxSahCoordinate);
                reference.box.extend(position);
            }
            tree_.box.extend(reference.box);
        }
        Events events;
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<Event>& of_axis = events[static_cast<std::size_t>(axis)];
            of_axis.reserve(2 * references_.size());
            for (std::uint32_t r = 0; r < references_.size(); ++r) add_events(of_axis, r, axis);
            std::sort(of_axis.begin(), of_axis.end());
        }
        tree_.nodes.resize(1);
        node(0, tree_.box, static_cast<std::uint32_t>(references_.size()), std::move(events), 0);
        if (full_) return fail("the tree is beyond the limit of {} nodes", kMaxSahNodes);
        return std::move(tree_);
    }

  private:
    static constexpr int kMaxDepth = 64;

    void add_events(std::vector<Event>& events, std::uint32_t reference, int axis) const {
        const Box& box = references_[reference].box;
        if (box.min[axis] == box.max[axis]) {
            events.push_back({box.min[axis], reference << 2 | kPlanar});
        } else {
            events.push_back({box.min[axis], reference << 2 | kStarts});
            events.push_back({box.max[axis], reference << 2 | kEnds});
        }
    }

    Plane best_plane(const Box& box, std::uint32_t count, const Events& events) const {
        Plane best;
        const double area = half_area(box);
        best.cost = static_cast<double>(settings_.intersection_cost) * count;
        if (!(area > 0)) return best;
        for (int axis = 0; axis < 3; ++axis) {
            const std::vector<Event>& of_axis = events[static_cast<std::size_t>(axis)];
            const double low = box.min[axis];
            const double high = box.max[axis];
            const double one = double{box.max[(axis + 1) % 3]} - double{box.min[(axis + 1) % 3]};
            const double other = double{box.max[(axis + 2) % 3]} - double{box.min[(axis + 2) % 3]};
            std::uint32_t below = 0;
            std::uint32_t above = count;
            for (std::size_t i = 0; i < of_axis.size();) {
                const float at = of_axis[i].at;
                std::array<std::uint32_t, 3> kinds{};
                for (; i < of_axis.size() && of_axis[i].at == at; ++i) ++kinds[of_axis[i].kind()];
                above -= kinds[kEnds] + kinds[kPlanar];
                if (at > low && at < high) {
                    const double part_below = (one * other + (at - low) * (one + other)) / area;
                    const double part_above = (one * other + (high - at) * (one + other)) / area;
                    for (const bool planar_below : {true, false}) {
                        const double tests = part_below * (below + (planar_below ? kinds[kPlanar] : 0)) +
                                             part_above * (above + (planar_below ? 0 : kinds[kPlanar]));
                        const double cost = static_cast<double>(settings_.traversal_cost) +
                                            static_cast<double>(settings_.intersection_cost) * tests;
                        if (cost < best.cost) best = {axis, at, planar_below, cost};
                    }
                }
                below += kinds[kStarts] + kinds[kPlanar];
            }
        }
        return best;
    }

    void leaf(std::uint32_t at, const Events& events) {
        const auto first = static_cast<std::uint32_t>(tree_.triangles.size());
        for (const Event& event : events[0])
            if (event.kind() != kEnds) tree_.triangles.push_back(references_[event.reference()].triangle);
        tree_.nodes[at] = SahNode::leaf(first, static_cast<std::uint32_t>(tree_.triangles.size()) - first);
    }

    void node(std::uint32_t at, const Box& box, std::uint32_t count, Events events, int depth) {
        const Plane plane = depth < kMaxDepth ? best_plane(box, count, events) : Plane{};
        full_ = full_ || tree_.nodes.size() + 2 > kMaxSahNodes || references_.size() + count > (1u << 30);
        if (plane.axis < 0 || full_) return leaf(at, events);
        const auto axis = static_cast<std::size_t>(plane.axis);
        // Each reference is on both sides until an event says otherwise.
        sides_.resize(references_.size());
        for (const Event& event : events[axis]) sides_[event.reference()] = Side::kBoth;
        for (const Event& event : events[axis]) {
            Side& side = sides_[event.reference()];
            if (event.kind() == kEnds && event.at <= plane.at) side = Side::kBelow;
            if (event.kind() == kStarts && event.at >= plane.at) side = Side::kAbove;
            if (event.kind() == kPlanar)
                side = event.at < plane.at || (event.at == plane.at && plane.planar_below) ? Side::kBelow
                                                                                           : Side::kAbove;
        }
        // References on both sides are cut in two.
        cut_.clear();
        std::uint32_t below = 0;
        std::uint32_t above = 0;
        for (const Event& event : events[axis]) {
            if (event.kind() == kEnds) continue;
            const std::uint32_t r = event.reference();
            below += sides_[r] != Side::kAbove ? 1 : 0;
            above += sides_[r] != Side::kBelow ? 1 : 0;
            if (sides_[r] != Side::kBoth) continue;
            cut_.push_back(r);
            references_[r].above = static_cast<std::uint32_t>(references_.size());
            Reference part = references_[r];
            part.box.min[plane.axis] = plane.at;
            references_.push_back(part);
            references_[r].box.max[plane.axis] = plane.at;
        }
        Events events_below;
        Events events_above;
        for (int a = 0; a < 3; ++a)
            split_events(a, events[static_cast<std::size_t>(a)], events_below[static_cast<std::size_t>(a)],
                         events_above[static_cast<std::size_t>(a)]);
        events = {};
        const auto child = static_cast<std::uint32_t>(tree_.nodes.size());
        std::array<float, 3> position{};
        position[axis] = plane.at;
        tree_.nodes[at] = SahNode::inner(position, 1u << axis, child);
        tree_.nodes.resize(tree_.nodes.size() + 2);
        Box box_below = box;
        Box box_above = box;
        box_below.max[plane.axis] = plane.at;
        box_above.min[plane.axis] = plane.at;
        node(child, box_below, below, std::move(events_below), depth + 1);
        node(child + 1, box_above, above, std::move(events_above), depth + 1);
    }

    // Events of references on one side keep their order. New events of those that are cut are sorted and
    // merged in.
    void split_events(int axis, const std::vector<Event>& events, std::vector<Event>& below,
                      std::vector<Event>& above) {
        kept_below_.clear();
        kept_above_.clear();
        for (const Event& event : events) {
            const Side side = sides_[event.reference()];
            if (side == Side::kBelow) kept_below_.push_back(event);
            if (side == Side::kAbove) kept_above_.push_back(event);
        }
        new_below_.clear();
        new_above_.clear();
        for (const std::uint32_t r : cut_) {
            add_events(new_below_, r, axis);
            add_events(new_above_, references_[r].above, axis);
        }
        std::sort(new_below_.begin(), new_below_.end());
        std::sort(new_above_.begin(), new_above_.end());
        below.resize(kept_below_.size() + new_below_.size());
        above.resize(kept_above_.size() + new_above_.size());
        std::merge(kept_below_.begin(), kept_below_.end(), new_below_.begin(), new_below_.end(),
                   below.begin());
        std::merge(kept_above_.begin(), kept_above_.end(), new_above_.begin(), new_above_.end(),
                   above.begin());
    }

    const SahSettings& settings_;
    SahTree tree_;
    bool full_ = false;
    std::vector<Reference> references_;
    std::vector<Side> sides_;
    std::vector<std::uint32_t> cut_;
    std::vector<Event> kept_below_;
    std::vector<Event> kept_above_;
    std::vector<Event> new_below_;
    std::vector<Event> new_above_;
};

}  // namespace

Result<SahTree> build_sah_kd_tree(const SahTriangles& triangles, const SahSettings& settings) {
    SWATH_TRY_VOID(check_sah(triangles, settings));
    return KdBuild(settings).build(triangles);
}

}  // namespace swath
