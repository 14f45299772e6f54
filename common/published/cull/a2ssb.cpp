#include <algorithm>

#include "common/published/cull/algorithms.h"

namespace swath {
namespace {

// The begin of share k of `size` things that are dealt out to `parts` in order. It ends where share k + 1
// begins.
std::size_t share_begin(std::size_t size, std::size_t k, std::size_t parts) { return size * k / parts; }

template <class Tree>
class A2ssb final : public PublishedWalk {
    using Node = typename Tree::Node;

  public:
    A2ssb(PublishedAlgorithm algorithm, const Tree& tree, ThreadTeam& team)
        : algorithm_(algorithm),
          tree_(tree),
          team_(team),
          start_level_(std::min(start_level(team.size()), tree_.shape().height())),
          split_level_(start_level_, tree_.shape().height()),
          members_(team.size()) {
        report_.members.resize(team.size());
        const std::uint32_t nodes = UniformOctree(start_level_).leaf_count();
        for (std::uint32_t code = 0; code < nodes; ++code)
            start_nodes_.push_back(tree_.node(start_level_, code));
    }

    const WalkReport& walk(const Frustum& frustum) override {
        planes_ = walk_planes(frustum);
        const int d =
            std::clamp(forced_level_.value_or(split_level_.level()), start_level_, tree_.shape().height());
        report_.split_level = d;
        report_.total_idle = Nanoseconds(0);

        team_.run([&](std::size_t k) { step_one(k, static_cast<std::uint32_t>(d)); });
        end_step();
        team_.run([&](std::size_t k) { step_two(k); });
        end_step();

        for (std::size_t k = 0; k < members_.size(); ++k) report_.members[k] = members_[k].report();
        split_level_.update(report_.total_idle);
        return report_;
    }

  private:
    void step_one(std::size_t k, std::uint32_t split_level) {
        Member<Node>& member = members_[k];
        member.begin_frame(planes_, tree_.shape());
        const std::size_t begin = share_begin(start_nodes_.size(), k, members_.size());
        const std::size_t end = share_begin(start_nodes_.size(), k + 1, members_.size());
        Tree::walks().step_one(member.walk, start_nodes_.data() + begin, end - begin, split_level,
                               *member.nodes);
    }

    // All members' lists, one after the other, are one list, of which processor k walks its share.
    void step_two(std::size_t k) {
        std::size_t size = 0;
        for (const auto& member : members_) size += member.nodes->size;
        std::size_t begin = share_begin(size, k, members_.size());
        std::size_t wanted = share_begin(size, k + 1, members_.size()) - begin;
        for (const auto& member : members_) {
            const std::size_t here = member.nodes->size;
            const std::size_t count = std::min(wanted, here - std::min(begin, here));
            if (count != 0) walk_below(members_[k], member.nodes->at + begin, count);
            begin -= std::min(begin, here);
            wanted -= count;
        }
        if (leaf_task_) leaf_task_(k, contents(members_[k].walk.leaves));
    }

    void walk_below(Member<Node>& member, const Node* nodes, std::size_t count) {
        switch (algorithm_) {
            case PublishedAlgorithm::kAlgo1:
                return Tree::walks().in_place(member.walk, nodes, count);
            case PublishedAlgorithm::kAlgo1Lanes:
                return Tree::walks().in_lanes(member.walk, nodes, count);
            case PublishedAlgorithm::kAlgo2:
                return Tree::walks().depth_first(member.walk, nodes, count);
            default:
                for (std::size_t i = 0; i < count; ++i) add(*member.queue, nodes[i]);
                Tree::walks().render_nodes(member.walk, 0, *member.queue);
        }
    }

    void end_step() {
        spans_.clear();
        for (std::size_t k = 0; k < members_.size(); ++k) {
            spans_.push_back({team_.start_time(k), team_.end_time(k)});
            members_[k].busy += spans_[k].end - spans_[k].start;
        }
        report_.total_idle += total_idle_time(spans_);
    }

    PublishedAlgorithm algorithm_;
    Tree tree_;
    ThreadTeam& team_;
    int start_level_;
    A2ssbSplitLevel split_level_;
    WalkPlanes planes_{};
    std::vector<Node> start_nodes_;
    std::vector<Member<Node>> members_;
    std::vector<WorkSpan> spans_;
    WalkReport report_;
};

}  // namespace

template <class Tree>
std::unique_ptr<PublishedWalk> make_a2ssb(PublishedAlgorithm algorithm, const Tree& tree, ThreadTeam& team) {
    return std::make_unique<A2ssb<Tree>>(algorithm, tree, team);
}

template std::unique_ptr<PublishedWalk> make_a2ssb(PublishedAlgorithm, const StoredTree&, ThreadTeam&);
template std::unique_ptr<PublishedWalk> make_a2ssb(PublishedAlgorithm, const ComputedTree&, ThreadTeam&);

}  // namespace swath
