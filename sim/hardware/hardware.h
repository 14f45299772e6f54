#pragma once
#include <optional>
#include <string>

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
    double write_pixels_per_s = 0;
    double read_s(double pixels) const { return latency_s + pixels / read_pixels_per_s; }
    double write_s(double pixels) const { return latency_s + pixels / write_pixels_per_s; }
};

// What the simulator knows of a cluster: the speed of its machines and its network. Values are SI units;
// sim/hardware/README.md documents the file format.
struct Hardware {
    std::string name;
    std::string about;

    struct Network {
        double latency_s = 0;
        double bytes_per_s = 0;                  // of each machine's interface, each way
        std::optional<double> core_bytes_per_s;  // of the switch; without: no limit
        double swath_bytes_per_pixel = 0;        // colour and depth, between servers
        double tile_bytes_per_pixel = 0;         // colour, to the display
        double active_share = 1;                 // of the pixels in a rectangle to send that are sent
    } network;

    struct Client {
        double transform_s = 0;         // an object's box to the screen
        double partition_server_s = 0;  // per object and server: a partition that is linear in the servers
        double partition_level_s = 0;   // per object and log2(servers)
    } client;

    struct Server {
        double polygon_s = 0;
        double fill_pixels_per_s = 0;
        bool culls = false;  // draws only what is on the screen
        Compositing compositing = Compositing::kGraphics;
        BufferAccess colour;
        BufferAccess depth;
        double pack_pixels_per_s = 0;   // host compositing: coding swaths, gathering tiles
        double merge_pixels_per_s = 0;  // host compositing: depth test of received pixels
    } server;

    struct Display {
        BufferAccess colour;  // only written
    } display;
};

}  // namespace swath::sim
