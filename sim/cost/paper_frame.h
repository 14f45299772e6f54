#pragma once
#include <span>
#include <vector>

#include "client/partition/partitioner.h"
#include "common/plan/frame_plan.h"
#include "sim/hardware/hardware.h"
#include "sim/table/table.h"

namespace swath::sim {

// What one server does in a frame, in seconds.
struct ServerTimes {
    double render_s = 0;
    double read_s = 0;   // colour and depth of what it sends
    double write_s = 0;  // colour and depth of the swaths that it gets
    double final_s = 0;  // colour of its tile
    double total_s() const { return render_s + read_s + write_s + final_s; }
};

// A frame as Samanta 2000 accounts for it: a server's phases follow one another, nobody waits for the
// network, and no object is culled. Compositing is where the hardware has it, in the paper on the graphics
// card; in host memory reading is that of all that was drawn, and the coding of swaths.
struct PaperFrame {
    std::vector<ServerTimes> servers;
    double client_s = 0;   // transforming and partitioning
    double display_s = 0;  // writing all tiles
};

// `objects` are projected with Accounting::kPaper and the plan's view, the plan is `algorithm`'s. What the
// paper leaves open is settled as its Table 1 shows:
// - every swath is read and written by two operations, one a buffer, each with its latency; with sort-last
//   every square of the grid is a swath of its own;
// - tiles are cut from the region that the objects' boxes span, with MAHD from the cells of its mesh that
//   they touch, not from the whole screen;
// - the hybrid reads and sends whole tiles; sort-first reads what its objects' boxes cover and sends the
//   tile; sort-last reads and sends of every square the bounds of what was drawn there.
// Thread-safe.
PaperFrame paper_frame(const FramePlan& plan, std::span<const ProjectedObject> objects, Algorithm algorithm,
                       const Hardware& hardware);

// The columns of Table 1: means over frames. Times in seconds.
class PaperMeans {
  public:
    void add(const PaperFrame& frame);
    void add(const PaperMeans& other);

    // `ideal_s` is what a server would take if the model's polygons were shared without any overhead. Rows
    // are named as in published/table1.csv and are those of `of`; times in ms. Without what cannot be: no
    // overlap if every object has one server, no exchange with sort-first.
    std::vector<Row> table1(const Row& of, Grouping grouping, double ideal_s) const;
    // The stages' means that Table 1 does not have: client, and effective_frame (the slowest stage).
    std::vector<Row> stages(const Row& of) const;

  private:
    double frames_ = 0;
    ServerTimes mean_;      // over servers
    double longest_s_ = 0;  // total of the server that takes longest
    double client_s_ = 0;
    double display_s_ = 0;
};

}  // namespace swath::sim
