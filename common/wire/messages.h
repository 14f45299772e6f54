#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/base/clock.h"
#include "common/base/ids.h"
#include "common/base/names.h"
#include "common/geometry/camera.h"
#include "common/geometry/rect.h"
#include "common/image/picture.h"
#include "common/image/pixel_codec.h"
#include "common/render/draw_settings.h"
#include "common/scene/model_blob.h"
#include "common/scene/objects.h"
#include "common/timeline/timeline.h"

namespace swath {

// What the programs say to each other; the bytes are in docs/wire.md. All are values, checked when they are
// decoded: a decoded message has no rectangle outside kMaxPictureSide, ids ascend, numbers keep their limits.
// What needs more than the message (is this object in the model, do sizes match their region) is checked by
// whoever uses it.

inline constexpr std::uint32_t kMaxFramesInFlight = 8;
// At up to five bytes each they leave room in a message's head for the rest.
inline constexpr std::size_t kMaxVisibleCounts = std::size_t{1} << 19;
inline constexpr std::size_t kMaxTextBytes = 4096;
inline constexpr std::size_t kMaxSpans = 4096;  // of a report
// 73 years. Sums and differences of two times fit in 64 bits.
inline constexpr std::int64_t kMaxTimeNs = std::int64_t{1} << 61;

// A probe wants to know that somebody answers, no more.
enum class Role : std::uint32_t { kClient = 1, kServer = 2, kDisplay = 3, kProbe = 4 };
template <>
inline constexpr auto kNames<Role> = names_of<Role>("role", {{Role::kClient, "client"},
                                                             {Role::kServer, "server"},
                                                             {Role::kDisplay, "display"},
                                                             {Role::kProbe, "probe"}});

// The first message of both ends of every connection.
struct Hello {
    Role role = Role::kClient;
    std::uint64_t session = 0;  // 0 until a session exists
    ServerId server{};          // of a server in a session
    std::uint32_t max_head_bytes = 0;
    std::uint32_t max_body_bytes = 0;
    bool operator==(const Hello&) const = default;
};

// Sent by either end after its Hello and when it has been silent for a while; answered at once. The answers
// estimate the offset of clocks.
struct Ping {
    Nanoseconds sent{0};
    bool operator==(const Ping&) const = default;
};
struct Pong {
    Nanoseconds sent{0};  // as in the Ping
    Nanoseconds peer{0};  // the answerer's clock
    bool operator==(const Pong&) const = default;
};

// Client to server: the session. The server loads the model (its own file, its cache, or NeedModel) and says
// Ready.
struct ServerSetup {
    std::uint64_t session = 0;
    ServerId server{};
    std::string model;  // as the user named it
    Digest digest{};    // of the model's blob
    std::uint64_t blob_bytes = 0;
    Drawing drawing;
    std::uint32_t frames_in_flight = 2;
    bool operator==(const ServerSetup&) const = default;
};
// Client to display; it answers Ready.
struct DisplaySetup {
    std::uint64_t session = 0;
    PictureFormat format = PictureFormat::kNone;
    std::uint32_t frames_in_flight = 2;
    bool live = false;  // the client takes wishes
    bool operator==(const DisplaySetup&) const = default;
};
// Client to server, while it has no frame: cut, draw and cull like this from now on. Ready answers; a server
// that cannot has changed nothing and says why in its `refused`.
struct Reconfigure {
    Drawing drawing;
    bool operator==(const Reconfigure&) const = default;
};
// Server to client: send the model's blob from `offset`. Client to server: a part of it, as the body.
struct NeedModel {
    std::uint64_t offset = 0;
    bool operator==(const NeedModel&) const = default;
};
struct ModelPart {
    std::uint64_t offset = 0;
    bool operator==(const ModelPart&) const = default;
};
inline constexpr std::uint32_t kModelPartBytes = 4u << 20;

struct Ready {
    std::uint64_t objects = 0;
    std::uint64_t triangles = 0;
    std::string
        description;  // a server's: of the renderer, for people; a display's: address of its page, if any
    std::string refused{};  // why a Reconfigure cannot be done; else empty
    bool operator==(const Ready&) const = default;
};
// Client to server, when it is ready: connect to the display and to these servers; others will come by
// themselves. Connected answers when all of them have read our Hello.
struct Connect {
    struct Peer {
        ServerId server{};
        std::string address;  // "host:port"
        bool operator==(const Peer&) const = default;
    };
    std::string display;
    std::vector<Peer> peers;  // ascending
    bool operator==(const Connect&) const = default;
};
struct Connected {
    bool operator==(const Connected&) const = default;
};
// Server to client: begin no more frames with me. Bye answers when those that are open are over.
struct Leave {
    bool operator==(const Leave&) const = default;
};
// Server or display to client: the connection to that server has broken. What follows is the client's to say.
struct Lost {
    ServerId server{};
    std::string why;
    bool operator==(const Lost&) const = default;
};

// What goes to or comes from one server.
struct Exchange {
    ServerId server{};
    Region region;
    bool operator==(const Exchange&) const = default;
};

// Client to server: its share of a FramePlan.
struct RenderFrame {
    FrameNumber frame = 0;
    View view;
    std::vector<ObjectId> group;  // ascending
    Rect content;
    Region final_region;
    std::vector<Exchange> outgoing;
    std::vector<Exchange> incoming;
    bool operator==(const RenderFrame&) const = default;
};
// Client to display: what a frame consists of.
struct AssembleFrame {
    FrameNumber frame = 0;
    int width = 0;
    int height = 0;
    Rgb background{};
    std::vector<Exchange> tiles;
    std::uint32_t stream =
        0;  // which of kMaxStreams pictures side by side this is the newest of, for viewers
    bool operator==(const AssembleFrame&) const = default;
};
inline constexpr std::uint32_t kMaxStreams = 2;

// Server to server and server to display: pixels of a frame, as the body (common/image/pixel_codec.h).
struct SwathPixels {
    FrameNumber frame = 0;
    BodySizes sizes;
    bool operator==(const SwathPixels&) const = default;
};
struct TilePixels {
    FrameNumber frame = 0;
    BodySizes sizes;
    bool operator==(const TilePixels&) const = default;
};

// To the client: what a machine did for a frame, on its own clock. The display's says that the frame is
// complete and carries the encoded picture, if one was asked for, as the body.
struct Report {
    FrameNumber frame = 0;
    std::vector<Span> spans;
    std::array<std::uint64_t, kCounterCount> counters{};
    std::uint64_t& operator[](Counter c) { return counters[static_cast<std::size_t>(c)]; }
    bool operator==(const Report&) const = default;
};
struct ServerReport : Report {
    // For each object of the frame's group how many of its triangles were left after culling; or none at all:
    // nothing was culled, or they would be more than kMaxVisibleCounts.
    std::vector<std::uint32_t> visible;
    bool operator==(const ServerReport&) const = default;
};
struct DisplayReport : Report {
    bool operator==(const DisplayReport&) const = default;
};

// Display to client: how many people look, when a session begins and at every change. Only then do notes find
// anybody.
struct Audience {
    std::uint32_t viewers = 0;
    bool operator==(const Audience&) const = default;
};
// Display to client: what the leading viewer wants, as the body (JSON, docs/viewer.md), at most
// kMaxWishBytes.
struct Wish {
    std::uint32_t viewer = 0;  // who
    bool operator==(const Wish&) const = default;
};
inline constexpr std::size_t kMaxWishBytes = std::size_t{16} << 10;
// Client to display: something for viewers, as the body (JSON, docs/viewer.md), at most kMaxNoteBytes.
enum class NoteTopic : std::uint32_t { kPlan = 1, kSession, kObjects, kState, kFrame, kSpeedup, kTrace };
template <>
inline constexpr auto kNames<NoteTopic> = names_of<NoteTopic>("topic", {{NoteTopic::kPlan, "plan"},
                                                                        {NoteTopic::kSession, "session"},
                                                                        {NoteTopic::kObjects, "objects"},
                                                                        {NoteTopic::kState, "state"},
                                                                        {NoteTopic::kFrame, "frame"},
                                                                        {NoteTopic::kSpeedup, "speedup"},
                                                                        {NoteTopic::kTrace, "trace"}});
struct Note {
    NoteTopic topic = NoteTopic::kPlan;
    FrameNumber frame = 0;  // kPlan: whose, sent before its AssembleFrame
    bool operator==(const Note&) const = default;
};
inline constexpr std::size_t kMaxNoteBytes = std::size_t{8} << 20;

// The sender cannot go on and closes; one line for a person.
struct Failed {
    std::string what;
    bool operator==(const Failed&) const = default;
};
// A clean end: the connection's silence from now on is no failure.
struct Bye {
    bool operator==(const Bye&) const = default;
};

using Message =
    std::variant<Hello, Ping, Pong, ServerSetup, DisplaySetup, NeedModel, ModelPart, Ready, Connect,
                 Connected, RenderFrame, AssembleFrame, SwathPixels, TilePixels, ServerReport, DisplayReport,
                 Failed, Bye, Reconfigure, Audience, Wish, Note, Leave, Lost>;
std::string_view name(const Message& message);

}  // namespace swath
