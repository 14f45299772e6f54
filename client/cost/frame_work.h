#pragma once
#include <span>
#include <vector>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"
#include "common/plan/frame_plan.h"

namespace swath {

// Pixels that one server draws and another owns, as work.
struct SwathWork {
    ServerId peer{};
    double send_s = 0;   // what the sender does: reading buffers, or coding in host memory
    double merge_s = 0;  // what the receiver does: writing buffers, or merging in host memory
    double pixels = 0;   // that are sent: active ones
    double bytes = 0;
};

// A server's part of a frame, as work.
struct ServerWork {
    double render_s = 0;
    double read_s = 0;                // host compositing: all that was drawn, once
    std::vector<SwathWork> outgoing;  // by peer
    std::vector<ServerId> incoming;   // by peer
    bool has_tile = false;
    double final_s = 0;    // what it does for its tile
    double display_s = 0;  // what the display does for it
    double tile_bytes = 0;
    double task_bytes = 0;  // of the message that tells it all this
    bool takes_part = false;
};

// The work that our cluster has with the plan on such machines: it sends swaths and tiles as FramePlan says
// (transfers and final_region) and its servers idle when there is nothing for them. `objects` are those that
// the plan was made from. By server. Thread-safe.
std::vector<ServerWork> frame_work(const FramePlan& plan, std::span<const ProjectedObject> objects,
                                   const Hardware& hardware);

// Triangles assigned to servers over those of the model (Samanta 2000, section 3): 1 but for sort-first.
double overlap_factor(const FramePlan& plan, std::span<const Object> model);

}  // namespace swath
