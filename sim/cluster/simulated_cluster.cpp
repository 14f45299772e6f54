#include "sim/cluster/simulated_cluster.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "client/cost/client_time.h"
#include "client/cost/frame_work.h"
#include "client/cost/pricer.h"
#include "client/director/director.h"
#include "client/path/path.h"
#include "common/base/check.h"
#include "display/assemble/assembly.h"
#include "server/swap/frame_swap.h"
#include "sim/cluster/simulated_server.h"
#include "sim/engine/event_queue.h"
#include "sim/engine/flow_network.h"
#include "sim/engine/station.h"
#include "sim/engine/stream.h"

namespace swath::sim {
namespace {

// A report has a few spans and counters; the display's task has a rectangle a tile.
constexpr double kReportBytes = 300;
constexpr double kAssembleBytesPerServer = 24;

double seconds(Nanoseconds time) { return std::chrono::duration<double>(time).count(); }

class Cluster {
  public:
    explicit Cluster(const ClusterScenario& scenario)
        : scenario_(scenario),
          partitioner_(make_partitioner(scenario.algorithm, scenario.objects)),
          network_(events_, rates_of(scenario)),
          director_(scenario.cameras.size(), scenario.frames_in_flight),
          client_(events_),
          display_(events_),
          assembly_(scenario.frames_in_flight) {
        for (std::size_t s = 0; s < scenario.servers; ++s)
            servers_.push_back(std::make_unique<SimulatedServer>(
                events_, scenario.hardware.server.compositing, scenario.frames_in_flight,
                SimulatedServer::Outside{
                    [this, s](FrameNumber f, const SwathWork& swath) { send_swath(f, server_id(s), swath); },
                    [this, s](FrameNumber f) { send_tile(f, server_id(s)); },
                    [this, s](FrameNumber f) { send_report(f, server_id(s)); }}));
    }

    ClusterRunCosts run() {
        follow(director_.on_start());
        events_.run();
        CHECK(director_.complete() == scenario_.cameras.size());
        return costs();
    }

  private:
    // A frame from its issue to its last report.
    struct Frame {
        Nanoseconds begin{0};
        std::vector<ServerWork> work;
        double overlap_factor = 1;
        MachineTimeline client;
        MachineTimeline display;
        std::size_t reports_missing = 0;
    };

    static constexpr std::size_t kClient = 0;
    static std::size_t host(ServerId id) { return 1 + index(id); }
    std::size_t display_host() const { return 1 + servers_.size(); }

    static NetworkRates rates_of(const ClusterScenario& scenario) {
        const Hardware::Network& network = scenario.hardware.network;
        return {std::vector<NicRates>(scenario.servers + 2, {network.bytes_per_s, network.bytes_per_s}),
                network.core_bytes_per_s};
    }

    // Sends on the connection of the two, which is made when it is first needed.
    void send(std::size_t from, std::size_t to, double bytes, EventQueue::Action arrived) {
        std::unique_ptr<Stream>& stream = streams_[{from, to}];
        if (!stream)
            stream = std::make_unique<Stream>(events_, network_,
                                              nanoseconds(scenario_.hardware.network.latency_s), from, to);
        stream->send(bytes, std::move(arrived));
    }

    void follow(const Director::Actions& actions) {
        for (const DirectorAction& action : actions)
            if (action.kind == DirectorAction::Kind::kIssue) issue(action.frame);
    }

    void issue(FrameNumber number) {
        View view = make_view(scenario_.cameras[number], scenario_.width, scenario_.height);
        view.pose = path_pose(number);
        const Accounting accounting =
            scenario_.hardware.server.culls ? Accounting::kCluster : Accounting::kPaper;
        const auto objects = project(scenario_.objects, view, accounting);
        const FramePlan plan = partitioner_->partition({number, view, objects, scenario_.servers});
        Frame& frame = frames_[number];
        frame.work = frame_work(plan, objects, scenario_.hardware);
        frame.overlap_factor = overlap_factor(plan, scenario_.objects);
        singles_s_.push_back(drawing_s(objects));
        const double time_s =
            client_s(objects.size(), scenario_.servers, scenario_.algorithm, scenario_.hardware);
        client_.submit(nanoseconds(time_s), [this, number](Nanoseconds begin, Nanoseconds end) {
            Frame& issued = frames_.at(number);
            issued.begin = begin;
            issued.client.spans.push_back({Phase::kPartition, begin, end, end - begin});
            send_tasks(number);
        });
    }

