#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "client/partition/projection.h"
#include "common/base/ids.h"
#include "common/base/names.h"
#include "common/plan/frame_plan.h"

namespace swath {

// All that decides a frame's partition. Borrows the objects for the call.
struct PartitionInput {
    FrameNumber frame = 0;
    View view;                                 // at least 1x1 pixel
    std::span<const ProjectedObject> objects;  // by ObjectId, projected with `view`; at most kMaxObjects
    std::size_t servers = 1;                   // 1 to kMaxServers
};

// Divides a frame among servers. The plan is a function of the input and of the objects that the partitioner
// was made with: an instance keeps scratch space and static parts, never decisions of an earlier frame. Every
// plan passes problem() with the algorithm's grouping, whatever the objects. A broken limit of PartitionInput
// throws CheckFailed. One thread at a time.
class Partitioner {
  public:
    virtual ~Partitioner() = default;
    virtual FramePlan partition(const PartitionInput& input) = 0;
};

enum class Algorithm {
    kHybrid,    // tiles and groups from one sweep of the screen, every frame (Samanta 2000, section 5)
    kMahd,      // sort-first: tiles cut along a mesh of loads, objects on every tile that they overlap
    kKdSplit,   // sort-first: tiles cut where the work of overlapping objects is equal (Samanta 1999)
    kSortLast,  // groups made once in model space, at pose 0, interleaved tiles (Samanta 2000, section 7.4)
};

template <>
inline constexpr auto kNames<Algorithm> = names_of<Algorithm>("algorithm",
                                                              {{Algorithm::kHybrid, "hybrid"},
                                                               {Algorithm::kMahd, "mahd"},
                                                               {Algorithm::kKdSplit, "kd-split"},
                                                               {Algorithm::kSortLast, "sort-last"}});
Grouping grouping_of(Algorithm algorithm);

// Makes a partitioner for this model; copies what it needs of `objects`. Every PartitionInput must have the
// same objects.
std::unique_ptr<Partitioner> make_partitioner(Algorithm algorithm, std::span<const Object> objects);

}  // namespace swath
