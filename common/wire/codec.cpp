#include "common/wire/codec.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "common/scene/objects.h"
#include "swath.pb.h"

namespace swath {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{'S', 'W', 'T', 'H'};
constexpr std::size_t kMaxNameBytes = 4096;
// 73 years. Sums and differences of two times fit in 64 bits.
constexpr std::int64_t kMaxTimeNs = std::int64_t{1} << 61;

void put(std::uint8_t* to, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}
std::uint32_t get(const std::uint8_t* from, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::uint32_t{from[i]} << (8 * i);
    return value;
}

// --- our values to protobuf's

void put_region(const Region& region, google::protobuf::RepeatedField<std::int32_t>& out) {
    out.Reserve(static_cast<int>(4 * region.size()));
    for (const Rect& r : region)
        for (const int v : {r.x0, r.y0, r.x1, r.y1}) out.Add(v);
}

void put_exchanges(const std::vector<Exchange>& exchanges,
                   google::protobuf::RepeatedPtrField<pb::Exchange>& out) {
    for (const Exchange& e : exchanges) {
        pb::Exchange& to = *out.Add();
        to.set_server(static_cast<std::uint32_t>(e.server));
        put_region(e.region, *to.mutable_region());
    }
}

void put_drawing(const Drawing& drawing, pb::Drawing& out) {
    out.set_octree_depth(static_cast<std::uint32_t>(drawing.cut.depth));
    out.set_sah_objects(static_cast<std::uint32_t>(drawing.cut.objects));
    for (const RendererKind kind : drawing.renderers) out.add_renderer(static_cast<std::uint32_t>(kind));
    out.set_cull(static_cast<std::uint32_t>(drawing.cull));
    out.set_shadows(drawing.flags.shadows);
    out.set_dynamic(drawing.flags.dynamic);
}

void put_report(const Report& m, pb::Report& out) {
    out.set_frame(m.frame);
    for (const Span& s : m.spans) {
        pb::SpanRecord& to = *out.add_spans();
        to.set_phase(static_cast<std::uint32_t>(s.phase));
        to.set_begin_ns(s.begin.count());
        to.set_end_ns(s.end.count());
        to.set_cpu_ns(s.cpu.count());
    }
    for (const std::uint64_t c : m.counters) out.add_counters(c);
}

template <class Pixels>
void put_pixels(const Pixels& m, pb::Pixels& out) {
    out.set_frame(m.frame);
    out.set_pixels(m.sizes.pixels);
    out.set_span_bytes(m.sizes.span_bytes);
    out.set_id_bytes(m.sizes.id_bytes);
}

struct Encoder {
    pb::Head& head;

