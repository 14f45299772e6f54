#include "client/machines/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/models.h"
#include "tests/support/wire_peer.h"

namespace swath::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Machines in this process, with a display and servers that the test plays. Servers are read from a file.
class MachinesTest : public testing::Test {
  protected:
    ~MachinesTest() override { stop(); }
    // Connections release the machines that own them when the loop runs once more.
    void stop() {
        if (!machines_) return;
        machines_->stop();
        loop_.io.restart();
        loop_.io.poll();
        machines_.reset();
    }
    void list(const std::vector<std::string>& servers) {
        std::string text;
        for (const std::string& server : servers) text += server + "\n";
        files_.write("servers", text);
    }
    std::string address(Door& door) { return to_string(door.address()); }

    void start() { start({"file:" + files_.path_of("servers")}); }
    void start(const std::vector<std::string>& servers) {
        Machines::Job job;
        job.servers = *parse_server_source(servers);
        job.display = display_door_.address();
        job.model = "a model";
        job.blob.append("0123456789", 10);
        job.objects = 7;
        job.session = 42;
        job.patience = std::chrono::milliseconds(300);
        Machines::Handlers handlers;
        handlers.on_started = [this](const std::string& page) {
            log_.push_back("started " + page);
            return Status();
        };
        handlers.on_members = [this] {
            log_.push_back(fmt::format("{} members", machines_->members().size()));
        };
        handlers.on_server = [this](ServerId server, Message&& message, Buffer&&) {
            log_.push_back(fmt::format("{} from {}", name(message), index(server)));
            return Status();
        };
        handlers.on_display = [this](Message&& message, Buffer&&) {
            log_.push_back(fmt::format("{} from the display", name(message)));
            return Status();
        };
        handlers.on_lost = [this](const std::string& who, const std::string& why) {
            log_.push_back(fmt::format("lost {}: {}", who, why));
        };
        stop();
        machines_ = std::make_shared<Machines>(loop_.io, std::move(job), loop_.clock, std::move(handlers));
        machines_->start();
    }
    void display() {
        display_ = std::make_unique<Peer>(loop_, display_door_.next(), hello_of(Role::kDisplay));
        EXPECT_EQ(display_->expect<DisplaySetup>().session, 42u);
        display_->send(Ready{0, 0, "a page"});
    }
    // A server that has come as far as Ready.
    std::unique_ptr<Peer> ready(Door& door, std::size_t id) {
        auto server = std::make_unique<Peer>(loop_, door.next(), hello_of(Role::kServer));
        const auto setup = server->expect<ServerSetup>();
        EXPECT_EQ(setup.server, server_id(id));
        EXPECT_EQ(setup.blob_bytes, 10u);
        server->send(Ready{7, 100, "a renderer"});
        return server;
    }
    std::unique_ptr<Peer> member(Door& door, std::size_t id) {
        auto server = ready(door, id);
        server->expect<Connect>();
        server->send(Connected{});
        loop_.run_until([&] {
            return std::count(machines_->members().begin(), machines_->members().end(), server_id(id)) > 0;
        });
        return server;
    }
    // Starts the machines with a display and one server.
    void run() {
        list({address(one_)});
        start();
        display();
        first_ = member(one_, 0);
        EXPECT_EQ(said(), "started a page");
    }
    // Takes the oldest line of the log.
    std::string said() {
        if (!loop_.run_until([&] { return !log_.empty(); })) return {};
        std::string line = log_.front();
        log_.erase(log_.begin());
        return line;
    }

    Loop loop_;
    TemporaryFolder files_;
    Door display_door_{loop_}, one_{loop_}, two_{loop_}, three_{loop_};
    std::shared_ptr<Machines> machines_;
    std::unique_ptr<Peer> display_, first_;
    std::vector<std::string> log_;
};

