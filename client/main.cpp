#include "client/run.h"
#include "common/base/allocator.h"
#include "common/renderers/make_renderer.h"

int main(int argc, char** argv) {
    using namespace swath;
    auto options = parse_client_options(argc, argv);
    if (!options) return options.error();
    start_log("swath-client", options->program.least_logged());
    StopSignals signals(kExitFailed, true);
    tune_allocator();
    // The client of a cluster does not draw; it only looks what works.
    set_raster_threads(options->single ? options->threads : 0);
    if (options->draw.renderers.empty()) {
        const DefaultRenderer found = default_renderer();
        log_info("drawing with {} ({})", name_of(found.kind), found.description);
        options->draw.renderers = {found.kind};
    }
    const auto status = run_client(*options, signals);
    return status ? kExitDone : run_error(status.error());
}
