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

// Decides for each frame whether a team shares a cull or the caller does it alone. Small frames are never
// shared: waking a member takes longer. For larger ones it measures which way is quicker, takes that, and
// tries the other way from time to time, ever more rarely while it does not pay. So a team costs next to
// nothing on a machine whose cores are taken, where members would begin and then stand still.
//
// A frame's work is expected in nanoseconds: about what one undisturbed thread would take.
class Sharing {
  public:
    Sharing(const ThreadTeam& team, SharingMode mode) : team_(team), mode_(mode) {}

    // The number of members for a frame of `expected_ns`, 1 or more. Begins to measure the frame.
    std::size_t members(double expected_ns);
    // Call it when the frame is done. `work_ns` is the work that it turned out to be.
    void done(double work_ns);

  private:
    // Time taken per work: the median of the last few frames, because on a busy machine every third may be
    // interrupted.
    class Rate {
      public:
        bool known() const { return count_ > 0; }
        double value() const;  // needs known()
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
    bool paid_ = false;           // whether sharing paid as of the last frame
    bool counts_ = false;         // whether the frame is large enough to learn from
    std::uint32_t interval_ = 0;  // frames until the other way is tried
    std::uint32_t since_ = 0;
    Nanoseconds begin_{0};
};

}  // namespace swath
