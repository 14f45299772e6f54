#include "client/live/notes.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace swath {
namespace {

using Json = nlohmann::json;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// The double that JSON writes as shortly as the float: 0.1, not 0.10000000149.
double decimal(float number) {
    char text[32];
    const auto end = std::to_chars(std::begin(text), std::end(text), number).ptr;
    double value = 0;
    std::from_chars(std::begin(text), end, value);
    return value;
}

template <class Numbers>
Json decimals(const Numbers& numbers) {
    Json list = Json::array();
    for (const float number : numbers) list.push_back(decimal(number));
    return list;
}

Json flat(const Region& region) {
    Json list = Json::array();
    for (const Rect& r : region)
        for (const int v : {r.x0, r.y0, r.x1, r.y1}) list.push_back(v);
    return list;
}

void put_box(const Box& box, Json& list) {
    for (const glm::vec3& corner : {box.min, box.max})
        for (int i = 0; i < 3; ++i) list.push_back(decimal(corner[i]));
}

template <NamedEnum E>
Json all_names() {
    Json names = Json::array();
    for (const E one : kAll<E>) names.push_back(name_of(one));
    return names;
}

// Each renderer alone, and the list that the run was started with.
Json renderer_choices(const LiveView* live) {
    Json names = all_names<RendererKind>();
    if (live != nullptr && live->start().setup.draw.renderers.size() > 1)
        names.push_back(renderer_list(live->start().setup.draw.renderers));
    return names;
}

Json name_or_null(const std::optional<Algorithm>& algorithm) {
    return algorithm ? Json(name_of(*algorithm)) : Json();
}

}  // namespace

