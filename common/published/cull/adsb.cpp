#include <algorithm>

#include "common/published/cull/algorithms.h"

namespace swath {
namespace {

template <class Tree>
class Adsb final : public PublishedWalk {
    using Node = typename Tree::Node;

  public:
    Adsb(const Tree& tree, ThreadTeam& team)
        : tree_(tree), team_(team), split_level_(tree_.shape().height()), members_(team.size()) {
        report_.members.resize(team.size());
    }

    const WalkReport& walk(const Frustum& frustum) override {
        const Nanoseconds start = team_.clock().now();
        planes_ = walk_planes(frustum);
        for (auto& member : members_) member.begin_frame(planes_, tree_.shape());
        const int d = std::clamp(forced_level_.value_or(split_level_.level()), 0, tree_.shape().height());

        add(*main().queue, tree_.node(0, 0));
        Tree::walks().render_nodes(main().walk, UniformOctree(d).node_count(), *main().queue);
        start_others();
        team_.set_task(0, [this] { work(0); });
        team_.start(0);
        team_.wait();

        for (std::size_t i = 0; i < members_.size(); ++i)
            members_[i].span = {i == 0 ? start : team_.start_time(i), team_.end_time(i)};
        finish(d);
        return report_;
    }

  private:
    Member<Node>& main() { return members_[0]; }

    // Gives every other processor its share of the main processor's list, which keeps the rest. It deals out
    // all before any starts, so that none is at work if there is no memory for it.
    void start_others() {
        WalkQueue<Node>& list = *main().queue;
        const std::size_t share = (list.tail - list.head) / members_.size();
        for (std::size_t i = 1; i < members_.size(); ++i)
            for (std::size_t n = 0; n < share; ++n) add(*members_[i].queue, take(list));
        for (std::size_t i = 1; i < members_.size(); ++i) {
            team_.set_task(i, [this, i] { work(i); });
            team_.start(i);
        }
    }

    // A processor's work (figure 2).
    void work(std::size_t i) {
        Tree::walks().render_nodes(members_[i].walk, 0, *members_[i].queue);
        if (leaf_task_) leaf_task_(i, contents(members_[i].walk.leaves));
    }

    void finish(int d) {
        spans_.clear();
        for (std::size_t i = 0; i < members_.size(); ++i) {
            members_[i].busy = members_[i].span.end - members_[i].span.start;
            spans_.push_back(members_[i].span);
            report_.members[i] = members_[i].report();
        }
        report_.split_level = d;
        report_.total_idle = total_idle_time(spans_);
        split_level_.update(report_.total_idle);
    }

    Tree tree_;
    ThreadTeam& team_;
    AdsbSplitLevel split_level_;
    WalkPlanes planes_{};
    std::vector<Member<Node>> members_;
    std::vector<WorkSpan> spans_;
    WalkReport report_;
};

}  // namespace

template <class Tree>
std::unique_ptr<PublishedWalk> make_adsb(const Tree& tree, ThreadTeam& team) {
    return std::make_unique<Adsb<Tree>>(tree, team);
}

template std::unique_ptr<PublishedWalk> make_adsb(const StoredTree&, ThreadTeam&);
template std::unique_ptr<PublishedWalk> make_adsb(const ComputedTree&, ThreadTeam&);

}  // namespace swath