    void operator()(const Hello& m) const {
        pb::Hello& out = *head.mutable_hello();
        out.set_role(static_cast<std::uint32_t>(m.role));
        out.set_session(m.session);
        out.set_server(static_cast<std::uint32_t>(m.server));
        out.set_max_head_bytes(m.max_head_bytes);
        out.set_max_body_bytes(m.max_body_bytes);
    }
    void operator()(const Ping& m) const { head.mutable_ping()->set_sent_ns(m.sent.count()); }
    void operator()(const Pong& m) const {
        head.mutable_pong()->set_sent_ns(m.sent.count());
        head.mutable_pong()->set_peer_ns(m.peer.count());
    }
    void operator()(const ServerSetup& m) const {
        pb::ServerSetup& out = *head.mutable_server_setup();
        out.set_session(m.session);
        out.set_server(static_cast<std::uint32_t>(m.server));
        out.set_model(m.model);
        out.set_digest(m.digest.data(), m.digest.size());
        out.set_blob_bytes(m.blob_bytes);
        put_drawing(m.drawing, *out.mutable_drawing());
        out.set_frames_in_flight(m.frames_in_flight);
    }
    void operator()(const DisplaySetup& m) const {
        pb::DisplaySetup& out = *head.mutable_display_setup();
        out.set_session(m.session);
        out.set_format(static_cast<std::uint32_t>(m.format));
        out.set_frames_in_flight(m.frames_in_flight);
        out.set_live(m.live);
    }
    void operator()(const Reconfigure& m) const {
        put_drawing(m.drawing, *head.mutable_reconfigure()->mutable_drawing());
    }
    void operator()(const NeedModel& m) const { head.mutable_need_model()->set_offset(m.offset); }
    void operator()(const ModelPart& m) const { head.mutable_model_part()->set_offset(m.offset); }
    void operator()(const Ready& m) const {
        pb::Ready& out = *head.mutable_ready();
        out.set_objects(m.objects);
        out.set_triangles(m.triangles);
        out.set_description(m.description);
        out.set_refused(m.refused.substr(0, kMaxNameBytes));
    }
    void operator()(const Connect& m) const {
        pb::Connect& out = *head.mutable_connect();
        out.set_display(m.display);
        for (const Connect::Peer& peer : m.peers) {
            pb::PeerAddress& to = *out.add_peers();
            to.set_server(static_cast<std::uint32_t>(peer.server));
            to.set_address(peer.address);
        }
    }
    void operator()(const Connected&) const { head.mutable_connected(); }
    void operator()(const Leave&) const { head.mutable_leave(); }
    void operator()(const Lost& m) const {
        head.mutable_lost()->set_server(static_cast<std::uint32_t>(m.server));
        head.mutable_lost()->set_why(m.why.substr(0, kMaxNameBytes));
    }
    void operator()(const RenderFrame& m) const {
        pb::RenderFrame& out = *head.mutable_render_frame();
        out.set_frame(m.frame);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) out.add_clip_from_model(m.view.clip_from_model[c][r]);
        for (int i = 0; i < 3; ++i) out.add_to_light(m.view.to_light[i]);
        out.set_width(static_cast<std::uint32_t>(m.view.width));
        out.set_height(static_cast<std::uint32_t>(m.view.height));
        out.mutable_group_steps()->Reserve(static_cast<int>(m.group.size()));
        ObjectId previous = 0;
        for (const ObjectId id : m.group) {
            out.add_group_steps(id - previous);
            previous = id;
        }
        put_region({m.content}, *out.mutable_content());
        put_region(m.final_region, *out.mutable_final_region());
        put_exchanges(m.outgoing, *out.mutable_outgoing());
        put_exchanges(m.incoming, *out.mutable_incoming());
        out.set_pose(m.view.pose);
    }
    void operator()(const AssembleFrame& m) const {
        pb::AssembleFrame& out = *head.mutable_assemble_frame();
        out.set_frame(m.frame);
        out.set_width(static_cast<std::uint32_t>(m.width));
        out.set_height(static_cast<std::uint32_t>(m.height));
        out.set_background(std::uint32_t{m.background[0]} << 16 | std::uint32_t{m.background[1]} << 8 |
                           m.background[2]);
        put_exchanges(m.tiles, *out.mutable_tiles());
        out.set_stream(m.stream);
    }
    void operator()(const SwathPixels& m) const { put_pixels(m, *head.mutable_swath()); }
    void operator()(const TilePixels& m) const { put_pixels(m, *head.mutable_tile()); }
    void operator()(const ServerReport& m) const {
        pb::Report& out = *head.mutable_server_report();
        put_report(m, out);
        out.mutable_visible()->Add(m.visible.begin(), m.visible.end());
    }
    void operator()(const DisplayReport& m) const { put_report(m, *head.mutable_display_report()); }
    void operator()(const Audience& m) const { head.mutable_audience()->set_viewers(m.viewers); }
    void operator()(const Wish& m) const { head.mutable_wish()->set_viewer(m.viewer); }
    void operator()(const Note& m) const {
        head.mutable_note()->set_topic(static_cast<std::uint32_t>(m.topic));
        head.mutable_note()->set_frame(m.frame);
    }
    void operator()(const Failed& m) const {
        head.mutable_failed()->set_what(m.what.substr(0, kMaxNameBytes));
    }
    void operator()(const Bye&) const { head.mutable_bye(); }
};

