#pragma once
#include <optional>
#include <string>

namespace swath {

// Where a server composites the pixels that it receives.
enum class Compositing {
    kGraphics,  // on the graphics card: each swath is read from and written to its buffers (Samanta 2000)
    kHost,      // in host memory: a server reads its content once, and sends its tile from memory
};

// Access to one buffer of a frame buffer: an operation takes `latency_s`, then it moves pixels at a rate.
struct BufferAccess {
    double latency_s = 0;
    double read_pixels_per_s = 0;
    double write_pixels_per_s = 0;  // kHost never writes: 0 will do
    double read_s(double pixels) const { return latency_s + pixels / read_pixels_per_s; }
    double write_s(double pixels) const { return latency_s + pixels / write_pixels_per_s; }
};

// The speed of a cluster's machines and network, from a profile (sim/hardware) or measured (client/predict).
// A value. Units are SI; 0 where the source says nothing and need not.
struct Hardware {
    std::string name;   // of the profile: a built-in one, or the file's without .toml
    std::string about;  // one line

    struct Network {
        double latency_s = 0;
        double bytes_per_s = 0;                  // each machine's interface, each way
        std::optional<double> core_bytes_per_s;  // the switch; none: no limit
        double swath_bytes_per_pixel = 0;        // per pixel sent between servers, headers and all
        double tile_bytes_per_pixel = 0;         // per pixel sent to the display, likewise
        double active_share = 1;                 // the share of a swath's rectangles that is active, so sent
        double tile_active_share = 1;            // the share of a tile's final region, likewise
    } network;

    struct Client {
        double transform_s = 0;         // per object: its box to the screen
        double partition_server_s = 0;  // per object and server, if linear in the servers
        double partition_level_s = 0;   // per object and log2(servers), likewise
    } client;

    struct Server {
        double frame_s = 0;  // any drawing at all; learned only, 0 in profiles
        double polygon_s = 0;
        double fill_pixels_per_s = 0;
        bool culls = false;  // draws only objects on the screen
        Compositing compositing = Compositing::kGraphics;
        BufferAccess colour;
        BufferAccess depth;  // with the object ids, if those are sent
        // For kHost, in pixels that are sent, so active ones.
        double pack_pixels_per_s = 0;    // coding swaths, gathering tiles
        double gather_pixels_per_s = 0;  // tiles alone, if known; 0 in profiles
        double merge_pixels_per_s = 0;   // decoding and depth test of received pixels
    } server;

    struct Display {
        BufferAccess colour;  // written only, one operation a tile, for the pixels that are sent
    } display;
};

}  // namespace swath
