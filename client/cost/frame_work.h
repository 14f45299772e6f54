#pragma once
#include <span>
#include <vector>

#include "client/cost/hardware.h"
#include "client/partition/partitioner.h"
#include "common/plan/frame_plan.h"

namespace swath {

// The work for the pixels that one server draws and another owns.
struct SwathWork {
    ServerId peer{};
    double send_s = 0;   // the sender's: reading buffers, or coding in host memory
    double merge_s = 0;  // the receiver's: writing buffers, or compositing in host memory
    double pixels = 0;   // active ones, since only those are sent
    double bytes = 0;
};

// The work of a server in a frame.
struct ServerWork {
    double render_s = 0;
    double read_s = 0;                // host compositing only: its whole content, once
    std::vector<SwathWork> outgoing;  // by peer
    std::vector<ServerId> incoming;   // by peer
    bool has_tile = false;
    double final_s = 0;    // its work for its tile
    double display_s = 0;  // the display's work for that tile
    double tile_bytes = 0;
    double task_bytes = 0;  // the message that gives it the task
    bool takes_part = false;
};

// The work of our cluster with this plan on this hardware, by rank. The cluster sends swaths and tiles as
// FramePlan says (transfers and final_region), and a server without work idles. The plan was made from
// `objects`. Thread-safe.
std::vector<ServerWork> frame_work(const FramePlan& plan, std::span<const ProjectedObject> objects,
                                   const Hardware& hardware);

// Triangles assigned to servers over those of the model (Samanta 2000, section 3); 1 unless the plan is
// sort-first.
double overlap_factor(const FramePlan& plan, std::span<const Object> model);

}  // namespace swath