// --- protobuf's values to ours, checked

Result<Region> get_region(const google::protobuf::RepeatedField<std::int32_t>& in, const char* field) {
    if (in.size() % 4 != 0) return fail("{}: {} numbers are no rectangles", field, in.size());
    Region region;
    region.reserve(static_cast<std::size_t>(in.size() / 4));
    for (int i = 0; i < in.size(); i += 4) {
        const Rect r{in[i], in[i + 1], in[i + 2], in[i + 3]};
        if (r.empty() || r.x0 < 0 || r.y0 < 0 || r.x1 > kMaxPictureSide || r.y1 > kMaxPictureSide)
            return fail("{}: a rectangle that is empty or leaves 0 to {}", field, kMaxPictureSide);
        region.push_back(r);
    }
    return region;
}

Result<ServerId> get_server(std::uint32_t id, const char* field) {
    if (id >= kMaxServers) return fail("{}: server {}, the limit is {}", field, id, kMaxServers);
    return static_cast<ServerId>(id);
}

Result<std::vector<Exchange>> get_exchanges(const google::protobuf::RepeatedPtrField<pb::Exchange>& in,
                                            const char* field) {
    if (static_cast<std::size_t>(in.size()) > kMaxServers)
        return fail("{}: {} entries, the limit is {}", field, in.size(), kMaxServers);
    std::vector<Exchange> exchanges;
    for (const pb::Exchange& e : in) {
        const auto server = get_server(e.server(), field);
        if (!server) return tl::unexpected(server.error());
        if (!exchanges.empty() && exchanges.back().server >= *server)
            return fail("{}: servers are not ascending", field);
        auto region = get_region(e.region(), field);
        if (!region) return tl::unexpected(region.error());
        exchanges.push_back({*server, std::move(*region)});
    }
    return exchanges;
}

// The rectangles of a region do not overlap, so it has no more pixels than where it lies. (Whether they
// overlap is not worth finding out: pixels would be sent twice, no more.)
Status check_inside(const Region& region, const Rect& place, const char* field, const char* place_name) {
    for (const Rect& r : region)
        if (!place.contains(r)) return fail("{}: a rectangle outside the {}", field, place_name);
    if (area(region) > place.area())
        return fail("{}: {} pixels, the {} has {}", field, area(region), place_name, place.area());
    return {};
}

bool is_time(std::int64_t ns) { return ns >= 0 && ns <= kMaxTimeNs; }

Status check_time(std::int64_t ns, const char* field) {
    if (!is_time(ns)) return fail("{}: outside of 0 to {}", field, kMaxTimeNs);
    return {};
}

Status check_size(std::uint32_t width, std::uint32_t height) {
    const auto limit = static_cast<std::uint32_t>(kMaxPictureSide);
    if (width < 1 || width > limit || height < 1 || height > limit ||
        std::int64_t{width} * height > kMaxPicturePixels)
        return fail("size: {}x{}, the limits are {} a side and {} pixels", width, height, limit,
                    kMaxPicturePixels);
    return {};
}

Status check_in_flight(std::uint32_t frames) {
    if (frames < 1 || frames > kMaxFramesInFlight)
        return fail("frames_in_flight: {}, the limits are 1 and {}", frames, kMaxFramesInFlight);
    return {};
}

Status check_text(const std::string& text, const char* field) {
    if (text.size() > kMaxNameBytes)
        return fail("{}: {} bytes, the limit is {}", field, text.size(), kMaxNameBytes);
    return {};
}

