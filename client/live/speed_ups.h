#pragma once
#include <map>
#include <optional>
#include <vector>

#include "client/live/live_view.h"
#include "common/base/clock.h"
#include "common/timeline/timeline.h"

namespace swath {

// Collects the results of a measurement of speed-ups (LiveView): means over the frames that count, by number
// of servers. Not thread-safe.
class SpeedUps {
  public:
    struct Point {
        std::size_t servers = 1;
        double interval_ms = 0;     // from one frame's end to the next one's
        double busiest_cpu_ms = 0;  // thread time of the busiest server, as if each had a core of its own
        std::optional<double> predicted_ms;
    };

    // A frame is over. Returns false if it belongs to no measurement, or does not count.
    bool on_frame(const FrameOrder& order, const FrameTimeline& timeline, std::optional<Nanoseconds> interval,
                  std::optional<double> predicted_ms);

    Algorithm algorithm() const { return algorithm_; }
    std::vector<Point> points() const;  // by servers

  private:
    struct Sum {
        double frames = 0;
        double interval_ms = 0;
        double busiest_cpu_ms = 0;
        std::optional<double> predicted_ms;  // the newest, since rates get better
    };
    std::size_t measurement_ = 0;
    Algorithm algorithm_ = Algorithm::kHybrid;
    std::map<std::size_t, Sum> sums_;
};

}  // namespace swath
