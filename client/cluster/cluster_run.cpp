#include "client/cluster/cluster_run.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cstring>
#include <filesystem>
#include <new>
#include <utility>

#include "client/cost/frame_work.h"
#include "client/path/path.h"
#include "common/base/check.h"
#include "common/base/log.h"
#include "common/timeline/phase_timer.h"

namespace swath {
namespace {

constexpr std::size_t kLiveHistory = 240;  // frames whose timelines a live run keeps

}  // namespace

ClusterRun::ClusterRun(boost::asio::io_context& io, ClusterJob job, const Clock& clock, Handlers handlers)
    : io_(io),
      job_(std::move(job)),
      clock_(clock),
      handlers_(std::move(handlers)),
      director_(job_.live ? Director::live(job_.frames_in_flight)
                          : Director(job_.cameras.size(), job_.frames_in_flight)),
      broadcast_([this](NoteTopic topic, FrameNumber frame, const std::string& text) {
          Buffer body(text.size());
          std::memcpy(body.data(), text.data(), text.size());
          // If the display does not take it, the next frame will show.
          (void)machines_->tell_display(Note{topic, frame}, std::move(body));
      }),
      patience_(io) {
    if (job_.live) live_.emplace(*job_.live);
    use(job_.scene);
}

void ClusterRun::start() {
    Machines::Job job;
    job.servers = job_.servers;
    job.display = job_.display;
    job.model = job_.model;
    job.blob = std::move(job_.blob);
    job.drawing = {job_.draw, job_.scene->cut};
    job.objects = job_.scene->objects.size();
    job.format = job_.format;
    job.frames_in_flight = job_.frames_in_flight;
    job.live = live_.has_value();
    job.session = job_.session;
    job.patience = job_.connect_patience;
    job.timing = job_.timing;
    const std::weak_ptr<ClusterRun> weak = weak_from_this();
    Machines::Handlers handlers;
    handlers.on_started = [weak](const std::string& page) {
        const auto self = weak.lock();
        return self ? self->on_started(page) : Status();
    };
    handlers.on_members = [weak] {
        if (const auto self = weak.lock()) self->on_members();
    };
    handlers.on_server = [weak](ServerId server, Message&& message, Buffer&&) {
        const auto self = weak.lock();
        return self ? self->on_server(server, std::move(message)) : Status();
    };
    handlers.on_display = [weak](Message&& message, Buffer&& body) {
        const auto self = weak.lock();
        return self ? self->on_display(std::move(message), body) : Status();
    };
    handlers.on_lost = [weak](const std::string& who, const std::string& why) {
        // perform() of an abort cannot fail.
        if (const auto self = weak.lock()) (void)self->perform(self->director_.on_lost(who, why));
    };
    machines_ = std::make_shared<Machines>(io_, std::move(job), clock_, std::move(handlers));
    machines_->start();
}

void ClusterRun::stop() {
    over_ = true;
    cutter_.reset();
    patience_.cancel();
    machines_->stop();
    handlers_ = {};
}

void ClusterRun::end() {
    std::sort(timelines_.begin(), timelines_.end(),
              [](const auto& a, const auto& b) { return a.frame < b.frame; });
    finish(
        std::vector(std::make_move_iterator(timelines_.begin()), std::make_move_iterator(timelines_.end())));
}

void ClusterRun::finish(Result<std::vector<FrameTimeline>> result) {
    if (over_) return;
    over_ = true;
    cutter_.reset();
    patience_.cancel();
    machines_->finish(result ? Status() : fail("the run ended: {}", result.error().message));
    boost::asio::post(io_, [self = shared_from_this(), result = std::move(result)]() mutable {
        if (self->handlers_.on_done) self->handlers_.on_done(std::move(result));
        self->handlers_ = {};
    });
}

Status ClusterRun::on_started(const std::string& page) {
    if (live_) live_->on_servers(machines_->members().size());
    tell_session();
    handlers_.on_ready(page, machines_->members().size());
    SWATH_TRY_VOID(perform(director_.on_start()));
    return follow_wish();
}

void ClusterRun::on_members() {
    if (over_) return;
    const std::size_t servers = machines_->members().size();
    log_info("{} servers take part", servers);
    tell_session();
    Status status;
    if (servers == 0) {
        await_servers();
        status = perform(director_.on_reconfigure());
    } else {
        if (live_) live_->on_servers(servers);
        patience_.cancel();
        status = std::exchange(awaiting_servers_, false) ? change_setup() : follow_wish();
        if (live_) tell_state();
    }
    if (!status) finish(tl::unexpected(status.error()));
}

// Viewers may wait for a server; a run along a path must end.
void ClusterRun::await_servers() {
    if (live_) return;
    patience_.expires_after(job_.connect_patience);
    patience_.async_wait([weak = weak_from_this()](const boost::system::error_code& stopped) {
        if (const auto self = weak.lock(); self && !stopped) self->finish(fail("no server is left"));
    });
}

void ClusterRun::tell_session() {
    // Viewers get the file's name, not its folder.
    SessionFacts facts{std::filesystem::path(job_.model).filename().string(),
                       job_.scene->mesh.triangle_count(),
                       job_.scene->swept_bounds(),
                       {},
                       job_.background};
    for (const ServerId server : machines_->members())
        facts.servers.push_back({to_string(machines_->address(server)), machines_->renderer(server)});
    broadcast_.on_session(std::move(facts), live_ ? &*live_ : nullptr,
                          job_.live ? job_.live->limits : WishLimits{});
}

Status ClusterRun::on_server(ServerId server, Message&& message) {
    const auto* report = std::get_if<ServerReport>(&message);
    if (report == nullptr) return fail("{} is not expected from a server", name(message));
    const auto found = frames_.find(report->frame);
    if (found == frames_.end()) return fail("a report for frame {}, which is not open", report->frame);
    const auto& servers = found->second.servers;
    const auto at = std::lower_bound(servers.begin(), servers.end(), server);
    if (at == servers.end() || *at != server)
        return fail("a report for frame {}, in which it takes no part", report->frame);
    SWATH_TRY_VOID(costs_->on_report(report->frame, server, report->visible));
    return on_report(1 + static_cast<std::size_t>(at - servers.begin()), *report,
                     machines_->clock_offset(server), {});
}

Status ClusterRun::on_display(Message&& message, const Buffer& body) {
    if (const auto* report = std::get_if<DisplayReport>(&message)) {
        const auto found = frames_.find(report->frame);
        if (found == frames_.end()) return fail("a report for frame {}, which is not open", report->frame);
        return on_report(1 + found->second.servers.size(), *report, machines_->display_clock_offset(), body);
    }
    if (const auto* audience = std::get_if<Audience>(&message)) return on_audience(*audience);
    if (const auto* wish = std::get_if<Wish>(&message)) return on_wish(*wish, body);
    return fail("{} is not expected from a display", name(message));
}

Status ClusterRun::perform(const Director::Actions& actions) {
    for (const DirectorAction& action : actions) {
        switch (action.kind) {
            case DirectorAction::Kind::kIssue:
                if (const auto status = issue(action.frame); !status) {
                    finish(tl::unexpected(status.error()));
                    return {};
                }
                break;
            case DirectorAction::Kind::kReconfigure:
                SWATH_TRY_VOID(change_setup());
                break;
            case DirectorAction::Kind::kFinish:
                end();
                break;
            case DirectorAction::Kind::kAbort:
                finish(fail("{}", action.reason));
                break;
        }
    }
    return {};
}

FrameOrder ClusterRun::order_of(FrameNumber number) {
    if (live_) return live_->next();
    FrameOrder order;
    order.camera = job_.cameras[number];
    order.numbers = numbers_of(order.camera);
    order.width = job_.width;
    order.height = job_.height;
    order.algorithm = job_.algorithm;
    order.servers = machines_->members().size();
    return order;
}

Partitioner& ClusterRun::partitioner(Algorithm algorithm) {
    auto& made = partitioners_[algorithm];
    if (!made) made = make_partitioner(algorithm, job_.scene->objects);
    return *made;
}

Status ClusterRun::issue(FrameNumber number) {
    std::vector<Span> spans;
    PhaseTimer timer(clock_, spans);
    const FrameOrder order = order_of(number);
    View view = make_view(order.camera, order.width, order.height);
    view.pose = job_.pose.value_or(path_pose(number));
    if (job_.to_light) view.to_light = *job_.to_light;
    auto projected = project(job_.scene->objects, view, Accounting::kCluster, costs_->costs());
    FramePlan plan = partitioner(order.algorithm).partition({number, view, projected, order.servers});
    if (const auto wrong = problem(plan, job_.scene->objects.size(), grouping_of(order.algorithm)))
        throw CheckFailed(fmt::format("frame {}: {}", number, *wrong));

    AssembleFrame assemble{number, order.width, order.height, job_.background, {}, order.stream};
    // A plan has ranks, messages have the servers' numbers; both ascend.
    OpenFrame& frame = frames_[number];
    frame.servers.assign(machines_->members().begin(),
                         machines_->members().begin() + static_cast<std::ptrdiff_t>(plan.servers.size()));
    machines_->on_issued(frame.servers);
    std::vector<RenderFrame> tasks(plan.servers.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const ServerShare& share = plan.servers[i];
        tasks[i] = {number, view, share.group, share.content, final_region(plan, server_id(i)), {}, {}};
        if (!tasks[i].final_region.empty())
            assemble.tiles.push_back({frame.servers[i], tasks[i].final_region});
    }
    for (Transfer& t : transfers(plan)) {
        tasks[index(t.from)].outgoing.push_back({frame.servers[index(t.to)], t.region});
        tasks[index(t.to)].incoming.push_back({frame.servers[index(t.from)], std::move(t.region)});
    }

    FrameTimeline& timeline = frame.finished.timeline;
    timeline.frame = number;
    timeline.overlap_factor = overlap_factor(plan, job_.scene->objects);
    timeline.machines.resize(2 + tasks.size());
    timeline.machines.front().machine = "client";
    for (std::size_t i = 0; i < tasks.size(); ++i)
        timeline.machines[1 + i].machine = server_name(server_id(i));
    timeline.machines.back().machine = "display";

    // A server without pixels takes no part in the frame.
    std::map<ServerId, std::vector<ObjectId>> groups;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        if (tasks[i].content.empty() && tasks[i].final_region.empty()) continue;
        if (const auto status = machines_->tell(frame.servers[i], tasks[i]); !status)
            return fail_in(machines_->who(frame.servers[i]), status.error());
        groups[frame.servers[i]] = std::move(tasks[i].group);
    }
    const std::size_t working = groups.size();
    costs_->on_issued(number, std::move(groups));
    broadcast_.on_planned(order, plan, timeline.overlap_factor);
    if (const auto status = machines_->tell_display(assemble); !status)
        return fail_in("the display", status.error());
    frame.missing = working + 1;
    frame.finished.order = order;
    frame.finished.plan = std::move(plan);
    frame.finished.projected = std::move(projected);
    timer.end(Phase::kPartition);
    timeline.machines[0].spans = std::move(spans);
    director_.on_issued(number, working);
    return live_ ? perform(director_.on_wanted(live_->wants_frame())) : Status{};
}

