#pragma once
#include <boost/asio/io_context.hpp>
#include <functional>
#include <memory>
#include <set>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/wire/connection.h"
#include "common/wire/listener.h"

namespace swath {

// One client's run, as a server or a display takes part in it. Lives on the io_context's thread.
class Session {
  public:
    virtual ~Session() = default;
    // What Hello says to those who connect during this session.
    virtual std::uint64_t id() const = 0;
    virtual ServerId server() const = 0;
    // A server has connected and introduced itself.
    virtual Status on_peer(const std::shared_ptr<Connection>& connection, const Hello& hello) = 0;
    // From the client or a peer. An error ends that connection.
    virtual Status on_message(const std::shared_ptr<Connection>& from, Message&& message, Buffer&& body) = 0;
    // Of the client or a peer; true when this ends the session.
    virtual bool on_closed(const std::shared_ptr<Connection>& connection, const Status& why) = 0;
    // This program is to end: tell the client, which then ends the session here.
    virtual void leave() = 0;
    // Closes its connections and waits for its threads. Called once, last.
    virtual void stop() = 0;
};

// What swath-server and swath-display share: listens, lets newcomers introduce themselves, gives the first
// client a session and everyone else to that session. One client at a time; a second is told that it must
// wait. An error ends one connection, never the program.
class SessionHost {
  public:
    using MakeSession = std::function<std::shared_ptr<Session>(std::shared_ptr<Connection> client)>;
    struct Options {
        Role role = Role::kServer;
        Address listen;
        WireTiming timing;
    };

    static Result<std::unique_ptr<SessionHost>> make(boost::asio::io_context& io, const Options& options,
                                                     const Clock& clock, MakeSession make_session);
    ~SessionHost();
    Address address() const { return listener_->address(); }
    // Takes leave of the client, if there is one, and calls back when nobody needs this program any more.
    void leave(std::function<void()> done);

  private:
    SessionHost(boost::asio::io_context& io, const Options& options, const Clock& clock,
                MakeSession make_session);
    void on_socket(boost::asio::ip::tcp::socket socket);
    Status on_hello(const std::shared_ptr<Connection>& connection, const Hello& hello);
    void on_closed(const std::shared_ptr<Connection>& connection, const Status& why);

    boost::asio::io_context& io_;
    Options options_;
    const Clock& clock_;
    MakeSession make_session_;
    std::unique_ptr<Listener> listener_;
    std::set<std::shared_ptr<Connection>> newcomers_;
    std::shared_ptr<Session> session_;
    bool leaving_ = false;           // from leave() on
    std::function<void()> on_left_;  // then, until the session is over
    std::shared_ptr<char> alive_ =
        std::make_shared<char>();  // callbacks hold it weakly: none acts after destruction
};

}  // namespace swath
