#include "client/run.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <random>
#include <thread>

#include "client/cluster/run_cluster.h"
#include "client/launch/local_cluster.h"
#include "client/path/path.h"
#include "client/report/picture_writer.h"
#include "client/single/single_run.h"
#include "common/base/file.h"
#include "common/program/progress.h"
#include "common/scene/model.h"
#include "common/scene/model_blob.h"
#include "common/timeline/export.h"
#include "common/timeline/summary.h"

namespace swath {
namespace {

// Several servers share this machine's cores: each draws with its own thread and as many more as are left
// over.
std::string raster_threads(std::size_t servers) {
    return std::to_string(std::max<std::size_t>(1, std::thread::hardware_concurrency() / servers) - 1);
}

Result<std::unique_ptr<LocalCluster>> start_local(const ClientOptions& options) {
    LocalCluster::Options local;
    local.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    local.servers = options.local;
    local.arguments = {"--quiet", "--silence-ms",
                       std::to_string(options.timing.silence_limit / std::chrono::milliseconds(1))};
    local.server_arguments = {
        "--threads", options.threads >= 0 ? std::to_string(options.threads) : raster_threads(options.local)};
    return LocalCluster::start(local);
}

Status save_timeline(const std::string& file, const std::vector<FrameTimeline>& frames) {
    const std::string text = file.ends_with(".csv") ? to_csv(frames) : to_chrome_trace(frames);
    return write_file(file, text);
}

}  // namespace

Status run_client(const ClientOptions& options) {
    const SteadyClock clock;
    const Nanoseconds begin = clock.now();
    auto mesh = load_model(options.model);
    if (!mesh) return tl::unexpected(mesh.error());
    Buffer blob = options.single ? Buffer() : write_blob(*mesh);
    const ObjectSet scene = build_objects(std::move(*mesh), options.granularity);
    spdlog::info("{}: {} triangles in {} objects (octree depth {}), {:.2f} s", options.model,
                 scene.mesh.triangle_count(), scene.objects.size(), scene.depth,
                 std::chrono::duration<double>(clock.now() - begin).count());

    PathOptions path{options.frames, options.seed,
                     static_cast<float>(options.width) / static_cast<float>(options.height),
                     static_cast<float>(options.zoom)};
    auto cameras = make_path(options.path, scene.bounds, path);
    if (!cameras) return tl::unexpected(cameras.error());

    const PictureWriter writer(options.out, options.format);
    Progress progress(cameras->size(), "frames", options.program.quiet, clock);
    const auto on_picture = [&](FrameNumber frame, const Buffer& encoded) {
        progress.step();
        return writer.write(frame, encoded);
    };

    Result<std::vector<FrameTimeline>> frames = fail("nothing was rendered");
    if (options.single) {
        SingleJob job;
        job.scene = &scene;
        job.renderer = options.renderer;
        job.cull = options.cull;
        job.cull_threads = drawing_threads(options.threads);
        job.cameras = std::move(*cameras);
        job.width = options.width;
        job.height = options.height;
        job.background = options.background;
        job.format = options.format;
        frames = render_single(job, clock, on_picture);
    } else {
        std::unique_ptr<LocalCluster> local;
        ClusterJob job;
        job.servers = options.servers;
        if (options.display) job.display = *options.display;
        if (options.servers.empty()) {
            auto started = start_local(options);
            if (!started) return tl::unexpected(started.error());
            local = std::move(*started);
            job.servers = local->servers();
            job.display = local->display();
        }
        // Servers elsewhere look for the file under the path that it has here.
        job.model =
            is_builtin(options.model) ? options.model : std::filesystem::absolute(options.model).string();
        job.scene = &scene;
        job.blob = std::move(blob);
        job.renderer = options.renderer;
        job.cull = options.cull;
        job.algorithm = options.algorithm;
        job.cameras = std::move(*cameras);
        job.width = options.width;
        job.height = options.height;
        job.background = options.background;
        job.format = options.format;
        job.frames_in_flight = options.in_flight;
        job.session = std::uint64_t{std::random_device{}()} << 32 | std::random_device{}();
        job.connect_patience = std::chrono::duration_cast<Nanoseconds>(
            std::chrono::duration<double>(options.connect_patience_s));
        job.timing = options.timing;
        const std::size_t servers = job.servers.size();
        frames = run_cluster(
            std::move(job), clock,
            [&] {
                spdlog::info("{} servers and the display are ready after {:.2f} s", servers,
                             std::chrono::duration<double>(clock.now() - begin).count());
            },
            on_picture);
    }
    if (!frames) return tl::unexpected(frames.error());

    std::cout << to_text(summarise(*frames));
    if (!options.timeline.empty()) {
        if (const auto status = save_timeline(options.timeline, *frames); !status) return status;
        std::cout << "timeline: " << options.timeline
                  << (options.timeline.ends_with(".json") ? " (open it in ui.perfetto.dev)\n" : "\n");
    }
    if (!options.out.empty()) std::cout << "pictures: " << frames->size() << " in " << options.out << "/\n";
    return {};
}

}  // namespace swath
