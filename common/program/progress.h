#pragma once
#include <cstddef>
#include <string>

#include "common/base/clock.h"

namespace swath {

// Shows on stderr how far a run is and how long it still takes: one line that is drawn anew on a terminal, a
// line every tenth of the run elsewhere. One thread at a time.
class Progress {
  public:
    // `what` is counted, in the plural: "frames". `total` at least 1. Of what is over within `patience`
    // nothing is shown.
    Progress(std::size_t total, std::string what, bool quiet, const Clock& clock,
             Nanoseconds patience = Nanoseconds(0));
    void step();

  private:
    std::size_t total_;
    std::string what_;
    bool quiet_;
    bool terminal_;
    const Clock& clock_;
    Nanoseconds patience_;
    Nanoseconds begin_;
    Nanoseconds drawn_{0};
    std::size_t done_ = 0;
};

}  // namespace swath
