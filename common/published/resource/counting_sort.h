#pragma once
#include <cstdint>
#include <span>

#include "common/base/sharing.h"
#include "common/base/thread_team.h"
#include "common/published/resource/histograms.h"
#include "common/published/resource/scratch.h"

namespace swath {

// Counting sort with one counter for each point of the resource space (ADSB, section 8.1; A2SSB, section 3.10
// a): the papers' choice, without their lists. It is good if the points are few enough for the nearest caches
// and the objects many enough to pay for clearing and adding up all counters.
//
// It reads the objects' keys where they are: they must outlive it, as the team must. One thread at a time.
class CountingSort {
  public:
    // Every key must be below `points`. Keeps 4 bytes for each point and member that takes part.
    CountingSort(std::span<const std::uint32_t> keys, std::uint64_t points, ThreadTeam& team,
                 SharingMode mode = SharingMode::kWhenItPays);

    // Sorts `visible`, ascending ids below keys.size(), by (key, id). Valid until the next call.
    std::span<const std::uint32_t> sort(std::span<const std::uint32_t> visible);

  private:
    std::span<const std::uint32_t> keys_;
    std::size_t points_;
    ThreadTeam& team_;
    Sharing sharing_;
    Histograms histograms_;
    Scratch<std::uint32_t> sorted_;
};

}  // namespace swath
