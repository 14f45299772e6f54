#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/thread_team.h"
#include "common/published/resource/scratch.h"

namespace swath {

// One row of counters for each part of the input: the counting arrays of counting sort (ADSB, section 8.1),
// one for each processor. Adding them up, cell by cell in the order of parts, stands for the papers' merge of
// R into M. It gives the place of each part's first thing of each cell, so that all parts can write at once
// and the result is stable.
class Histograms {
  public:
    // Rows are not cleared: each part clears its own.
    void resize(std::size_t parts, std::size_t cells);
    std::uint32_t* row(std::size_t part) { return counts_.data() + part * stride_; }
    std::size_t cells() const { return cells_; }

    // Turns the counts into first positions: by cell, then by part.
    void to_positions(ThreadTeam& team);

  private:
    std::uint32_t sum(std::size_t begin, std::size_t end);
    void accumulate(std::size_t begin, std::size_t end, std::uint32_t position);

    std::size_t parts_ = 0;
    std::size_t cells_ = 0;
    std::size_t stride_ = 0;
    Scratch<std::uint32_t> counts_;
    std::vector<std::uint32_t> sums_;
};

}  // namespace swath
