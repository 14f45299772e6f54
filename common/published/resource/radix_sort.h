#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/sharing.h"
#include "common/base/thread_team.h"
#include "common/published/resource/histograms.h"
#include "common/published/resource/scratch.h"

namespace swath {

// The digits of keys below `points`, least significant first: as few as kMaxBits allows, of sizes as equal as
// possible (131,072 keys: 9 and 8 bits). One key needs no digit.
struct RadixDigits {
    static constexpr int kMaxBits =
        11;  // 2048 counters and as many places to write to are about what L1 takes
    static constexpr std::size_t kMax = 3;
    std::array<int, kMax> bits{};
    std::size_t count = 0;

    bool operator==(const RadixDigits&) const = default;
};
RadixDigits radix_digits(std::uint64_t points);

// Radix sort, least significant digit first, with one stable counting sort a digit. The number of points only
// decides the number of digits, so it is good for few visible objects in a large space, and stays fast when
// the counters of all points do not fit a cache. Between passes an object is its key and id in 64 bits.
//
// It reads the objects' keys where they are: they must outlive it, as the team must. One thread at a time.
class RadixSort {
  public:
    // Every key must be below `points`, which is at most 2^32.
    RadixSort(std::span<const std::uint32_t> keys, std::uint64_t points, ThreadTeam& team,
              SharingMode mode = SharingMode::kWhenItPays);

    // Sorts `visible`, ascending ids below keys.size(), by (key, id). Valid until the next call and as long
    // as `visible`, which is the answer if there is one key.
    std::span<const std::uint32_t> sort(std::span<const std::uint32_t> visible);

  private:
    std::span<const std::uint32_t> keys_;
    RadixDigits digits_;
    ThreadTeam& team_;
    Sharing sharing_;
    std::array<Histograms, RadixDigits::kMax> histograms_;
    std::array<Scratch<std::uint64_t>, 2> packed_;
    Scratch<std::uint32_t> sorted_;
};

}  // namespace swath
