#pragma once
#include <optional>
#include <string>
#include <vector>

#include "client/live/wish.h"
#include "client/machines/server_source.h"
#include "client/partition/partitioner.h"
#include "common/image/picture.h"
#include "common/program/program.h"
#include "common/render/draw_settings.h"
#include "common/scene/objects.h"
#include "common/wire/address.h"

namespace swath {

// The command line of swath-client, checked.
struct ClientOptions {
    std::string model;
    bool single = false;
    std::size_t local = 4;  // servers to start here, unless `servers` are given
    std::optional<ServerSource> servers;
    std::optional<Address> display;
    Algorithm algorithm = Algorithm::kHybrid;
    DrawSettings draw{.renderers = {}};  // no renderers: what works here
    Granularity granularity;
    int width = 1280;
    int height = 960;
    Rgb background{16, 18, 24};
    std::optional<std::size_t> frames;
    std::optional<float> pose;       // of a model that moves, 0 to 1
    std::optional<glm::vec3> light;  // direction to it, not 0
    std::string path = "orbit";
    std::uint64_t seed = 1;
    double zoom = 1;
    std::uint32_t in_flight = 3;
    int threads = -1;   // besides the drawing one, per process; -1: as many as fit
    bool cuda = false;  // builds the trees of ray casters on this machine
    std::string out;    // folder of pictures, or the file of one; empty: none
    PictureFormat format = PictureFormat::kPng;
    std::string timeline;  // file; empty: none
    double connect_patience_s = 5;
    ProgramOptions program;
    std::optional<std::string>
        view;                // [HOST:]PORT of the page that a local display serves, "" elsewhere; a live run
    WishLimits view_limits;  // the run fills in its servers
    WireTiming timing;
};

// The options, or the exit code with which the program must end now: it has printed help or an error.
tl::expected<ClientOptions, int> parse_client_options(int argc, char** argv);

// Those that are set, as in a command line: " --shadows".
std::string to_arguments(const RenderFlags& flags);

}  // namespace swath