    // The seconds that one server takes to draw everything.
    double drawing_s(std::span<const ProjectedObject> objects) const {
        double polygons = 0;
        Rect covered;
        for (const ProjectedObject& object : objects) {
            polygons += static_cast<double>(object.work);
            if (object.work > 0) covered = bounding(covered, object.box);
        }
        return Pricer(scenario_.hardware).render_s(polygons, covered);
    }

    void send_tasks(FrameNumber number) {
        Frame& frame = frames_.at(number);
        std::size_t working = 0;
        std::vector<ServerId> tiles;
        for (std::size_t s = 0; s < frame.work.size(); ++s) {
            const ServerWork& work = frame.work[s];
            if (work.has_tile) tiles.push_back(server_id(s));
            if (!work.takes_part) continue;
            ++working;
            send(kClient, host(server_id(s)), work.task_bytes,
                 [this, number, s] { servers_[s]->on_task(number, frames_.at(number).work[s]); });
        }
        const double bytes = kReportBytes + kAssembleBytesPerServer * static_cast<double>(tiles.size());
        send(kClient, display_host(), bytes,
             [this, number, tiles = std::move(tiles)] { follow(decided(assembly_.on_task(number, tiles))); });
        frame.reports_missing = working + 1;
        director_.on_issued(number, working);
    }

    void send_swath(FrameNumber number, ServerId from, const SwathWork& swath) {
        send(host(from), host(swath.peer), swath.bytes,
             [this, number, from, to = index(swath.peer), merge_s = swath.merge_s] {
                 servers_[to]->on_swath(number, from, merge_s);
             });
    }

    void send_tile(FrameNumber number, ServerId from) {
        send(host(from), display_host(), frames_.at(number).work[index(from)].tile_bytes,
             [this, number, from] { follow(decided(assembly_.on_tile(number, from))); });
    }

    void send_report(FrameNumber number, ServerId from) {
        send(host(from), kClient, kReportBytes, [this, number] {
            const auto actions = decided(director_.on_server_report(number));
            end_report(number);
            follow(actions);
        });
    }

    void follow(const Assembly::Actions& actions) {
        for (const AssemblyAction& action : actions) {
            const FrameNumber number = action.frame;
            if (action.kind == AssemblyAction::Kind::kAssemble) {
                const double time_s = frames_.at(number).work[index(action.server)].display_s;
                display_.submit(nanoseconds(time_s), [this, number](Nanoseconds begin, Nanoseconds end) {
                    frames_.at(number).display.spans.push_back({Phase::kAssemble, begin, end, end - begin});
                });
            } else {
                display_.submit(Nanoseconds(0),
                                [this, number](Nanoseconds, Nanoseconds end) { on_picture(number, end); });
            }
        }
    }

    void on_picture(FrameNumber number, Nanoseconds when) {
        pictures_.push_back(when);
        if (scenario_.on_picture) scenario_.on_picture();
        latency_s_ += seconds(when - frames_.at(number).begin);
        send(display_host(), kClient, kReportBytes, [this, number] {
            const auto actions = decided(director_.on_display_report(number));
            end_report(number);
            follow(actions);
        });
    }

    // Counts a report; the last one ends the frame.
    void end_report(FrameNumber number) {
        Frame& frame = frames_.at(number);
        if (--frame.reports_missing > 0) return;
        if (scenario_.keep_timelines) {
            FrameTimeline timeline;
            timeline.frame = number;
            timeline.overlap_factor = frame.overlap_factor;
            frame.client.machine = "client";
            frame.display.machine = "display";
            timeline.machines.push_back(std::move(frame.client));
            for (std::size_t s = 0; s < servers_.size(); ++s) {
                MachineTimeline machine;
                machine.machine = server_name(server_id(s));
                machine.spans = servers_[s]->take_spans(number);
                timeline.machines.push_back(std::move(machine));
            }
            timeline.machines.push_back(std::move(frame.display));
            timelines_.push_back(std::move(timeline));
        } else {
            for (const auto& server : servers_) server->take_spans(number);
        }
        frames_.erase(number);
    }

