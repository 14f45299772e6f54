#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace swath::sim {

// Who merges the pixels that servers exchange.
enum class Compositing {
    kGraphics,  // the graphics card: a swath is read from and written to its buffers on its own (Samanta
                // 2000)
    kHost,      // host memory: a server reads all it drew once, merges there and sends its tile from there
};

// Access to one buffer of a frame buffer: an operation takes `latency_s` and then moves pixels at a rate.
struct BufferAccess {
    double latency_s = 0;
    double read_pixels_per_s = 0;
    double write_pixels_per_s = 0;  // kHost never writes and may have none
    double read_s(double pixels) const { return latency_s + pixels / read_pixels_per_s; }
    double write_s(double pixels) const { return latency_s + pixels / write_pixels_per_s; }
};

// What the simulator knows of a cluster: the speed of its machines and its network. Values are SI units, 0
// where the profile says nothing and needs to say nothing. README.md documents the file format.
struct Hardware {
    std::string name;   // of the profile: a built-in's, or the file's without .toml
    std::string about;  // one line

    struct Network {
        double latency_s = 0;
        double bytes_per_s = 0;                  // of each machine's interface, each way
        std::optional<double> core_bytes_per_s;  // of the switch; without: no limit
        double swath_bytes_per_pixel = 0;        // all that a pixel sent between servers costs
        double tile_bytes_per_pixel = 0;         // ... and one sent to the display
        double active_share = 1;                 // of the pixels in a swath's rectangles that are sent
        double tile_active_share = 1;            // ... and of those in a tile's final region
    } network;

    struct Client {
        double transform_s = 0;         // per object: its box to the screen
        double partition_server_s = 0;  // per object and server: a partition that is linear in the servers
        double partition_level_s = 0;   // per object and log2(servers)
    } client;

    struct Server {
        double polygon_s = 0;
        double fill_pixels_per_s = 0;
        bool culls = false;  // draws only what is on the screen
        Compositing compositing = Compositing::kGraphics;
        BufferAccess colour;
        BufferAccess depth;  // with the object ids, where they are sent
        // kHost; of pixels that are sent, that is active ones.
        double pack_pixels_per_s = 0;   // coding swaths, gathering tiles
        double merge_pixels_per_s = 0;  // decoding and depth test of received pixels
    } server;

    struct Display {
        BufferAccess colour;  // only written, an operation a tile: its pixels that are sent
    } display;
};

// A profile in TOML. Errors name the profile, the line and the key, and say what was expected.
Result<Hardware> parse_hardware(std::string_view toml, std::string name);

// A built-in profile, or the file when the name ends in ".toml".
Result<Hardware> find_hardware(const std::string& name_or_file);
std::vector<std::string> builtin_hardware();

// Every value with its unit and its meaning, a line each, for people.
std::string explain(const Hardware& hardware);

}  // namespace swath::sim
