#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/base/thread_team.h"
#include "common/geometry/frustum.h"
#include "common/published/octree/pointer_octree.h"
#include "common/published/octree/uniform_octree.h"

namespace swath {

// The algorithms of the papers, over a uniform octree. "ADSB" is Machado and Feijó's paper of SBGames 2008 on
// adaptive delayed static balancing, "A2SSB" Machado's thesis chapter on adaptive two-step static balancing,
// whose five variants are numbered in section 3.8.
enum class PublishedAlgorithm {
    kAdsb,   // appendix A
    kAlgo1,  // A2SSB
    kAlgo2,  // A2SSB, step two a depth-first recursion over nodes
    kAlgo3,  // A2SSB, step two breadth first over nodes
    kAlgo4,  // one processor, one box moved through the tree
    kAlgo5,  // one processor, depth-first recursion over nodes: the canonical octree culling
    // ALGO1 and ALGO4 taken to where caches end: the moving box is kept in vector registers, as the corners
    // that the planes ask for, and all planes are tested at once. All others test one plane after the other,
    // so what these gain is not the papers' gain.
    kAlgo1Lanes,
    kAlgo4Lanes,
};
bool has_one_member(PublishedAlgorithm algorithm);       // whatever the team: kAlgo4, kAlgo5, kAlgo4Lanes
std::string_view name_of(PublishedAlgorithm algorithm);  // "ADSB", "ALGO1", "ALGO1 lanes" ...

struct MemberReport {
    std::uint64_t nodes_tested = 0;
    Nanoseconds busy{0};
    std::span<const std::uint32_t> leaves;  // codes, in the order found
};

// One frame. Member k is the paper's P(k + 1). The algorithms for one processor have one member.
struct WalkReport {
    int split_level = 0;  // used in this frame; 0 for the algorithms for one processor
    Nanoseconds total_idle{0};
    std::vector<MemberReport> members;
};

// A published algorithm, with what it keeps from frame to frame. It finds the leaves whose boxes are not
// outside of the frustum: the same set with every algorithm, team and split level. Owned and called by one
// thread. The team and the tree must outlive it, and the team must be idle when it is called.
class PublishedWalk {
  public:
    // A member's last work in a frame, with its leaves: the papers' "render objects at node".
    using LeafTask = std::function<void(std::size_t member, std::span<const std::uint32_t> leaves)>;

    virtual ~PublishedWalk() = default;
    // `frustum` is in the tree's coordinates, in leaf edges. The report is valid until the next call.
    virtual const WalkReport& walk(const Frustum& frustum) = 0;
    // Sets a level in place of the one that adapts. A level that the tree or the team does not allow becomes
    // the nearest that they do. Has no effect on the algorithms for one processor.
    void force_split_level(std::optional<int> level) { forced_level_ = level; }
    void set_leaf_task(LeafTask task) { leaf_task_ = std::move(task); }

  protected:
    std::optional<int> forced_level_;
    LeafTask leaf_task_;
};

// Walks stored nodes, as published. In ALGO1, step one reads nodes and step two does not.
std::unique_ptr<PublishedWalk> make_published_walk(PublishedAlgorithm algorithm, const PointerOctree& tree,
                                                   ThreadTeam& team);
// Walks nodes that are computed instead of stored.
std::unique_ptr<PublishedWalk> make_published_walk(PublishedAlgorithm algorithm, const UniformOctree& tree,
                                                   ThreadTeam& team);

}  // namespace swath
