#pragma once
#include <span>
#include <vector>

#include "client/partition/partitioner.h"
#include "common/plan/frame_plan.h"
#include "sim/hardware/hardware.h"
#include "sim/table/table.h"

namespace swath::sim {

// A server's work in a frame, in seconds.
struct ServerTimes {
    double render_s = 0;
    double read_s = 0;   // colour and depth of the swaths that it sends
    double write_s = 0;  // colour and depth of the swaths that it receives
    double final_s = 0;  // colour of its tile
    double total_s() const { return render_s + read_s + write_s + final_s; }
};

// A frame by the accounting of Samanta 2000: a server's phases follow one another, nobody waits for the
// network, and no object is culled. The hardware says where pixels are composited; in the paper on the
// graphics card. In host memory, reading is the read-back of the content and the coding of swaths.
struct PaperFrame {
    std::vector<ServerTimes> servers;
    double client_s = 0;   // projecting and partitioning
    double display_s = 0;  // writing all tiles
};

// `objects` are projected with Accounting::kPaper and the plan's view; the plan is `algorithm`'s. Where the
// paper is silent, its Table 1 shows:
// - every swath is read and written by two operations, one a buffer, each with its latency; with sort-last
//   every square of the grid is a swath of its own;
// - tiles are cut from the region that the objects' boxes span (MAHD: from the cells of its mesh that they
//   touch), not from the whole screen;
// - the hybrid reads and sends whole tiles; sort-first reads what its objects' boxes cover and sends the
//   tile; sort-last reads and sends, of every square, the bounds of what was drawn there.
// Thread-safe.
PaperFrame paper_frame(const FramePlan& plan, std::span<const ProjectedObject> objects, Algorithm algorithm,
                       const Hardware& hardware);

// Means over frames of the columns of Table 1.
class PaperMeans {
  public:
    void add(const PaperFrame& frame);
    void add(const PaperMeans& other);

    // The columns of Table 1 in ms, named as in published/table1.csv, with the labels of `of`. `ideal_s` is a
    // server's time if the model's polygons were shared without any overhead. Omits columns that cannot be:
    // overlap if every object has one server, exchange for sort-first.
    std::vector<Row> table1(const Row& of, Grouping grouping, double ideal_s) const;
    // The means that Table 1 lacks: client, and effective_frame (the slowest stage).
    std::vector<Row> stages(const Row& of) const;

  private:
    double frames_ = 0;
    ServerTimes mean_;      // over servers
    double longest_s_ = 0;  // total of the slowest server
    double client_s_ = 0;
    double display_s_ = 0;
};

}  // namespace swath::sim
