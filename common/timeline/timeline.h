#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/clock.h"
#include "common/base/ids.h"
#include "common/base/names.h"

namespace swath {

// A kind of work that a machine does for a frame. Measured and simulated frames have the same phases
// (docs/design.md).
enum class Phase : std::uint8_t {
    kPartition,   // client: objects and camera to a plan
    kCull,        // server: leaves of the group's objects against the content's frustum
    kRender,      // server: drawing until it is finished
    kPixelRead,   // server: colour, depth and id to host memory
    kSwap,        // server: coding and sending swath pixels to peers
    kPixelWrite,  // server: compositing received swaths
    kFinalRead,   // server: gathering the finished tile's active pixels
    kSend,        // server: handing the tile to the display's connection
    kAssemble,    // display: tiles into the picture
    kEncode,      // display: the picture into a PNG or JPEG
    kWait,        // any: nothing to do for the frame, because others are not ready
};
template <>
inline constexpr auto kNames<Phase> = names_of<Phase>("phase", {{Phase::kPartition, "partition"},
                                                                {Phase::kCull, "cull"},
                                                                {Phase::kRender, "render"},
                                                                {Phase::kPixelRead, "pixel read"},
                                                                {Phase::kSwap, "swap"},
                                                                {Phase::kPixelWrite, "pixel write"},
                                                                {Phase::kFinalRead, "final read"},
                                                                {Phase::kSend, "send"},
                                                                {Phase::kAssemble, "assemble"},
                                                                {Phase::kEncode, "encode"},
                                                                {Phase::kWait, "wait"}});
inline constexpr std::size_t kPhaseCount = kAll<Phase>.size();

// A number that a machine counts for a frame.
enum class Counter : std::uint8_t {
    kTriangles,       // server: drawn after culling
    kObjects,         // server: drawn after culling
    kSwapPixels,      // server: active pixels sent to peers
    kSwapBytes,       // server: bytes of those messages, framing included
    kTilePixels,      // server: active pixels sent to the display
    kTileBytes,       // server: bytes of that message, framing included
    kReceivedPixels,  // server: active pixels received from peers
    kLeaves,          // server: drawn after culling
    kSplitLevel,      // server: at which A2SSB shared an octree among threads; 0 also if it did not
};
template <>
inline constexpr auto kNames<Counter> = names_of<Counter>("counter",
                                                          {{Counter::kTriangles, "triangles"},
                                                           {Counter::kObjects, "objects"},
                                                           {Counter::kSwapPixels, "swap_pixels"},
                                                           {Counter::kSwapBytes, "swap_bytes"},
                                                           {Counter::kTilePixels, "tile_pixels"},
                                                           {Counter::kTileBytes, "tile_bytes"},
                                                           {Counter::kReceivedPixels, "received_pixels"},
                                                           {Counter::kLeaves, "leaves"},
                                                           {Counter::kSplitLevel, "split_level"}});
inline constexpr std::size_t kCounterCount = kAll<Counter>.size();

// A time in which a machine did one phase. Times are on the client's clock.
struct Span {
    Phase phase = Phase::kWait;
    Nanoseconds begin{0};
    Nanoseconds end{0};
    Nanoseconds cpu{0};  // CPU time of the thread that did it; 0 if unknown
    bool operator==(const Span&) const = default;
};

// The name of a server's machine, like "server 0". The others are "client" and "display". Summaries tell
// servers by these names, so whoever records or simulates a server's time must use this.
std::string server_name(ServerId id);
bool is_server(std::string_view machine);
// The machine of `swath-client --single`, one process that does all.
inline constexpr std::string_view kSingleMachine = "single";

// One machine's part of a frame.
struct MachineTimeline {
    std::string machine;
    std::vector<Span> spans;
    std::array<std::uint64_t, kCounterCount> counters{};
    std::uint64_t& operator[](Counter c) { return counters[static_cast<std::size_t>(c)]; }
    std::uint64_t operator[](Counter c) const { return counters[static_cast<std::size_t>(c)]; }
    bool operator==(const MachineTimeline&) const = default;
};

// The times and counts of one frame, which the cluster measured or the simulator computed. A value. A
// machine's spans may overlap those of neighbouring frames.
struct FrameTimeline {
    FrameNumber frame = 0;
    std::vector<MachineTimeline> machines;
    // Triangles assigned to servers / triangles of the model (Samanta 2000, section 3).
    double overlap_factor = 1.0;
    bool operator==(const FrameTimeline&) const = default;
};

}  // namespace swath
