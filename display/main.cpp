#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <cerrno>
#include <cstring>
#include <iostream>

#include "common/base/allocator.h"
#include "common/program/health.h"
#include "common/program/program.h"
#include "display/session/display.h"

namespace {

// Many programs like the page's usual port.
std::string way_out(const swath::Error& error, swath::Address address) {
    if (!error.message.ends_with(std::strerror(EADDRINUSE)) || ++address.port == 0) return {};
    return "; try --view " +
           (address.host == "127.0.0.1" ? std::to_string(address.port) : to_string(address));
}

}  // namespace

int main(int argc, char** argv) {
    using namespace swath;
    DisplayOptions options;
    std::string listen = "127.0.0.1:4100";
    std::string view;
    std::string view_at;
    ProgramOptions program;

    CLI::App app{
        "swath-display: the display of Swath. It waits for a swath-client, assembles the tiles that the "
        "servers send\n"
        "into pictures, encodes them as the client asks (PNG, JPEG or not at all) and tells it when each is\n"
        "complete. Then it waits for the next client.\n"};
    app.add_option("--listen", listen,
                   "HOST:PORT to listen on; port 0 takes a free one. There is no authentication: listen\n"
                   "beyond loopback only in a network you trust")
        ->capture_default_str();
    auto* viewed =
        app.add_option(
               "--view", view,
               "[HOST:]PORT at which a browser sees the run and steers it, on 127.0.0.1 unless HOST says\n"
               "otherwise; port 0 takes a free one. Beyond loopback it needs the token in the address that\n"
               "is printed, and is not encrypted")
            ->type_name("[HOST:]PORT");
    app.add_option("--view-at", view_at,
                   "HOST:PORT at which people reach --view, where something (a container engine, a tunnel)\n"
                   "passes it on: that address is printed, and if it is loopback no token is asked for")
        ->needs(viewed);
    add_program_options(app, program, options.timing);
    add_waiting_options(app, program);
    if (const auto code = parse_options(app, argc, argv, protocol_here)) return *code;
    start_log("swath-display", program.least_logged());

    const auto address = parse_address(listen);
    if (!address) return usage_error({"--listen: " + address.error().message});
    options.listen = *address;
    if (program.health) {
        const Status health = check_health(*address, Role::kDisplay);
        return health ? kExitDone : run_error(health.error());
    }
    WebServer::Options web;
    if (!view.empty()) {
        const auto at = parse_local_address(view);
        if (!at) return usage_error({"--view: " + at.error().message});
        web.listen = *at;
        if (!view_at.empty()) {
            const auto published = parse_address(view_at);
            if (!published) return usage_error({"--view-at: " + published.error().message});
            web.published = *published;
        }
    }
    // A terminal's Ctrl-C reaches all programs. One on a lifeline leaves it to the program that started it.
    StopSignals signals(kExitDone, !program.lifeline);
    tune_allocator();

    const SteadyClock clock;
    boost::asio::io_context io(1);
    std::unique_ptr<ViewerHost> viewers;
    if (!view.empty()) {
        auto made = ViewerHost::make(web, clock);
        if (!made) return run_error({"--view: " + made.error().message + way_out(made.error(), web.listen)});
        viewers = std::move(*made);
        options.viewers = viewers.get();
    }
    const auto display = make_display(io, options, clock);
    if (!display) return run_error(display.error());
    announce((*display)->address());
    if (viewers) std::cout << "viewer " << viewers->url() << std::endl;
    return run_until_stopped(io, **display, signals, program);
}
