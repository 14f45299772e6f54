// Servers that come and go while a run goes on, and programs that are told to stop.
#include <gmock/gmock.h>

#include <csignal>
#include <thread>

#include "tests/e2e/live_viewer.h"
#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr auto kStop = kSlowdown * seconds(2);

class Membership : public EndToEnd {
  protected:
    struct Server {
        std::unique_ptr<Process> process;
        std::string address;
    };
    Server server(const std::string& listen = "127.0.0.1:0") const {
        auto process = start("swath-server", {"--listen", listen});
        std::string address = listening_address(*process);
        return {std::move(process), std::move(address)};
    }
    void list(const std::vector<std::string>& addresses) const {
        std::string text = "# servers of this test\n";
        for (const std::string& address : addresses) text += address + "\n";
        files_.write("servers", text);
    }
    std::string from_list() const { return "file:" + files_.path_of("servers"); }
    // Starts a display with a page.
    void start_display() {
        display_ = start("swath-display", {"--listen", "127.0.0.1:0", "--view", "0"});
        display_address_ = listening_address(*display_);
    }
    std::unique_ptr<Process> start_client(const std::string& servers, const Arguments& more) const {
        return start("swath-client",
                     Arguments{kModel, "--servers", servers, "--display", display_address_} + more);
    }
    std::string single(const LiveViewer& viewer) {
        const std::string camera = files_.write("view.camera", viewer.camera_line());
        const std::string folder = render({kModel, "--single", "--path", camera, "--size", "320x240"});
        return contents(std::filesystem::path(folder) / "frame_0000.png");
    }
    static void expect_stops(Process& process, milliseconds limit = kPatience) {
        process.signal(SIGTERM);
        const Finished finished = process.wait(limit);
        expect_no_crash(finished);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
    }
    void TearDown() override {
        display_.reset();
        EndToEnd::TearDown();
    }
    // The next lossless picture that so many servers have drawn.
    static LiveViewer::Picture still_by(LiveViewer& viewer, std::size_t servers) {
        return viewer.picture([&](const auto& picture) {
            return picture.header["format"] == "png" && picture.header["plan"].is_object() &&
                   picture.header["plan"]["servers"] == servers;
        });
    }
    static bool has_servers(const Json& session, std::size_t count) {
        return session["servers"].size() == count;
    }

    static constexpr const char* kModel = "builtin:knot:20000";
    const Json home_{{"camera", {0.5, 1.25, 7.5, 0.1, 0, 0, 0, 1, 0, 34.5}}, {"width", 320}, {"height", 240}};
    std::unique_ptr<Process> display_;
    std::string display_address_;
};

TEST_F(Membership, LiveRunTakesNewcomersAndPlansAroundThoseThatLeave) {
    start_display();
    std::vector<Server> servers;
    servers.push_back(server());
    list({servers[0].address});
    const auto client = start_client(from_list(), {"--view"});
    LiveViewer viewer(client->wait_for_line("viewer http://127.0.0.1:", kPatience));
    const auto first = viewer.still(viewer.wish(home_));
    const std::string expected = single(viewer);
    EXPECT_EQ(first.header["plan"]["servers"], 1);
    EXPECT_TRUE(first.file == expected);

    const auto expect_all = [&](std::size_t count) {
        viewer.note("session", [&](const Json& note) { return has_servers(note, count); });
        EXPECT_TRUE(still_by(viewer, count).file == expected) << count;
    };
    for (int i = 0; i < 3; ++i) servers.push_back(server());
    list({servers[0].address, servers[1].address, servers[2].address, servers[3].address});
    expect_all(4);
    // The oldest server leaves while frames are drawn; a number of servers that was chosen stays.
    viewer.wish({{"path", "orbit"}});
    viewer.picture([](const auto& p) { return p.header["plan"].is_object(); });
    expect_stops(*servers[0].process);
    viewer.wish({{"path", nullptr}});
    expect_all(3);
    EXPECT_EQ(viewer.still(viewer.wish({{"servers", 2}})).header["plan"]["servers"], 2);
    const Server back = server(servers[0].address);  // it is still on the list
    viewer.note("session", [&](const Json& note) { return has_servers(note, 4); });
    still_by(viewer, 2);
    viewer.wish({{"servers", nullptr}});
    expect_all(4);
    // Servers that are struck off the list are released, and wait for another client.
    list({servers[2].address});
    expect_all(1);
    EXPECT_EQ(run("swath-server", {"--health", "--listen", servers[1].address}).exit_code, 0);
    expect_stops(*client);
    EXPECT_THAT(display_->wait_for_line("done", kPatience), HasSubstr("client"));
}

