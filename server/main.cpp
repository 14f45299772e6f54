#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <cstdio>

#include "common/base/allocator.h"
#include "common/program/health.h"
#include "common/program/program.h"
#include "common/renderers/make_renderer.h"
#include "server/session/server.h"

int main(int argc, char** argv) {
    using namespace swath;
    ServerOptions options;
    std::string listen = "127.0.0.1:4000";
    std::string cache = default_cache_folder();
    int threads = -1;
    bool cuda = false;
    ProgramOptions program;

    CLI::App app{
        "swath-server: a render server of Swath. It waits for a swath-client, loads the model that the "
        "client names\n"
        "(from this machine, its cache, or the client), draws its share of every frame with a software "
        "OpenGL,\n"
        "swaps pixels with the other servers and sends its tile to the display. Then it waits for the next "
        "client.\n"};
    app.add_option("--listen", listen,
                   "HOST:PORT to listen on; port 0 takes a free one. There is no authentication: listen\n"
                   "beyond loopback only in a network you trust")
        ->capture_default_str();
    app.add_option("--cache", cache, "folder for models that clients send")->capture_default_str();
    app.add_option("--max-model-mib", "largest model that a client may send, in MiB [8192]")
        ->transform(whole_number(1, 1 << 24))
        ->each([&](const std::string& v) { options.max_model_bytes = std::stoull(v) << 20; });
    add_threads_option(app, threads);
    add_trees_option(app, cuda);
    add_program_options(app, program, options.timing);
    add_waiting_options(app, program);
    if (const auto code = parse_options(app, argc, argv, [] { return protocol_here() + renderers_here(); }))
        return *code;
    start_log("swath-server", program.least_logged());

    const auto address = parse_address(listen);
    if (!address) return usage_error({"--listen: " + address.error().message});
    options.listen = *address;
    if (program.health) {
        const Status health = check_health(*address, Role::kServer);
        return health ? kExitDone : run_error(health.error());
    }
    options.cache = cache;
    options.threads = drawing_threads(threads);
    set_raster_threads(threads);
    cuda = cuda && can_build_on_cuda();
    // A terminal's Ctrl-C reaches all programs. One on a lifeline leaves it to the program that started it.
    StopSignals signals(kExitDone, !program.lifeline);
    tune_allocator();

    const SteadyClock clock;
    boost::asio::io_context io(1);
    const auto server = make_server(io, options, clock, [cuda](RendererSetup setup, const ObjectSet& scene) {
        setup.cuda = cuda;
        return make_renderer(setup, scene);
    });
    if (!server) return run_error(server.error());
    announce((*server)->address());
    return run_until_stopped(io, **server, signals, program);
}
