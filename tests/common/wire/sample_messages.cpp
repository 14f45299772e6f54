#include "tests/common/wire/sample_messages.h"

#include <random>

#include "common/scene/objects.h"

namespace swath::test {
namespace {

class Maker {
  public:
    explicit Maker(std::uint32_t seed) : random_(seed) {}

    std::uint32_t u32() { return static_cast<std::uint32_t>(random_()); }
    std::uint64_t u64() { return std::uint64_t{u32()} << 32 | u32(); }
    std::uint32_t below(std::uint32_t limit) { return u32() % limit; }
    // Times up to the largest that travels, small ones too.
    template <NamedEnum E>
    E any() {
        return kAll<E>[below(static_cast<std::uint32_t>(kAll<E>.size()))];
    }
    Nanoseconds time() { return Nanoseconds(static_cast<std::int64_t>(u64() >> (3 + below(61)))); }
    ServerId server() { return server_id(below(kMaxServers)); }
    float number() { return static_cast<float>(static_cast<std::int32_t>(u32())) / 65536.0f; }
    std::string text() {
        std::string made(below(40), '\0');
        for (char& c : made) c = static_cast<char>(u32());  // paths are bytes, not always UTF-8
        return made;
    }
    Rect rect(const Rect& in) {
        const auto side = [&](int low, int high, int& from, int& to) {
            from = low + static_cast<int>(below(static_cast<std::uint32_t>(high - low)));
            to = from + 1 + static_cast<int>(below(static_cast<std::uint32_t>(high - from)));
        };
        Rect r;
        side(in.x0, in.x1, r.x0, r.x1);
        side(in.y0, in.y1, r.y0, r.y1);
        return r;
    }
    // Disjoint columns of `in`, each cut to some rows.
    Region region(const Rect& in) {
        Region made;
        const std::uint32_t step = 1 + below(static_cast<std::uint32_t>(in.width()));
        for (int x = in.x0; x < in.x1 && made.size() < 20; x += static_cast<int>(step))
            made.push_back(rect({x, in.y0, std::min(x + static_cast<int>(step), in.x1), in.y1}));
        return made;
    }
    std::vector<Exchange> exchanges(const Rect& in) {
        std::vector<Exchange> made;
        for (std::uint32_t s = below(5); s < 12; s += 1 + below(5))
            made.push_back({server_id(s), region(in)});
        return made;
    }
    int side() { return 1 + static_cast<int>(below(below(2) == 0 ? 40 : 8192)); }