template <class M>
Result<M> get_report(const pb::Report& in) {
    M m;
    m.frame = in.frame();
    if (in.spans_size() > 4096) return fail("spans: {}, the limit is 4096", in.spans_size());
    for (const pb::SpanRecord& s : in.spans()) {
        if (s.phase() >= kPhaseCount) return fail("spans: phase {}, the limit is {}", s.phase(), kPhaseCount);
        for (const std::int64_t ns : {s.begin_ns(), s.end_ns(), s.cpu_ns()})
            if (!is_time(ns)) return fail("spans: a time outside of 0 to {}", kMaxTimeNs);
        if (s.end_ns() < s.begin_ns()) return fail("spans: one ends before it begins");
        m.spans.push_back({static_cast<Phase>(s.phase()), Nanoseconds(s.begin_ns()), Nanoseconds(s.end_ns()),
                           Nanoseconds(s.cpu_ns())});
    }
    if (in.counters_size() != static_cast<int>(kCounterCount))
        return fail("counters: {} where {} are expected", in.counters_size(), kCounterCount);
    for (int i = 0; i < in.counters_size(); ++i) m.counters[static_cast<std::size_t>(i)] = in.counters(i);
    return m;
}

Result<Message> get_server_report(const pb::Report& in) {
    if (static_cast<std::size_t>(in.visible_size()) > kMaxVisibleCounts)
        return fail("visible: {} counts, the limit is {}", in.visible_size(), kMaxVisibleCounts);
    auto report = get_report<ServerReport>(in);
    if (!report) return tl::unexpected(report.error());
    report->visible.assign(in.visible().begin(), in.visible().end());
    return *std::move(report);
}

template <class M>
M get_pixels(const pb::Pixels& in) {
    return M{in.frame(), {in.pixels(), in.span_bytes(), in.id_bytes()}};
}

Result<Message> get_hello(const pb::Hello& in) {
    if (!value_of<Role>(in.role())) return fail("role: {} is none", in.role());
    const auto server = get_server(in.server(), "server");
    if (!server) return tl::unexpected(server.error());
    return Hello{static_cast<Role>(in.role()), in.session(), *server, in.max_head_bytes(),
                 in.max_body_bytes()};
}

Result<Drawing> get_drawing(const pb::Drawing& in) {
    if (in.octree_depth() > static_cast<std::uint32_t>(kMaxOctreeDepth))
        return fail("octree_depth: {}, the limit is {}", in.octree_depth(), kMaxOctreeDepth);
    if (in.sah_objects() > kMaxObjectsAsked)
        return fail("sah_objects: {}, the limit is {}", in.sah_objects(), kMaxObjectsAsked);
    if (in.sah_objects() > 0 && in.octree_depth() > 0)
        return fail("sah_objects: {}, and an octree_depth too", in.sah_objects());
    if (in.renderer_size() < 1 || static_cast<std::size_t>(in.renderer_size()) > kMaxServers)
        return fail("renderer: {}, the limits are 1 and {}", in.renderer_size(), kMaxServers);
    if (!value_of<CullAlgorithm>(in.cull())) return fail("cull: {} is none", in.cull());
    Drawing drawing;
    drawing.cut = {ObjectsBy::kUniform, static_cast<int>(in.octree_depth())};
    if (in.sah_objects() > 0) drawing.cut = {ObjectsBy::kSah, 0, in.sah_objects()};
    drawing.renderers.clear();
    for (const std::uint32_t kind : in.renderer()) {
        if (!value_of<RendererKind>(kind)) return fail("renderer: {} is none", kind);
        drawing.renderers.push_back(static_cast<RendererKind>(kind));
    }
    drawing.cull = static_cast<CullAlgorithm>(in.cull());
    drawing.flags = {in.shadows(), in.dynamic()};
    return drawing;
}

Result<Message> get_server_setup(const pb::ServerSetup& in) {
    ServerSetup m;
    m.session = in.session();
    const auto server = get_server(in.server(), "server");
    if (!server) return tl::unexpected(server.error());
    m.server = *server;
    if (const auto s = check_text(in.model(), "model"); !s) return tl::unexpected(s.error());
    m.model = in.model();
    if (in.digest().size() != m.digest.size())
        return fail("digest: {} bytes where {} are expected", in.digest().size(), m.digest.size());
    std::memcpy(m.digest.data(), in.digest().data(), m.digest.size());
    m.blob_bytes = in.blob_bytes();
    const auto drawing = get_drawing(in.drawing());
    if (!drawing) return tl::unexpected(drawing.error());
    m.drawing = *drawing;
    if (const auto s = check_in_flight(in.frames_in_flight()); !s) return tl::unexpected(s.error());
    m.frames_in_flight = in.frames_in_flight();
    return m;
}