TEST_F(MachinesTest, StartWhenTheDisplayAndTheFirstServersAreLinked) {
    start({address(one_), address(two_)});
    const auto second = ready(two_, 1);
    const auto first = ready(one_, 0);
    loop_.run_until([&] { return second->connection->has_clock_offset(); });
    display();
    EXPECT_EQ(first->expect<Connect>(), (Connect{address(display_door_), {}}));
    EXPECT_EQ(second->expect<Connect>(), (Connect{address(display_door_), {{server_id(0), address(one_)}}}));
    second->send(Connected{});
    loop_.run_until([&] { return machines_->members().size() == 1; });
    EXPECT_THAT(log_, IsEmpty());
    first->send(Connected{});
    EXPECT_EQ(said(), "started a page");
    EXPECT_THAT(machines_->members(), ElementsAre(server_id(0), server_id(1)));
    EXPECT_EQ(machines_->who(server_id(1)), "server 1 at " + address(two_));
    EXPECT_EQ(machines_->renderer(server_id(1)), "a renderer");
}

TEST_F(MachinesTest, OfANameAreToldAddresses) {
    const std::uint16_t port = one_.address().port;
    start({fmt::format("dns:localhost:{}", port)});
    display();
    const auto server = ready(one_, 0);
    EXPECT_EQ(server->expect<Connect>(), (Connect{address(display_door_), {}}));
    EXPECT_EQ(machines_->address(server_id(0)), (Address{"127.0.0.1", port}));
}

TEST_F(MachinesTest, SendTheModelPartByPart) {
    start({address(one_)});
    Peer server(loop_, one_.next(), hello_of(Role::kServer));
    server.expect<ServerSetup>();
    server.send(NeedModel{4});
    EXPECT_EQ(server.expect<ModelPart>().offset, 4u);
    EXPECT_EQ(server.body.size(), 6u);
    server.send(NeedModel{10});
    EXPECT_EQ(said(), "lost server 0 at " + address(one_) + ": NeedModel: offset 10 of 10");
}

TEST_F(MachinesTest, PassOnWhatIsSaidAboutFrames) {
    run();
    ServerReport report;
    first_->send(report);
    EXPECT_EQ(said(), "ServerReport from 0");
    display_->send(Audience{1});
    EXPECT_EQ(said(), "Audience from the display");
}

TEST_F(MachinesTest, TakeNewcomersAndLetThemGo) {
    run();
    list({address(one_), address(two_)});
    const auto newcomer = ready(two_, 1);
    EXPECT_EQ(newcomer->expect<Connect>(),
              (Connect{address(display_door_), {{server_id(0), address(one_)}}}));
    EXPECT_THAT(log_, IsEmpty());
    newcomer->send(Connected{});
    EXPECT_EQ(said(), "2 members");

    machines_->on_issued(machines_->members());
    first_->send(Leave{});
    EXPECT_EQ(said(), "1 members");
    EXPECT_THAT(machines_->members(), ElementsAre(server_id(1)));
    first_->send(ServerReport{});
    EXPECT_EQ(said(), "ServerReport from 0");
    EXPECT_FALSE(first_->closed.has_value());
    machines_->on_over({server_id(0), server_id(1)});
    EXPECT_EQ(first_->ending(), "");  // a Bye

    // It is back soon, because it is still on the list.
    const auto back = member(one_, 0);
    EXPECT_EQ(said(), "2 members");
    list({address(two_)});  // struck off
    EXPECT_EQ(said(), "1 members");
    EXPECT_EQ(back->ending(), "");
}

TEST_F(MachinesTest, GoOnWithoutNewcomersThatFailAndTryThemAgain) {
    run();
    list({address(one_), address(two_)});
    {
        Peer wrong(loop_, two_.next(), hello_of(Role::kDisplay));
        EXPECT_EQ(wrong.ending(), "this is a display, a server is expected");
    }
    {
        const auto unable = ready(two_, 1);
        unable->expect<Connect>();
        unable->connection->fail_with({"cannot connect to anybody"});
        unable->ending();
    }
    {
        Peer other(loop_, two_.next(), hello_of(Role::kServer));
        other.expect<ServerSetup>();
        other.send(Ready{8, 100, "a renderer"});
        EXPECT_EQ(other.ending(), "cut the model into 8 objects, this client into 7");
    }
    const auto newcomer = member(two_, 1);
    EXPECT_EQ(said(), "2 members");
    EXPECT_THAT(log_, IsEmpty());
}

