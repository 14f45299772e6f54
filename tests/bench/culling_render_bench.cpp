#include <cmath>
#include <numeric>

#include "client/partition/partitioner.h"
#include "client/partition/projection.h"
#include "client/path/path.h"
#include "common/cullers/make_culler.h"
#include "common/program/program.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/model.h"
#include "tests/bench/figures.h"
#include "tests/support/models.h"

namespace swath::bench {
namespace {

constexpr int kDrawnWidth = 1280;
constexpr int kDrawnHeight = 960;
constexpr std::size_t kCameras = 8;
constexpr std::uint32_t kWholeObjects = 0xffff'ffff;  // triangles in a leaf: each object is its own leaf

// The drawing of one server in one frame.
struct Task {
    View view;
    std::vector<ObjectId> group;
    Rect content;
};
using Frame = std::vector<Task>;

// The cost of frames, summed over servers.
struct Cost {
    double triangles = 0;
    double cull_us = 0;  // CPU time, which other processes hardly disturb
    double render_ms = 0;
};

Status draw(Renderer& renderer, LeafCull& cull, const Frame& frame, Cost& cost) {
    const SteadyClock clock;
    for (const Task& task : frame) {
        if (task.content.empty()) continue;
        const Nanoseconds begin = clock.thread_cpu();
        const CullResult list = cull.cull(task.group, task.view, task.content);
        const Nanoseconds culled = clock.thread_cpu();
        SWATH_TRY_VOID(renderer.draw(list.ranges, task.view, task.content));
        cost.render_ms += static_cast<double>((clock.thread_cpu() - culled).count()) * 1e-6;
        cost.cull_us += static_cast<double>((culled - begin).count()) * 1e-3;
        cost.triangles += static_cast<double>(list.triangles);
    }
    return {};
}

// Culls every frame by object and by leaf in turn, and draws with one renderer: the triangles' order is the
// same.
Status measure(Figures& figures, const Effort& effort, const std::string& name, const ObjectSet& coarse,
               const ObjectSet& fine, const std::vector<Frame>& frames) {
    SWATH_TRY(auto renderer, make_renderer({.kind = default_renderer().kind}, coarse));
    const SteadyClock clock;
    ThreadTeam team(1, clock);
    std::array<LeafCull, 2> culls{make_leaf_cull(CullAlgorithm::kWide, coarse, team),
                                  make_leaf_cull(CullAlgorithm::kWide, fine, team)};
    std::array<std::vector<double>, 2> triangles;
    std::array<std::vector<double>, 2> cull_us;
    std::array<std::vector<double>, 2> render_ms;
    std::vector<double> ratio;
    const auto count = static_cast<double>(frames.size());
    for (int i = -1; i < effort.repetitions; ++i) {
        std::array<Cost, 2> costs;
        for (const Frame& frame : frames)
            for (std::size_t way = 0; way < culls.size(); ++way)
                SWATH_TRY_VOID(draw(*renderer, culls[way], frame, costs[way]));
        if (i < 0) continue;  // a warm-up for the caches and Mesa's shaders
        for (std::size_t way = 0; way < culls.size(); ++way) {
            triangles[way].push_back(costs[way].triangles / count);
            cull_us[way].push_back(costs[way].cull_us / count);
            render_ms[way].push_back(costs[way].render_ms / count);
        }
        ratio.push_back(costs[1].render_ms / costs[0].render_ms);
    }
    for (std::size_t way = 0; way < culls.size(); ++way) {
        const std::string by = way == 0 ? "_by_object" : "_by_leaf";
        figures.add(name + "_triangles" + by, triangles[way], "", "drawn, mean of a frame, all servers");
        figures.add(name + "_cull_us" + by, cull_us[way], "us", "CPU, mean of a frame, all servers");
        figures.add(name + "_render_ms" + by, render_ms[way], "ms", "CPU, mean of a frame, all servers");
    }
    figures.add(name + "_render_ratio", ratio, "ratio", "by leaf over by object: below 1");
    return {};
}

// Frames of one process in the middle of the model, turning round.
Result<std::vector<Frame>> from_inside(const ObjectSet& scene) {
    std::vector<ObjectId> all(scene.objects.size());
    std::iota(all.begin(), all.end(), ObjectId{0});
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < kCameras; ++i) {
        const double turn = 6.283185307179586 * static_cast<double>(i) / kCameras;
        Camera camera;
        camera.eye = scene.bounds.centre();
        camera.target = camera.eye + glm::vec3(std::cos(turn), 0, std::sin(turn));
        camera.fov_y = 1;
        const View view = make_view(with_depth_range(camera, scene.bounds), kDrawnWidth, kDrawnHeight);
        frames.push_back({{view, all, view.viewport()}});
    }
    return frames;
}

// Frames of four sort-first servers, with the camera around the model.
Result<std::vector<Frame>> mahd_of_four(const ObjectSet& scene) {
    SWATH_TRY(const auto cameras, make_path("orbit", scene.bounds, {kCameras, 1, 4.0f / 3.0f, 1.0f}));
    const auto partitioner = make_partitioner(Algorithm::kMahd, scene.objects);
    std::vector<Frame> frames;
    for (FrameNumber number = 0; number < cameras.size(); ++number) {
        const View view = make_view(cameras[number], kDrawnWidth, kDrawnHeight);
        const auto projected = project(scene.objects, view);
        Frame& frame = frames.emplace_back();
        for (const ServerShare& share : partitioner->partition({number, view, projected, 4}).servers)
            frame.push_back({view, share.group, share.content});
    }
    return frames;
}

Status measure_model(Figures& figures, const Effort& effort, const std::string& name,
                     const std::string& model, Result<std::vector<Frame>> (*frames_of)(const ObjectSet&)) {
    SWATH_TRY(const auto mesh, load_model(model));
    // Takes the default number of objects, and a small one, with objects much larger than a leaf.
    for (const std::size_t objects : {std::size_t{1500}, std::size_t{100}}) {
        const ObjectSet coarse = build_objects(mesh, {.objects = objects, .leaf_triangles = kWholeObjects});
        const ObjectSet fine = build_objects(mesh, {.objects = objects});
        SWATH_TRY(const auto frames, frames_of(coarse));
        SWATH_TRY_VOID(measure(figures, effort, fmt::format("{}_{}", name, objects), coarse, fine, frames));
    }
    return {};
}

}  // namespace

Status bench_culling_render(Figures& figures, const Effort& effort) {
    set_raster_threads(0);  // all on one thread, whose CPU time is then that of drawing
    SWATH_TRY_VOID(measure_model(figures, effort, "mahd4", effort.model, mahd_of_four));
    if (is_builtin(effort.model))
        return measure_model(figures, effort, "inside", "builtin:town:20000", from_inside);
    const auto room = test::shared_model("conference.ply");
    if (room) return measure_model(figures, effort, "inside", room->string(), from_inside);
    figures.note(
        "the Conference room (../shared/models/conference.ply) is missing: no figures from inside it");
    return {};
}

}  // namespace swath::bench
