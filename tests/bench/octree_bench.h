#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/base/instruction_set.h"
#include "common/octree/sah/sah_builder.h"
#include "tests/bench/figures.h"
#include "tests/bench/octree_embree.h"
#include "tests/bench/octree_scenes.h"
#include "tests/bench/race.h"

// The parts of bench_octree(). Errors: a tree that cannot be built, rays that do not hit what Embree's hit,
// or a plot that cannot be drawn.
namespace swath::bench {

struct OctreeBench {
    Figures& figures;
    const Effort& effort;
    std::vector<OctreeScene> scenes;

    // Of a scene without figures, whose numbers are for tables, fewer.
    int repetitions(const OctreeScene& scene, int full) const {
        if (effort.smoke) return 1;
        return scene.has_bars ? full : std::min(full, 3);
    }
    bool draws() const { return !effort.out.empty(); }
};

// build_vs_kdtree_*, sah_cost_vs_kdtree_*, build_vs_embree_medium_*, build_fast_vs_embree_low_*: what
// builders need and what their trees are like.
Status bench_octree_builds(OctreeBench& bench);
// rays_vs_embree_*: primary rays, and what a ray meets.
Status bench_octree_rays(OctreeBench& bench);
// By the number of threads.
Status bench_octree_scaling(OctreeBench& bench);
// What settings trade for what: into files of `bench.effort.out`, and as tables.
Status bench_octree_trade(OctreeBench& bench);

inline constexpr std::size_t kBuildThreads = 2;

// An entrant for Race::add_work: builds a tree for which it frees the one before first, unmeasured.
class OurBuild {
  public:
    // Each build with `fresh` a builder that has no memory yet.
    OurBuild(const OctreeScene& scene, const SahSettings& settings, std::size_t threads, bool fresh = false);
    void prepare();
    void build();
    // What was built last; before that, builds.
    Result<SahTree> tree();

  private:
    SahTriangles triangles_;
    SahSettings settings_;
    std::size_t threads_;
    bool fresh_;
    std::unique_ptr<SahBuilder> builder_;
    Result<SahTree> tree_ = fail("nothing built yet");
};

// The same for Embree: a new scene each time; or, with `again`, the same scene over and over.
class EmbreeBuild {
  public:
    EmbreeBuild(const OctreeScene& scene, EmbreeDevice& device, EmbreeQuality quality, bool again = false);
    void prepare();
    void build() { built_->commit(); }
    std::size_t bytes() const { return built_->bytes(); }

  private:
    const OctreeScene& scene_;
    EmbreeDevice& device_;
    EmbreeQuality quality_;
    bool again_;
    std::unique_ptr<EmbreeScene> built_;
};

// Both must outlive the race.
template <class Build>
void add_build(Race& race, const std::string& name, Build& build) {
    race.add_work(
        name, [&build] { build.prepare(); }, [&build] { build.build(); });
}

// As EmbreeScene::cast, for our trees.
std::uint64_t cast_ours(const OctreeScene& scene, const SahTree& tree, InstructionSet set,
                        const RayView& view, int first_row, int last_row, float* distances);

inline double ms(double us) { return us / 1000; }

}  // namespace swath::bench
