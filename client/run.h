#pragma once
#include "client/options.h"
#include "common/base/result.h"
#include "common/program/stop_signals.h"

namespace swath {

// Does what the command line says: loads the model, renders its frames here or on a cluster, keeps pictures
// and timeline, and prints the summary to stdout. Blocking.
Status run_client(const ClientOptions& options, StopSignals& signals);

}  // namespace swath
