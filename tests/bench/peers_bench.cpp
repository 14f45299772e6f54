#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>

#include "client/cluster/run_cluster.h"
#include "client/path/path.h"
#include "common/program/cli.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/model.h"
#include "common/scene/model_blob.h"
#include "display/session/display.h"
#include "server/session/server.h"
#include "tests/bench/cached_renderer.h"
#include "tests/bench/figures.h"

namespace swath::bench {
namespace {

// Times of peers for the same work on a machine like this one (2 cores): IceT 2.2, direct strategy, MPI over
// TCP, a k-d split of the Dragon, all ranks on one core; OpenSceneGraph 3.6.5 with two llvmpipe threads.
// 1280x960, about 42 % of the pixels covered.
struct Peer {
    std::size_t servers;
    double icet_cpu_ns;  // per screen pixel
    double icet_kib;     // per frame
    double share;        // the part of those bytes that we allow ourselves
};
constexpr std::array<Peer, 3> kPeers{Peer{2, 2.6, 2934, 0.7}, Peer{4, 3.8, 4018, 0.5},
                                     Peer{8, 6.2, 5809, 0.5}};
constexpr double kOsgFps = 8.7;
constexpr double kOsgCpuMs = 190;

constexpr int kWidth = 1280;
constexpr int kHeight = 960;
constexpr std::size_t kViews = 9;

// The peers' orbit: about y, 30 degrees of view, the eye 0.29 from the box's centre.
std::vector<Camera> peers_orbit(const Box& bounds) {
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < kViews; ++i) {
        const double angle = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(kViews);
        Camera camera;
        camera.target = bounds.centre();
        camera.eye = camera.target + 0.29f * glm::vec3(std::sin(angle), 0, std::cos(angle));
        camera.fov_y = 0.5235988f;
        cameras.push_back(with_depth_range(camera, bounds));
    }
    return cameras;
}

// A child process that runs one of our servers or displays, and ends with this object.
class Child {
  public:
    template <class Make>
    explicit Child(const Make& make) {
        std::array<int, 2> out{};
        if (::pipe(out.data()) != 0) std::abort();
        pid_ = ::fork();
        if (pid_ == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);
            const SteadyClock clock;
            boost::asio::io_context io(1);
            const auto host = make(io, clock);
            const std::uint16_t port = host ? (*host)->address().port : std::uint16_t{0};
            if (::write(out[1], &port, sizeof port) != sizeof port) ::_exit(1);
            io.run();
            ::_exit(0);
        }
        ::close(out[1]);
        if (::read(out[0], &address_.port, sizeof address_.port) != sizeof address_.port) address_.port = 0;
        ::close(out[0]);
        address_.host = "127.0.0.1";
    }
    ~Child() {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    const Address& address() const { return address_; }
    double cpu_s() const {
        clockid_t clock{};
        timespec time{};
        if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

  private:
    pid_t pid_ = -1;
    Address address_;
};

double process_cpu_s() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Measures swap, composite and gather of `peer.servers` server processes and a display on one core over TCP:
// all their CPU time and the client's, less the timeline's partitioning, culling, drawing and reading back.
Status bench_swap_stage(Figures& figures, const Effort& effort, const Peer& peer,
                        const std::shared_ptr<const ObjectSet>& scene, const Mesh& mesh) {
    const std::size_t passes =
        2 + 2 * static_cast<std::size_t>(effort.repetitions);  // the first one fills the caches
    std::vector<std::unique_ptr<Child>> servers;
    for (std::size_t i = 0; i < peer.servers; ++i)
        servers.push_back(std::make_unique<Child>([](boost::asio::io_context& io, const Clock& clock) {
            ServerOptions options;
            options.cache = std::filesystem::temp_directory_path() / "swath-bench";
            return make_server(io, options, clock,
                               [](const RendererSetup& setup,
                                  const ObjectSet& objects) -> Result<std::unique_ptr<Renderer>> {
                                   SWATH_TRY(auto renderer, make_renderer(setup, objects));
                                   return std::make_unique<CachedRenderer>(std::move(renderer));
                               });
        }));
    const Child display(
        [](boost::asio::io_context& io, const Clock& clock) { return make_display(io, {}, clock); });

    ClusterJob job;
    for (const auto& server : servers) job.servers.list.push_back(server->address());
    job.display = display.address();
    job.model = "none: the client has it";
    job.scene = scene;
    job.blob = write_blob(mesh);
    const auto orbit = peers_orbit(scene->bounds);
    for (std::size_t pass = 0; pass < passes; ++pass)
        job.cameras.insert(job.cameras.end(), orbit.begin(), orbit.end());
    job.width = kWidth;
    job.height = kHeight;
    job.session = std::random_device{}();
    job.timing.silence_limit = std::chrono::seconds(20);

    const auto all_cpu = [&] {
        double sum = process_cpu_s() + display.cpu_s();
        for (const auto& server : servers) sum += server->cpu_s();
        return sum;
    };
    std::vector<double> cpu_at;  // at the end of each pass
    const SteadyClock clock;
    std::size_t done = 0;
    StopSignals signals(kExitFailed, true);
    const auto on_picture = [&](FrameNumber, const Buffer&) -> Status {
        if (++done % kViews == 0) cpu_at.push_back(all_cpu());
        return {};
    };
    SWATH_TRY(const auto timelines,
              run_cluster(
                  std::move(job), clock, signals, [](const std::string&, std::size_t) {}, on_picture));

    std::vector<double> cpu_ns;
    std::vector<double> kib;
    for (std::size_t pass = 2; pass < passes; ++pass) {
        double other = 0;
        double bytes = 0;
        for (std::size_t f = pass * kViews; f < (pass + 1) * kViews; ++f)
            for (const MachineTimeline& machine : timelines[f].machines) {
                bytes += static_cast<double>(machine[Counter::kSwapBytes] + machine[Counter::kTileBytes]);
                for (const Span& span : machine.spans)
                    if (span.phase == Phase::kPartition || span.phase == Phase::kCull ||
                        span.phase == Phase::kRender || span.phase == Phase::kPixelRead)
                        other += std::chrono::duration<double>(span.cpu).count();
            }
        cpu_ns.push_back((cpu_at[pass] - cpu_at[pass - 1] - other) / kViews / (kWidth * kHeight) * 1e9);
        kib.push_back(bytes / kViews / 1024);
    }
    figures.add(fmt::format("swap_cpu_ns_n{}", peer.servers), cpu_ns, "ns/pixel",
                fmt::format("at most IceT's {:.1f}: CPU of all machines a screen pixel", peer.icet_cpu_ns));
    figures.add(fmt::format("swap_kib_n{}", peer.servers), kib, "KiB",
                fmt::format("at most {:.0f} = {:.1f} of IceT's {:.0f}: swapped and gathered a frame",
                            peer.share * peer.icet_kib, peer.share, peer.icet_kib));
    return {};
}

// Limits this process and its children to one core, as for IceT's figures.
class OneCore {
  public:
    OneCore() {
        ::sched_getaffinity(0, sizeof before_, &before_);
        cpu_set_t one;
        CPU_ZERO(&one);
        for (int i = 0; i < CPU_SETSIZE; ++i)
            if (CPU_ISSET(i, &before_)) {
                CPU_SET(i, &one);
                break;
            }
        ::sched_setaffinity(0, sizeof one, &one);
    }
    ~OneCore() { ::sched_setaffinity(0, sizeof before_, &before_); }
    OneCore(const OneCore&) = delete;
    OneCore& operator=(const OneCore&) = delete;

  private:
    cpu_set_t before_{};
};

// Measures whole frames of real processes.
Status bench_frames(Figures& figures, const Effort& effort, const Box& bounds) {
    const auto folder = std::filesystem::temp_directory_path() / fmt::format("swath-bench-{}", ::getpid());
    std::filesystem::create_directories(folder);
    const std::string path = (folder / "orbit.txt").string();
    {
        std::ofstream file(path);
        for (const Camera& c : peers_orbit(bounds))
            file << fmt::format("{} {} {} {} {} {} 0 1 0 30\n", c.eye.x, c.eye.y, c.eye.z, c.target.x,
                                c.target.y, c.target.z);
    }
    const auto render = [&](std::size_t count) {
        return run_program({client_program(), effort.model, "--quiet", "--local", "2", "--path", path,
                            "--frames", std::to_string(count)});
    };
    const auto frames = static_cast<double>(effort.frames);
    std::vector<double> fps;
    std::vector<double> cpu_ms;
    for (int i = 0; i < effort.repetitions; ++i) {
        const Finished start = render(1);
        const Finished run = render(1 + effort.frames);
        if (start.exit_code != 0 || run.exit_code != 0)
            return fail("swath-client failed with exit code {}", run.exit_code);
        fps.push_back(run.frames_per_s());
        cpu_ms.push_back((run.cpu_s - start.cpu_s) / frames * 1000);
    }
    std::filesystem::remove_all(folder);
    figures.add("fps_n2", fps, "1/s",
                fmt::format("more than OpenSceneGraph's {:.1f}, the best single process", kOsgFps));
    figures.add("cpu_ms_n2", cpu_ms, "ms",
                fmt::format("less than its {:.0f}: CPU of all programs a frame", kOsgCpuMs));
    return {};
}

}  // namespace

Status bench_peers(Figures& figures, const Effort& effort) {
    ::setenv("LP_NUM_THREADS", "0", 1);
    SWATH_TRY(const auto mesh, load_model(effort.model));
    const auto scene = std::make_shared<const ObjectSet>(build_objects(mesh, {}));
    {
        const OneCore one_core;
        for (const Peer& peer : kPeers) SWATH_TRY_VOID(bench_swap_stage(figures, effort, peer, scene, mesh));
    }
    figures.note(
        "IceT 2.2.0: 2.6, 3.8, 6.2 ns and 2,934, 4,018, 5,809 KiB on 2, 4, 8 ranks (direct, TCP, one core).");
    figures.note(
        "CPU a frame, one process: OpenSceneGraph 3.6.5 192-201 ms, 8.7 frames/s; VTK 9.1 242-245 ms, 7.25; "
        "ParaView 5.11 265-302 ms, 6.3.");
    return bench_frames(figures, effort, scene->bounds);
}

}  // namespace swath::bench