Result<Message> get_display_setup(const pb::DisplaySetup& in) {
    if (!value_of<PictureFormat>(in.format())) return fail("format: {} is none", in.format());
    if (const auto s = check_in_flight(in.frames_in_flight()); !s) return tl::unexpected(s.error());
    return DisplaySetup{in.session(), static_cast<PictureFormat>(in.format()), in.frames_in_flight(),
                        in.live()};
}

Result<Message> get_connect(const pb::Connect& in) {
    Connect m;
    if (const auto s = check_text(in.display(), "display"); !s) return tl::unexpected(s.error());
    m.display = in.display();
    if (static_cast<std::size_t>(in.peers_size()) > kMaxServers)
        return fail("peers: {}, the limit is {}", in.peers_size(), kMaxServers);
    for (const pb::PeerAddress& peer : in.peers()) {
        const auto server = get_server(peer.server(), "peers");
        if (!server) return tl::unexpected(server.error());
        if (!m.peers.empty() && m.peers.back().server >= *server) return fail("peers: not ascending");
        if (const auto s = check_text(peer.address(), "peers"); !s) return tl::unexpected(s.error());
        m.peers.push_back({*server, peer.address()});
    }
    return m;
}

Result<View> get_view(const pb::RenderFrame& in) {
    if (in.clip_from_model_size() != 16 || in.to_light_size() != 3)
        return fail("view: a matrix of 16 and a vector of 3 are expected");
    View view;
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(in.clip_from_model(i))) return fail("clip_from_model: not a finite number");
        view.clip_from_model[i / 4][i % 4] = in.clip_from_model(i);
    }
    for (int i = 0; i < 3; ++i) {
        if (!std::isfinite(in.to_light(i))) return fail("to_light: not a finite number");
        view.to_light[i] = in.to_light(i);
    }
    if (const auto s = check_size(in.width(), in.height()); !s) return tl::unexpected(s.error());
    view.width = static_cast<int>(in.width());
    view.height = static_cast<int>(in.height());
    if (!(in.pose() >= 0 && in.pose() <= 1)) return fail("pose: {}, the limits are 0 and 1", in.pose());
    view.pose = in.pose();
    return view;
}

Result<Message> get_render_frame(const pb::RenderFrame& in) {
    RenderFrame m;
    m.frame = in.frame();
    const auto view = get_view(in);
    if (!view) return tl::unexpected(view.error());
    m.view = *view;
    m.group.reserve(static_cast<std::size_t>(in.group_steps_size()));
    std::uint64_t id = 0;
    for (const std::uint32_t step : in.group_steps()) {
        if (step == 0 && !m.group.empty()) return fail("group: ids are not ascending");
        id += step;
        if (id >= kMaxObjects) return fail("group: object {}, the limit is {}", id, kMaxObjects);
        m.group.push_back(static_cast<ObjectId>(id));
    }
    const Rect viewport = m.view.viewport();
    if (in.content_size() != 4) return fail("content: one rectangle is expected");
    m.content = {in.content(0), in.content(1), in.content(2), in.content(3)};
    if (m.content.empty()) m.content = {};
    if (!viewport.contains(m.content)) return fail("content: outside the viewport");
    auto region = get_region(in.final_region(), "final_region");
    if (!region) return tl::unexpected(region.error());
    m.final_region = std::move(*region);
    if (const auto s = check_inside(m.final_region, viewport, "final_region", "viewport"); !s)
        return tl::unexpected(s.error());
    // What comes is merged where the server has drawn or owns pixels: it has memory for no others.
    Rect cover = m.content;
    for (const Rect& r : m.final_region) cover = bounding(cover, r);
    for (const auto& [from, to, field, place, place_name] :
         {std::tuple(&in.outgoing(), &m.outgoing, "outgoing", m.content, "content"),
          std::tuple(&in.incoming(), &m.incoming, "incoming", cover, "content and final region")}) {
        auto exchanges = get_exchanges(*from, field);
        if (!exchanges) return tl::unexpected(exchanges.error());
        *to = std::move(*exchanges);
        for (const Exchange& e : *to)
            if (const auto s = check_inside(e.region, place, field, place_name); !s)
                return tl::unexpected(s.error());
    }
    return m;
}