    RenderFrame render_frame() {
        RenderFrame m;
        m.frame = u64();
        m.view.width = side();
        m.view.height = side();
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) m.view.clip_from_model[c][r] = number();
        m.view.to_light = {number(), number(), number()};
        m.view.pose = static_cast<float>(below(5)) / 4;
        for (std::uint64_t id = below(3); id < kMaxObjects && m.group.size() < 50;
             id += 1 + below(1u << below(32)))
            m.group.push_back(static_cast<ObjectId>(id));
        if (below(4) != 0) m.content = rect(m.view.viewport());
        m.final_region = region(m.view.viewport());
        if (!m.content.empty()) {
            m.outgoing = exchanges(m.content);
            m.incoming = exchanges(m.content);
        }
        return m;
    }
    AssembleFrame assemble_frame() {
        AssembleFrame m{u64(), side(), side(), {}, {}};
        for (std::uint8_t& c : m.background) c = static_cast<std::uint8_t>(u32());
        // Tiles must not overlap: each server has a column.
        const int step = (m.width + 11) / 12;
        for (int i = 0; i * step < m.width; ++i)
            if (below(3) != 0)
                m.tiles.push_back({server_id(static_cast<std::size_t>(i)),
                                   region({i * step, 0, std::min((i + 1) * step, m.width), m.height})});
        return m;
    }
    ServerSetup server_setup() {
        ServerSetup m;
        m.session = u64();
        m.server = server();
        m.model = text();
        for (std::uint8_t& byte : m.digest) byte = static_cast<std::uint8_t>(u32());
        m.blob_bytes = u64();
        m.drawing = drawing();
        m.frames_in_flight = 1 + below(kMaxFramesInFlight);
        return m;
    }
    DisplaySetup display_setup() {
        const auto format = any<PictureFormat>();
        return {u64(), format, 1 + below(kMaxFramesInFlight), below(2) == 0};
    }
    Drawing drawing() {
        const Cut uniform{ObjectsBy::kUniform, static_cast<int>(below(kMaxOctreeDepth + 1)), 0};
        const Cut sah{ObjectsBy::kSah, 0, 1 + below(kMaxObjectsAsked)};
        Drawing m;
        m.cut = below(2) == 0 ? uniform : sah;
        m.renderers.resize(1 + below(3));
        for (RendererKind& kind : m.renderers) kind = any<RendererKind>();
        m.cull = any<CullAlgorithm>();
        m.flags = {below(2) == 0, below(2) == 0};
        return m;
    }
    Connect connect() {
        Connect m{text(), {}};
        for (std::uint32_t id = below(3); id < kMaxServers && m.peers.size() < 20; id += 1 + below(90))
            m.peers.push_back({server_id(id), text()});
        return m;
    }
    Note note() { return {any<NoteTopic>(), u64()}; }
    template <class M>
    M report() {
        M m;
        m.frame = u64();
        for (std::uint32_t i = below(20); i > 0; --i) {
            const Nanoseconds begin = time() / 2;
            m.spans.push_back({static_cast<Phase>(below(static_cast<std::uint32_t>(kPhaseCount))), begin,
                               begin + time() / 2, time()});
        }
        for (std::uint64_t& c : m.counters) c = u64();
        return m;
    }
    ServerReport server_report() {
        auto m = report<ServerReport>();
        m.visible.resize(below(3) == 0 ? 0 : below(100));
        for (std::uint32_t& count : m.visible) count = u32() >> below(32);
        return m;
    }
    Hello hello() { return {static_cast<Role>(1 + below(4)), u64(), server(), u32(), u32()}; }
    BodySizes sizes() { return {u32(), u32(), u32()}; }

  private:
    std::mt19937 random_;  // its numbers are the same everywhere, unlike those of distributions
};

}  // namespace

std::vector<Message> sample_messages(std::uint32_t seed) {
    Maker make(seed);
    std::vector<Message> all;
    all.emplace_back(make.hello());
    all.emplace_back(Ping{make.time()});
    all.emplace_back(Pong{make.time(), make.time()});
    all.emplace_back(make.server_setup());
    all.emplace_back(make.display_setup());
    all.emplace_back(NeedModel{make.u64()});
    all.emplace_back(ModelPart{make.u64()});
    all.emplace_back(Ready{make.u64(), make.u64(), make.text(), make.text()});
    all.emplace_back(make.connect());
    all.emplace_back(Connected{});
    all.emplace_back(make.render_frame());
    all.emplace_back(make.assemble_frame());
    all.emplace_back(SwathPixels{make.u64(), make.sizes()});
    all.emplace_back(TilePixels{make.u64(), make.sizes()});
    all.emplace_back(make.server_report());
    all.emplace_back(make.report<DisplayReport>());
    all.emplace_back(Failed{make.text()});
    all.emplace_back(Bye{});
    all.emplace_back(Reconfigure{make.drawing()});
    all.emplace_back(Audience{make.u32()});
    all.emplace_back(Wish{make.u32()});
    all.emplace_back(make.note());
    all.emplace_back(Leave{});
    all.emplace_back(Lost{make.server(), make.text()});
    return all;
}

RenderFrame sample_render_frame() {
    RenderFrame m;
    m.frame = 7;
    m.view.width = 64;
    m.view.height = 48;
    m.group = {0, 3, 4, 900};
    m.content = {10, 10, 40, 30};
    m.final_region = {{0, 0, 20, 48}, {20, 0, 32, 24}};
    m.outgoing = {{server_id(0), {{32, 10, 40, 24}}}, {server_id(2), {{20, 24, 40, 30}}}};
    m.incoming = {{server_id(2), {{0, 0, 20, 48}, {20, 0, 32, 24}}}};
    return m;
}

}  // namespace swath::test
