#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/scene/objects.h"

namespace swath {

// What objects are expected to cost in the next frame, from what servers saw of them in the last one whose
// reports have all come: the triangles that were left after culling, added up over the frame's servers, but
// no more than the object has; and all it has where nothing was seen, since it may come into view. Sans-I/O:
// told of every frame and report, it decides nothing but these numbers. Not thread-safe.
class ObjectCosts {
  public:
    explicit ObjectCosts(std::span<const Object> objects);

    // Triangles, by ObjectId: all of them until a frame is over. Valid until the next call of another member.
    std::span<const std::uint32_t> costs() const { return costs_; }

    // The groups (ascending ids) of the servers that will report on a frame.
    void on_issued(FrameNumber frame, std::map<ServerId, std::vector<ObjectId>> groups);

    // `visible`: of each object of the server's group, or nothing at all, which counts as all of them in
    // full. Errors blame the server.
    Status on_report(FrameNumber frame, ServerId server, std::span<const std::uint32_t> visible);

  private:
    struct Open {
        std::map<ServerId, std::vector<ObjectId>> groups;  // of those that have not reported
        std::vector<std::uint32_t> sums;                   // by ObjectId
    };
    void close(FrameNumber frame, const std::vector<std::uint32_t>& sums);

    std::vector<std::uint32_t> triangles_;  // of each object
    std::vector<std::uint32_t> costs_;
    FrameNumber next_ = 0;  // frames before it are too old to count
    std::map<FrameNumber, Open> open_;
};

}  // namespace swath
