#include <algorithm>
#include <cmath>
#include <ctime>

#include "client/path/path.h"
#include "common/base/clock.h"
#include "common/program/program.h"
#include "common/raster/meshlets.h"
#include "common/raster/raster_renderer.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/model.h"
#include "tests/bench/figures.h"
#include "tests/support/models.h"

namespace swath::bench {
namespace {

// A way to look at a model.
struct Look {
    std::string name;    // of its figures
    float distance = 1;  // of the eye from the centre, of orbit's; 0: inside of the model
    int width = 1280;
    int height = 960;
};

View view_of(const ObjectSet& scene, const Look& look) {
    Camera camera;
    const glm::vec3 centre = scene.bounds.centre();
    const glm::vec3 size = scene.bounds.size();
    if (look.distance == 0) {
        camera.eye = centre;
        camera.target = centre + glm::vec3(1, -0.2f, 0.3f);
        camera.fov_y = 1.05f;
    } else {
        const float half = 0.5f * std::max({size.x, size.y, size.z});
        camera.eye = centre + look.distance * half * glm::vec3(0.3f, 0.4f, 2.8f);
        camera.target = centre;
        camera.fov_y = 0.8f;
    }
    return make_view(with_depth_range(camera, scene.bounds), look.width, look.height);
}

std::vector<TriangleRange> all_of(const ObjectSet& scene) {
    std::vector<TriangleRange> ranges;
    for (ObjectId id = 0; id < scene.objects.size(); ++id)
        ranges.push_back({id, scene.objects[id].first_triangle, scene.objects[id].triangle_count});
    return ranges;
}

// Copies of a model, one behind another as seen from orbit.
Mesh in_a_row(const Mesh& mesh, int copies) {
    Mesh row;
    const glm::vec3 size = bounds(mesh).size();
    const glm::vec3 away = -std::max({size.x, size.y, size.z}) * glm::normalize(glm::vec3(0.3f, 0.4f, 2.8f));
    for (int i = 0; i < copies; ++i) {
        const auto first = static_cast<std::uint32_t>(row.vertices.size());
        for (Vertex vertex : mesh.vertices) {
            vertex.position += static_cast<float>(i) * away;
            row.vertices.push_back(vertex);
        }
        for (const std::uint32_t index : mesh.indices) row.indices.push_back(first + index);
    }
    return row;
}

double seconds_of(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The seconds that the quickest of a few pictures takes.
Result<double> best_of(int pictures, clockid_t clock, Renderer& renderer,
                       std::span<const TriangleRange> ranges, const View& view) {
    double best = 1e9;
    for (int i = 0; i < pictures; ++i) {
        const double begin = seconds_of(clock);
        SWATH_TRY_VOID(renderer.draw(ranges, view, view.viewport()));
        best = std::min(best, seconds_of(clock) - begin);
    }
    return best;
}

struct Differences {
    std::int64_t coverage = 0;
    std::int64_t object = 0;
    std::int64_t colour = 0;
    std::int64_t covered = 0;
};
Result<Differences> compare(Renderer& one, Renderer& other, const View& view) {
    PixelFrame a;
    PixelFrame b;
    a.reshape(view.viewport());
    b.reshape(view.viewport());
    SWATH_TRY_VOID(one.read(view.viewport(), a));
    SWATH_TRY_VOID(other.read(view.viewport(), b));
    Differences found;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const bool in_a = *a.depth(x, y) < kFarDepth;
            const bool in_b = *b.depth(x, y) < kFarDepth;
            found.coverage += in_a != in_b ? 1 : 0;
            if (!in_a || !in_b) continue;
            ++found.covered;
            found.object += *a.id(x, y) != *b.id(x, y) ? 1 : 0;
            found.colour += *a.colour(x, y) != *b.colour(x, y) ? 1 : 0;
        }
    return found;
}

class Bench {
  public:
    Bench(Figures& figures, const Effort& effort) : figures_(figures), effort_(effort) {}

    // Draws a model with llvmpipe and with every instruction set in turn, from all sides.
    Status model(const std::string& what, Mesh mesh, const std::vector<Look>& looks) {
        const ObjectSet scene = build_objects(std::move(mesh), {});
        const std::vector<TriangleRange> all = all_of(scene);
        SWATH_TRY(const auto peer, make_renderer({.kind = default_renderer().kind}, scene));
        std::vector<std::unique_ptr<Renderer>> ours;
        for (const InstructionSet set : instruction_sets()) {
            SWATH_TRY(auto renderer, make_raster_renderer({.kind = RendererKind::kRaster}, scene, set));
            ours.push_back(std::move(renderer));
        }
        for (const Look& look : looks) {
            const View view = view_of(scene, look);
            std::vector<double> peer_ms;
            std::vector<std::vector<double>> ratios(ours.size());
            for (int i = -1; i < effort_.repetitions; ++i) {
                SWATH_TRY(const double theirs, best_of(2, CLOCK_THREAD_CPUTIME_ID, *peer, all, view));
                peer_ms.push_back(1e3 * theirs);
                for (std::size_t k = 0; k < ours.size(); ++k) {
                    SWATH_TRY(const double mine, best_of(3, CLOCK_THREAD_CPUTIME_ID, *ours[k], all, view));
                    if (i >= 0) ratios[k].push_back(theirs / mine);
                }
            }
            for (std::size_t k = 0; k < ours.size(); ++k) {
                const InstructionSet set = instruction_sets()[k];
                worst_ = std::min(worst_, median(ratios[k]));
                figures_.add(
                    fmt::format("{}_{}", look.name, set == InstructionSet::kPortable ? "plain" : name(set)),
                    ratios[k], "ratio", "CPU time, llvmpipe / ours");
            }
            SWATH_TRY(const Differences found, compare(*peer, *ours.back(), view));
            figures_.note(
                fmt::format("{}: {}, {}x{}: llvmpipe {:.1f} ms, {} pixels covered by both; {} by one alone, "
                            "{} of another object, {} "
                            "of another colour",
                            look.name, what, look.width, look.height, median(peer_ms), found.covered,
                            found.coverage, found.object, found.colour));
            covered_by_one_ += found.coverage;
        }
        return {};
    }