Status ClusterRun::on_report(std::size_t at, const Report& report, Nanoseconds clock_offset,
                             const Buffer& body) {
    const auto found = frames_.find(report.frame);
    OpenFrame& frame = found->second;
    MachineTimeline& machine = frame.finished.timeline.machines[at];
    const bool display = at + 1 == frame.finished.timeline.machines.size();
    if (report.spans.empty() || !machine.spans.empty())
        return fail("a report for frame {} that is empty or came twice", report.frame);
    machine.spans = report.spans;
    for (Span& span : machine.spans) {
        span.begin += clock_offset;
        span.end += clock_offset;
    }
    machine.counters = report.counters;
    SWATH_TRY(auto actions,
              display ? director_.on_display_report(report.frame) : director_.on_server_report(report.frame));
    if (display) {
        if (const auto status = handlers_.on_picture(report.frame, body); !status) {
            finish(tl::unexpected(status.error()));
            return {};
        }
    }
    if (--frame.missing == 0) {
        broadcast_.on_over(frame.finished, live_ && live_->measuring(), clock_.now());
        timelines_.push_back(std::move(frame.finished.timeline));
        const std::vector<ServerId> servers = std::move(frame.servers);
        frames_.erase(found);
        machines_->on_over(servers);
        if (live_ && timelines_.size() > kLiveHistory) timelines_.pop_front();
    }
    return perform(actions);
}

