#pragma once
#include <cstddef>
#include <string>

#include "common/base/clock.h"

namespace swath {

// Shows on stderr how far a run is: one line that is drawn anew on a terminal, a line every tenth of the run
// elsewhere.
class Progress {
  public:
    Progress(std::size_t frames, bool quiet, const Clock& clock);
    void step();

  private:
    std::size_t frames_;
    bool quiet_;
    bool terminal_;
    const Clock& clock_;
    Nanoseconds begin_;
    Nanoseconds drawn_{0};
    std::size_t done_ = 0;
};

}  // namespace swath