    ClusterRunCosts costs() {
        const std::size_t frames = pictures_.size();
        const double run_s = seconds(events_.now());
        ClusterRunCosts costs;
        costs.latency_s = latency_s_ / static_cast<double>(frames);
        costs.events = events_.executed();
        // A frame begins when the one `frames_in_flight` before it is over. So pictures come in rounds of
        // that many, perhaps in a burst, and only whole rounds have the mean distance. The last ones count;
        // the rest at the beginning, where the pipeline fills, does not.
        const std::size_t rounds = (frames - 1) / scenario_.frames_in_flight;
        const std::size_t counted = rounds > 0 ? rounds * scenario_.frames_in_flight : frames;
        const Nanoseconds begin = rounds > 0 ? pictures_[frames - 1 - counted] : Nanoseconds(0);
        costs.frame_s = seconds(pictures_.back() - begin) / static_cast<double>(counted);
        costs.single_s =
            std::accumulate(singles_s_.end() - static_cast<std::ptrdiff_t>(counted), singles_s_.end(), 0.0) /
            static_cast<double>(counted);

        const auto share = [&](double busy_s) { return run_s > 0 ? busy_s / run_s : 0; };
        const auto on_link = [&](double bytes) { return bytes / scenario_.hardware.network.bytes_per_s; };
        double draw_s = 0;
        double host_s = 0;
        double link_s = 0;
        for (std::size_t s = 0; s < servers_.size(); ++s) {
            draw_s = std::max(draw_s, seconds(servers_[s]->draw_busy()));
            host_s = std::max(host_s, seconds(servers_[s]->pixel_busy()));
            const std::size_t at = host(server_id(s));
            link_s = std::max({link_s, on_link(network_.bytes_out(at)), on_link(network_.bytes_in(at))});
        }
        const bool on_card = scenario_.hardware.server.compositing == Compositing::kGraphics;
        const double client_link_s =
            std::max(on_link(network_.bytes_out(kClient)), on_link(network_.bytes_in(kClient)));
        costs.use.push_back({"client", share(seconds(client_.busy()))});
        costs.use.push_back({"client network", share(client_link_s)});
        costs.use.push_back({on_card ? "server graphics" : "server drawing", share(draw_s)});
        if (!on_card) costs.use.push_back({"server compositing", share(host_s)});
        costs.use.push_back({"server network", share(link_s)});
        if (const auto core = scenario_.hardware.network.core_bytes_per_s)
            costs.use.push_back({"network core", share(network_.bytes() / *core)});
        costs.use.push_back({"display network", share(on_link(network_.bytes_in(display_host())))});
        costs.use.push_back({"display", share(seconds(display_.busy()))});
        std::sort(timelines_.begin(), timelines_.end(),
                  [](const FrameTimeline& a, const FrameTimeline& b) { return a.frame < b.frame; });
        costs.timelines = std::move(timelines_);
        return costs;
    }

    const ClusterScenario& scenario_;
    std::unique_ptr<Partitioner> partitioner_;
    EventQueue events_;
    FlowNetwork network_;
    std::map<std::pair<std::size_t, std::size_t>, std::unique_ptr<Stream>> streams_;
    Director director_;
    Station client_;
    std::vector<std::unique_ptr<SimulatedServer>> servers_;
    Station display_;
    Assembly assembly_;
    std::map<FrameNumber, Frame> frames_;
    std::vector<FrameTimeline> timelines_;
    std::vector<Nanoseconds> pictures_;  // when each was complete, by frame
    double latency_s_ = 0;
    std::vector<double> singles_s_;  // by frame
};

}  // namespace

ResourceUse busiest(std::span<const ResourceUse> use) {
    CHECK(!use.empty());
    return *std::ranges::max_element(use, {}, &ResourceUse::share);
}

ClusterRunCosts simulate(const ClusterScenario& scenario) {
    CHECK(!scenario.cameras.empty());
    CHECK(scenario.servers >= 1u);
    CHECK(scenario.servers <= kMaxServers);
    CHECK(scenario.frames_in_flight >= 1u);
    return Cluster(scenario).run();
}

}  // namespace swath::sim
