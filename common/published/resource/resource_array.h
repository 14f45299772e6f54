#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.h"
#include "common/base/thread_team.h"

namespace swath {

// The resource data array R[i,j,k,...] = {c, L} as the papers print it (ADSB, section 8.2, equation 1; A2SSB,
// section 3.10, equation 31): for each point of the resource space the number c of objects and the list L of
// them. Points are named by their keys. It is here to be compared with: RadixSort and RankBitmap are faster.
// One thread at a time for each point.
class ResourceArray {
  public:
    static constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 24;  // of 32 bytes for each array

    // For a space of at most kMaxPoints.
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

// The merged resource data array M (ADSB, section 8.3, figure 8; A2SSB, section 3.10 c): for each point the
// sum of c and the lists of all processors' arrays, one behind the other in the order of `arrays`. The first
// list that is not empty is handed over as it is, the others are appended. Leaves `arrays` empty and drops
// what was in `merged`; all are of the same number of points. The papers leave doing this in parallel to the
// future: here each member merges a range of points of its own.
void merge(std::span<ResourceArray> arrays, ThreadTeam& team, ResourceArray& merged);

// Sorting as the papers do it: each member adds its share of the visible objects to its own R, R are merged
// into M, M is read from its first point to its last.
//
// Made with the objects' keys, which are read, not copied, and must outlive it, as the team must. One thread
// at a time.
class LiteralSort {
  public:
    // Fails for a space that ResourceArray cannot hold. Every key is below `points`.
    static Result<LiteralSort> make(std::span<const std::uint32_t> keys, std::uint64_t points,
                                    ThreadTeam& team);

    // `visible`: ids below keys.size(), ascending. The same ids by (key, id), valid until the next call.
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
