#include "common/published/cull/octree_culler.h"

#include <bit>
#include <vector>

#include "common/base/check.h"
#include "common/published/cull/member_lists.h"
#include "common/published/cull/object_cells.h"
#include "common/published/cull/walks.h"

namespace swath {
namespace {

// A set of numbers below a limit, which comes out ascending.
class NumberSet {
  public:
    explicit NumberSet(std::size_t limit) : words_((limit + 63) / 64) {}
    void add(std::span<const std::uint32_t> numbers) {
        for (const std::uint32_t n : numbers) words_[n / 64] |= std::uint64_t{1} << n % 64;
    }
    // Empties the set.
    void move_to(std::vector<std::uint32_t>& numbers) {
        for (std::size_t i = 0; i < words_.size(); ++i) {
            for (std::uint64_t word = words_[i]; word != 0; word &= word - 1)
                numbers.push_back(static_cast<std::uint32_t>(64 * i) +
                                  static_cast<std::uint32_t>(std::countr_zero(word)));
            words_[i] = 0;
        }
    }

  private:
    std::vector<std::uint64_t> words_;
};

class OctreeCuller final : public Culler {
  public:
    OctreeCuller(PublishedAlgorithm algorithm, std::span<const Box> boxes, ThreadTeam& team)
        : algorithm_(algorithm),
          team_(team),
          cells_(boxes),
          found_(has_one_member(algorithm) ? 1 : team.size()),
          set_(boxes.size()) {
        make_walk();
    }

    std::span<const std::uint32_t> cull(const Frustum& frustum) override {
        planes_ = walk_planes(frustum);
        const WalkReport& report = walk_->walk(cells_.loosened(frustum));
        split_level_ = report.split_level;
        visible_.clear();
        CHECK(report.members.size() == found_.size());
        for (auto& found : found_) set_.add(contents(*found.ids));
        set_.move_to(visible_);
        return visible_;
    }

    // The papers say nothing of moving boxes. Here the cells are made anew, and what has been learned of the
    // split level stays while the tree's height does.
    void refit(std::span<const Box> boxes) override {
        CHECK(boxes.size() == cells_.box_count());
        const int height = cells_.shape().height();
        cells_ = ObjectCells(boxes);
        if (cells_.shape().height() != height) make_walk();
    }

    std::optional<int> split_level() const override { return split_level_; }

  private:
    // The ids that one member has found.
    struct alignas(128) Found {
        OwnedList<WalkList<std::uint32_t>> ids;
    };

    void make_walk() {
        walk_ = make_published_walk(algorithm_, cells_.shape(), team_);
        walk_->set_leaf_task([this](std::size_t member, std::span<const std::uint32_t> leaves) {
            cull_boxes(member, leaves);
        });
    }

    void cull_boxes(std::size_t member, std::span<const std::uint32_t> leaves) {
        WalkList<std::uint32_t>& ids = *found_[member].ids;
        ids.size = 0;
        best_walk_table().cull_cells(planes_, cells_.cells(), leaves.data(), leaves.size(), ids);
        const std::size_t first = cells_.first_of_no_cell();
        const std::size_t count = cells_.box_count() - first;
        best_walk_table().cull_boxes(planes_, cells_.cells(), first + count * member / found_.size(),
                                     first + count * (member + 1) / found_.size(), ids);
    }

    PublishedAlgorithm algorithm_;
    ThreadTeam& team_;
    ObjectCells cells_;
    std::unique_ptr<PublishedWalk> walk_;
    std::vector<Found> found_;
    NumberSet set_;
    WalkPlanes planes_{};
    std::optional<int> split_level_;
    std::vector<std::uint32_t> visible_;
};

}  // namespace

std::unique_ptr<Culler> make_octree_culler(PublishedAlgorithm algorithm, std::span<const Box> boxes,
                                           ThreadTeam& team) {
    return std::make_unique<OctreeCuller>(algorithm, boxes, team);
}

}  // namespace swath
