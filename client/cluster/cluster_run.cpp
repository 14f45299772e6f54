#include "client/cluster/cluster_run.h"

#include <algorithm>
#include <boost/asio/post.hpp>

#include "common/base/check.h"
#include "common/scene/model_blob.h"
#include "common/timeline/phase_timer.h"
#include "common/wire/listener.h"

namespace swath {

ClusterRun::ClusterRun(boost::asio::io_context& io, ClusterJob job, const Clock& clock, Handlers handlers)
    : io_(io),
      job_(std::move(job)),
      clock_(clock),
      handlers_(std::move(handlers)),
      partitioner_(make_partitioner(job_.algorithm, job_.scene->objects)),
      costs_(job_.scene->objects),
      model_triangles_(job_.scene->mesh.triangle_count()),
      digest_(digest(job_.blob.bytes())),
      director_(job_.cameras.size(), job_.frames_in_flight) {
    for (std::size_t i = 0; i < job_.servers.size(); ++i)
        peers_.push_back({fmt::format("server {} at {}", i, to_string(job_.servers[i])),
                          Role::kServer,
                          {},
                          false,
                          false,
                          false});
    peers_.push_back(
        {fmt::format("display at {}", to_string(job_.display)), Role::kDisplay, {}, false, false, false});
}

void ClusterRun::start() {
    for (std::size_t i = 0; i < peers_.size(); ++i)
        connect(i, i < job_.servers.size() ? job_.servers[i] : job_.display);
}

void ClusterRun::stop() {
    over_ = true;
    for (Peer& peer : peers_)
        if (peer.connection) peer.connection->close();
    handlers_ = {};
}

void ClusterRun::finish(Result<std::vector<FrameTimeline>> result) {
    if (over_) return;
    over_ = true;
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
    setup.octree_depth = job_.scene->depth;
    setup.renderer = job_.renderer;
    setup.cull = job_.cull;
    for (const Address& address : job_.servers) setup.servers.push_back(to_string(address));
    setup.display = to_string(job_.display);
    setup.frames_in_flight = job_.frames_in_flight;
    const auto servers = static_cast<std::uint32_t>(job_.servers.size());
    for (std::size_t i = 0; i < peers_.size(); ++i) {
        setup.server = server_id(i < servers ? i : 0);
        const Status status =
            i < servers
                ? offer(peers_[i], setup)
                : offer(peers_[i], DisplaySetup{job_.session, servers, job_.format, job_.frames_in_flight});
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
        handlers_.on_ready();
        return run(director_.on_start());
    }
    if (const auto* report = std::get_if<ServerReport>(&message);
        report != nullptr && peer.role == Role::kServer)
        return on_server_report(i, *report);
    if (const auto* report = std::get_if<DisplayReport>(&message);
        report != nullptr && peer.role == Role::kDisplay)
        return on_report(i, *report, body);
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
    if (peer.role == Role::kServer && ready.objects != job_.scene->objects.size())
        return fail("cut the model into {} objects, this client into {}", ready.objects,
                    job_.scene->objects.size());
    if (peer.ready) return fail("Ready came twice");
    peer.ready = true;
    if (!std::all_of(peers_.begin(), peers_.end(), [](const Peer& p) { return p.ready; })) return {};
    for (const Peer& p : peers_)
        if (p.role == Role::kServer)
            if (const auto status = offer(p, Connect{}); !status) return status;
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
            case DirectorAction::Kind::kFinish:
                std::sort(timelines_.begin(), timelines_.end(),
                          [](const auto& a, const auto& b) { return a.frame < b.frame; });
                finish(std::move(timelines_));
                break;
            case DirectorAction::Kind::kAbort:
                finish(fail("{}", action.reason));
                break;
        }
    }
    return {};
}

Status ClusterRun::issue(FrameNumber number) {
    std::vector<Span> spans;
    PhaseTimer timer(clock_, spans);
    const View view = make_view(job_.cameras[number], job_.width, job_.height);
    const auto projected = project(job_.scene->objects, view, Accounting::kCluster, costs_.costs());
    const FramePlan plan = partitioner_->partition({number, view, projected, job_.servers.size()});
    if (const auto wrong = problem(plan, job_.scene->objects.size(), grouping_of(job_.algorithm)))
        throw CheckFailed(fmt::format("frame {}: {}", number, *wrong));

    AssembleFrame assemble{number, job_.width, job_.height, job_.background, {}};
    std::vector<RenderFrame> tasks(plan.servers.size());
    std::uint64_t drawn = 0;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const ServerShare& share = plan.servers[i];
        tasks[i] = {number, view, share.group, share.content, final_region(plan, server_id(i)), {}, {}};
        if (!tasks[i].final_region.empty()) assemble.tiles.push_back({server_id(i), tasks[i].final_region});
        for (const ObjectId id : share.group) drawn += job_.scene->objects[id].triangle_count;
    }
    for (Transfer& t : transfers(plan)) {
        tasks[index(t.from)].outgoing.push_back({t.to, t.region});
        tasks[index(t.to)].incoming.push_back({t.from, std::move(t.region)});
    }

    OpenFrame& frame = frames_[number];
    frame.timeline.frame = number;
    frame.timeline.overlap_factor = static_cast<double>(drawn) / static_cast<double>(model_triangles_);
    frame.timeline.machines.resize(1 + peers_.size());
    frame.timeline.machines[0].machine = "client";
    for (std::size_t i = 0; i < peers_.size(); ++i)
        frame.timeline.machines[1 + i].machine =
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
    costs_.on_issued(number, std::move(groups));
    if (const auto status = offer(peers_.back(), assemble); !status)
        return fail_in(peers_.back().who, status.error());
    frame.missing = working + 1;
    timer.end(Phase::kPartition);
    frame.timeline.machines[0].spans = std::move(spans);
    director_.on_issued(number, working);
    return {};
}

Status ClusterRun::on_server_report(std::size_t i, const ServerReport& report) {
    if (const auto status = costs_.on_report(report.frame, server_id(i), report.visible); !status)
        return status;
    return on_report(i, report, {});
}

Status ClusterRun::on_report(std::size_t i, const Report& report, const Buffer& body) {
    auto found = frames_.find(report.frame);
    if (found == frames_.end()) return fail("a report for frame {}, which is not open", report.frame);
    OpenFrame& frame = found->second;
    const Peer& peer = peers_[i];
    MachineTimeline& machine = frame.timeline.machines[1 + i];
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
        timelines_.push_back(std::move(frame.timeline));
        frames_.erase(found);
    }
    return run(*actions);
}

}  // namespace swath