TEST_F(Membership, LiveRunWaitsForAServerWhenAllHaveLeft) {
    start_display();
    Server one = server();
    list({one.address});
    const auto client = start_client(from_list(), {"--view"});
    LiveViewer viewer(client->wait_for_line("viewer http://127.0.0.1:", kPatience));
    const std::string before = viewer.still(viewer.wish(home_)).file;
    expect_stops(*one.process);
    viewer.note("session", [&](const Json& note) { return has_servers(note, 0); });
    // Wishes made meanwhile count later, also those that change the setup.
    viewer.wish({{"objects", 60}});
    const auto id = viewer.wish({{"cull", "none"}});
    const Server other = server(one.address);
    const auto still = viewer.still(id);
    EXPECT_TRUE(still.file == before);
    EXPECT_LT(viewer.note("objects", [](const Json& note) { return note["generation"] > 1; })["count"], 200);
    expect_stops(*client);
}

// Every frame is exact, whoever took part.
TEST_F(Membership, PicturesOfARunAreTheSameWhileServersComeAndGo) {
    start_display();
    const Arguments path{"--size", "320x240", "--frames", "1000", "--path", "random", "--seed", "5"};
    const std::string expected = render(Arguments{kModel, "--single"} + path);
    for (const char* algorithm : {"hybrid", "sort-last"}) {
        const Server stays = server();
        std::vector<std::string> addresses{stays.address};
        std::vector<Server> others;
        for (int i = 0; i < 2; ++i) {
            others.push_back(server());
            addresses.push_back(others.back().address);
        }
        list(addresses);
        const std::string out = files_.path_of(std::string("out_") + algorithm);
        const std::string timeline = files_.path_of(std::string("timeline_") + algorithm + ".csv");
        const auto client = start_client(
            from_list(), path + Arguments{"--out", out, "--algorithm", algorithm, "--timeline", timeline});
        client->wait_for_line("/1000 frames", kPatience);
        expect_stops(*others[0].process);
        client->wait_for_line("2 servers take part", kPatience);
        others[0] = server();
        addresses.push_back(others[0].address);
        list(addresses);
        client->wait_for_line("3 servers take part", kPatience);
        expect_stops(*others[1].process);
        const Finished finished = client->wait(kPatience);
        expect_no_crash(finished);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        expect_same_pictures(expected, out);
        EXPECT_THAT(contents(timeline), HasSubstr("server 2"));
    }
}

TEST_F(Membership, ServerOfAPlainListComesBackToo) {
    start_display();
    const Server one = server();
    Server two = server();
    const auto client = start_client(one.address + "," + two.address, {"--view"});
    LiveViewer viewer(client->wait_for_line("viewer http://127.0.0.1:", kPatience));
    viewer.still(viewer.wish(home_));
    expect_stops(*two.process);
    viewer.note("session", [&](const Json& note) { return has_servers(note, 1); });
    two = server(two.address);
    viewer.note("session", [&](const Json& note) { return has_servers(note, 2); });
    still_by(viewer, 2);
    expect_stops(*client);
}

TEST_F(Membership, AllAddressesOfANameAreServers) {
    start_display();
    const Server one = server();
    const std::string port = one.address.substr(one.address.rfind(':'));
    const std::string out = files_.path_of("out");
    const Arguments small{"--size", "160x120", "--frames", "2"};
    const auto client = start_client("dns:localhost" + port, small + Arguments{"--out", out});
    EXPECT_EQ(client->wait(kPatience).exit_code, 0);
    expect_same_pictures(render(Arguments{kModel, "--single"} + small), out);
}

TEST_F(Membership, RunAlongAPathEndsWhenNoServerIsLeft) {
    start_display();
    const Server one = server();
    const auto client =
        start_client(one.address, {"--size", "320x240", "--frames", "100000", "--connect-s", "0.5"});
    client->wait_for_line("are ready", kPatience);
    expect_stops(*one.process);
    expect_one_error(client->wait(kPatience), 1, {"no server is left"});
}

