#include "common/published/cull/algorithms.h"

namespace swath {
namespace {

template <class Tree>
class Single final : public PublishedWalk {
    using Node = typename Tree::Node;

  public:
    Single(PublishedAlgorithm algorithm, const Tree& tree, const Clock& clock)
        : walk_from_root_(algorithm == PublishedAlgorithm::kAlgo4   ? Tree::walks().in_place
                          : algorithm == PublishedAlgorithm::kAlgo5 ? Tree::walks().depth_first
                                                                    : Tree::walks().in_lanes),
          tree_(tree),
          root_(tree_.node(0, 0)),
          clock_(clock) {
        report_.members.resize(1);
    }

    const WalkReport& walk(const Frustum& frustum) override {
        const Nanoseconds start = clock_.now();
        const WalkPlanes planes = walk_planes(frustum);
        member_.begin_frame(planes, tree_.shape());
        walk_from_root_(member_.walk, &root_, 1);
        if (leaf_task_) leaf_task_(0, contents(member_.walk.leaves));
        member_.busy = clock_.now() - start;
        report_.members[0] = member_.report();
        return report_;
    }

  private:
    void (*walk_from_root_)(MemberWalk&, const Node*, std::size_t);
    Tree tree_;
    Node root_;
    const Clock& clock_;
    Member<Node> member_;
    WalkReport report_;
};

}  // namespace

template <class Tree>
std::unique_ptr<PublishedWalk> make_single(PublishedAlgorithm algorithm, const Tree& tree,
                                           const ThreadTeam& team) {
    return std::make_unique<Single<Tree>>(algorithm, tree, team.clock());
}

template std::unique_ptr<PublishedWalk> make_single(PublishedAlgorithm, const StoredTree&, const ThreadTeam&);
template std::unique_ptr<PublishedWalk> make_single(PublishedAlgorithm, const ComputedTree&,
                                                    const ThreadTeam&);

}  // namespace swath
