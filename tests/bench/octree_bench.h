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

    // Fewer for a scene without figures, whose numbers are only for tables.
    int repetitions(const OctreeScene& scene, int full) const {
        if (effort.smoke) return 1;
        return scene.has_bars ? full : std::min(full, 3);
    }
    bool draws() const { return !effort.out.empty(); }
};

// Figures build_vs_kdtree_*, sah_cost_vs_kdtree_*, build_vs_embree_medium_*, build_fast_vs_embree_low_*: the
// time of builders and the quality of their trees.
Status bench_octree_builds(OctreeBench& bench);
// Figures rays_vs_embree_*: primary rays, and the work of each.
Status bench_octree_rays(OctreeBench& bench);
// Times by number of threads.
Status bench_octree_scaling(OctreeBench& bench);
// Varies settings; writes files into `bench.effort.out`, and tables.
Status bench_octree_trade(OctreeBench& bench);

inline constexpr std::size_t kBuildThreads = 2;

// The names of trees in tables and plots.
inline constexpr const char* kOursDefault = "ours, default";
inline constexpr const char* kOursFast = "ours, fast";
inline constexpr const char* kEmbreeLow = "Embree low";
inline constexpr const char* kEmbreeMedium = "Embree medium";
inline constexpr const char* kEmbreeHigh = "Embree high";

// A runner for Race::add_work that builds a tree. prepare() frees the tree before, unmeasured.
class OurBuild {
  public:
    // With `fresh`, each build has a new builder, without memory.
    OurBuild(const OctreeScene& scene, const SahSettings& settings, std::size_t threads, bool fresh = false);
    void prepare();
    void build();
    // The last tree; builds one if there is none.
    Result<SahTree> tree();

  private:
    SahTriangles triangles_;
    SahSettings settings_;
    std::size_t threads_;
    bool fresh_;
    std::unique_ptr<SahBuilder> builder_;
    Result<SahTree> tree_ = fail("nothing built yet");
};

// The same for Embree: each build makes a new scene, or, with `again`, builds the same scene anew.
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

// Does the same as EmbreeScene::cast with our trees.
std::uint64_t cast_ours(const OctreeScene& scene, const SahTree& tree, InstructionSet set,
                        const RayView& view, int first_row, int last_row, float* distances);

inline double ms(double us) { return us / 1000; }

}  // namespace swath::bench
