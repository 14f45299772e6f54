#include "client/live/speed_ups.h"

#include <algorithm>

namespace swath {
namespace {

double busiest_cpu_ms(const FrameTimeline& timeline) {
    double most = 0;
    for (const MachineTimeline& machine : timeline.machines) {
        if (!is_server(machine.machine)) continue;
        double sum = 0;
        for (const Span& span : machine.spans) sum += milliseconds(span.cpu);
        most = std::max(most, sum);
    }
    return most;
}

}  // namespace

bool SpeedUps::on_frame(const FrameOrder& order, const FrameTimeline& timeline,
                        std::optional<Nanoseconds> interval, std::optional<double> predicted_ms) {
    if (order.measurement == 0 || !order.counts || !interval) return false;
    if (order.measurement != measurement_) sums_.clear();
    measurement_ = order.measurement;
    algorithm_ = order.algorithm;
    Sum& sum = sums_[order.servers];
    ++sum.frames;
    sum.interval_ms += milliseconds(*interval);
    sum.busiest_cpu_ms += busiest_cpu_ms(timeline);
    if (predicted_ms) sum.predicted_ms = predicted_ms;
    return true;
}

std::vector<SpeedUps::Point> SpeedUps::points() const {
    std::vector<Point> points;
    for (const auto& [servers, sum] : sums_)
        points.push_back(
            {servers, sum.interval_ms / sum.frames, sum.busiest_cpu_ms / sum.frames, sum.predicted_ms});
    return points;
}

}  // namespace swath