Result<Message> get_assemble_frame(const pb::AssembleFrame& in) {
    AssembleFrame m;
    m.frame = in.frame();
    if (const auto s = check_size(in.width(), in.height()); !s) return tl::unexpected(s.error());
    m.width = static_cast<int>(in.width());
    m.height = static_cast<int>(in.height());
    if (in.background() > 0xffffff) return fail("background: {:#x}, the limit is 0xffffff", in.background());
    m.background = {static_cast<std::uint8_t>(in.background() >> 16),
                    static_cast<std::uint8_t>(in.background() >> 8),
                    static_cast<std::uint8_t>(in.background())};
    auto tiles = get_exchanges(in.tiles(), "tiles");
    if (!tiles) return tl::unexpected(tiles.error());
    m.tiles = std::move(*tiles);
    for (const Exchange& e : m.tiles)
        if (const auto s = check_inside(e.region, {0, 0, m.width, m.height}, "tiles", "picture"); !s)
            return tl::unexpected(s.error());
    if (in.stream() >= kMaxStreams) return fail("stream: {}, the limit is {}", in.stream(), kMaxStreams);
    m.stream = in.stream();
    return m;
}

Result<Message> get_note(const pb::Note& in) {
    if (!value_of<NoteTopic>(in.topic())) return fail("topic: {} is none", in.topic());
    return Note{static_cast<NoteTopic>(in.topic()), in.frame()};
}

Result<Message> get_message(const pb::Head& head) {
    switch (head.kind_case()) {
        case pb::Head::kHello:
            return get_hello(head.hello());
        case pb::Head::kPing:
            if (const auto s = check_time(head.ping().sent_ns(), "sent_ns"); !s)
                return tl::unexpected(s.error());
            return Ping{Nanoseconds(head.ping().sent_ns())};
        case pb::Head::kPong:
            if (const auto s = check_time(head.pong().sent_ns(), "sent_ns"); !s)
                return tl::unexpected(s.error());
            if (const auto s = check_time(head.pong().peer_ns(), "peer_ns"); !s)
                return tl::unexpected(s.error());
            return Pong{Nanoseconds(head.pong().sent_ns()), Nanoseconds(head.pong().peer_ns())};
        case pb::Head::kServerSetup:
            return get_server_setup(head.server_setup());
        case pb::Head::kDisplaySetup:
            return get_display_setup(head.display_setup());
        case pb::Head::kNeedModel:
            return NeedModel{head.need_model().offset()};
        case pb::Head::kModelPart:
            return ModelPart{head.model_part().offset()};
        case pb::Head::kReady:
            if (const auto s = check_text(head.ready().description(), "description"); !s)
                return tl::unexpected(s.error());
            if (const auto s = check_text(head.ready().refused(), "refused"); !s)
                return tl::unexpected(s.error());
            return Ready{head.ready().objects(), head.ready().triangles(), head.ready().description(),
                         head.ready().refused()};
        case pb::Head::kConnect:
            return get_connect(head.connect());
        case pb::Head::kConnected:
            return Connected{};
        case pb::Head::kRenderFrame:
            return get_render_frame(head.render_frame());
        case pb::Head::kAssembleFrame:
            return get_assemble_frame(head.assemble_frame());
        case pb::Head::kSwath:
            return get_pixels<SwathPixels>(head.swath());
        case pb::Head::kTile:
            return get_pixels<TilePixels>(head.tile());
        case pb::Head::kServerReport:
            return get_server_report(head.server_report());
        case pb::Head::kDisplayReport:
            return get_report<DisplayReport>(head.display_report());
        case pb::Head::kFailed:
            if (const auto s = check_text(head.failed().what(), "what"); !s) return tl::unexpected(s.error());
            return Failed{head.failed().what()};
        case pb::Head::kBye:
            return Bye{};
        case pb::Head::kReconfigure: {
            const auto drawing = get_drawing(head.reconfigure().drawing());
            return drawing ? Result<Message>(Reconfigure{*drawing}) : tl::unexpected(drawing.error());
        }
        case pb::Head::kAudience:
            return Audience{head.audience().viewers()};
        case pb::Head::kWish:
            return Wish{head.wish().viewer()};
        case pb::Head::kNote:
            return get_note(head.note());
        case pb::Head::kLeave:
            return Leave{};
        case pb::Head::kLost: {
            const auto server = get_server(head.lost().server(), "server");
            if (!server) return tl::unexpected(server.error());
            if (const auto s = check_text(head.lost().why(), "why"); !s) return tl::unexpected(s.error());
            return Lost{*server, head.lost().why()};
        }
        case pb::Head::KIND_NOT_SET:
            break;
    }
    return fail("a message of no kind that this version knows");
}

}  // namespace

