#include "client/run.h"

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
#include "common/base/log.h"
#include "common/program/progress.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/model.h"
#include "common/scene/model_blob.h"
#include "common/timeline/export.h"
#include "common/timeline/summary.h"

namespace swath {
namespace {

// Servers on one machine share its cores: each draws with its own thread and an equal part of the rest.
std::string raster_threads(std::size_t servers) {
    return std::to_string(std::max<std::size_t>(1, std::thread::hardware_concurrency() / servers) - 1);
}

// Viewers of a live run may ask for ray casters later.
bool builds_on_cuda(const ClientOptions& options) {
    return options.cuda && (options.view || has_raycast(options.draw.renderers)) && can_build_on_cuda();
}

// The model as any program finds it, wherever it runs on this machine.
std::string whole_name(const std::string& model) {
    return is_builtin(model) ? model : std::filesystem::absolute(model).string();
}

Result<std::unique_ptr<LocalCluster>> start_local(const ClientOptions& options) {
    LocalCluster::Options local;
    local.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    local.servers = options.local;
    local.arguments = {"--quiet", "--silence-ms",
                       std::to_string(options.timing.silence_limit / std::chrono::milliseconds(1))};
    local.server_arguments = {
        "--threads", options.threads >= 0 ? std::to_string(options.threads) : raster_threads(options.local)};
    // The servers see the devices that we see; if there is none, one line in the log is enough.
    if (builds_on_cuda(options))
        local.server_arguments.insert(local.server_arguments.end(), {"--trees-on", "cuda"});
    if (options.view) local.display_arguments = {"--view", *options.view};
    return LocalCluster::start(local);
}

std::optional<glm::vec3> to_light(const ClientOptions& options) {
    if (!options.light) return std::nullopt;
    return glm::vec3(glm::normalize(glm::dvec3(*options.light)));
}

// The pose of all frames; none: each frame has the path's.
std::optional<float> pose_of(const ClientOptions& options, const ObjectSet& scene) {
    if (!scene.moves()) return 0.0f;
    return options.view ? options.pose.value_or(0) : options.pose;
}

// A live run starts with the path's first camera.
Result<LiveView::Settings> live_settings(const ClientOptions& options, const ObjectSet& scene,
                                         const Camera& home) {
    LiveView::Settings live;
    live.bounds = scene.swept_bounds();
    live.limits = options.view_limits;
    live.seed = options.seed;
    live.start.camera = numbers_of(home);
    if (const auto camera = camera_of(live.start.camera); !camera)
        return fail_in("the model cannot be looked at", camera.error());
    live.start.width = std::min(options.width, live.limits.max_width);
    live.start.height = std::min(options.height, live.limits.max_height);
    live.start.algorithm = options.algorithm;
    live.start.setup = {options.granularity.depth ? scene.objects.size() : options.granularity.objects,
                        options.draw};
    return live;
}

// Quotes a word for a shell.
std::string quoted(const std::string& word) {
    if (!word.empty() &&
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                               "_-+=./:,@%") == std::string::npos)
        return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

// The command that draws the view of a live run, with the camera in a file.
std::string command_of(const ClientOptions& options, const LiveWish& wish,
                       const std::vector<Address>& servers, const Cut& cut) {
    const std::size_t count = std::min(wish.servers.value_or(servers.size()), servers.size());
    std::string where = fmt::format("--local {}", count);
    if (options.display) {
        ServerSource source = *options.servers;
        if (wish.servers) {
            source = {};
            source.list.assign(servers.begin(), servers.begin() + static_cast<std::ptrdiff_t>(count));
        }
        where =
            fmt::format("--servers {} --display {}", quoted(to_string(source)), to_string(*options.display));
    }
    const std::string what = cut.by == ObjectsBy::kSah
                                 ? fmt::format("--objects-by sah --objects {}", cut.objects)
                                 : fmt::format("--octree-depth {}", cut.depth);
    const DrawSettings& draw = wish.setup.draw;
    std::string how = renderer_list(draw.renderers);
    if (has_raycast(draw.renderers)) {
        how += to_arguments(draw.flags);
        if (options.cuda) how += " --trees-on cuda";
    }
    std::string look;
    if (options.pose) look += fmt::format(" --pose {}", *options.pose);
    if (options.light)
        look += fmt::format(" --light={},{},{}", options.light->x, options.light->y, options.light->z);
    return fmt::format(
        "swath-client {} {} --algorithm {} --renderer {} --cull {} {} --size {}x{} "
        "--background {:02x}{:02x}{:02x}{} --path view.camera --out view",
        quoted(whole_name(options.model)), where, name_of(wish.algorithm), how, name_of(draw.cull), what,
        wish.width, wish.height, options.background[0], options.background[1], options.background[2], look);
}

Status save_timeline(const std::string& file, const std::vector<FrameTimeline>& frames) {
    const std::string text = file.ends_with(".csv") ? to_csv(frames) : to_chrome_trace(frames);
    return write_file(file, text);
}

}  // namespace

Status run_client(const ClientOptions& options, StopSignals& signals) {
    const SteadyClock clock;
    const Nanoseconds begin = clock.now();
    SWATH_TRY(auto mesh, load_model(options.model));
    Buffer blob = options.single ? Buffer() : write_blob(mesh);
    const auto shared_scene =
        std::make_shared<const ObjectSet>(build_objects(std::move(mesh), options.granularity));
    const ObjectSet& scene = *shared_scene;
    log_info("{}: {} triangles in {} objects ({}), {:.2f} s", options.model, scene.mesh.triangle_count(),
             scene.objects.size(), to_string(scene.cut),
             std::chrono::duration<double>(clock.now() - begin).count());

    PathOptions path{options.frames, options.seed,
                     static_cast<float>(options.width) / static_cast<float>(options.height),
                     static_cast<float>(options.zoom)};
    SWATH_TRY(auto cameras, make_path(options.path, scene.swept_bounds(), path));

    const std::size_t frame_count = cameras.size();
    SWATH_TRY(const auto writer, PictureWriter::make(options.out, options.format, frame_count));
    if (options.out.empty() && !options.view) log_info("no pictures are kept; --out FOLDER keeps them");
    std::optional<Progress> progress;  // of a run that has an end, from when it begins to draw
    const auto begin_to_draw = [&] {
        if (!options.view) progress.emplace(frame_count, "frames", options.program.quiet, clock);
    };
    const auto on_picture = [&](FrameNumber frame, const Buffer& encoded) {
        if (progress) progress->step();
        return writer.write(frame, encoded);
    };

    Result<std::vector<FrameTimeline>> frames = fail("nothing was rendered");
    if (options.single) {
        SingleJob job;
        job.scene = &scene;
        job.renderer = {options.draw.renderers.front(), options.draw.flags, drawing_threads(options.threads),
                        builds_on_cuda(options)};
        job.cull = options.draw.cull;
        job.cameras = std::move(cameras);
        job.pose = pose_of(options, scene);
        job.to_light = to_light(options);
        job.width = options.width;
        job.height = options.height;
        job.background = options.background;
        job.format = options.format;
        begin_to_draw();
        frames = render_single(job, clock, on_picture);
    } else {
        std::unique_ptr<LocalCluster> local;
        ClusterJob job;
        if (options.servers) {
            job.servers = *options.servers;
            job.display = *options.display;
        } else {
            SWATH_TRY(local, start_local(options));
            job.servers.list = local->servers();
            job.display = local->display();
        }
        job.model = whole_name(options.model);  // servers elsewhere look for the file under this path
        job.scene = shared_scene;
        job.blob = std::move(blob);
        job.draw = options.draw;
        job.algorithm = options.algorithm;
        job.pose = pose_of(options, scene);
        job.to_light = to_light(options);
        if (options.view) {
            SWATH_TRY(job.live, live_settings(options, scene, cameras.front()));
        } else {
            job.cameras = std::move(cameras);
        }
        job.command = [&options](const LiveWish& wish, const std::vector<Address>& servers, const Cut& cut) {
            return command_of(options, wish, servers, cut);
        };
        job.width = options.width;
        job.height = options.height;
        job.background = options.background;
        job.format = options.format;
        job.frames_in_flight = options.in_flight;
        job.session = std::uint64_t{std::random_device{}()} << 32 | std::random_device{}();
        job.connect_patience = std::chrono::duration_cast<Nanoseconds>(
            std::chrono::duration<double>(options.connect_patience_s));
        job.timing = options.timing;
        frames = run_cluster(
            std::move(job), clock, signals,
            [&](const std::string& page, std::size_t servers) {
                log_info("{} servers and the display are ready after {:.2f} s", servers,
                         std::chrono::duration<double>(clock.now() - begin).count());
                if (options.view) std::cout << "viewer " << page << std::endl;
                begin_to_draw();
            },
            on_picture);
    }
    if (!frames) return tl::unexpected(frames.error());

    std::cout << to_text(summarise(*frames));
    if (!options.view) std::cout << "pictures: " << writer.summary() << '\n';
    if (!options.timeline.empty()) {
        SWATH_TRY_VOID(save_timeline(options.timeline, *frames));
        std::cout << "timeline: " << options.timeline
                  << (options.timeline.ends_with(".json")
                          ? " (open it in ui.perfetto.dev, or offline in a Chromium's chrome://tracing)\n"
                          : "\n");
    }
    return {};
}

}  // namespace swath
