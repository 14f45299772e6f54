#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.h"
#include "common/base/thread_team.h"

namespace swath {

// The resource data array R[i,j,k,...] = {c, L} as the papers print it (ADSB, section 8.2, equation 1; A2SSB,
// section 3.10, equation 31): for each point of the resource space the number c of its objects and their list
// L. Points are named by their keys. It is only for comparison: RadixSort and RankBitmap are faster. One
// thread at a time for each point.
class ResourceArray {
  public:
    static constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 24;  // of 32 bytes for each array

    // Fails if `points` is above kMaxPoints.
    static Result<ResourceArray> make(std::uint64_t points);

    std::size_t points() const { return entries_.size(); }
    void add(std::uint32_t key, std::uint32_t id);
    std::uint32_t count(std::uint32_t key) const { return entries_[key].c; }
    std::span<const std::uint32_t> list(std::uint32_t key) const { return entries_[key].L; }
    void clear();

  private:
    friend void merge(std::span<ResourceArray> arrays, ThreadTeam& team, ResourceArray& merged);

    struct Entry {
        std::uint32_t c = 0;
        std::vector<std::uint32_t> L;
    };
    explicit ResourceArray(std::size_t points) : entries_(points) {}

    std::vector<Entry> entries_;
};

// Makes the merged resource data array M (ADSB, section 8.3, figure 8; A2SSB, section 3.10 c): for each point
// the sum of c and the lists of all processors' arrays, in the order of `arrays`. The first list that is not
// empty is moved, the others are appended. Leaves `arrays` empty and drops what was in `merged`; all must
// have the same number of points. The papers leave doing this in parallel to the future; here each member
// merges a range of points.
void merge(std::span<ResourceArray> arrays, ThreadTeam& team, ResourceArray& merged);

// Sorts as the papers do: each member adds its share of the visible objects to an R of its own, all R are
// merged into M, and M is read from its first point to its last.
//
// It reads the objects' keys where they are: they must outlive it, as the team must. One thread at a time.
class LiteralSort {
  public:
    // Fails if ResourceArray cannot hold the space. Every key must be below `points`.
    static Result<LiteralSort> make(std::span<const std::uint32_t> keys, std::uint64_t points,
                                    ThreadTeam& team);

    // Sorts `visible`, ascending ids below keys.size(), by (key, id). Valid until the next call.
    std::span<const std::uint32_t> sort(std::span<const std::uint32_t> visible);
    // M of the last call.
    const ResourceArray& merged() const { return merged_; }

  private:
    LiteralSort(std::span<const std::uint32_t> keys, ResourceArray empty, ThreadTeam& team);

    std::span<const std::uint32_t> keys_;
    ThreadTeam& team_;
    std::vector<ResourceArray> arrays_;
    ResourceArray merged_;
    std::vector<std::uint32_t> sorted_;
};

}  // namespace swath
