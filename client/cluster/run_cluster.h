#pragma once
#include <functional>
#include <vector>

#include "client/cluster/cluster_run.h"

namespace swath {

// Runs a job to its end on an io_context of its own; SIGINT and SIGTERM end it early with an error, a live
// run without one. Blocking.
Result<std::vector<FrameTimeline>> run_cluster(ClusterJob job, const Clock& clock,
                                               std::function<void(const std::string& page)> on_ready,
                                               std::function<Status(FrameNumber, const Buffer&)> on_picture);

}  // namespace swath
