#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/scene/objects.h"

namespace swath {

// Expects what objects cost in the next frame: the triangles that were left after culling in the newest frame
// of which all servers have reported, added up over the servers, but no more than the object has. An object
// of which nobody saw anything costs all its triangles, since it may come into view. Sans-I/O. Not
// thread-safe.
class ObjectCosts {
  public:
    explicit ObjectCosts(std::span<const Object> objects);

    // Triangles by ObjectId; all of them until a frame is over. Valid until the next call of another member.
    std::span<const std::uint32_t> costs() const { return costs_; }

    // The groups (ascending ids) of the servers that will report on a frame.
    void on_issued(FrameNumber frame, std::map<ServerId, std::vector<ObjectId>> groups);

    // `visible` has the triangles left of each object of the server's group. Empty, it counts every object in
    // full. Errors blame the server.
    Status on_report(FrameNumber frame, ServerId server, std::span<const std::uint32_t> visible);

  private:
    struct Open {
        std::map<ServerId, std::vector<ObjectId>> groups;  // of the servers that have not reported
        std::vector<std::uint32_t> sums;                   // by ObjectId
    };
    void close(FrameNumber frame, const std::vector<std::uint32_t>& sums);

    std::vector<std::uint32_t> triangles_;  // that each object has
    std::vector<std::uint32_t> costs_;
    FrameNumber next_ = 0;  // frames before it are too old to count
    std::map<FrameNumber, Open> open_;
};

}  // namespace swath
