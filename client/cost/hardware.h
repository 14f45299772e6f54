#pragma once
#include <optional>
#include <string>

namespace swath {

// Who merges the pixels that servers exchange.
enum class Compositing {
    // The graphics card: each swath is read from and written to its buffers alone (Samanta 2000).
    kGraphics,
    // Host memory: a server reads all that it drew once, composites there and sends its tile from there.
    kHost,
};

// Access to one buffer of a frame buffer: an operation takes `latency_s` and then moves pixels at a rate.
struct BufferAccess {
    double latency_s = 0;
    double read_pixels_per_s = 0;
    double write_pixels_per_s = 0;  // kHost never writes and may have none
    double read_s(double pixels) const { return latency_s + pixels / read_pixels_per_s; }
    double write_s(double pixels) const { return latency_s + pixels / write_pixels_per_s; }
};

// What is known of a cluster: the speed of its machines and its network, from a profile (sim/hardware) or
// measured (client/predict). A value. Units are SI, 0 where the source says nothing and needs to say nothing.
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
        double frame_s = 0;  // to draw anything at all; profiles have none, it is measured
        double polygon_s = 0;
        double fill_pixels_per_s = 0;
        bool culls = false;  // draws only what is on the screen
        Compositing compositing = Compositing::kGraphics;
        BufferAccess colour;
        BufferAccess depth;  // with the object ids, where they are sent
        // kHost; of pixels that are sent, that is active ones.
        double pack_pixels_per_s = 0;    // coding swaths, gathering tiles
        double gather_pixels_per_s = 0;  // gathering tiles, where it is known apart; profiles have none
        double merge_pixels_per_s = 0;   // decoding and depth test of received pixels
    } server;

    struct Display {
        BufferAccess colour;  // only written, an operation a tile: its pixels that are sent
    } display;
};

}  // namespace swath
