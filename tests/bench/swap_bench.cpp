#include <chrono>
#include <cstring>
#include <random>

#include "client/partition/partitioner.h"
#include "client/partition/projection.h"
#include "client/path/path.h"
#include "common/cullers/make_culler.h"
#include "common/image/pixel_codec.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/model.h"
#include "common/wire/codec.h"
#include "tests/bench/figures.h"

namespace swath::bench {
namespace {

// The seconds of one call of `work`, which is repeated until they add up to a tenth.
template <class Work>
double seconds(const Work& work) {
    for (int times = 1;; times *= 2) {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < times; ++i) work();
        const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (spent >= 0.1) return spent / times;
    }
}

// The data of a composite of planes: it reads 12 bytes from the peer, and reads and writes 12 of ours.
struct Planes {
    explicit Planes(std::size_t n) : colour(n), depth(n), id(n) {}
    std::vector<std::uint32_t> colour;
    std::vector<float> depth;
    std::vector<ObjectId> id;
};

Planes random_planes(std::size_t n, unsigned seed) {
    Planes planes(n);
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < n; ++i) {
        planes.colour[i] = static_cast<std::uint32_t>(random());
        planes.depth[i] = static_cast<float>(random() % 1000) / 1000.0f;  // ties included
        planes.id[i] = static_cast<ObjectId>(random() % 1500);
    }
    return planes;
}

void bench_composite(Figures& figures, int repetitions, std::size_t n, const std::string& name,
                     const std::string& bar) {
    const Planes theirs = random_planes(n, 1);
    const Planes start = random_planes(n, 2);
    Planes ours = start;
    Planes scratch(n);
    std::vector<double> rate;
    std::vector<double> of_bound;
    for (int i = 0; i < repetitions; ++i) {
        ours = start;
        const double composite = seconds([&] {
            composite_pixels(n, theirs.colour.data(), theirs.depth.data(), theirs.id.data(),
                             ours.colour.data(), ours.depth.data(), ours.id.data());
        });
        // The bound: copying 24 bytes a pixel (24 read, 24 written; composite reads 24 and writes 12).
        const double copy = seconds([&] {
            std::memcpy(scratch.colour.data(), theirs.colour.data(), 4 * n);
            std::memcpy(scratch.depth.data(), theirs.depth.data(), 4 * n);
            std::memcpy(scratch.id.data(), theirs.id.data(), 4 * n);
            std::memcpy(ours.colour.data(), start.colour.data(), 4 * n);
            std::memcpy(ours.depth.data(), start.depth.data(), 4 * n);
            std::memcpy(ours.id.data(), start.id.data(), 4 * n);
        });
        rate.push_back(static_cast<double>(n) / composite * 1e-9);
        of_bound.push_back(copy * 36 / 48 / composite);
    }
    figures.add(name, rate, "Gpixel/s", bar);
    figures.add(name + "_of_bound", of_bound, "ratio", "1 = memcpy's bytes a second on the same planes");
}

}  // namespace

Status bench_swap(Figures& figures, const Effort& effort) {
    SWATH_TRY(auto mesh, load_model(effort.model));
    const ObjectSet scene = build_objects(std::move(mesh), {});
    SWATH_TRY(const auto cameras, make_path("orbit", scene.bounds, {8, 1, 4.0f / 3.0f, 1.0f}));
    SWATH_TRY(auto renderer, make_renderer({.kind = default_renderer().kind}, scene));

    const auto partitioner = make_partitioner(Algorithm::kHybrid, scene.objects);
    const SteadyClock clock;
    ThreadTeam team(1, clock);
    LeafCull cull = make_leaf_cull(CullAlgorithm::kWide, scene, team);
    std::vector<double> bytes_a_pixel;
    std::vector<double> ids_a_pixel;
    for (FrameNumber number = 0; number < cameras.size(); ++number) {
        const View view = make_view(cameras[number], 1280, 960);
        const auto projected = project(scene.objects, view);
        const FramePlan plan = partitioner->partition({number, view, projected, 8});
        double pixels = 0;
        double bytes = 0;
        double ids = 0;
        PixelFrame frame;
        for (const Transfer& t : transfers(plan)) {
            const ServerShare& share = plan.servers[index(t.from)];
            const CullResult list = cull.cull(share.group, view, share.content);
            SWATH_TRY_VOID(renderer->draw(list.ranges, view, share.content));
            frame.reshape(share.content);
            SWATH_TRY_VOID(renderer->read(share.content, frame));
            Buffer body;
            const BodySizes sizes = encode_swath(frame, t.region, body);
            pixels += sizes.pixels;
            ids += sizes.id_bytes;
            bytes += static_cast<double>(kPrefixBytes + encode_head(SwathPixels{number, sizes}).size() +
                                         body.size());
        }
        bytes_a_pixel.push_back(bytes / pixels);
        ids_a_pixel.push_back(ids / pixels);
    }
    figures.add("bytes_per_active_pixel", bytes_a_pixel, "bytes",
                "8, spans, ids and framing: the Dragon on 8 servers, by frame");
    figures.add("id_bytes_per_active_pixel", ids_a_pixel, "bytes", "the ids' part of it");
    bench_composite(figures, effort.repetitions, 1280 * 960, "composite_gpixel_per_s",
                    "at least 0.5: a whole screen, larger than the caches near the core");
    bench_composite(figures, effort.repetitions, 20'000, "composite_swath_gpixel_per_s",
                    "a swath as the hybrid's servers swap them");
    return {};
}

}  // namespace swath::bench