Status ClusterRun::on_audience(const Audience& audience) {
    broadcast_.on_viewers(audience.viewers);
    if (!live_) return {};
    live_->on_viewers(audience.viewers);
    tell_state();
    return follow_wish();
}

Status ClusterRun::on_wish(const Wish& wish, const Buffer& body) {
    if (!live_) return fail("a Wish, and this run takes none");
    if (body.size() > kMaxWishBytes)
        return fail("a Wish of {} bytes, the limit is {}", body.size(), kMaxWishBytes);
    const std::string_view text(reinterpret_cast<const char*>(body.data()), body.size());
    // A bad wish ends nothing: the next one may be better.
    if (const auto status = live_->on_wish(text, wish.viewer); !status)
        log_warning("viewer {}: {}", wish.viewer, status.error().message);
    if (live_->take_trace()) broadcast_.on_trace({timelines_.begin(), timelines_.end()});
    tell_state();
    return follow_wish();
}

Status ClusterRun::follow_wish() {
    if (!live_) return {};
    if (live_->wanted_setup()) SWATH_TRY_VOID(perform(director_.on_reconfigure()));
    return perform(director_.on_wanted(live_->wants_frame()));
}

void ClusterRun::tell_state() {
    LiveWish shown = live_->wish();
    shown.setup = live_->setup();
    std::vector<Address> servers;
    for (const ServerId server : machines_->members()) servers.push_back(machines_->address(server));
    broadcast_.on_state(*live_, changing_ ? "changing the setup" : "",
                        job_.command(shown, servers, job_.scene->cut));
}

