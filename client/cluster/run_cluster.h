#pragma once
#include <functional>
#include <vector>

#include "client/cluster/cluster_run.h"
#include "common/program/stop_signals.h"

namespace swath {

// Runs a job to its end on an io_context of its own. A signal ends it early: a live run well, any other with
// an error. Blocking.
Result<std::vector<FrameTimeline>> run_cluster(
    ClusterJob job, const Clock& clock, StopSignals& signals,
    std::function<void(const std::string& page, std::size_t servers)> on_ready,
    std::function<Status(FrameNumber, const Buffer&)> on_picture);

}  // namespace swath
