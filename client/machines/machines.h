#pragma once
#include <boost/asio/io_context.hpp>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "client/machines/discovery.h"
#include "client/machines/roster.h"
#include "client/machines/setup_change.h"
#include "common/base/buffer.h"
#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/render/draw_settings.h"
#include "common/scene/model_blob.h"
#include "common/wire/connection.h"

namespace swath {

// The display and the servers of a run. It finds them, connects to them, sets them up, links servers to each
// other, releases those that leave, and passes on their messages about frames. A run starts when the display
// and the servers that were found first are there; later ones are brought up beside it. A fault of a server
// that takes no part yet is a warning, and the server is tried again; a lost member or display ends the run.
// On the io_context's thread.
class Machines : public std::enable_shared_from_this<Machines> {
  public:
    struct Job {
        ServerSource servers;
        Address display;
        std::string model;  // as the user named it
        Buffer blob;        // the model, for servers that lack it
        Drawing drawing;
        std::size_t objects = 0;  // that this drawing has
        PictureFormat format = PictureFormat::kNone;
        std::uint32_t frames_in_flight = 3;
        bool live = false;
        std::uint64_t session = 0;                       // a random number
        Nanoseconds patience = std::chrono::seconds(5);  // until a run has started
        WireTiming timing;
    };
    // Nothing is called any more after on_lost or stop().
    struct Handlers {
        // All are there. `page` is the address of the display's page, if it has one.
        std::function<Status(const std::string& page)> on_started;
        // The members have changed.
        std::function<void()> on_members;
        // Messages about frames, from a member and from the display. An error blames the sender.
        std::function<Status(ServerId, Message&&, Buffer&&)> on_server;
        std::function<Status(Message&&, Buffer&&)> on_display;
        std::function<void(const std::string& who, const std::string& why)> on_lost;
    };
    Machines(boost::asio::io_context& io, Job job, const Clock& clock, Handlers handlers);
    void start();
    // Ends all connections: with a Bye, or with the reason.
    void finish(const Status& why);
    // Ends all connections at once.
    void stop();

    // The servers that may take part in the next frame; the index here is the rank in a plan.
    const std::vector<ServerId>& members() const { return members_; }
    const std::string& who(ServerId server) const { return servers_.at(server).who; }  // for people
    const Address& address(ServerId server) const { return servers_.at(server).address; }
    const std::string& renderer(ServerId server) const { return servers_.at(server).renderer; }  // described
    // The time to add to the server's to get ours.
    Nanoseconds clock_offset(ServerId server) const;
    Nanoseconds display_clock_offset() const { return display_->clock_offset(); }

    Status tell(ServerId server, const Message& message);
    Status tell_display(const Message& message, Buffer body = {});

    // A frame with these servers is open; is over.
    void on_issued(const std::vector<ServerId>& servers) { roster_.on_issued(servers); }
    void on_over(const std::vector<ServerId>& servers);

    // Call it while no frame is open. All members cut, draw and cull like this from now on, or none does and
    // `done` gets the reason. Newcomers follow by themselves.
    using Reconfigured = std::function<Status(const std::string& refused)>;
    Status reconfigure(const Drawing& drawing, std::size_t objects, Reconfigured done);

  private:
    struct Server {
        Address address;
        std::string who;  // "server 2 at 127.0.0.1:4002"
        std::string renderer;
        std::shared_ptr<Connection> connection;
        bool first = false;  // the run starts with it
        bool ready = false;  // for `drawing`
        Drawing drawing;     // that it was told
    };

    bool starting() const { return !started_ && !over_; }
    void on_found(const Result<std::vector<Address>>& found);
    void find(const Address& address, bool first);
    void connect(ServerId id);
    void connect_display();
    std::shared_ptr<Connection> open(boost::asio::ip::tcp::socket socket, Connection::Handlers handlers);
    Status on_hello(ServerId id, const Hello& hello);
    Status on_display_hello(const Hello& hello);
    Status on_message(ServerId id, Message&& message, Buffer&& body);
    Status on_display_message(Message&& message, Buffer&& body);
    Status send_model_part(const Server& server, std::uint64_t offset);
    Status on_ready(ServerId id, const Ready& ready);
    Status on_answer(ServerId id, const Ready& ready);
    Status ask(ServerId id, const Drawing& drawing);
    Status ask_members(const Drawing& drawing);
    void use_next_drawing();
    Status end_change(const std::string& refused);
    Status bring_up_to_date(ServerId id);
    Status advance();
    Status link();
    void update_members();
    void release();
    void on_closed(ServerId id, const std::string& why);
    void drop(ServerId id, const std::string& why);
    bool needed(ServerId id) const;
    void on_lost(const Lost& lost, const std::string& said_by);
    void lose(const std::string& who, const std::string& why);

    boost::asio::io_context& io_;
    Job job_;
    const Clock& clock_;
    Handlers handlers_;
    Digest digest_;  // made before the network runs: a large model takes a while
    Nanoseconds begin_{0};
    std::unique_ptr<Discovery> discovery_;
    bool found_ = false;  // the first servers
    Roster roster_;
    std::map<ServerId, Server> servers_;
    std::vector<ServerId> members_;
    std::map<std::string, Nanoseconds> left_;    // by address: when it was released
    std::map<std::string, std::string> warned_;  // by address: the newest warning, which is not repeated
    std::shared_ptr<Connection> display_;
    bool display_ready_ = false;
    std::string page_;  // the display's

    // A change of drawing.
    SetupChange change_;
    std::set<ServerId> asked_;  // those that were asked and have not answered
    Drawing next_drawing_;
    std::size_t next_objects_ = 0;
    Reconfigured reconfigured_;

    bool started_ = false;
    bool over_ = false;
};

}  // namespace swath