    // Two threads beside one: wall time, and CPU time of the process.
    Status threads(Mesh mesh) {
        const ObjectSet scene = build_objects(std::move(mesh), {});
        const std::vector<TriangleRange> all = all_of(scene);
        const View view = view_of(scene, {});
        SWATH_TRY(const auto one, make_raster_renderer({.kind = RendererKind::kRaster}, scene));
        SWATH_TRY(const auto two, make_raster_renderer({.kind = RendererKind::kRaster, .threads = 2}, scene));
        figures_.add(
            "bytes_per_triangle",
            {static_cast<double>(Meshlets(scene).bytes()) / static_cast<double>(scene.mesh.triangle_count())},
            "bytes", "of meshlets");
        std::vector<double> speedup;
        std::vector<double> overhead;
        for (int i = 0; i < 3 * effort_.repetitions; ++i) {
            SWATH_TRY(const double wall_of_one, best_of(3, CLOCK_MONOTONIC, *one, all, view));
            SWATH_TRY(const double wall_of_two, best_of(3, CLOCK_MONOTONIC, *two, all, view));
            SWATH_TRY(const double cpu_of_one, best_of(3, CLOCK_PROCESS_CPUTIME_ID, *one, all, view));
            SWATH_TRY(const double cpu_of_two, best_of(3, CLOCK_PROCESS_CPUTIME_ID, *two, all, view));
            speedup.push_back(wall_of_one / wall_of_two);
            overhead.push_back(cpu_of_two / cpu_of_one - 1);
        }
        figures_.add("threads2_speedup", speedup, "ratio", "wall time, one thread / two");
        figures_.add("threads2_cpu_overhead", overhead, "ratio", "CPU time, two threads / one - 1");
        return {};
    }

    void finish() {
        figures_.add("worst_ratio", {worst_}, "ratio", "the least of all, CPU time, llvmpipe / ours");
        figures_.add("covered_by_one", {static_cast<double>(covered_by_one_)}, "",
                     "pixels that only one of both covers");
    }

  private:
    Figures& figures_;
    const Effort& effort_;
    double worst_ = 1e9;
    std::int64_t covered_by_one_ = 0;
};

std::vector<Look> with_prefix(const std::string& prefix, std::vector<Look> looks) {
    for (Look& look : looks) look.name = prefix + look.name;
    return looks;
}

}  // namespace

Status bench_raster(Figures& figures, const Effort& effort) {
    set_raster_threads(0);  // all of llvmpipe on one thread, whose CPU time is then that of drawing
    Bench bench(figures, effort);
    const std::vector<Look> outside{{"orbit", 1},
                                    {"fill", 0.8f},
                                    {"far", 3},
                                    {"close", 0.32f},
                                    {"orbit4k", 1, 3840, 2160},
                                    {"close4k", 0.32f, 3840, 2160}};
    const std::vector<Look> inside{{"inside", 0}, {"inside4k", 0, 3840, 2160}};
    SWATH_TRY(auto mesh, load_model(effort.model));
    SWATH_TRY_VOID(
        bench.model("the model", mesh, effort.smoke ? std::vector<Look>{{"orbit", 1, 320, 240}} : outside));
    SWATH_TRY_VOID(bench.threads(mesh));
    if (!effort.smoke) {
        SWATH_TRY_VOID(bench.model("eight of them behind one another", in_a_row(mesh, 8), {{"behind", 1}}));
        const auto bunny = test::shared_model("bunny.ply");
        const auto room = test::shared_model("conference.ply");
        if (bunny) {
            SWATH_TRY(auto other, load_model(bunny->string()));
            SWATH_TRY_VOID(bench.model("the Bunny", other, with_prefix("bunny_", outside)));
            SWATH_TRY_VOID(bench.model("the Bunny", std::move(other), with_prefix("bunny_", inside)));
        } else {
            figures.note("bunny.ply is missing: no figures of it");
        }
        if (room) {
            SWATH_TRY(auto other, load_model(room->string()));
            SWATH_TRY_VOID(bench.model("the Conference", other, with_prefix("conference_", outside)));
            SWATH_TRY_VOID(bench.model("the Conference", std::move(other), inside));
        } else {
            figures.note("conference.ply is missing: no figures from inside of it");
        }
    }
    bench.finish();
    return {};
}

}  // namespace swath::bench