std::string session_note(const SessionFacts& facts, const LiveView* live, const WishLimits& limits) {
    Json note{{"type", "session"},
              {"model", facts.model},
              {"triangles", facts.triangles},
              {"live", live != nullptr},
              {"why", live != nullptr ? Json()
                                      : Json("this run follows a camera path; swath-client --view starts one "
                                             "that can be steered")},
              {"home", live != nullptr ? decimals(live->home()) : Json()},
              {"background", fmt::format("#{:02x}{:02x}{:02x}", facts.background[0], facts.background[1],
                                         facts.background[2])}};
    Json& bounds = note["bounds"] = Json::array();
    put_box(facts.bounds, bounds);
    Json& servers = note["servers"] = Json::array();
    for (std::size_t i = 0; i < facts.servers.size(); ++i)
        servers.push_back({{"name", server_name(server_id(i))},
                           {"address", facts.servers[i].address},
                           {"renderer", facts.servers[i].renderer}});
    note["choices"] = {{"algorithms", all_names<Algorithm>()},
                       {"renderers", renderer_choices(live)},
                       {"culls", all_names<CullAlgorithm>()},
                       {"paths", {"orbit", "random"}},
                       {"objects", {100, 400, 1500, 6000, 25'000}},
                       {"max_width", limits.max_width},
                       {"max_height", limits.max_height}};
    return text_of(note);
}

std::string objects_note(std::uint64_t generation, const ObjectSet& scene) {
    Json note{{"type", "objects"},
              {"generation", generation},
              {"by", name_of(scene.cut.by)},
              {"depth", scene.cut.by == ObjectsBy::kUniform ? Json(scene.cut.depth) : Json()},
              {"count", scene.objects.size()},
              {"boxes", nullptr}};
    note["end_boxes"] = nullptr;
    if (scene.objects.size() <= kMaxBoxes) {
        Json& boxes = note["boxes"] = Json::array();
        for (const Object& object : scene.objects) put_box(object.box, boxes);
        if (scene.moves()) {
            Json& ends = note["end_boxes"] = Json::array();
            for (const Object& object : scene.objects) put_box(object.end_box, ends);
        }
    }
    return text_of(note);
}

std::string plan_note(const FrameOrder& order, const FramePlan& plan, double overlap,
                      std::uint64_t generation) {
    Json note{{"wish", order.wish},
              {"by", order.by},
              {"algorithm", name_of(order.algorithm)},
              {"servers", plan.servers.size()},
              {"width", order.width},
              {"height", order.height},
              {"camera", decimals(order.numbers)},
              {"pose", decimal(plan.view.pose)},
              {"generation", generation},
              {"overlap", overlap}};
    Json& clip = note["clip"] = Json::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) clip.push_back(decimal(plan.view.clip_from_model[column][row]));
    std::size_t ids = 0;
    for (const ServerShare& share : plan.servers) ids += share.group.size();
    Json tiles = Json::array();
    Json contents = Json::array();
    Json groups = Json::array();
    for (const ServerShare& share : plan.servers) {
        tiles.push_back(flat(share.tile));
        contents.push_back(share.content.empty() ? Json::array() : flat({share.content}));
        if (ids > kMaxObjectsInPlan) continue;
        Json steps = Json::array();
        ObjectId before = 0;
        for (const ObjectId id : share.group) steps.push_back(id - std::exchange(before, id));
        groups.push_back(std::move(steps));
    }
    note["tiles"] = std::move(tiles);
    note["contents"] = std::move(contents);
    note["groups"] = ids > kMaxObjectsInPlan ? Json() : std::move(groups);
    Json& links = note["links"] = Json::array();
    for (const Transfer& transfer : transfers(plan)) {
        Json link{index(transfer.from), index(transfer.to)};
        for (Json& number : flat(transfer.region)) link.push_back(std::move(number));
        links.push_back(std::move(link));
    }
    return text_of(note);
}

std::string state_note(const LiveView& live, const std::string& busy, const std::string& command) {
    const LiveWish& wish = live.wish();
    const Json note{{"type", "state"},
                    {"wish", wish.id},
                    {"by", wish.by},
                    {"camera", decimals(live.camera())},
                    {"width", wish.width},
                    {"height", wish.height},
                    {"algorithm", name_of(wish.algorithm)},
                    {"against", name_or_null(wish.against)},
                    {"servers", wish.servers ? Json(*wish.servers) : Json()},
                    {"objects", live.accepted_setup().objects},
                    {"renderer", renderer_list(live.accepted_setup().draw.renderers)},
                    {"cull", name_of(live.accepted_setup().draw.cull)},
                    {"path", wish.path.empty() ? Json() : Json(wish.path)},
                    {"paused", wish.paused},
                    {"refused", live.refused()},
                    {"busy", busy.empty() ? Json() : Json(busy)},
                    {"command", command}};
    return text_of(note);
}

namespace {

double ms(Nanoseconds time) { return std::round(static_cast<double>(time.count()) / 1e3) / 1e3; }

Json machine_json(const MachineTimeline& machine) {
    Json spans = Json::array();
    for (const Span& span : machine.spans)
        spans.push_back({name_of(span.phase), ms(span.begin), ms(span.end), ms(span.cpu)});
    Json counters = Json::object();
    for (const Counter counter : kAll<Counter>)
        if (machine[counter] > 0) counters[std::string(name_of(counter))] = machine[counter];
    return {{"name", machine.machine}, {"spans", std::move(spans)}, {"counters", std::move(counters)}};
}

Json prediction_json(const Prediction& prediction) {
    Json machines = Json::array();
    for (const MachinePrediction& machine : prediction.machines) {
        Json phases = Json::object();
        for (const Phase phase : kAll<Phase>)
            if (machine[phase] > 0) phases[std::string(name_of(phase))] = machine[phase];
        machines.push_back({{"name", machine.name}, {"phases", std::move(phases)}});
    }
    return {{"machines", std::move(machines)}, {"frame", prediction.frame_ms}};
}

Json others_json(const std::vector<Comparison>& others, Algorithm in_use) {
    double in_use_ms = 0;
    for (const Comparison& other : others)
        if (other.algorithm == in_use) in_use_ms = other.prediction.frame_ms;
    Json list = Json::array();
    for (const Comparison& other : others)
        list.push_back({{"algorithm", name_of(other.algorithm)},
                        {"frame", other.prediction.frame_ms},
                        {"ratio", in_use_ms > 0 ? Json(other.prediction.frame_ms / in_use_ms) : Json()},
                        {"overlap", other.prediction.overlap},
                        {"swap_pixels", other.prediction.swap_pixels}});
    return list;
}

}  // namespace

std::string frame_note(const FinishedFrame& frame, const FrameFindings& findings) {
    Json note{
        {"type", "frame"},
        {"frame", frame.timeline.frame},
        {"stream", frame.order.stream},
        {"algorithm", name_of(frame.order.algorithm)},
        {"servers", frame.order.servers},
        {"overlap", frame.timeline.overlap_factor},
        {"interval", findings.interval ? Json(ms(*findings.interval)) : Json()},
        {"prediction", findings.prediction ? prediction_json(*findings.prediction) : Json()},
        {"others", findings.others.empty() ? Json() : others_json(findings.others, frame.order.algorithm)}};
    Json& machines = note["machines"] = Json::array();
    for (const MachineTimeline& machine : frame.timeline.machines) machines.push_back(machine_json(machine));
    Json& critical = note["critical"] = Json::array();
    for (const CriticalSpan& span : findings.critical)
        critical.push_back({span.machine, name_of(span.phase), ms(span.begin), ms(span.end)});
    return text_of(note);
}

std::string speedup_note(const SpeedUps& found, bool running) {
    Json points = Json::array();
    for (const SpeedUps::Point& point : found.points())
        points.push_back({{"servers", point.servers},
                          {"interval", point.interval_ms},
                          {"busiest_cpu", point.busiest_cpu_ms},
                          {"predicted", point.predicted_ms ? Json(*point.predicted_ms) : Json()}});
    return text_of({{"type", "speedup"},
                    {"algorithm", name_of(found.algorithm())},
                    {"running", running},
                    {"points", std::move(points)}});
}

std::string trace_note(const std::string& trace) {
    return fmt::format(R"({{"type":"trace","trace":{}}})", trace);
}

}  // namespace swath
