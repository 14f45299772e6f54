#include "server/session/session.h"

#include <boost/asio/post.hpp>
#include <new>
#include <utility>

#include "common/base/check.h"
#include "common/base/log.h"
#include "common/timeline/phase_timer.h"
#include "common/wire/listener.h"

namespace swath {
namespace asio = boost::asio;

ServerSession::ServerSession(asio::io_context& io, const ServerOptions& options, const Clock& clock,
                             RendererFactory factory, std::shared_ptr<Connection> client)
    : io_(io),
      options_(options),
      clock_(clock),
      client_(std::move(client)),
      store_(options.cache),
      draw_thread_(std::make_unique<DrawThread>(std::move(factory), options.threads, clock)) {}

void ServerSession::stop() {
    client_->finish();
    for (const auto& [id, peer] : peers_) peer->finish();
    if (display_) display_->finish();
    peers_.clear();
    display_.reset();
    draw_thread_.reset();
}

void ServerSession::resume(const std::function<Status()>& rest) {
    if (!draw_thread_) return;
    Status status;
    try {
        status = rest();
    } catch (const std::bad_alloc&) {
        status = fail("not enough memory");
    }
    if (!status) give_up(status.error());
}

// The session cannot go on: tells the client why. The end of its connection ends the session.
void ServerSession::give_up(const Error& error) {
    if (draw_thread_) client_->fail_with(error);
}

void ServerSession::tell_client(const Message& message) {
    if (const auto sent = client_->offer(message); !sent) give_up(sent.error());
}

bool ServerSession::on_closed(const std::shared_ptr<Connection>& connection, const Status& why) {
    if (connection == client_) return true;
    on_server_closed(connection->peer_hello().server, *connection, why);
    return false;
}

void ServerSession::on_display_closed(const Connection& connection, const Status& why) {
    display_.reset();
    if (!why) give_up({fmt::format("lost the display at {}: {}", connection.peer(), why.error().message)});
}

void ServerSession::on_server_closed(ServerId id, const Connection& connection, const Status& why) {
    const auto peer = peers_.find(id);
    if (peer == peers_.end() || peer->second.get() != &connection) return;
    peers_.erase(peer);
    // A Bye: the peer has left, or heard before us that the client has ended the run.
    if (why || !draw_thread_) return;
    log_warning("lost server {} ({}): {}", index(id), connection.peer(), why.error().message);
    tell_client(Lost{id, why.error().message});
}

Status ServerSession::on_message(const std::shared_ptr<Connection>& from, Message&& message, Buffer&& body) {
    if (!draw_thread_) return {};
    if (from == client_) return from_client(std::move(message), std::move(body));
    const Hello& sender = from->peer_hello();
    if (sender.role == Role::kServer) return from_server(sender.server, std::move(message), std::move(body));
    return fail("{} is not expected from a display", name(message));
}

Status ServerSession::from_client(Message&& message, Buffer&& body) {
    if (const auto* setup = std::get_if<ServerSetup>(&message)) return on_setup(*setup);
    if (const auto* part = std::get_if<ModelPart>(&message)) return on_model_part(*part, body);
    if (const auto* connect = std::get_if<Connect>(&message)) return on_connect(*connect);
    if (const auto* other = std::get_if<Reconfigure>(&message)) return on_reconfigure(*other);
    if (auto* task = std::get_if<RenderFrame>(&message)) return on_render_frame(std::move(*task));
    return fail("{} is not expected from a client", name(message));
}

Status ServerSession::on_setup(const ServerSetup& setup) {
    if (set_up_) return fail("ServerSetup came twice");
    set_up_ = true;
    setup_ = setup;
    swap_ = std::make_unique<FrameSwap>(setup.frames_in_flight);
    if (setup.blob_bytes > options_.max_model_bytes)
        return fail("model {}: {} bytes, this server's limit is {}", setup.model, setup.blob_bytes,
                    options_.max_model_bytes);
    draw_thread_->post([self = shared_from_this()] {
        auto mesh =
            std::make_shared<std::optional<Mesh>>(self->store_.find(self->setup_.model, self->setup_.digest));
        asio::post(self->io_, [self, mesh] {
            self->resume([&]() -> Status {
                if (*mesh) {
                    self->load(std::move(**mesh));
                } else {
                    log_info("model {}: asking the client for it", self->setup_.model);
                    self->need_model_part();
                }
                return {};
            });
        });
    });
    return {};
}

void ServerSession::need_model_part() {
    part_awaited_ = true;
    tell_client(NeedModel{blob_.size()});
}

Status ServerSession::on_model_part(const ModelPart& part, const Buffer& body) {
    if (!part_awaited_) return fail("ModelPart is not expected now");
    part_awaited_ = false;
    if (part.offset != blob_.size())
        return fail("ModelPart: offset {} where {} was asked for", part.offset, blob_.size());
    if (body.empty() || body.size() > setup_.blob_bytes - blob_.size())
        return fail("ModelPart: {} bytes where {} are missing", body.size(),
                    setup_.blob_bytes - blob_.size());
    blob_.append(body.data(), body.size());
    if (blob_.size() < setup_.blob_bytes) {
        need_model_part();
        return {};
    }
    draw_thread_->post([self = shared_from_this()] {
        auto mesh =
            std::make_shared<Result<Mesh>>(self->store_.accept(self->blob_.bytes(), self->setup_.digest));
        asio::post(self->io_, [self, mesh] {
            self->resume([&]() -> Status {
                self->blob_ = Buffer();
                if (!*mesh) return tl::unexpected(mesh->error());
                self->load(std::move(**mesh));
                return {};
            });
        });
    });
    return {};
}

void ServerSession::load(Mesh mesh) {
    draw_thread_->load(std::move(mesh), setup_.server, setup_.drawing, when_loaded());
}

std::function<void(Result<SceneInfo>)> ServerSession::when_loaded() {
    return [self = shared_from_this()](const Result<SceneInfo>& result) {
        asio::post(self->io_, [self, result] { self->resume([&] { return self->on_loaded(result); }); });
    };
}

Status ServerSession::on_loaded(const Result<SceneInfo>& loaded) {
    if (!loaded) return tl::unexpected(loaded.error());
    objects_ = loaded->objects;
    ready_ = true;
    reconfiguring_ = false;
    setup_.drawing = loaded->drawing;
    log_info("model {}: {} triangles in {} objects; {}{}{}", setup_.model, loaded->triangles, loaded->objects,
             loaded->renderer, loaded->refused.empty() ? "" : ", still: ", loaded->refused);
    tell_client(Ready{loaded->objects, loaded->triangles, loaded->renderer, loaded->refused});
    return {};
}

Status ServerSession::on_reconfigure(const Reconfigure& reconfigure) {
    if (!ready_ || reconfiguring_ || !frames_.empty()) return fail("Reconfigure is not expected now");
    reconfiguring_ = true;
    draw_thread_->reconfigure(reconfigure.drawing, when_loaded());
    return {};
}

// Connections: every server connects to the display and to the servers that were there before.

Status ServerSession::on_connect(const Connect& to) {
    if (!ready_ || connecting_) return fail("Connect is not expected now");
    connecting_ = true;
    for (const Connect::Peer& peer : to.peers)
        if (peer.server == setup_.server || peers_.contains(peer.server))
            return fail("Connect: server {} is not expected", index(peer.server));
    unheard_ = 1 + to.peers.size();
    connect(to.display, Role::kDisplay, {});
    for (const Connect::Peer& peer : to.peers) connect(peer.address, Role::kServer, peer.server);
    return {};
}

void ServerSession::connect(const std::string& text, Role role, ServerId id) {
    const auto address = parse_address(text);
    if (!address) return give_up(address.error());
    async_connect(
        io_, *address, options_.connect_patience,
        [self = shared_from_this(), role, id](Result<asio::ip::tcp::socket> socket) {
            if (!self->draw_thread_) return;
            if (!socket) return self->give_up(socket.error());
            Connection::Options options;
            options.hello.role = Role::kServer;
            options.hello.session = self->setup_.session;
            options.hello.server = self->setup_.server;
            options.timing = self->options_.timing;
            const auto connection = std::make_shared<Connection>(std::move(*socket), options, self->clock_);
            (role == Role::kDisplay ? self->display_ : self->peers_[id]) = connection;
            const std::weak_ptr<Connection> weak = connection;
            connection->start(
                {[self, role, id](const Hello& hello) { return self->on_peer_hello(role, id, hello); },
                 [self, weak](Message&& message, Buffer&& body) {
                     return self->on_message(weak.lock(), std::move(message), std::move(body));
                 },
                 [self, role, id, weak](const Status& why) {
                     const auto closed = weak.lock();
                     if (role == Role::kDisplay)
                         self->on_display_closed(*closed, why);
                     else
                         self->on_server_closed(id, *closed, why);
                 },
                 [self] { self->on_heard(); }});
        });
}

Status ServerSession::on_peer_hello(Role role, ServerId id, const Hello& hello) const {
    if (hello.role != role)
        return fail("a {} answers where a {} is expected", name_of(hello.role), name_of(role));
    if (hello.session != setup_.session) return fail("this {} is in another session", name_of(role));
    if (role == Role::kServer && hello.server != id)
        return fail("this is server {}, not {}", index(hello.server), index(id));
    return {};
}

Status ServerSession::on_peer(const std::shared_ptr<Connection>& connection, const Hello& hello) {
    if (!set_up_ || hello.session != setup_.session) return fail("this server is in another session");
    if (hello.server == setup_.server || !peers_.emplace(hello.server, connection).second)
        return fail("server {} is not expected here", index(hello.server));
    return {};
}

// A peer that has read our Hello takes our pixels, and knows that we take its.
void ServerSession::on_heard() {
    if (!draw_thread_ || --unheard_ > 0) return;
    connected_ = true;
    tell_client(Connected{});
}

Status ServerSession::check(const RenderFrame& task) const {
    if (!connected_) return fail("RenderFrame before Connected");
    if (reconfiguring_) return fail("RenderFrame before Ready");
    if (!task.group.empty() && task.group.back() >= objects_)
        return fail("RenderFrame: object {}, this model has {}", task.group.back(), objects_);
    for (const auto* exchanges : {&task.outgoing, &task.incoming})
        for (const Exchange& e : *exchanges)
            if (!peers_.contains(e.server))
                return fail("RenderFrame: an exchange with server {}", index(e.server));
    return {};
}

Status ServerSession::on_render_frame(RenderFrame&& task) {
    SWATH_TRY_VOID(check(task));
    SwapTask swap{task.frame, {}, {}, !task.final_region.empty()};
    for (const Exchange& e : task.outgoing) swap.outgoing.push_back(e.server);
    for (const Exchange& e : task.incoming) swap.incoming.push_back(e.server);
    SWATH_TRY(const auto actions, swap_->on_task(swap));

    OpenFrame& frame = frames_[task.frame];
    frame.report.frame = task.frame;
    const Nanoseconds now = clock_.now();
    frame.report.spans.push_back({Phase::kWait, now, now, Nanoseconds(0)});  // until drawing begins
    frame.task = std::move(task);

    return perform(actions);
}

Status ServerSession::from_server(ServerId from, Message&& message, Buffer&& body) {
    const auto* pixels = std::get_if<SwathPixels>(&message);
    if (pixels == nullptr) return fail("{} is not expected from a server", name(message));
    SWATH_TRY(const auto actions, swap_->on_swath(pixels->frame, from));
    Piece piece{pixels->sizes, std::move(body)};
    if (!actions.empty()) return perform(actions, &piece);
    early_.keep(pixels->frame, from, std::move(piece));
    return {};
}

// `arrived` is the piece that the actions come from, if they do; the others have been kept.
Status ServerSession::perform(const FrameSwap::Actions& actions, const Piece* arrived) {
    for (const SwapAction& action : actions) {
        OpenFrame& frame = frames_.at(action.frame);
        Status status;
        switch (action.kind) {
            case SwapAction::Kind::kDraw:
                draw(frame);
                break;
            case SwapAction::Kind::kSendSwath:
                status = send_swath(frame, action.peer);
                break;
            case SwapAction::Kind::kComposite:
                status = arrived != nullptr
                             ? composite(frame, action.peer, *arrived)
                             : composite(frame, action.peer, early_.take(action.frame, action.peer));
                break;
            case SwapAction::Kind::kSendTile:
                status = send_tile(frame);
                break;
            case SwapAction::Kind::kFinished:
                status = finish(action.frame);
                break;
        }
        if (!status) return status;
    }
    return {};
}

void ServerSession::draw(OpenFrame& frame) {
    DrawJob job{
        frame.task.view, std::move(frame.task.group), frame.task.content, frame.task.final_region, {}};
    if (!pool_.empty()) {
        job.pixels = std::move(pool_.back());
        pool_.pop_back();
    }
    draw_thread_->draw(
        std::move(job), [self = shared_from_this(), number = frame.task.frame](DrawResult result) {
            asio::post(self->io_, [self, number, drawn = std::make_shared<DrawResult>(std::move(result))] {
                self->resume([&] { return self->on_drawn(number, *drawn); });
            });
        });
}

Status ServerSession::on_drawn(FrameNumber number, DrawResult& drawn) {
    if (!drawn.status) return drawn.status;
    OpenFrame& frame = frames_.at(number);
    frame.pixels = std::move(drawn.pixels);
    ServerReport& report = frame.report;
    report.spans.front().end = drawn.spans.front().begin;
    report.spans.insert(report.spans.end(), drawn.spans.begin(), drawn.spans.end());
    report[Counter::kTriangles] = drawn.list.triangles;
    report[Counter::kObjects] = drawn.list.objects;
    report[Counter::kLeaves] = drawn.list.leaves;
    report[Counter::kSplitLevel] = static_cast<std::uint64_t>(drawn.list.split_level.value_or(0));
    if (setup_.drawing.cull != CullAlgorithm::kNone && drawn.list.visible.size() <= kMaxVisibleCounts)
        report.visible = std::move(drawn.list.visible);
    return perform(swap_->on_drawn(number));
}

namespace {

const Region& region_of(const std::vector<Exchange>& exchanges, ServerId server) {
    for (const Exchange& e : exchanges)
        if (e.server == server) return e.region;
    CHECK(false);
    std::abort();
}

}  // namespace

Status ServerSession::send_swath(OpenFrame& frame, ServerId to) {
    PhaseTimer timer(clock_, frame.report.spans);
    Buffer body;
    const BodySizes sizes = encode_swath(frame.pixels, region_of(frame.task.outgoing, to), body);
    const std::size_t bytes = body.size();
    const auto peer = peers_.find(to);
    if (peer == peers_.end()) return fail("server {} has gone", index(to));
    const auto sent = peer->second->offer(SwathPixels{frame.task.frame, sizes}, std::move(body));
    if (!sent) return fail("server {}: {}", index(to), sent.error().message);
    frame.report[Counter::kSwapPixels] += sizes.pixels;
    frame.report[Counter::kSwapBytes] += bytes + *sent;
    timer.end(Phase::kSwap);
    return {};
}

Status ServerSession::composite(OpenFrame& frame, ServerId from, const Piece& piece) {
    PhaseTimer timer(clock_, frame.report.spans);
    const auto status = composite_swath(piece.body.bytes(), piece.sizes, region_of(frame.task.incoming, from),
                                        static_cast<ObjectId>(objects_), frame.pixels);
    if (!status) return fail("garbled pixels from server {}: {}", index(from), status.error().message);
    frame.report[Counter::kReceivedPixels] += piece.sizes.pixels;
    timer.end(Phase::kPixelWrite);
    return {};
}

Status ServerSession::send_tile(OpenFrame& frame) {
    PhaseTimer timer(clock_, frame.report.spans);
    Buffer body;
    const BodySizes sizes = encode_tile(frame.pixels, frame.task.final_region, body);
    const std::size_t bytes = body.size();
    timer.end(Phase::kFinalRead);
    if (!display_) return fail("the display has gone");
    const auto sent = display_->offer(TilePixels{frame.task.frame, sizes}, std::move(body));
    if (!sent) return fail_in("the display", sent.error());
    frame.report[Counter::kTilePixels] += sizes.pixels;
    frame.report[Counter::kTileBytes] += bytes + *sent;
    timer.end(Phase::kSend);
    return {};
}

Status ServerSession::finish(FrameNumber number) {
    auto open = frames_.extract(number);
    pool_.push_back(std::move(open.mapped().pixels));
    tell_client(open.mapped().report);
    return {};
}

}  // namespace swath
