#include "display/session/session.h"

#include <boost/asio/post.hpp>
#include <new>
#include <utility>

#include "common/base/check.h"
#include "common/base/log.h"
#include "common/timeline/phase_timer.h"

namespace swath {
namespace asio = boost::asio;

DisplaySession::DisplaySession(asio::io_context& io, const Clock& clock, ViewerHost* viewers,
                               std::shared_ptr<Connection> client)
    : io_(io),
      clock_(clock),
      viewers_(viewers),
      client_(std::move(client)),
      encoder_(std::make_unique<WorkerThread>()) {}

void DisplaySession::stop() {
    stopped_ = true;
    if (viewers_ != nullptr && assembly_) viewers_->end();
    client_->finish();
    for (const auto& [id, server] : servers_) server->finish();
    servers_.clear();
    encoder_.reset();
}

void DisplaySession::give_up(const Error& error) {
    if (!stopped_) client_->fail_with(error);
}

bool DisplaySession::on_closed(const std::shared_ptr<Connection>& connection, const Status& why) {
    if (connection == client_) return true;
    const ServerId id = connection->peer_hello().server;
    const auto server = servers_.find(id);
    if (server == servers_.end() || server->second != connection) return false;
    servers_.erase(server);
    if (why) return false;  // a Bye: it has left, or heard before us that the client has ended the run
    log_warning("lost server {} ({}): {}", index(id), connection->peer(), why.error().message);
    if (!stopped_) tell(Lost{id, why.error().message});
    return false;
}

Status DisplaySession::on_peer(const std::shared_ptr<Connection>& connection, const Hello& hello) {
    if (!assembly_ || hello.session != setup_.session) return fail("this display is in another session");
    if (!servers_.emplace(hello.server, connection).second)
        return fail("server {} is not expected here", index(hello.server));
    return {};
}

Status DisplaySession::on_message(const std::shared_ptr<Connection>& from, Message&& message, Buffer&& body) {
    if (stopped_) return {};
    if (from == client_) return from_client(message, std::move(body));
    const Hello& sender = from->peer_hello();
    if (sender.role == Role::kServer) return from_server(sender.server, message, std::move(body));
    return fail("{} is not expected here", name(message));
}

Status DisplaySession::from_client(const Message& message, Buffer&& body) {
    if (const auto* setup = std::get_if<DisplaySetup>(&message)) return on_setup(*setup);
    if (const auto* task = std::get_if<AssembleFrame>(&message)) return on_assemble(*task);
    if (const auto* note = std::get_if<Note>(&message)) return on_note(*note, std::move(body));
    return fail("{} is not expected from a client", name(message));
}

Status DisplaySession::on_setup(const DisplaySetup& setup) {
    if (assembly_) return fail("DisplaySetup came twice");
    setup_ = setup;
    assembly_ = std::make_unique<Assembly>(setup.frames_in_flight);
    Ready ready;
    if (viewers_ != nullptr) ready.description = viewers_->url();
    tell(ready);
    if (viewers_ != nullptr) tell(Audience{begin_viewing()});
    return {};
}

// Returns the number of viewers.
std::uint32_t DisplaySession::begin_viewing() {
    const std::weak_ptr<DisplaySession> weak = weak_from_this();
    ViewerHost::Callbacks callbacks;
    callbacks.on_audience = [weak](std::uint32_t viewers) {
        if (const auto self = weak.lock(); self && !self->stopped_) self->tell(Audience{viewers});
    };
    callbacks.on_wish = [weak](ViewerId viewer, const std::string& wish) {
        const auto self = weak.lock();
        if (!self || self->stopped_) return;
        self->next_wish_.emplace(viewer, wish);
        self->pass_wish();
    };
    return viewers_->begin(setup_.live, io_.get_executor(), std::move(callbacks));
}

void DisplaySession::pass_wish() {
    if (!next_wish_ || wish_under_way_) return;
    const auto [viewer, text] = *std::exchange(next_wish_, std::nullopt);
    Buffer body;
    body.append(text.data(), text.size());
    wish_under_way_ = true;
    tell(Wish{viewer}, std::move(body));
}

Status DisplaySession::on_note(const Note& note, Buffer&& text) {
    if (!assembly_) return fail("Note before DisplaySetup");
    if (viewers_ == nullptr) return {};
    if (note.topic == NoteTopic::kState) {
        wish_under_way_ = false;
        pass_wish();
    }
    return viewers_->note(note.topic, note.frame, std::move(text));
}

Status DisplaySession::on_assemble(const AssembleFrame& task) {
    if (!assembly_) return fail("AssembleFrame before DisplaySetup");
    std::vector<ServerId> servers;
    for (const Exchange& e : task.tiles) servers.push_back(e.server);
    SWATH_TRY(const auto actions, assembly_->on_task(task.frame, servers));

    OpenFrame& frame = frames_[task.frame];
    frame.task = task;
    frame.report.frame = task.frame;
    frame.picture = pool_.take();
    if (viewers_ != nullptr) viewers_->announce(task.frame);
    PhaseTimer timer(clock_, frame.report.spans);
    fill(*frame.picture, task.width, task.height, task.background);
    timer.end(Phase::kAssemble);

    return perform(actions);
}

Status DisplaySession::from_server(ServerId from, const Message& message, Buffer&& body) {
    const auto* pixels = std::get_if<TilePixels>(&message);
    if (pixels == nullptr) return fail("{} is not expected from a server", name(message));
    SWATH_TRY(const auto actions, assembly_->on_tile(pixels->frame, from));
    Piece piece{pixels->sizes, std::move(body)};
    if (!actions.empty()) return perform(actions, &piece);
    early_.keep(pixels->frame, from, std::move(piece));
    return {};
}

// `arrived` is the piece that the actions come from, if they do; the others have been kept.
Status DisplaySession::perform(const Assembly::Actions& actions, const Piece* arrived) {
    for (const AssemblyAction& action : actions) {
        switch (action.kind) {
            case AssemblyAction::Kind::kAssemble: {
                OpenFrame& frame = frames_.at(action.frame);
                SWATH_TRY_VOID(arrived != nullptr ? assemble(frame, action.server, *arrived)
                                                  : assemble(frame, action.server,
                                                             early_.take(action.frame, action.server)));
                break;
            }
            case AssemblyAction::Kind::kComplete:
                complete(action.frame);
                break;
        }
    }
    return {};
}

Status DisplaySession::assemble(OpenFrame& frame, ServerId from, const Piece& tile) {
    PhaseTimer timer(clock_, frame.report.spans);
    const Region* region = nullptr;
    for (const Exchange& e : frame.task.tiles)
        if (e.server == from) region = &e.region;
    CHECK((region != nullptr) == true);
    const auto status = assemble_tile(tile.body.bytes(), tile.sizes, *region, *frame.picture);
    if (!status) return fail("garbled tile from server {}: {}", index(from), status.error().message);
    timer.end(Phase::kAssemble);
    return {};
}

void DisplaySession::complete(FrameNumber number) {
    auto frame = std::make_shared<OpenFrame>(std::move(frames_.at(number)));
    frames_.erase(number);
    if (viewers_ != nullptr) viewers_->picture(number, frame->task.stream, frame->picture);
    if (setup_.format == PictureFormat::kNone) {
        tell(frame->report);
        return;
    }
    encoder_->post([self = shared_from_this(), frame] {
        PhaseTimer timer(self->clock_, frame->report.spans);
        auto encoded = std::make_shared<Result<Buffer>>(fail("not enough memory to encode a picture"));
        try {
            *encoded = encode(*frame->picture, self->setup_.format);
        } catch (const std::bad_alloc&) {  // the error stays
        }
        timer.end(Phase::kEncode);
        asio::post(self->io_, [self, frame, encoded] {
            if (self->stopped_) return;
            if (!*encoded) return self->give_up(encoded->error());
            self->tell(frame->report, std::move(**encoded));
        });
    });
}

// A client that takes too little is given up.
void DisplaySession::tell(const Message& message, Buffer body) {
    if (const auto sent = client_->offer(message, std::move(body)); !sent) give_up(sent.error());
}

}  // namespace swath
