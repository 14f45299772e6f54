#include "sim/hardware/keys.h"

#include <array>

namespace swath::sim {
namespace {

using H = Hardware;
using D = double&;

// clang-format off
const std::array kKeys{
    Key{"about", +[](H& h) -> std::string& { return h.about; }, {}, Need::kAlways,
        "what this is, in one line"},

    Key{"network.latency", +[](H& h) -> D { return h.network.latency_s; }, Unit::kTime, Need::kAlways,
        "of a message, before its first byte flows"},
    Key{"network.bandwidth", +[](H& h) -> D { return h.network.bytes_per_s; }, Unit::kBandwidth, Need::kAlways,
        "of each machine's interface, in each direction"},
    Key{"network.core_bandwidth", +[](H& h) -> std::optional<double>& { return h.network.core_bytes_per_s; },
        Unit::kBandwidth, Need::kOptional, "of the switch, all messages together; without it there is no limit"},
    Key{"network.swath", +[](H& h) -> D { return h.network.swath_bytes_per_pixel; }, Unit::kBytesPerPixel,
        Need::kAlways, "size of a pixel sent from server to server"},
    Key{"network.tile", +[](H& h) -> D { return h.network.tile_bytes_per_pixel; }, Unit::kBytesPerPixel,
        Need::kAlways, "size of a pixel sent to the display"},
    Key{"network.active_share", +[](H& h) -> D { return h.network.active_share; }, Unit::kShare, Need::kAlways,
        "how many of the pixels in a swath's rectangles are sent; 1 sends whole rectangles"},
    Key{"network.tile_active_share", +[](H& h) -> D { return h.network.tile_active_share; }, Unit::kShare,
        Need::kAlways, "... and of those in a tile, to the display"},

    Key{"client.transform", +[](H& h) -> D { return h.client.transform_s; }, Unit::kObjectTime, Need::kAlways,
        "to find an object's box on the screen"},
    Key{"client.partition_per_server", +[](H& h) -> D { return h.client.partition_server_s; }, Unit::kServerTime,
        Need::kOptional, "of a partition whose time is linear in the servers; without it 0"},
    Key{"client.partition_per_level", +[](H& h) -> D { return h.client.partition_level_s; }, Unit::kLevelTime,
        Need::kOptional, "of a partition whose time is linear in log2 of the servers; without it 0"},

    Key{"server.polygon", +[](H& h) -> D { return h.server.polygon_s; }, Unit::kPolygonTime, Need::kAlways,
        "to draw a polygon, whatever its size"},
    Key{"server.fill", +[](H& h) -> D { return h.server.fill_pixels_per_s; }, Unit::kPixelRate, Need::kAlways,
        "pixels drawn; drawing takes the longer of polygons and pixels"},
    Key{"server.culls", +[](H& h) -> bool& { return h.server.culls; }, {}, Need::kAlways,
        "whether objects outside of the view cost nothing"},
    Key{"server.compositing", +[](H& h) -> Compositing& { return h.server.compositing; }, {}, Need::kAlways,
        "who composites pixels: \"graphics\" reads and writes each swath in the graphics card's buffers, \"host\" "
        "reads a frame once and composites in memory"},
    Key{"server.colour.latency", +[](H& h) -> D { return h.server.colour.latency_s; }, Unit::kTime, Need::kAlways,
        "of an operation on the colour buffer"},
    Key{"server.colour.read", +[](H& h) -> D { return h.server.colour.read_pixels_per_s; }, Unit::kPixelRate,
        Need::kAlways, "from the colour buffer to host memory"},
    Key{"server.colour.write", +[](H& h) -> D { return h.server.colour.write_pixels_per_s; }, Unit::kPixelRate,
        Need::kForGraphics, "from host memory to the colour buffer"},
    Key{"server.depth.latency", +[](H& h) -> D { return h.server.depth.latency_s; }, Unit::kTime, Need::kAlways,
        "of an operation on the depth buffer"},
    Key{"server.depth.read", +[](H& h) -> D { return h.server.depth.read_pixels_per_s; }, Unit::kPixelRate,
        Need::kAlways, "from the depth buffer (and that of object ids) to host memory"},
    Key{"server.depth.write", +[](H& h) -> D { return h.server.depth.write_pixels_per_s; }, Unit::kPixelRate,
        Need::kForGraphics, "from host memory to the depth buffer"},
    Key{"server.pack", +[](H& h) -> D { return h.server.pack_pixels_per_s; }, Unit::kPixelRate,
        Need::kForHost, "coding of swaths and gathering of the tile, counting pixels that are sent"},
    Key{"server.merge", +[](H& h) -> D { return h.server.merge_pixels_per_s; }, Unit::kPixelRate,
        Need::kForHost, "decoding and depth test of received pixels"},

    Key{"display.latency", +[](H& h) -> D { return h.display.colour.latency_s; }, Unit::kTime, Need::kAlways,
        "of an operation on the display's colour buffer, one for each tile"},
    Key{"display.write", +[](H& h) -> D { return h.display.colour.write_pixels_per_s; }, Unit::kPixelRate,
        Need::kAlways, "from a received tile to the display's colour buffer, counting pixels that are sent"},
};
// clang-format on

}  // namespace

std::span<const Key> hardware_keys() { return kKeys; }

std::string example(const Key& key) {
    struct {
        const Key& key;
        std::string operator()(double& (*)(Hardware&)) const {
            return key.unit == Unit::kShare ? "0.5" : fmt::format("\"{}\"", example(key.unit));
        }
        std::string operator()(std::optional<double>& (*)(Hardware&)) const {
            return fmt::format("\"{}\"", example(key.unit));
        }
        std::string operator()(bool& (*)(Hardware&)) const { return "true"; }
        std::string operator()(Compositing& (*)(Hardware&)) const {
            return fmt::format("\"{}\" or \"{}\"", kGraphicsWord, kHostWord);
        }
        std::string operator()(std::string& (*)(Hardware&)) const { return "\"eight PCs of 1999\""; }
    } of{key};
    return std::visit(of, key.place);
}

}  // namespace swath::sim
