#include "client/cluster/cluster_run.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cstring>
#include <filesystem>
#include <new>
#include <utility>

#include "client/cost/frame_work.h"
#include "common/base/check.h"
#include "common/scene/model_blob.h"
#include "common/timeline/phase_timer.h"
#include "common/wire/listener.h"

namespace swath {
namespace {

constexpr std::size_t kLiveHistory = 240;  // frames whose timelines a live run keeps

}  // namespace

ClusterRun::ClusterRun(boost::asio::io_context& io, ClusterJob job, const Clock& clock, Handlers handlers)
    : io_(io),
      job_(std::move(job)),
      clock_(clock),
      handlers_(std::move(handlers)),
      digest_(digest(job_.blob.bytes())),
      director_(job_.live ? Director::live(job_.frames_in_flight)
                          : Director(job_.cameras.size(), job_.frames_in_flight)),
      broadcast_([this](NoteTopic topic, FrameNumber frame, const std::string& text) {
          Buffer body(text.size());
          std::memcpy(body.data(), text.data(), text.size());
          // A display that does not take it is found out by the next frame.
          (void)offer(peers_.back(), Note{topic, frame}, std::move(body));
      }),
      drawing_{job_.scene->depth, job_.renderer, job_.cull} {
    if (job_.live) live_.emplace(*job_.live);
    use(job_.scene);
    for (std::size_t i = 0; i < job_.servers.size(); ++i) {
        Peer& peer = peers_.emplace_back();
        peer.address = to_string(job_.servers[i]);
        peer.who = fmt::format("server {} at {}", i, peer.address);
    }
    Peer& display = peers_.emplace_back();
    display.role = Role::kDisplay;
    display.address = to_string(job_.display);
    display.who = fmt::format("display at {}", display.address);
}

void ClusterRun::start() {
    for (std::size_t i = 0; i < peers_.size(); ++i)
        connect(i, i < job_.servers.size() ? job_.servers[i] : job_.display);
}

void ClusterRun::stop() {
    over_ = true;
    cutter_.reset();
    for (Peer& peer : peers_)
        if (peer.connection) peer.connection->close();
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
    for (Peer& peer : peers_) {
        if (!peer.connection) continue;
        if (result)
            peer.connection->finish();
        else
            peer.connection->fail_with({"the run ended: " + result.error().message});
    }
    boost::asio::post(io_, [self = shared_from_this(), result = std::move(result)]() mutable {
        if (self->handlers_.on_done) self->handlers_.on_done(std::move(result));
        self->handlers_ = {};
    });
}

// --- connecting and setting up

void ClusterRun::connect(std::size_t i, const Address& address) {
    async_connect(
        io_, address, job_.connect_patience,
        [self = shared_from_this(), i](Result<boost::asio::ip::tcp::socket> socket) {
            if (self->over_) return;
            if (!socket) return self->lost(i, socket.error().message);
            Connection::Options options;
            options.hello.role = Role::kClient;
            options.timing = self->job_.timing;
            Peer& peer = self->peers_[i];
            peer.connection = std::make_shared<Connection>(std::move(*socket), options, self->clock_);
            peer.connection->start({[self, i](const Hello& hello) -> Status {
                                        Peer& greeter = self->peers_[i];
                                        if (hello.role != greeter.role)
                                            return fail("this is a {}, a {} is expected", name(hello.role),
                                                        name(greeter.role));
                                        greeter.greeted = true;
                                        if (std::all_of(self->peers_.begin(), self->peers_.end(),
                                                        [](const Peer& p) { return p.greeted; }))
                                            self->set_up();
                                        return {};
                                    },
                                    [self, i](Message&& message, Buffer&& body) {
                                        return self->on_message(i, std::move(message), std::move(body));
                                    },
                                    [self, i](const Status& why) {
                                        self->lost(i, why ? "ended the session" : why.error().message);
                                    }});
        });
}

void ClusterRun::set_up() {
    ServerSetup setup;
    setup.session = job_.session;
    setup.model = job_.model;
    setup.digest = digest_;
    setup.blob_bytes = job_.blob.size();
    setup.drawing = drawing_;
    for (const Address& address : job_.servers) setup.servers.push_back(to_string(address));
    setup.display = to_string(job_.display);
    setup.frames_in_flight = job_.frames_in_flight;
    const auto servers = static_cast<std::uint32_t>(job_.servers.size());
    for (std::size_t i = 0; i < peers_.size(); ++i) {
        setup.server = server_id(i < servers ? i : 0);
        const Status status = i < servers
                                  ? offer(peers_[i], setup)
                                  : offer(peers_[i], DisplaySetup{job_.session, servers, job_.format,
                                                                  job_.frames_in_flight, live_.has_value()});
        if (!status) return lost(i, status.error().message);
    }
}

Status ClusterRun::offer(const Peer& peer, const Message& message, Buffer body) {
    const auto sent = peer.connection->offer(message, std::move(body));
    return sent ? Status{} : tl::unexpected(sent.error());
}

Status ClusterRun::on_message(std::size_t i, Message&& message, Buffer&& body) {
    if (over_) return {};
    Peer& peer = peers_[i];
    if (const auto* need = std::get_if<NeedModel>(&message)) return send_model_part(peer, need->offset);
    if (const auto* ready = std::get_if<Ready>(&message)) return on_ready(peer, *ready);
    if (std::holds_alternative<Connected>(message)) {
        peer.connected = true;
        if (started_ || !std::all_of(peers_.begin(), peers_.end(),
                                     [](const Peer& p) { return p.role == Role::kDisplay || p.connected; }))
            return {};
        started_ = true;
        handlers_.on_ready(page_);
        if (const auto status = run(director_.on_start()); !status) return status;
        return follow_wish();
    }
    if (const auto* report = std::get_if<ServerReport>(&message);
        report != nullptr && peer.role == Role::kServer)
        return on_server_report(i, *report);
    if (const auto* report = std::get_if<DisplayReport>(&message);
        report != nullptr && peer.role == Role::kDisplay)
        return on_report(i, *report, body);
    if (const auto* audience = std::get_if<Audience>(&message);
        audience != nullptr && peer.role == Role::kDisplay)
        return on_audience(*audience);
    if (const auto* wish = std::get_if<Wish>(&message); wish != nullptr && peer.role == Role::kDisplay)
        return on_wish(*wish, body);
    return fail("{} is not expected from a {}", name(message), name(peer.role));
}

Status ClusterRun::send_model_part(const Peer& peer, std::uint64_t offset) {
    if (offset >= job_.blob.size()) return fail("NeedModel: offset {} of {}", offset, job_.blob.size());
    const std::size_t bytes =
        std::min<std::size_t>(kModelPartBytes, job_.blob.size() - static_cast<std::size_t>(offset));
    Buffer body(bytes);
    std::memcpy(body.data(), job_.blob.data() + offset, bytes);
    return offer(peer, ModelPart{offset}, std::move(body));
}

Status ClusterRun::on_ready(Peer& peer, const Ready& ready) {
    if (change_.under_way() && peer.role == Role::kServer) return on_changed(ready);
    if (peer.role == Role::kServer && ready.objects != job_.scene->objects.size())
        return fail("cut the model into {} objects, this client into {}", ready.objects,
                    job_.scene->objects.size());
    if (peer.ready) return fail("Ready came twice");
    peer.ready = true;
    if (peer.role == Role::kDisplay) {
        page_ = ready.description;
        if (live_ && page_.empty()) return fail("has no page to look at: start it with --view");
    } else {
        peer.description = ready.description;
    }
    if (!std::all_of(peers_.begin(), peers_.end(), [](const Peer& p) { return p.ready; })) return {};
    // Viewers are told the file's name, not where it lies.
    SessionFacts facts{std::filesystem::path(job_.model).filename().string(),
                       job_.scene->mesh.triangle_count(),
                       job_.scene->bounds,
                       {},
                       job_.background};
    for (const Peer& p : peers_)
        if (p.role == Role::kServer) {
            facts.servers.push_back({p.address, p.description});
            if (const auto status = offer(p, Connect{}); !status) return status;
        }
    broadcast_.on_session(std::move(facts), live_ ? &*live_ : nullptr,
                          job_.live ? job_.live->limits : WishLimits{});
    return {};
}

void ClusterRun::lost(std::size_t i, const std::string& why) {
    if (over_) return;
    // run() of an abort cannot fail.
    (void)run(director_.on_lost(peers_[i].who, why));
}

// --- frames

Status ClusterRun::run(const Director::Actions& actions) {
    for (const DirectorAction& action : actions) {
        switch (action.kind) {
            case DirectorAction::Kind::kIssue:
                if (const auto status = issue(action.frame); !status) {
                    finish(tl::unexpected(status.error()));
                    return {};
                }
                break;
            case DirectorAction::Kind::kReconfigure:
                if (const auto status = change_setup(); !status) return status;
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
    order.servers = job_.servers.size();
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
    const View view = make_view(order.camera, order.width, order.height);
    auto projected = project(job_.scene->objects, view, Accounting::kCluster, costs_->costs());
    FramePlan plan = partitioner(order.algorithm).partition({number, view, projected, order.servers});
    if (const auto wrong = problem(plan, job_.scene->objects.size(), grouping_of(order.algorithm)))
        throw CheckFailed(fmt::format("frame {}: {}", number, *wrong));

    AssembleFrame assemble{number, order.width, order.height, job_.background, {}, order.stream};
    std::vector<RenderFrame> tasks(plan.servers.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const ServerShare& share = plan.servers[i];
        tasks[i] = {number, view, share.group, share.content, final_region(plan, server_id(i)), {}, {}};
        if (!tasks[i].final_region.empty()) assemble.tiles.push_back({server_id(i), tasks[i].final_region});
    }
    for (Transfer& t : transfers(plan)) {
        tasks[index(t.from)].outgoing.push_back({t.to, t.region});
        tasks[index(t.to)].incoming.push_back({t.from, std::move(t.region)});
    }

    OpenFrame& frame = frames_[number];
    FrameTimeline& timeline = frame.finished.timeline;
    timeline.frame = number;
    timeline.overlap_factor = overlap_factor(plan, job_.scene->objects);
    timeline.machines.resize(1 + peers_.size());
    timeline.machines[0].machine = "client";
    for (std::size_t i = 0; i < peers_.size(); ++i)
        timeline.machines[1 + i].machine =
            peers_[i].role == Role::kDisplay ? "display" : server_name(server_id(i));

    // A server without pixels takes no part in the frame.
    std::map<ServerId, std::vector<ObjectId>> groups;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        if (tasks[i].content.empty() && tasks[i].final_region.empty()) continue;
        if (const auto status = offer(peers_[i], tasks[i]); !status)
            return fail_in(peers_[i].who, status.error());
        groups[server_id(i)] = std::move(tasks[i].group);
    }
    const std::size_t working = groups.size();
    costs_->on_issued(number, std::move(groups));
    broadcast_.on_planned(order, plan, timeline.overlap_factor);
    if (const auto status = offer(peers_.back(), assemble); !status)
        return fail_in(peers_.back().who, status.error());
    frame.missing = working + 1;
    frame.finished.order = order;
    frame.finished.plan = std::move(plan);
    frame.finished.projected = std::move(projected);
    timer.end(Phase::kPartition);
    timeline.machines[0].spans = std::move(spans);
    director_.on_issued(number, working);
    return live_ ? run(director_.on_wanted(live_->wants_frame())) : Status{};
}

Status ClusterRun::on_server_report(std::size_t i, const ServerReport& report) {
    if (const auto status = costs_->on_report(report.frame, server_id(i), report.visible); !status)
        return status;
    return on_report(i, report, {});
}

Status ClusterRun::on_report(std::size_t i, const Report& report, const Buffer& body) {
    auto found = frames_.find(report.frame);
    if (found == frames_.end()) return fail("a report for frame {}, which is not open", report.frame);
    OpenFrame& frame = found->second;
    const Peer& peer = peers_[i];
    MachineTimeline& machine = frame.finished.timeline.machines[1 + i];
    if (report.spans.empty() || !machine.spans.empty())
        return fail("a report for frame {} that is empty or came twice", report.frame);
    const Nanoseconds offset = peer.connection->clock_offset();
    machine.spans = report.spans;
    for (Span& span : machine.spans) {
        span.begin += offset;
        span.end += offset;
    }
    machine.counters = report.counters;
    auto actions = peer.role == Role::kDisplay ? director_.on_display_report(report.frame)
                                               : director_.on_server_report(report.frame);
    if (!actions) return tl::unexpected(actions.error());
    if (peer.role == Role::kDisplay) {
        if (const auto status = handlers_.on_picture(report.frame, body); !status) {
            finish(tl::unexpected(status.error()));
            return {};
        }
    }
    if (--frame.missing == 0) {
        broadcast_.on_over(frame.finished, live_ && live_->measuring(), clock_.now());
        timelines_.push_back(std::move(frame.finished.timeline));
        frames_.erase(found);
        if (live_ && timelines_.size() > kLiveHistory) timelines_.pop_front();
    }
    return run(*actions);
}

// --- a live run

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
    // What a page says ends nothing: the display has checked that it is a wish, and the next one may be
    // better.
    if (const auto status = live_->on_wish(text, wish.viewer); !status)
        spdlog::warn("viewer {}: {}", wish.viewer, status.error().message);
    if (live_->take_trace()) broadcast_.on_trace({timelines_.begin(), timelines_.end()});
    tell_state();
    return follow_wish();
}

Status ClusterRun::follow_wish() {
    if (!live_) return {};
    if (live_->wanted_setup())
        if (const auto status = run(director_.on_reconfigure()); !status) return status;
    return run(director_.on_wanted(live_->wants_frame()));
}

void ClusterRun::tell_state() {
    LiveWish shown = live_->wish();
    shown.setup = live_->setup();
    broadcast_.on_state(*live_, changing_ ? "changing the setup" : "",
                        job_.command(shown, job_.scene->depth));
}

// No frame is open. The client cuts the model first: the servers are told a depth.
Status ClusterRun::change_setup() {
    const auto wanted = live_->wanted_setup();
    if (!wanted) {
        if (const auto status = run(director_.on_reconfigured()); !status) return status;
        return follow_wish();
    }
    next_setup_ = *wanted;
    changing_ = true;
    tell_state();
    if (wanted->objects == live_->setup().objects) return on_cut(job_.scene);
    if (!cutter_) cutter_ = std::make_unique<WorkerThread>();
    // The task holds nothing alive: the run's end waits for it.
    cutter_->post([this, weak = weak_from_this(), scene = job_.scene, objects = wanted->objects] {
        std::shared_ptr<const ObjectSet> cut;  // null: no memory
        try {
            cut = std::make_shared<const ObjectSet>(build_objects(scene->mesh, {std::nullopt, objects}));
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
    const Drawing next{next_scene_->depth, next_setup_.renderer, next_setup_.cull};
    if (next == drawing_) return end_change({});
    change_.begin(job_.servers.size());
    return ask_servers(next);
}

Status ClusterRun::ask_servers(const Drawing& drawing) {
    for (const Peer& peer : peers_)
        if (peer.role == Role::kServer)
            if (const auto status = offer(peer, Reconfigure{drawing}); !status)
                return fail_in(peer.who, status.error());
    return {};
}

Status ClusterRun::on_changed(const Ready& ready) {
    const ObjectSet& scene = change_.going_back() ? *job_.scene : *next_scene_;
    if (ready.refused.empty() && ready.objects != scene.objects.size())
        return fail("cut the model into {} objects, this client into {}", ready.objects,
                    scene.objects.size());
    switch (change_.on_answer(ready.refused)) {
        case SetupChange::Next::kWait:
            return {};
        case SetupChange::Next::kDone:
            return end_change({});
        case SetupChange::Next::kGoBack:
            return ask_servers(drawing_);
        case SetupChange::Next::kUndone:
            return end_change(change_.why());
        case SetupChange::Next::kStuck:
            return fail("cannot go back to what it had: {}", ready.refused);
    }
    return {};
}

Status ClusterRun::end_change(const std::string& refused) {
    auto scene = std::exchange(next_scene_, nullptr);
    changing_ = false;
    if (refused.empty()) {
        const Drawing before =
            std::exchange(drawing_, {scene->depth, next_setup_.renderer, next_setup_.cull});
        if (drawing_.renderer != before.renderer || drawing_.cull != before.cull) broadcast_.on_drawing();
        if (scene != job_.scene) use(std::move(scene));
        live_->on_setup(next_setup_);
    } else {
        live_->on_setup_refused(next_setup_, refused);
    }
    tell_state();
    if (const auto status = run(director_.on_reconfigured()); !status) return status;
    return follow_wish();
}

void ClusterRun::use(std::shared_ptr<const ObjectSet> scene) {
    job_.scene = std::move(scene);
    partitioners_.clear();
    costs_.emplace(job_.scene->objects);
    broadcast_.on_scene(job_.scene);
}

}  // namespace swath
