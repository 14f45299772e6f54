#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/base/thread_team.h"
#include "common/cull/wide/aligned_array.h"

namespace swath {

// The memory that a cull writes ids to, on one thread or on several. Each part of the work, a range of ids,
// writes from the place that its first id has if all are visible. So parts never meet, nothing grows, and the
// answer does not depend on who did what. One call at a time.
class IdSlots {
  public:
    // Ids are below `capacity`; parts may scribble up to its next multiple of 16.
    explicit IdSlots(std::size_t capacity);

    // These two are for work that one thread does.
    std::uint32_t* data() { return apart_.data(); }
    std::span<const std::uint32_t> first(std::size_t count) const { return {apart_.data(), count}; }

    // Shares work among `members` of the team, 1 to all, who take parts as they come free. work(i) writes
    // ids, ascending, from data() + begins[i] and returns how many, at most begins[i + 1] - begins[i]. It
    // must not throw. `begins` ascends. Returns all ids, which the members bring together; valid until the
    // next call.
    std::span<const std::uint32_t> share(ThreadTeam& team, std::size_t members,
                                         std::span<const std::size_t> begins,
                                         const std::function<std::size_t(std::size_t part)>& work);

  private:
    std::size_t capacity_;
    AlignedArray<std::uint32_t> apart_;
    AlignedArray<std::uint32_t> together_;  // made when work is first shared
    std::vector<std::size_t> ends_;         // of the parts in together_
};

}  // namespace swath
