#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/published/octree/sah_kd_tree.h"
#include "common/raycast/packets.h"
#include "tests/bench/octree_bench.h"
#include "tests/bench/plots.h"

namespace swath::bench {

std::uint64_t cast_ours(const OctreeScene& scene, const SahTree& tree, InstructionSet set,
                        const RayView& view, int first_row, int last_row, float* distances) {
    const KernelTree kernel = kernel_tree(tree, scene.corners);
    const auto nearest = packet_kernels(set).nearest_by_depth;
    const TileRays rays(view);
    // Depth as in the rasteriser: 0 at the near plane, 1 at the far one.
    const float offset = view.far / (view.far - view.near);
    RayPacket packet{};
    packet.depth_scale = offset * view.near;
    packet.active = (1u << kPacketRays) - 1;
    for (int lane = 0; lane < kPacketRays; ++lane) {
        for (int axis = 0; axis < 3; ++axis) packet.origin[axis][lane] = view.eye[axis];
        packet.depth_offset[lane] = offset;
    }
    PacketHits found;
    std::uint64_t hits = 0;
    for (int y = first_row; y < last_row; y += kTile)
        for (int x = 0; x < view.width; x += kTile) {
            rays.directions(x, y, packet.direction[0], packet.direction[1], packet.direction[2]);
            nearest(kernel, packet, found);
            for (int lane = 0; lane < kPacketRays; ++lane)
                hits += found.triangle[lane] != kNoTriangle ? 1 : 0;
            if (distances == nullptr) continue;
            for (int lane = 0; lane < kPacketRays; ++lane)
                distances[(y + lane / kTile) * view.width + x + lane % kTile] =
                    found.triangle[lane] != kNoTriangle ? packet.depth_scale / (offset - found.nearness[lane])
                                                        : std::numeric_limits<float>::infinity();
        }
    return hits;
}

namespace {

using Cast = std::function<std::uint64_t(const RayView&, float* distances)>;

struct Caster {
    std::string name;
    Cast cast;
    // Finds the same as all other exact casters, to the last bit.
    bool exact;
};

// The distances of all pixels of all views.
std::vector<float> distances_of(const OctreeScene& scene, const Cast& cast, std::uint64_t& hits) {
    std::vector<float> distances(scene.rays());
    float* first = distances.data();
    hits = 0;
    for (const RayView& view : scene.views) {
        hits += cast(view, first);
        first += view.rays();
    }
    return distances;
}

struct Difference {
    std::size_t hits = 0;       // one hits and the other does not
    std::size_t distances = 0;  // both hit, at distances that differ by more than a thousandth
};
Difference compare(const std::vector<float>& one, const std::vector<float>& other) {
    Difference difference;
    for (std::size_t i = 0; i < one.size(); ++i) {
        if (std::isinf(one[i]) != std::isinf(other[i]))
            ++difference.hits;
        else if (std::abs(one[i] - other[i]) > 1e-3f * one[i])
            ++difference.distances;
    }
    return difference;
}

// Edges round one way or the other: at most this share of the rays may differ, or a few in a small picture.
constexpr double kTolerated = 1e-4;
constexpr double kFew = 4;

// Compares casters with the first one. An error if they see different things; else says what differs at
// edges.
Result<std::string> check(const OctreeScene& scene, const std::vector<Caster>& casters) {
    std::uint64_t expected_hits = 0;
    const std::vector<float> expected = distances_of(scene, casters.front().cast, expected_hits);
    std::string text;
    for (const Caster& caster : casters) {
        std::uint64_t hits = 0;
        const std::vector<float> found = distances_of(scene, caster.cast, hits);
        const Difference difference = compare(expected, found);
        if (caster.exact && found != expected)
            return fail("{}: '{}' and '{}' do not find the same", scene.name, caster.name,
                        casters.front().name);
        if (static_cast<double>(difference.hits + difference.distances) >
            kFew + kTolerated * static_cast<double>(expected.size()))
            return fail(
                "{}: '{}' hits with {} rays and '{}' with {} of {}; {} differ in that, {} in distance",
                scene.name, caster.name, hits, casters.front().name, expected_hits, expected.size(),
                difference.hits, difference.distances);
        if (!caster.exact)
            text += fmt::format("{}{}: {} in hit or not, {} in distance", text.empty() ? "" : "; ",
                                caster.name, difference.hits, difference.distances);
    }
    return fmt::format("\n{}: {} of {} rays hit; at edges differ from ours {}", scene.name, expected_hits,
                       expected.size(), text);
}

struct Trees {
    SahTree ours;
    SahTree fast;
    SahTree kd;
};
Result<Trees> build_trees(const OctreeScene& scene) {
    Trees trees;
    SWATH_TRY(trees.ours, OurBuild(scene, kDefaultSah, kBuildThreads).tree());
    SWATH_TRY(trees.fast, OurBuild(scene, kFastSah, kBuildThreads).tree());
    SWATH_TRY(trees.kd, build_sah_kd_tree(scene.triangles(), kDefaultSah));
    return trees;
}

// The nodes and triangles that rays of every fourth tile meet, in packets and each alone.
struct Work {
    PacketWork packets;
    PacketWork alone;
};
Work work_of(const OctreeScene& scene, const SahTree& tree) {
    const KernelTree kernel = kernel_tree(tree, scene.corners);
    const auto count = packet_kernels(best_instruction_set()).count;
    Work work;
    PacketHits hits;
    for (const RayView& view : scene.views) {
        const TileRays rays(view);
        RayPacket packet{};
        for (int axis = 0; axis < 3; ++axis)
            std::fill(std::begin(packet.origin[axis]), std::end(packet.origin[axis]), view.eye[axis]);
        for (int y = 0; y < view.height; y += 2 * kTile)
            for (int x = 0; x < view.width; x += 2 * kTile) {
                rays.directions(x, y, packet.direction[0], packet.direction[1], packet.direction[2]);
                packet.active = (1u << kPacketRays) - 1;
                count(kernel, packet, hits, work.packets);
                packet.active = 1u << (x + y) / (2 * kTile) % kPacketRays;
                count(kernel, packet, hits, work.alone);
            }
    }
    return work;
}

std::string work_table(const OctreeScene& scene, const Trees& trees) {
    std::string text = fmt::format("\nWhat the primary rays of {} meet\n  {:16}{:>27}{:>27}\n  {:16}",
                                   scene.name, "", "a ray alone", "a packet of 16", "");
    for (int i = 0; i < 2; ++i) text += fmt::format("{:>9}{:>9}{:>9}", "steps", "leaves", "tests");
    for (const auto& [name, tree] :
         {std::pair{"serial kd-tree", &trees.kd}, std::pair{"ours, default", &trees.ours},
          std::pair{"ours, fast", &trees.fast}}) {
        const Work work = work_of(scene, *tree);
        text += fmt::format("\n  {:16}", name);
        for (const PacketWork* part : {&work.alone, &work.packets}) {
            const auto each = [&](std::uint64_t sum) {
                return static_cast<double>(sum) / static_cast<double>(part->packets);
            };
            text += fmt::format("{:>9.1f}{:>9.2f}{:>9.1f}", each(part->steps), each(part->leaves),
                                each(part->triangles));
        }
    }
    return text;
}

constexpr const char* kOursOnKdTree = "ours on the kd-tree";
constexpr const char* kMediumAvx2 = "Embree medium, avx2";

Result<Race> race_scene(OctreeBench& bench, const OctreeScene& scene) {
    SWATH_TRY(const auto trees, build_trees(scene));
    EmbreeDevice device(kBuildThreads);
    EmbreeDevice narrow(kBuildThreads, "avx2");
    EmbreeScene low(device, scene.set.mesh, EmbreeQuality::kLow);
    EmbreeScene medium(device, scene.set.mesh, EmbreeQuality::kMedium);
    EmbreeScene medium_avx2(narrow, scene.set.mesh, EmbreeQuality::kMedium);
    EmbreeScene high(device, scene.set.mesh, EmbreeQuality::kHigh);
    for (EmbreeScene* hierarchy : {&low, &medium, &medium_avx2, &high}) hierarchy->commit();

    std::vector<Caster> casters;
    const auto add_ours = [&](const std::string& name, const SahTree& tree, InstructionSet set) {
        casters.push_back({name,
                           [&scene, &tree, set](const RayView& view, float* distances) {
                               return cast_ours(scene, tree, set, view, 0, view.height, distances);
                           },
                           true});
    };
    const auto add_embree = [&](const std::string& name, const EmbreeScene& hierarchy) {
        casters.push_back({name,
                           [&hierarchy](const RayView& view, float* distances) {
                               return hierarchy.cast(view, 0, view.height, distances);
                           },
                           false});
    };
    add_ours(kOursDefault, trees.ours, best_instruction_set());
    add_embree(kEmbreeMedium, medium);
    for (const InstructionSet set : instruction_sets())
        if (set != best_instruction_set())
            add_ours(fmt::format("{}, {}", kOursDefault, name(set)), trees.ours, set);
    add_ours(kOursFast, trees.fast, best_instruction_set());
    add_ours(kOursOnKdTree, trees.kd, best_instruction_set());
    add_embree(kEmbreeLow, low);
    add_embree(kEmbreeHigh, high);
    add_embree(kMediumAvx2, medium_avx2);

    SWATH_TRY(const auto edges, check(scene, casters));
    bench.figures.note(edges);
    bench.figures.note(work_table(scene, trees));
    Race race("rays", scene.name);
    for (const Caster& caster : casters)
        race.add_work(caster.name, {}, [&scene, &caster] {
            for (const RayView& view : scene.views) caster.cast(view, nullptr);
        });
    race.run(bench.repetitions(scene, 5), 1);
    return race;
}

}  // namespace

Status bench_octree_rays(OctreeBench& bench) {
    std::vector<std::string> names{kOursDefault, kOursFast, kOursOnKdTree};
    for (const InstructionSet set : instruction_sets())
        if (set != best_instruction_set()) names.push_back(fmt::format("{}, {}", kOursDefault, name(set)));
    names.insert(names.end(), {kEmbreeHigh, kEmbreeMedium, kEmbreeLow, kMediumAvx2});
    std::vector<std::string> lines(names.size());
    std::string head = fmt::format("\n{:32}", "Primary rays, one thread");
    std::string units =
        fmt::format("\n  {:30}", fmt::format("with {} unless said", name(best_instruction_set())));
    sim::Bars bars;
    bars.title = "Primary rays, one thread";
    bars.y_label = "million rays a second";
    bars.segments = {kOursOnKdTree, kOursDefault, kOursFast, kEmbreeHigh, kEmbreeMedium, kEmbreeLow};
    for (const OctreeScene& scene : bench.scenes) {
        SWATH_TRY(const auto race, race_scene(bench, scene));
        const auto rate = [&](const std::string& name) {
            return static_cast<double>(scene.rays()) / race.us(name);
        };
        head += fmt::format("{:>16}", scene.name);
        units += fmt::format("{:>9} {:>6}", "Mray/s", "/med.");
        for (std::size_t i = 0; i < names.size(); ++i)
            lines[i] += fmt::format("{:>9.1f} {:>6.2f}", rate(names[i]),
                                    median(race.ratios(kEmbreeMedium, names[i])));
        sim::Bars::Group group{scene.name, {}};
        for (std::size_t i = 0; i < bars.segments.size(); ++i) {
            sim::Bars::Bar bar{"", std::vector<double>(bars.segments.size())};
            bar.values[i] = rate(bars.segments[i]);
            group.bars.push_back(std::move(bar));
        }
        bars.groups.push_back(std::move(group));
        if (scene.has_bars)
            bench.figures.add("rays_vs_embree_" + scene.name, race.ratios(kEmbreeMedium, kOursDefault), "x",
                              "at least 0.5: primary rays a second, ours / Embree medium, one thread");
    }
    std::string text = head + units;
    for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("\n  {:30}{}", names[i], lines[i]);
    bench.figures.note(text);
    return bench.draws() ? draw_with_csv(bars, bench.effort.out / "octree_rays") : Status{};
}

}  // namespace swath::bench