// No frame is open, and the director begins none until it hears that the change is over.
Status ClusterRun::change_setup() {
    const auto wanted = live_ ? live_->wanted_setup() : std::nullopt;
    if (!wanted) return go_on();
    next_setup_ = *wanted;
    changing_ = true;
    tell_state();
    // The client cuts the model first, then tells the servers how.
    if (wanted->objects == live_->setup().objects) return on_cut(job_.scene);
    if (!cutter_) cutter_ = std::make_unique<WorkerThread>();
    // The task holds nothing alive: the run's end waits for it.
    cutter_->post([this, weak = weak_from_this(), scene = job_.scene, objects = wanted->objects] {
        std::shared_ptr<const ObjectSet> cut;  // null: no memory
        try {
            cut = std::make_shared<const ObjectSet>(
                build_objects(scene->mesh, {.objects = objects, .by = scene->cut.by}));
        } catch (const std::bad_alloc&) {
        }
        boost::asio::post(io_, [weak, cut] {
            const auto self = weak.lock();
            if (!self || self->over_) return;
            if (const auto status = self->on_cut(cut); !status) self->finish(tl::unexpected(status.error()));
        });
    });
    return {};
}

Status ClusterRun::on_cut(std::shared_ptr<const ObjectSet> scene) {
    if (!scene) return end_change("not enough memory to cut the model anew");
    next_scene_ = std::move(scene);
    const Drawing next{next_setup_.draw, next_scene_->cut};
    if (next == Drawing{job_.draw, job_.scene->cut}) return end_change({});
    return machines_->reconfigure(next, next_scene_->objects.size(),
                                  [weak = weak_from_this()](const std::string& refused) {
                                      const auto self = weak.lock();
                                      return self ? self->end_change(refused) : Status();
                                  });
}

Status ClusterRun::end_change(const std::string& refused) {
    auto scene = std::exchange(next_scene_, nullptr);
    changing_ = false;
    if (refused.empty()) {
        if (std::exchange(job_.draw, next_setup_.draw) != next_setup_.draw) broadcast_.on_drawing();
        if (scene != job_.scene) use(std::move(scene));
        live_->on_setup(next_setup_);
        tell_session();  // it names the servers' renderers
    } else {
        live_->on_setup_refused(next_setup_, refused);
    }
    tell_state();
    return go_on();
}

Status ClusterRun::go_on() {
    awaiting_servers_ = machines_->members().empty();
    if (awaiting_servers_) return {};
    SWATH_TRY_VOID(perform(director_.on_reconfigured()));
    return follow_wish();
}

void ClusterRun::use(std::shared_ptr<const ObjectSet> scene) {
    job_.scene = std::move(scene);
    partitioners_.clear();
    costs_.emplace(job_.scene->objects);
    broadcast_.on_scene(job_.scene);
}

}  // namespace swath