TEST_F(Membership, RunSaysThatItFoundNobody) {
    start_display();
    list({"# nobody yet"});
    expect_one_error(start_client(from_list(), {"--connect-s", "0.3"})->wait(kPatience), 1,
                     {from_list(), "no servers"});
    expect_one_error(start_client("dns:no-such-host.invalid:4000", {"--connect-s", "0.3"})->wait(kPatience),
                     1, {"no-such-host.invalid"});
    files_.write("servers", "a b\n");
    expect_one_error(start_client(from_list(), {})->wait(kPatience), 1, {"servers", "line 1", "'a b'"});
    expect_one_error(start_client("file:" + files_.path_of("none"), {})->wait(kPatience), 1, {"none"});
}

TEST_F(Membership, ProgramsStopWithinTwoSecondsWhateverTheyDo) {
    start_display();
    const Server one = server();
    // The server loads a large model, and so does the client.
    const auto loading = start("swath-client", {"builtin:knot:6000000", "--servers", one.address, "--display",
                                                display_address_, "--view"});
    std::this_thread::sleep_for(milliseconds(300));
    loading->signal(SIGTERM);
    EXPECT_EQ(loading->wait(kStop).exit_code, 1);
    const auto large = start("swath-client", {"builtin:knot:6000000", "--servers", one.address, "--display",
                                              display_address_, "--view"});
    one.process->wait_for_line("client ", kPatience);
    std::this_thread::sleep_for(milliseconds(200));
    expect_stops(*one.process, kStop);
    expect_one_error(large->wait(kPatience), 1, {one.address});

    const Server two = server();
    const auto client = start_client(two.address, {"--frames", "100000"});
    client->wait_for_line("are ready", kPatience);
    expect_stops(*display_, kStop);
    expect_one_error(client->wait(kStop), 1, {"display", "stopped"});
}

TEST_F(Membership, HealthIsThatSomebodyAnswers) {
    start_display();
    const Server one = server();
    EXPECT_EQ(run("swath-server", {"--health", "--listen", one.address}).exit_code, 0);
    EXPECT_EQ(run("swath-display", {"--health", "--listen", display_address_}).exit_code, 0);
    expect_one_error(run("swath-server", {"--health", "--listen", display_address_}), 1,
                     {"a display, not a server"});
    one.process->signal(SIGSTOP);
    expect_one_error(run("swath-server", {"--health", "--listen", one.address}), 1, {one.address});
    one.process->signal(SIGCONT);
    const std::string port = one.address.substr(one.address.rfind(':'));
    EXPECT_EQ(run("swath-server", {"--health", "--listen", "0.0.0.0" + port}).exit_code, 0);
    expect_stops(*one.process);
    expect_one_error(run("swath-server", {"--health", "--listen", one.address}), 1, {"refused"});
}

TEST_F(Membership, PageIsWhereItIsPublished) {
    const auto address_of_page = [&](const Arguments& more) {
        const auto display =
            start("swath-display", Arguments{"--listen", "127.0.0.1:0", "--view", "0.0.0.0:0"} + more);
        const std::string page = display->wait_for_line("viewer ", kPatience);
        expect_stops(*display);
        return page;
    };
    EXPECT_EQ(address_of_page({"--view-at", "127.0.0.1:8080"}), "viewer http://127.0.0.1:8080/");
    EXPECT_EQ(address_of_page({"--view-at", "localhost:80"}), "viewer http://localhost:80/");
    EXPECT_THAT(address_of_page({"--view-at", "swath.example:8080"}),
                testing::StartsWith("viewer http://swath.example:8080/?token="));
    EXPECT_THAT(address_of_page({}), HasSubstr("/?token="));
    for (const char* nowhere : {"0.0.0.0:8080", "[::]:8080"})
        expect_one_error(
            run("swath-display", {"--listen", "127.0.0.1:0", "--view", "0", "--view-at", nowhere}), 1,
            {"--view", nowhere});
    expect_one_error(run("swath-display", {"--view", "0", "--view-at", "8080"}), 2, {"--view-at", "8080"});
}

}  // namespace
}  // namespace swath::test