std::array<std::uint8_t, kPrefixBytes> encode_prefix(const Prefix& prefix) {
    std::array<std::uint8_t, kPrefixBytes> bytes{};
    std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
    put(&bytes[4], kWireVersion, 2);
    put(&bytes[8], prefix.head_bytes, 4);
    put(&bytes[12], prefix.body_bytes, 4);
    return bytes;
}

Result<Prefix> decode_prefix(std::span<const std::uint8_t, kPrefixBytes> bytes, const WireLimits& limits) {
    if (std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) return fail("not a Swath message");
    if (const std::uint32_t version = get(&bytes[4], 2); version != kWireVersion)
        return fail("speaks version {} of the protocol, this program speaks {}", version, kWireVersion);
    if (get(&bytes[6], 2) != 0) return fail("a garbled message prefix");
    const Prefix prefix{get(&bytes[8], 4), get(&bytes[12], 4)};
    if (prefix.head_bytes > limits.max_head_bytes)
        return fail("a message head of {} bytes, the limit is {}", prefix.head_bytes, limits.max_head_bytes);
    if (prefix.body_bytes > limits.max_body_bytes)
        return fail("a message body of {} bytes, the limit is {}", prefix.body_bytes, limits.max_body_bytes);
    return prefix;
}

std::string encode_head(const Message& message) {
    pb::Head head;
    std::visit(Encoder{head}, message);
    return head.SerializeAsString();
}

Result<Message> decode_head(std::span<const std::uint8_t> bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        return fail("a message head that is too long");
    pb::Head head;
    if (!head.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
        return fail("a garbled message head");
    auto message = get_message(head);
    if (!message && head.kind_case() != pb::Head::KIND_NOT_SET) {
        const auto* field = pb::Head::descriptor()->FindFieldByNumber(static_cast<int>(head.kind_case()));
        return fail("a garbled {} message: {}", field->name(), message.error().message);
    }
    return message;
}

std::string_view name(const Message& message) {
    static constexpr std::array<std::string_view, std::variant_size_v<Message>> kNames{
        "Hello",       "Ping",       "Pong",         "ServerSetup",   "DisplaySetup", "NeedModel",
        "ModelPart",   "Ready",      "Connect",      "Connected",     "RenderFrame",  "AssembleFrame",
        "SwathPixels", "TilePixels", "ServerReport", "DisplayReport", "Failed",       "Bye",
        "Reconfigure", "Audience",   "Wish",         "Note",          "Leave",        "Lost"};
    return kNames[message.index()];
}

}  // namespace swath
