#pragma once
#include <algorithm>
#include <concepts>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <span>
#include <type_traits>

#include "common/base/result.h"
#include "common/wire/messages.h"
#include "swath.pb.h"

// The fields of every message, once for both directions: what each is called in swath.proto, where it is in
// our struct, and its limits. `io` is a FieldWriter, for which `m` is const, or a FieldReader; `p` is the
// message as Protocol Buffers have it.

namespace swath {

template <class M, class Message>
concept Of = std::same_as<std::remove_const_t<M>, Message>;

inline Status check_size(std::uint32_t width, std::uint32_t height) {
    const auto limit = static_cast<std::uint32_t>(kMaxPictureSide);
    if (width < 1 || width > limit || height < 1 || height > limit ||
        std::int64_t{width} * height > kMaxPicturePixels)
        return fail("size: {}x{}, the limits are {} a side and {} pixels", width, height, limit,
                    kMaxPicturePixels);
    return {};
}

// The rectangles of a region do not overlap, so it has no more pixels than where it lies. (Whether they
// overlap is not worth finding out: pixels would be sent twice, no more.)
inline Status check_inside(const Region& region, const Rect& place, const char* name,
                           const char* place_name) {
    for (const Rect& r : region)
        if (!place.contains(r)) return fail("{}: a rectangle outside the {}", name, place_name);
    if (area(region) > place.area())
        return fail("{}: {} pixels, the {} has {}", name, area(region), place_name, place.area());
    return {};
}
inline Status check_inside(const std::vector<Exchange>& exchanges, const Rect& place, const char* name,
                           const char* place_name) {
    for (const Exchange& e : exchanges) SWATH_TRY_VOID(check_inside(e.region, place, name, place_name));
    return {};
}

bool ascend(const auto& of_servers) {
    const auto server = [](const auto& one) { return one.server; };
    return std::ranges::adjacent_find(of_servers, std::greater_equal(), server) == of_servers.end();
}

// A field of `p`: its name, its value and how to set it; and one that is a list or a message.
#define FIELD(name) \
#name, p.name(), [&p](const auto& value) { p.set_##name(static_cast<decltype(p.name())>(value)); }
#define PART(name) #name, *p.mutable_##name()

void fields(auto& io, Of<Hello> auto& m, pb::Hello& p) {
    io.named(m.role, FIELD(role));
    io.number(m.session, FIELD(session));
    io.index(m.server, FIELD(server), kMaxServers);
    io.number(m.max_head_bytes, FIELD(max_head_bytes));
    io.number(m.max_body_bytes, FIELD(max_body_bytes));
}

void fields(auto& io, Of<Ping> auto& m, pb::Ping& p) { io.time(m.sent, FIELD(sent_ns)); }

void fields(auto& io, Of<Pong> auto& m, pb::Pong& p) {
    io.time(m.sent, FIELD(sent_ns));
    io.time(m.peer, FIELD(peer_ns));
}

void fields(auto& io, Of<Drawing> auto& m, pb::Drawing& p) {
    io.at_most(m.cut.depth, FIELD(octree_depth), kMaxOctreeDepth);
    io.at_most(m.cut.objects, FIELD(sah_objects), kMaxObjectsAsked);
    io.check([&] {
        return m.cut.objects == 0 || m.cut.depth == 0
                   ? Status()
                   : fail("sah_objects: {}, and an octree_depth too", m.cut.objects);
    });
    io.derived(m.cut.by, [&] { return m.cut.objects > 0 ? ObjectsBy::kSah : ObjectsBy::kUniform; });
    io.each_named(m.renderers, PART(renderer), kMaxServers);
    io.named(m.cull, FIELD(cull));
    io.number(m.flags.shadows, FIELD(shadows));
    io.number(m.flags.dynamic, FIELD(dynamic));
}

void fields(auto& io, Of<ServerSetup> auto& m, pb::ServerSetup& p) {
    io.number(m.session, FIELD(session));
    io.index(m.server, FIELD(server), kMaxServers);
    io.text(m.model, FIELD(model));
    io.digest(m.digest, FIELD(digest));
    io.number(m.blob_bytes, FIELD(blob_bytes));
    fields(io, m.drawing, *p.mutable_drawing());
    io.within(m.frames_in_flight, FIELD(frames_in_flight), 1u, kMaxFramesInFlight);
}

void fields(auto& io, Of<DisplaySetup> auto& m, pb::DisplaySetup& p) {
    io.number(m.session, FIELD(session));
    io.named(m.format, FIELD(format));
    io.within(m.frames_in_flight, FIELD(frames_in_flight), 1u, kMaxFramesInFlight);
    io.number(m.live, FIELD(live));
}

void fields(auto& io, Of<Reconfigure> auto& m, pb::Reconfigure& p) {
    fields(io, m.drawing, *p.mutable_drawing());
}

void fields(auto& io, Of<NeedModel> auto& m, pb::NeedModel& p) { io.number(m.offset, FIELD(offset)); }

void fields(auto& io, Of<ModelPart> auto& m, pb::ModelPart& p) { io.number(m.offset, FIELD(offset)); }

void fields(auto& io, Of<Ready> auto& m, pb::Ready& p) {
    io.number(m.objects, FIELD(objects));
    io.number(m.triangles, FIELD(triangles));
    io.text(m.description, FIELD(description));
    io.reason(m.refused, FIELD(refused));
}

void fields(auto& io, Of<Connect::Peer> auto& m, pb::PeerAddress& p) {
    io.index(m.server, FIELD(server), kMaxServers);
    io.text(m.address, FIELD(address));
}

void fields(auto& io, Of<Connect> auto& m, pb::Connect& p) {
    io.text(m.display, FIELD(display));
    io.each(m.peers, PART(peers), kMaxServers, "");
    io.check([&] { return ascend(m.peers) ? Status() : fail("peers: not ascending"); });
}

void fields(auto&, Of<Connected> auto&, pb::Connected&) {}

void fields(auto&, Of<Leave> auto&, pb::Leave&) {}

void fields(auto& io, Of<Lost> auto& m, pb::Lost& p) {
    io.index(m.server, FIELD(server), kMaxServers);
    io.reason(m.why, FIELD(why));
}

void fields(auto& io, Of<Exchange> auto& m, pb::Exchange& p) {
    io.index(m.server, FIELD(server), kMaxServers);
    io.region(m.region, PART(region));
}

void exchange_fields(auto& io, auto& exchanges, const char* name, auto& list) {
    io.each(exchanges, name, list, kMaxServers, " entries");
    io.check([&] { return ascend(exchanges) ? Status() : fail("{}: servers are not ascending", name); });
}

void fields(auto& io, Of<RenderFrame> auto& m, pb::RenderFrame& p) {
    io.number(m.frame, FIELD(frame));
    io.check([&] {
        return p.clip_from_model_size() == 16 && p.to_light_size() == 3
                   ? Status()
                   : fail("view: a matrix of 16 and a vector of 3 are expected");
    });
    io.floats(std::span(glm::value_ptr(m.view.clip_from_model), 16), PART(clip_from_model));
    io.floats(std::span(glm::value_ptr(m.view.to_light), 3), PART(to_light));
    io.number(m.view.width, FIELD(width));
    io.number(m.view.height, FIELD(height));
    io.check([&] { return check_size(p.width(), p.height()); });
    io.within(m.view.pose, FIELD(pose), 0.0f, 1.0f);
    io.ids(m.group, "group", *p.mutable_group_steps());
    io.rect(m.content, PART(content));
    io.check([&] {
        return m.view.viewport().contains(m.content) ? Status() : fail("content: outside the viewport");
    });
    io.region(m.final_region, PART(final_region));
    io.check([&] { return check_inside(m.final_region, m.view.viewport(), "final_region", "viewport"); });
    exchange_fields(io, m.outgoing, PART(outgoing));
    io.check([&] { return check_inside(m.outgoing, m.content, "outgoing", "content"); });
    exchange_fields(io, m.incoming, PART(incoming));
    // A server composites only where it has drawn or owns pixels: it has memory for no others.
    io.check([&] {
        Rect cover = m.content;
        for (const Rect& r : m.final_region) cover = bounding(cover, r);
        return check_inside(m.incoming, cover, "incoming", "content and final region");
    });
}

void fields(auto& io, Of<AssembleFrame> auto& m, pb::AssembleFrame& p) {
    io.number(m.frame, FIELD(frame));
    io.number(m.width, FIELD(width));
    io.number(m.height, FIELD(height));
    io.check([&] { return check_size(p.width(), p.height()); });
    io.colour(m.background, FIELD(background));
    exchange_fields(io, m.tiles, PART(tiles));
    io.check([&] { return check_inside(m.tiles, {0, 0, m.width, m.height}, "tiles", "picture"); });
    io.below(m.stream, FIELD(stream), kMaxStreams);
}

void pixel_fields(auto& io, auto& m, pb::Pixels& p) {
    io.number(m.frame, FIELD(frame));
    io.number(m.sizes.pixels, FIELD(pixels));
    io.number(m.sizes.span_bytes, FIELD(span_bytes));
    io.number(m.sizes.id_bytes, FIELD(id_bytes));
}
void fields(auto& io, Of<SwathPixels> auto& m, pb::Pixels& p) { pixel_fields(io, m, p); }
void fields(auto& io, Of<TilePixels> auto& m, pb::Pixels& p) { pixel_fields(io, m, p); }

void fields(auto& io, Of<Span> auto& m, pb::SpanRecord& p) {
    io.index(m.phase, FIELD(phase), kPhaseCount);
    io.time(m.begin, FIELD(begin_ns));
    io.time(m.end, FIELD(end_ns));
    io.time(m.cpu, FIELD(cpu_ns));
    io.check([&] { return m.end >= m.begin ? Status() : fail("spans: one ends before it begins"); });
}

void report_fields(auto& io, auto& m, pb::Report& p) {
    io.number(m.frame, FIELD(frame));
    io.each(m.spans, PART(spans), kMaxSpans, "");
    io.numbers(m.counters, PART(counters));
}
void fields(auto& io, Of<ServerReport> auto& m, pb::Report& p) {
    report_fields(io, m, p);
    io.numbers(m.visible, PART(visible), kMaxVisibleCounts);
}
void fields(auto& io, Of<DisplayReport> auto& m, pb::Report& p) { report_fields(io, m, p); }

void fields(auto& io, Of<Audience> auto& m, pb::Audience& p) { io.number(m.viewers, FIELD(viewers)); }

void fields(auto& io, Of<Wish> auto& m, pb::Wish& p) { io.number(m.viewer, FIELD(viewer)); }

void fields(auto& io, Of<Note> auto& m, pb::Note& p) {
    io.named(m.topic, FIELD(topic));
    io.number(m.frame, FIELD(frame));
}

void fields(auto& io, Of<Failed> auto& m, pb::Failed& p) { io.reason(m.what, FIELD(what)); }

void fields(auto&, Of<Bye> auto&, pb::Bye&) {}

#undef FIELD
#undef PART

}  // namespace swath
