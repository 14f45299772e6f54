#include "client/machines/machines.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cstring>
#include <utility>

#include "common/base/log.h"
#include "common/wire/listener.h"

namespace swath {
namespace {

constexpr Nanoseconds kNewcomersPatience = std::chrono::seconds(1);
// A name or list may go on naming a server that is about to end.
constexpr Nanoseconds kAfterLeaving = std::chrono::seconds(2);

}  // namespace

Machines::Machines(boost::asio::io_context& io, Job job, const Clock& clock, Handlers handlers)
    : io_(io),
      job_(std::move(job)),
      clock_(clock),
      handlers_(std::move(handlers)),
      digest_(digest(job_.blob.bytes())) {}

void Machines::start() {
    begin_ = clock_.now();
    connect_display();
    discovery_ = std::make_unique<Discovery>(
        io_, job_.servers, [weak = weak_from_this()](const Result<std::vector<Address>>& found) {
            if (const auto self = weak.lock(); self && !self->over_) self->on_found(found);
        });
    discovery_->start();
}

void Machines::stop() {
    over_ = true;
    // Later, since this may be a call from it.
    boost::asio::post(io_, [discovery = std::shared_ptr<Discovery>(std::move(discovery_))] {});
    for (auto& [id, server] : servers_)
        if (server.connection) server.connection->close();
    if (display_) display_->close();
    handlers_ = {};
}

void Machines::finish(const Status& why) {
    const auto end = [&](const std::shared_ptr<Connection>& connection) {
        if (!connection) return;
        if (why)
            connection->finish();
        else
            connection->fail_with(why.error());
    };
    over_ = true;
    for (auto& [id, server] : servers_) end(server.connection);
    end(display_);
    boost::asio::post(io_, [discovery = std::shared_ptr<Discovery>(std::move(discovery_))] {});
}

void Machines::lose(const std::string& who, const std::string& why) {
    if (std::exchange(over_, true)) return;
    handlers_.on_lost(who, why);
}

Nanoseconds Machines::clock_offset(ServerId server) const {
    return servers_.at(server).connection->clock_offset();
}

Status Machines::tell(ServerId server, const Message& message) {
    const auto sent = servers_.at(server).connection->offer(message);
    return sent ? Status{} : tl::unexpected(sent.error());
}

Status Machines::tell_display(const Message& message, Buffer body) {
    const auto sent = display_->offer(message, std::move(body));
    return sent ? Status{} : tl::unexpected(sent.error());
}

void Machines::on_found(const Result<std::vector<Address>>& found) {
    const std::string source = to_string(job_.servers);
    const bool is_file = job_.servers.kind == ServerSource::Kind::kFile;
    if (!found || found->empty()) {
        const std::string why = found ? "it has no servers" : found.error().message;
        if (found_) {
            if (std::exchange(warned_[source], why) != why) log_warning("{}: {}", source, why);
        } else if ((is_file && !found) || clock_.now() - begin_ > job_.patience) {
            lose(source, why);
        }
        return;
    }
    warned_.erase(source);
    const bool first = !std::exchange(found_, true);
    for (const Address& address : *found) find(address, first);
    // A server that is struck off somebody's list is not wanted any more.
    if (!is_file) return;
    for (const auto& [id, server] : servers_)
        if (std::count(found->begin(), found->end(), server.address) == 0) roster_.on_leave(id);
    update_members();
    release();
}

void Machines::find(const Address& address, bool first) {
    if (over_) return;
    for (const auto& [id, server] : servers_)
        if (server.address == address) return;
    if (const auto left = left_.find(to_string(address)); left != left_.end()) {
        if (clock_.now() - left->second < kAfterLeaving) return;
        left_.erase(left);
    }
    if (roster_.full()) {
        const std::string why = fmt::format("{} servers take part, there may be no more", kMaxServers);
        if (std::exchange(warned_[to_string(address)], why) != why)
            log_warning("server at {}: {}", to_string(address), why);
        return;
    }
    const ServerId id = roster_.add();
    Server& server = servers_[id];
    server.address = address;
    server.who = fmt::format("server {} at {}", index(id), to_string(address));
    server.first = first;
    connect(id);
}

std::shared_ptr<Connection> Machines::open(boost::asio::ip::tcp::socket socket,
                                           Connection::Handlers handlers) {
    Connection::Options options;
    options.hello.role = Role::kClient;
    options.timing = job_.timing;
    auto connection = std::make_shared<Connection>(std::move(socket), options, clock_);
    connection->start(std::move(handlers));
    return connection;
}

void Machines::connect(ServerId id) {
    const Server& server = servers_.at(id);
    // By the time that an attempt fails, another server may have the number.
    async_connect(io_, server.address, starting() ? job_.patience : kNewcomersPatience,
                  [self = shared_from_this(), id,
                   address = server.address](Result<boost::asio::ip::tcp::socket> socket) {
                      const auto found = self->servers_.find(id);
                      if (self->over_ || found == self->servers_.end() || found->second.address != address ||
                          found->second.connection)
                          return;
                      if (!socket) return self->drop(id, socket.error().message);
                      found->second.connection = self->open(
                          std::move(*socket),
                          {[self, id](const Hello& hello) { return self->on_hello(id, hello); },
                           [self, id](Message&& message, Buffer&& body) {
                               return self->on_message(id, std::move(message), std::move(body));
                           },
                           [self, id](const Status& why) {
                               self->on_closed(id, why ? "ended the session" : why.error().message);
                           }});
                  });
}

void Machines::connect_display() {
    async_connect(io_, job_.display, job_.patience,
                  [self = shared_from_this()](Result<boost::asio::ip::tcp::socket> socket) {
                      if (self->over_) return;
                      const std::string who = fmt::format("display at {}", to_string(self->job_.display));
                      if (!socket) return self->lose(who, socket.error().message);
                      self->display_ = self->open(
                          std::move(*socket),
                          {[self](const Hello& hello) { return self->on_display_hello(hello); },
                           [self](Message&& message, Buffer&& body) {
                               return self->on_display_message(std::move(message), std::move(body));
                           },
                           [self, who](const Status& why) {
                               self->lose(who, why ? "ended the session" : why.error().message);
                           }});
                  });
}

void Machines::on_closed(ServerId id, const std::string& why) {
    if (over_) return;
    drop(id, why);
}

bool Machines::needed(ServerId id) const {
    if (asked_.contains(id)) return true;
    return started_ ? roster_.is_member(id) || roster_.has_open_frames(id)
                    : servers_.at(id).first && job_.servers.kind == ServerSource::Kind::kList;
}

// A server, or the display, says so.
void Machines::on_lost(const Lost& lost, const std::string& said_by) {
    const auto found = servers_.find(lost.server);
    if (found == servers_.end()) return;  // it has been released
    drop(lost.server, fmt::format("{} (says {})", lost.why, said_by));
}

// The server is gone. If the run needs it, the run ends.
void Machines::drop(ServerId id, const std::string& why) {
    const Server server = servers_.at(id);
    if (needed(id)) return lose(server.who, why);
    if (server.connection) server.connection->close();
    servers_.erase(id);
    roster_.remove(id);
    const std::string address = to_string(server.address);
    if (std::exchange(warned_[address], why) != why)
        log_warning("{}: {}; going on without it", server.who, why);
    if (starting() && servers_.empty()) {
        if (clock_.now() - begin_ > job_.patience) return lose(server.who, why);
        found_ = false;
    }
    if (const Status status = advance(); !status) lose("the run", status.error().message);
}

Status Machines::on_display_hello(const Hello& hello) {
    if (hello.role != Role::kDisplay)
        return fail("this is a {}, a {} is expected", name_of(hello.role), name_of(Role::kDisplay));
    return tell_display(DisplaySetup{job_.session, job_.format, job_.frames_in_flight, job_.live});
}

Status Machines::on_hello(ServerId id, const Hello& hello) {
    if (hello.role != Role::kServer)
        return fail("this is a {}, a {} is expected", name_of(hello.role), name_of(Role::kServer));
    Server& server = servers_.at(id);
    server.drawing = job_.drawing;
    return tell(id, ServerSetup{job_.session, id, job_.model, digest_, job_.blob.size(), server.drawing,
                                job_.frames_in_flight});
}

Status Machines::on_display_message(Message&& message, Buffer&& body) {
    if (over_) return {};
    if (const auto* lost = std::get_if<Lost>(&message)) {
        on_lost(*lost, "the display");
        return {};
    }
    const auto* ready = std::get_if<Ready>(&message);
    if (ready == nullptr) return handlers_.on_display(std::move(message), std::move(body));
    if (std::exchange(display_ready_, true)) return fail("Ready came twice");
    page_ = ready->description;
    if (job_.live && page_.empty()) return fail("has no page to look at: start it with --view");
    return advance();
}

Status Machines::on_message(ServerId id, Message&& message, Buffer&& body) {
    if (over_) return {};
    if (const auto* need = std::get_if<NeedModel>(&message))
        return send_model_part(servers_.at(id), need->offset);
    if (const auto* ready = std::get_if<Ready>(&message)) return on_ready(id, *ready);
    if (std::holds_alternative<Connected>(message)) {
        SWATH_TRY_VOID(roster_.on_linked(id));
        if (started_) log_info("{}: takes part", servers_.at(id).who);
        warned_.erase(to_string(servers_.at(id).address));
        return advance();
    }
    if (const auto* lost = std::get_if<Lost>(&message)) {
        // A newcomer that lacks a link cannot take part.
        if (!needed(id)) return fail("lost server {}: {}", index(lost->server), lost->why);
        on_lost(*lost, servers_.at(id).who);
        return {};
    }
    if (std::holds_alternative<Leave>(message)) {
        log_info("{}: leaves", servers_.at(id).who);
        roster_.on_leave(id);
        update_members();
        release();
        return {};
    }
    return handlers_.on_server(id, std::move(message), std::move(body));
}

Status Machines::send_model_part(const Server& server, std::uint64_t offset) {
    if (offset >= job_.blob.size()) return fail("NeedModel: offset {} of {}", offset, job_.blob.size());
    const std::size_t bytes =
        std::min<std::size_t>(kModelPartBytes, job_.blob.size() - static_cast<std::size_t>(offset));
    Buffer body(bytes);
    std::memcpy(body.data(), job_.blob.data() + offset, bytes);
    const auto sent = server.connection->offer(ModelPart{offset}, std::move(body));
    return sent ? Status{} : tl::unexpected(sent.error());
}

Status Machines::on_ready(ServerId id, const Ready& ready) {
    if (asked_.contains(id)) return on_answer(id, ready);
    Server& server = servers_.at(id);
    if (server.ready) return fail("Ready came twice");
    if (!ready.refused.empty()) return fail("{}", ready.refused);
    if (server.drawing == job_.drawing && ready.objects != job_.objects)
        return fail("cut the model into {} objects, this client into {}", ready.objects, job_.objects);
    server.ready = true;
    server.renderer = ready.description;
    return bring_up_to_date(id);
}

// The drawing may have changed while the server got ready.
Status Machines::bring_up_to_date(ServerId id) {
    const Server& server = servers_.at(id);
    if (server.ready && server.drawing != job_.drawing) SWATH_TRY_VOID(ask(id, job_.drawing));
    roster_.on_ready(id, server.ready);
    return advance();
}

Status Machines::advance() {
    if (over_) return {};
    SWATH_TRY_VOID(link());
    if (!started_) {
        const bool complete = std::all_of(servers_.begin(), servers_.end(), [&](const auto& entry) {
            return !entry.second.first || roster_.is_member(entry.first);
        });
        members_ = roster_.members();
        if (!display_ready_ || !found_ || members_.empty() || !complete) return {};
        started_ = true;
        return handlers_.on_started(page_);
    }
    update_members();
    return {};
}

// The first servers are linked together.
Status Machines::link() {
    const bool all_ready = std::all_of(servers_.begin(), servers_.end(), [&](const auto& entry) {
        return !entry.second.first || entry.second.ready;
    });
    if (!display_ready_ || (!started_ && !all_ready)) return {};
    // If the servers have a name, everybody is told addresses, as this machine resolves them.
    const bool resolved = job_.servers.kind == ServerSource::Kind::kName;
    for (const Roster::Link& link : roster_.link()) {
        Connect connect{resolved ? display_->peer() : to_string(job_.display), {}};
        for (const ServerId peer : link.peers)
            connect.peers.push_back({peer, to_string(servers_.at(peer).address)});
        if (const Status status = tell(link.server, connect); !status)
            return fail_in(servers_.at(link.server).who, status.error());
    }
    return {};
}

void Machines::update_members() {
    if (!started_ || over_) return;
    std::vector<ServerId> members = roster_.members();
    if (members == members_) return;
    members_ = std::move(members);
    handlers_.on_members();
}

void Machines::on_over(const std::vector<ServerId>& servers) {
    roster_.on_over(servers);
    release();
}

void Machines::release() {
    // Servers that are asked for a change answer first.
    if (over_ || change_.under_way()) return;
    for (const ServerId id : roster_.released()) {
        const Server& server = servers_.at(id);
        if (server.connection) server.connection->finish();
        left_[to_string(server.address)] = clock_.now();
        servers_.erase(id);
        roster_.remove(id);
    }
}

Status Machines::reconfigure(const Drawing& drawing, std::size_t objects, Reconfigured done) {
    next_drawing_ = drawing;
    next_objects_ = objects;
    reconfigured_ = std::move(done);
    if (members_.empty()) {
        use_next_drawing();
        return end_change({});
    }
    change_.begin(members_.size());
    asked_ = {members_.begin(), members_.end()};
    return ask_members(drawing);
}

Status Machines::ask(ServerId id, const Drawing& drawing) {
    Server& server = servers_.at(id);
    server.drawing = drawing;
    server.ready = false;
    const auto sent = server.connection->offer(Reconfigure{server.drawing});
    return sent ? Status{} : fail_in(server.who, sent.error());
}

Status Machines::ask_members(const Drawing& drawing) {
    for (const ServerId id : asked_) SWATH_TRY_VOID(ask(id, drawing));
    return {};
}

Status Machines::on_answer(ServerId id, const Ready& ready) {
    Server& server = servers_.at(id);
    if (server.ready) return fail("Ready came twice");
    server.ready = true;
    const std::size_t objects = change_.going_back() ? job_.objects : next_objects_;
    if (ready.refused.empty() && ready.objects != objects)
        return fail("cut the model into {} objects, this client into {}", ready.objects, objects);
    if (ready.refused.empty()) server.renderer = ready.description;
    switch (change_.on_answer(ready.refused)) {
        case SetupChange::Next::kWait:
            return {};
        case SetupChange::Next::kDone:
            use_next_drawing();
            return end_change({});
        case SetupChange::Next::kGoBack:
            return ask_members(job_.drawing);
        case SetupChange::Next::kUndone:
            return end_change(change_.why());
        case SetupChange::Next::kStuck:
            return fail("cannot go back to what it had: {}", ready.refused);
    }
    return {};
}

void Machines::use_next_drawing() {
    job_.drawing = next_drawing_;
    job_.objects = next_objects_;
}

Status Machines::end_change(const std::string& refused) {
    asked_.clear();
    // A server that came up meanwhile was not asked.
    for (const auto& [id, server] : servers_)
        if (server.ready && server.drawing != job_.drawing) {
            roster_.on_ready(id, false);
            SWATH_TRY_VOID(ask(id, job_.drawing));
        }
    update_members();
    release();
    return std::exchange(reconfigured_, nullptr)(refused);
}

}  // namespace swath
