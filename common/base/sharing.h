#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/clock.h"
#include "common/base/thread_team.h"

namespace swath {

enum class SharingMode {
    kWhenItPays,  // see Sharing
    kAlways,      // the whole team in every frame: for tests and measurements
};

// Decides, frame by frame, whether a cull is shared out among a team's members or done by the caller alone.
// Small frames are not: waking somebody takes longer. Of larger ones it measures which way is quicker and
// takes that, and tries the other way again from time to time, ever more rarely while it does not pay. So a
// machine whose cores are taken, where members would begin and then stand still, costs next to nothing.
//
// Frames are measured in expected work: the nanoseconds that one undisturbed thread would take, about.
class Sharing {
  public:
    Sharing(const ThreadTeam& team, SharingMode mode) : team_(team), mode_(mode) {}

    // How many members should do a frame of `expected_ns`, 1 or more; begins to measure it.
    std::size_t members(double expected_ns);
    // The frame is done, and was `work_ns`.
    void done(double work_ns);

  private:
    // Time taken over work: the median of the last few frames, since on a busy machine every third may be
    // interrupted.
    class Rate {
      public:
        bool known() const { return count_ > 0; }
        double value() const;  // once known
        void add(double sample) { samples_[count_++ % samples_.size()] = sample; }
        void forget() { count_ = 0; }

      private:
        std::array<double, 5> samples_{};
        std::size_t count_ = 0;
    };
    bool shared_pays() const { return shared_.known() && shared_.value() < alone_.value(); }

    const ThreadTeam& team_;
    SharingMode mode_;
    Rate alone_;
    Rate shared_;
    bool sharing_ = false;
    bool paid_ = false;           // sharing did, as of the last frame
    bool counts_ = false;         // the frame is large enough to learn from
    std::uint32_t interval_ = 0;  // frames until the other way is tried
    std::uint32_t since_ = 0;
    Nanoseconds begin_{0};
};

}  // namespace swath