TEST_F(MachinesTest, StartWithoutServersOfAFileThatDoNotAnswer) {
    Loop elsewhere;
    const std::string closed = address(*std::make_unique<Door>(elsewhere));
    list({closed, address(one_)});
    start();
    display();
    const auto server = ready(one_, 1);
    server->expect<Connect>();
    server->send(Connected{});
    EXPECT_EQ(said(), "started a page");
    EXPECT_THAT(machines_->members(), ElementsAre(server_id(1)));
}

TEST_F(MachinesTest, NeedEveryServerThatIsNamedOneByOne) {
    Loop elsewhere;
    const std::string closed = address(*std::make_unique<Door>(elsewhere));
    start({address(one_), closed});
    const auto server = ready(one_, 0);
    EXPECT_EQ(said(), "lost server 1 at " + closed + ": cannot connect to " + closed +
                          ": Connection refused (tried for 0.3 s)");
}

TEST_F(MachinesTest, SayThatNobodyIsThere) {
    start({"dns:no-such-host.invalid:4000"});
    EXPECT_THAT(said(), HasSubstr("lost dns:no-such-host.invalid:4000: no-such-host.invalid: "));
    list({});
    start();
    EXPECT_EQ(said(), "lost file:" + files_.path_of("servers") + ": it has no servers");
    start({"file:" + files_.path_of("none")});
    EXPECT_THAT(said(), HasSubstr(files_.path_of("none") + ": "));
}

TEST_F(MachinesTest, SayWhoOfTheRunIsLost) {
    run();
    first_->connection->close();
    EXPECT_EQ(said(), "lost server 0 at " + address(one_) + ": closed the connection");
}

TEST_F(MachinesTest, SayWhoIsLostWhoeverHeardOfItFirst) {
    run();
    list({address(one_), address(two_)});
    const auto second = member(two_, 1);
    EXPECT_EQ(said(), "2 members");
    second->send(Lost{server_id(7), "it has been let go long ago"});
    second->send(ServerReport{});
    EXPECT_EQ(said(), "ServerReport from 1");
    second->send(Lost{server_id(0), "reset"});
    EXPECT_EQ(said(),
              "lost server 0 at " + address(one_) + ": reset (says server 1 at " + address(two_) + ")");
}

TEST_F(MachinesTest, SayWhoIsLostAsTheDisplaySees) {
    run();
    display_->send(Lost{server_id(0), "garbled tile"});
    EXPECT_EQ(said(), "lost server 0 at " + address(one_) + ": garbled tile (says the display)");
}

TEST_F(MachinesTest, GoOnWithoutANewcomerThatMembersLose) {
    run();
    list({address(one_), address(two_)});
    const auto newcomer = ready(two_, 1);
    newcomer->expect<Connect>();
    first_->send(Lost{server_id(1), "reset"});
    newcomer->ending();
    const auto again = ready(two_, 1);
    again->expect<Connect>();
    again->send(Lost{server_id(0), "reset"});  // its link to another server is gone
    EXPECT_EQ(again->ending(), "lost server 0: reset");
    member(two_, 1);
    EXPECT_EQ(said(), "2 members");
    EXPECT_THAT(log_, IsEmpty());
}

TEST_F(MachinesTest, SayThatTheDisplayIsLost) {
    run();
    display_->connection->fail_with({"it was stopped"});
    EXPECT_EQ(said(), "lost display at " + address(display_door_) + ": it was stopped");
}

TEST_F(MachinesTest, ThatLeftInTheMiddleOfAFrameAreLost) {
    run();
    machines_->on_issued(machines_->members());
    first_->send(Leave{});
    EXPECT_EQ(said(), "0 members");
    first_->connection->close();
    EXPECT_THAT(said(), HasSubstr("lost server 0"));
}

