#include "client/run.h"
#include "common/base/allocator.h"

int main(int argc, char** argv) {
    using namespace swath;
    const auto options = parse_client_options(argc, argv);
    if (!options) return options.error();
    start_log("swath-client", options->program);
    StopSignals signals(kExitFailed, true);
    tune_allocator();
    if (options->single) set_raster_threads(options->threads);
    const auto status = run_client(*options, signals);
    return status ? kExitDone : run_error(status.error());
}
