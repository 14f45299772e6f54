#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/scene/objects.h"
#include "common/wire/codec.h"
#include "swath.pb.h"
#include "tests/common/wire/sample_messages.h"

// Messages that obey the schema and break a limit: each is refused by a line that names the field and the
// limit.

namespace swath {
namespace {

using namespace test;

constexpr std::int64_t kTooLate = (std::int64_t{1} << 61) + 1;

std::string refused(const pb::Head& head) {
    const std::string bytes = head.SerializeAsString();
    const auto message = decode_head({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    return message ? "no error" : message.error().message;
}

pb::Head head_of(const Message& message) {
    pb::Head head;
    EXPECT_TRUE(head.ParseFromString(encode_head(message)));
    return head;
}

// Changes fields of a valid message, one at a time.
template <class Part>
class Table {
  public:
    Table(const Message& valid, Part* (pb::Head::*part)()) : valid_(head_of(valid)), part_(part) {
        EXPECT_EQ(refused(valid_), "no error");
    }
    void expect(const std::function<void(Part&)>& change, const std::string& line) const {
        pb::Head head = valid_;
        change(*(head.*part_)());
        EXPECT_EQ(refused(head), line);
    }

  private:
    pb::Head valid_;
    Part* (pb::Head::*part_)();
};

void set_rects(google::protobuf::RepeatedField<std::int32_t>& field, const std::vector<int>& numbers) {
    field.Clear();
    for (const int n : numbers) field.Add(n);
}

TEST(WireLimit, OfHello) {
    const Table<pb::Hello> hello(Hello{Role::kServer, 1, server_id(2), 3, 4}, &pb::Head::mutable_hello);
    hello.expect([](auto& m) { m.set_role(0); }, "a garbled hello message: role: 0 is none");
    hello.expect([](auto& m) { m.set_role(5); }, "a garbled hello message: role: 5 is none");
    hello.expect([](auto& m) { m.set_server(1024); },
                 "a garbled hello message: server: server 1024, the limit is 1024");
}

TEST(WireLimit, OfTimes) {
    const Table<pb::Ping> ping(Ping{Nanoseconds(5)}, &pb::Head::mutable_ping);
    const std::string limit = ": outside of 0 to 2305843009213693952";
    ping.expect([](auto& m) { m.set_sent_ns(-1); }, "a garbled ping message: sent_ns" + limit);
    ping.expect([](auto& m) { m.set_sent_ns(kTooLate); }, "a garbled ping message: sent_ns" + limit);
    const Table<pb::Pong> pong(Pong{Nanoseconds(5), Nanoseconds(6)}, &pb::Head::mutable_pong);
    pong.expect([](auto& m) { m.set_sent_ns(std::numeric_limits<std::int64_t>::min()); },
                "a garbled pong message: sent_ns" + limit);
    pong.expect([](auto& m) { m.set_peer_ns(std::numeric_limits<std::int64_t>::max()); },
                "a garbled pong message: peer_ns" + limit);
}

TEST(WireLimit, OfServerSetup) {
    ServerSetup valid;
    valid.server = server_id(1);
    const Table<pb::ServerSetup> setup(valid, &pb::Head::mutable_server_setup);
    const std::string in = "a garbled server_setup message: ";
    setup.expect([](auto& m) { m.set_server(2000); }, in + "server: server 2000, the limit is 1024");
    setup.expect([](auto& m) { m.set_model(std::string(4097, 'x')); },
                 in + "model: 4097 bytes, the limit is 4096");
    setup.expect([](auto& m) { m.set_digest(std::string(31, 'x')); },
                 in + "digest: 31 bytes where 32 are expected");
    setup.expect([](auto& m) { m.mutable_drawing()->set_octree_depth(kMaxOctreeDepth + 1); },
                 in + "octree_depth: 11, the limit is 10");
    setup.expect([](auto& m) { m.mutable_drawing()->set_sah_objects(1'000'001); },
                 in + "sah_objects: 1000001, the limit is 1000000");
    setup.expect([](auto& m) { m.mutable_drawing()->set_renderer(0, 0); }, in + "renderer: 0 is none");
    setup.expect([](auto& m) { m.mutable_drawing()->set_renderer(0, 5); }, in + "renderer: 5 is none");
    setup.expect([](auto& m) { m.mutable_drawing()->set_cull(0); }, in + "cull: 0 is none");
    setup.expect([](auto& m) { m.mutable_drawing()->set_cull(5); }, in + "cull: 5 is none");
    setup.expect([](auto& m) { m.set_frames_in_flight(0); },
                 in + "frames_in_flight: 0, the limits are 1 and 8");
    setup.expect([](auto& m) { m.set_frames_in_flight(9); },
                 in + "frames_in_flight: 9, the limits are 1 and 8");
}

TEST(WireLimit, OfDisplaySetup) {
    const Table<pb::DisplaySetup> setup(DisplaySetup{}, &pb::Head::mutable_display_setup);
    const std::string in = "a garbled display_setup message: ";
    setup.expect([](auto& m) { m.set_format(3); }, in + "format: 3 is none");
    setup.expect([](auto& m) { m.set_frames_in_flight(9); },
                 in + "frames_in_flight: 9, the limits are 1 and 8");
}

TEST(WireLimit, OfConnect) {
    const Connect valid{"d:1", {{server_id(0), "a:1"}, {server_id(5), "b:2"}}};
    const Table<pb::Connect> connect(valid, &pb::Head::mutable_connect);
    const std::string in = "a garbled connect message: ";
    connect.expect([](auto& m) { m.set_display(std::string(5000, 'x')); },
                   in + "display: 5000 bytes, the limit is 4096");
    connect.expect([](auto& m) { m.mutable_peers(1)->set_server(0); }, in + "peers: not ascending");
    connect.expect([](auto& m) { m.mutable_peers(1)->set_server(1024); },
                   in + "peers: server 1024, the limit is 1024");
    connect.expect([](auto& m) { m.mutable_peers(0)->set_address(std::string(5000, 'x')); },
                   in + "peers: 5000 bytes, the limit is 4096");
    connect.expect(
        [](auto& m) {
            for (int i = 0; i < 1023; ++i) m.add_peers();
        },
        in + "peers: 1025, the limit is 1024");
}

TEST(WireLimit, OfLost) {
    const Table<pb::Lost> lost(Lost{server_id(3), "it fell over"}, &pb::Head::mutable_lost);
    lost.expect([](auto& m) { m.set_server(1024); },
                "a garbled lost message: server: server 1024, the limit is 1024");
    lost.expect([](auto& m) { m.set_why(std::string(5000, 'x')); },
                "a garbled lost message: why: 5000 bytes, the limit is 4096");
}

TEST(WireLimit, OfReconfigure) {
    const Table<pb::Reconfigure> drawing(Reconfigure{}, &pb::Head::mutable_reconfigure);
    const std::string in = "a garbled reconfigure message: ";
    drawing.expect([](auto& m) { m.mutable_drawing()->set_octree_depth(11); },
                   in + "octree_depth: 11, the limit is 10");
    drawing.expect([](auto& m) { m.mutable_drawing()->set_sah_objects(1'000'001); },
                   in + "sah_objects: 1000001, the limit is 1000000");
    drawing.expect(
        [](auto& m) {
            m.mutable_drawing()->set_octree_depth(1);
            m.mutable_drawing()->set_sah_objects(2);
        },
        in + "sah_objects: 2, and an octree_depth too");
    drawing.expect([](auto& m) { m.mutable_drawing()->set_renderer(0, 5); }, in + "renderer: 5 is none");
    drawing.expect([](auto& m) { m.mutable_drawing()->clear_renderer(); },
                   in + "renderer: 0, the limits are 1 and 1024");
    drawing.expect(
        [](auto& m) {
            for (int i = 0; i < 1024; ++i) m.mutable_drawing()->add_renderer(1);
        },
        in + "renderer: 1025, the limits are 1 and 1024");
    drawing.expect([](auto& m) { m.mutable_drawing()->set_cull(0); }, in + "cull: 0 is none");
}

TEST(WireLimit, OfNotesAndStreams) {
    const Table<pb::Note> note(Note{}, &pb::Head::mutable_note);
    note.expect([](auto& m) { m.set_topic(0); }, "a garbled note message: topic: 0 is none");
    note.expect([](auto& m) { m.set_topic(8); }, "a garbled note message: topic: 8 is none");
    const Table<pb::AssembleFrame> frame(AssembleFrame{1, 2, 2, {}, {}}, &pb::Head::mutable_assemble_frame);
    frame.expect([](auto& m) { m.set_stream(2); },
                 "a garbled assemble_frame message: stream: 2, the limit is 2");
}

TEST(WireLimit, OfTextsForPeople) {
    const Table<pb::Ready> ready(Ready{1, 2, "llvmpipe"}, &pb::Head::mutable_ready);
    ready.expect([](auto& m) { m.set_description(std::string(4097, 'x')); },
                 "a garbled ready message: description: 4097 bytes, the limit is 4096");
    ready.expect([](auto& m) { m.set_refused(std::string(4097, 'x')); },
                 "a garbled ready message: refused: 4097 bytes, the limit is 4096");
    const Table<pb::Failed> failed(Failed{"why"}, &pb::Head::mutable_failed);
    failed.expect([](auto& m) { m.set_what(std::string(4097, 'x')); },
                  "a garbled failed message: what: 4097 bytes, the limit is 4096");
}

class RenderFrameLimit : public testing::Test {
  protected:
    void expect(const std::function<void(pb::RenderFrame&)>& change, const std::string& line) const {
        task_.expect(change, "a garbled render_frame message: " + line);
    }
    const Table<pb::RenderFrame> task_{sample_render_frame(), &pb::Head::mutable_render_frame};
};

TEST_F(RenderFrameLimit, OfTheView) {
    const std::string size = ", the limits are 16384 a side and 67108864 pixels";
    const std::string numbers = "view: a matrix of 16 and a vector of 3 are expected";
    expect([](auto& m) { m.clear_clip_from_model(); }, numbers);
    expect([](auto& m) { m.add_clip_from_model(0); }, numbers);
    expect([](auto& m) { m.clear_to_light(); }, numbers);
    expect([](auto& m) { m.set_clip_from_model(7, std::numeric_limits<float>::infinity()); },
           "clip_from_model: not a finite number");
    expect([](auto& m) { m.set_to_light(2, std::numeric_limits<float>::quiet_NaN()); },
           "to_light: not a finite number");
    expect([](auto& m) { m.set_pose(-0.25f); }, "pose: -0.25, the limits are 0 and 1");
    expect([](auto& m) { m.set_pose(1.5f); }, "pose: 1.5, the limits are 0 and 1");
    expect([](auto& m) { m.set_pose(std::numeric_limits<float>::quiet_NaN()); },
           "pose: nan, the limits are 0 and 1");
    expect([](auto& m) { m.set_width(0); }, "size: 0x48" + size);
    expect([](auto& m) { m.set_height(16385); }, "size: 64x16385" + size);
    expect([](auto& m) { m.set_height(0x80000001); }, "size: 64x2147483649" + size);
}

TEST_F(RenderFrameLimit, OfTheGroup) {
    expect([](auto& m) { m.set_group_steps(1, 0); }, "group: ids are not ascending");
    expect([](auto& m) { m.set_group_steps(0, kMaxObjects); },
           "group: object 2147483647, the limit is 2147483647");
    expect(
        [](auto& m) {
            m.set_group_steps(0, 5);
            m.set_group_steps(1, 0xffffffff);  // would be 4 in 32 bits
        },
        "group: object 4294967300, the limit is 2147483647");
}

TEST_F(RenderFrameLimit, OfRectangles) {
    const std::string sides = ": a rectangle that is empty or leaves 0 to 16384";
    expect([](auto& m) { m.clear_content(); }, "content: one rectangle is expected");
    expect([](auto& m) { set_rects(*m.mutable_content(), {0, 0, 65, 48}); }, "content: outside the viewport");
    expect(
        [](auto& m) {
            set_rects(*m.mutable_content(), {-2147483647 - 1, 0, 2147483647, 48});
        },
        "content: outside the viewport");
    expect([](auto& m) { m.add_final_region(1); }, "final_region: 9 numbers are no rectangles");
    expect([](auto& m) { set_rects(*m.mutable_final_region(), {3, 3, 3, 9}); }, "final_region" + sides);
    expect([](auto& m) { set_rects(*m.mutable_final_region(), {-1, 0, 3, 9}); }, "final_region" + sides);
    expect([](auto& m) { set_rects(*m.mutable_final_region(), {0, 0, 16385, 9}); }, "final_region" + sides);
    expect(
        [](auto& m) {
            set_rects(*m.mutable_final_region(), {0, 0, 65, 9});
        },
        "final_region: a rectangle outside the viewport");
    expect(
        [](auto& m) {
            set_rects(*m.mutable_final_region(), {0, 0, 64, 48, 0, 0, 1, 1});
        },
        "final_region: 3073 pixels, the viewport has 3072");
}

TEST_F(RenderFrameLimit, OfExchanges) {
    expect([](auto& m) { m.mutable_outgoing(0)->set_server(1024); },
           "outgoing: server 1024, the limit is 1024");
    expect([](auto& m) { m.mutable_outgoing(0)->set_server(2); }, "outgoing: servers are not ascending");
    expect(
        [](auto& m) {
            for (std::uint32_t i = 0; i < 1025; ++i) m.add_incoming()->set_server(i);
        },
        "incoming: 1026 entries, the limit is 1024");
    expect(
        [](auto& m) {
            set_rects(*m.mutable_incoming(0)->mutable_region(), {1, 2, 3});
        },
        "incoming: 3 numbers are no rectangles");
    expect(
        [](auto& m) {
            set_rects(*m.mutable_outgoing(0)->mutable_region(), {30, 10, 41, 24});
        },
        "outgoing: a rectangle outside the content");
    expect(
        [](auto& m) {
            set_rects(*m.mutable_outgoing(0)->mutable_region(), {60, 10, 65, 24});
        },
        "outgoing: a rectangle outside the content");
    expect(
        [](auto& m) {
            set_rects(*m.mutable_outgoing(0)->mutable_region(), {10, 10, 40, 30, 10, 10, 40, 30});
        },
        "outgoing: 1200 pixels, the content has 600");
}

// The server neither draws nor owns these pixels, so it has no memory for them.
TEST_F(RenderFrameLimit, OfIncomingPixelsIsWhatTheServerDrawsAndOwns) {
    expect(
        [](auto& m) {
            set_rects(*m.mutable_incoming(0)->mutable_region(), {39, 0, 41, 3});
        },
        "incoming: a rectangle outside the content and final region");
}

TEST(WireLimit, OfAssembleFrame) {
    const Table<pb::AssembleFrame> task(
        AssembleFrame{
            3, 64, 48, {1, 2, 3}, {{server_id(0), {{0, 0, 32, 48}}}, {server_id(4), {{32, 0, 64, 48}}}}},
        &pb::Head::mutable_assemble_frame);
    const std::string in = "a garbled assemble_frame message: ";
    const std::string size = ", the limits are 16384 a side and 67108864 pixels";
    task.expect([](auto& m) { m.set_width(0); }, in + "size: 0x48" + size);
    task.expect([](auto& m) { m.set_height(16385); }, in + "size: 64x16385" + size);
    task.expect(
        [](auto& m) {
            m.set_width(8193);
            m.set_height(8192);
        },
        in + "size: 8193x8192" + size);
    task.expect([](auto& m) { m.set_background(0x1000000); },
                in + "background: 0x1000000, the limit is 0xffffff");
    task.expect([](auto& m) { m.mutable_tiles(1)->set_server(0); }, in + "tiles: servers are not ascending");
    task.expect(
        [](auto& m) {
            set_rects(*m.mutable_tiles(1)->mutable_region(), {32, 0, 65, 48});
        },
        in + "tiles: a rectangle outside the picture");
    task.expect(
        [](auto& m) {
            set_rects(*m.mutable_tiles(1)->mutable_region(), {0, 0, 64, 48, 0, 0, 1, 1});
        },
        in + "tiles: 3073 pixels, the picture has 3072");
}

TEST(WireLimit, OfReports) {
    ServerReport valid;
    valid.spans = {{Phase::kCull, Nanoseconds(1), Nanoseconds(2), Nanoseconds(1)}};
    const Table<pb::Report> report(valid, &pb::Head::mutable_server_report);
    const std::string in = "a garbled server_report message: ";
    const std::string times = "spans: a time outside of 0 to 2305843009213693952";
    report.expect([](auto& m) { m.mutable_spans(0)->set_phase(kPhaseCount); },
                  in + "spans: phase 11, the limit is 11");
    report.expect([](auto& m) { m.mutable_spans(0)->set_begin_ns(3); },
                  in + "spans: one ends before it begins");
    report.expect([](auto& m) { m.mutable_spans(0)->set_begin_ns(-1); }, in + times);
    report.expect([](auto& m) { m.mutable_spans(0)->set_end_ns(kTooLate); }, in + times);
    report.expect([](auto& m) { m.mutable_spans(0)->set_cpu_ns(kTooLate); }, in + times);
    report.expect(
        [](auto& m) {
            for (int i = 0; i < 4096; ++i) *m.add_spans() = m.spans(0);
        },
        in + "spans: 4097, the limit is 4096");
    report.expect([](auto& m) { m.add_counters(1); }, in + "counters: 10 where 9 are expected");
    report.expect([](auto& m) { m.clear_counters(); }, in + "counters: 0 where 9 are expected");
    report.expect([](auto& m) { m.mutable_visible()->Resize(524'289, 1); },
                  in + "visible: 524289 counts, the limit is 524288");
    report.expect([](auto& m) { m.mutable_visible()->Resize(524'288, ~0u); }, "no error");
}

}  // namespace
}  // namespace swath