TEST_F(MachinesTest, ChangeTogetherOrNotAtAll) {
    run();
    list({address(one_), address(two_)});
    const auto second = member(two_, 1);
    EXPECT_EQ(said(), "2 members");
    const auto change = [&](const Drawing& drawing, std::size_t objects) {
        EXPECT_TRUE(machines_->reconfigure(drawing, objects, [this](const std::string& refused) {
            log_.push_back("changed: " + refused);
            return Status();
        }));
        EXPECT_EQ(first_->expect<Reconfigure>().drawing, drawing);
        EXPECT_EQ(second->expect<Reconfigure>().drawing, drawing);
    };
    const Drawing before{};
    const Drawing deeper{{{RendererKind::kEgl, RendererKind::kRaycast}, CullAlgorithm::kNone}, {.depth = 3}};
    change(deeper, 9);
    first_->send(Ready{9, 100, "EGL"});
    second->send(Ready{7, 100, "OSMesa", "no EGL here"});
    EXPECT_EQ(first_->expect<Reconfigure>().drawing, before);
    EXPECT_EQ(second->expect<Reconfigure>().drawing, before);
    first_->send(Ready{7, 100, "a renderer"});
    second->send(Ready{7, 100, "a renderer"});
    EXPECT_EQ(said(), "changed: no EGL here");

    change(deeper, 9);
    first_->send(Ready{9, 100, "EGL"});
    second->send(Leave{});  // it is released when all have changed
    EXPECT_EQ(said(), "1 members");
    second->send(Ready{9, 100, "EGL"});
    EXPECT_EQ(said(), "changed: ");
    EXPECT_EQ(second->ending(), "");
    EXPECT_EQ(machines_->renderer(server_id(0)), "EGL");
}

TEST_F(MachinesTest, AreDealtTheirRenderersInTurnByTheirNumbers) {
    const Drawing mixed{
        {{RendererKind::kRaycast, RendererKind::kOsmesa}, CullAlgorithm::kNone, {.shadows = true}},
        {.depth = 2}};
    EXPECT_EQ(mixed.renderer_of(server_id(0)), RendererKind::kRaycast);
    EXPECT_EQ(mixed.renderer_of(server_id(3)), RendererKind::kOsmesa);
    run();
    EXPECT_TRUE(machines_->reconfigure(mixed, 7, [this](const std::string&) {
        log_.emplace_back("changed");
        return Status();
    }));
    EXPECT_EQ(first_->expect<Reconfigure>().drawing, mixed);
    first_->send(Ready{7, 100, "rays"});
    EXPECT_EQ(said(), "changed");
    list({address(one_), address(two_)});
    auto second = std::make_unique<Peer>(loop_, two_.next(), hello_of(Role::kServer));
    EXPECT_EQ(second->expect<ServerSetup>().drawing, mixed);
}

TEST_F(MachinesTest, BringNewcomersUpToDateWhenTheDrawingHasChangedMeanwhile) {
    run();
    list({address(one_), address(two_)});
    auto slow = std::make_unique<Peer>(loop_, two_.next(), hello_of(Role::kServer));
    EXPECT_EQ(slow->expect<ServerSetup>().drawing.cut.depth, 0);
    EXPECT_TRUE(machines_->reconfigure({{{RendererKind::kOsmesa}, CullAlgorithm::kWide}, {.depth = 3}}, 9,
                                       [this](const std::string&) {
                                           log_.emplace_back("changed");
                                           return Status();
                                       }));
    first_->expect<Reconfigure>();
    first_->send(Ready{9, 100, "a renderer"});
    EXPECT_EQ(said(), "changed");
    slow->send(Ready{7, 100, "a renderer"});  // as it was told at first
    EXPECT_EQ(slow->expect<Reconfigure>().drawing.cut.depth, 3);
    slow->send(Ready{9, 100, "a renderer"});
    slow->expect<Connect>();
    slow->send(Connected{});
    EXPECT_EQ(said(), "2 members");
}

}  // namespace
}  // namespace swath::test
