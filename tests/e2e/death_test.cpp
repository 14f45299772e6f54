// Programs that die or are told to stop in the middle of a run: the client ends in time and names the lost
// program, and nothing is left behind.
#include <unistd.h>

#include <csignal>
#include <regex>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Some seconds of frames; a line of progress comes after a tenth of them.
const Arguments kLongRun{"builtin:knot:40000", "--size", "640x480", "--frames", "600"};

class Death : public EndToEnd {
  protected:
    // A client in the middle of its run.
    std::unique_ptr<Process> running(const Arguments& arguments) const {
        auto process = start("swath-client", kLongRun + arguments);
        process->wait_for_line("/600 frames", kPatience);
        return process;
    }
    static std::vector<pid_t> children_named(const Process& client, const std::string& program) {
        std::vector<pid_t> found;
        for (const pid_t pid : living_descendants(client.pid()))
            if (program_of(pid) == program) found.push_back(pid);
        return found;
    }
    std::unique_ptr<RemoteCluster> cluster(int servers) const {
        return std::make_unique<RemoteCluster>(
            [this](const std::string& program, const Arguments& arguments) {
                return start(program, arguments);
            },
            servers);
    }
    void expect_served(const RemoteCluster& cluster) {
        const Arguments arguments{"builtin:knot:5000", "--size", "64x48", "--frames", "2"};
        const std::string expected = render(arguments + Arguments{"--single"});
        expect_same_pictures(expected, render(arguments + cluster.flags()));
    }
};

TEST_F(Death, KilledLocalServerEndsTheRunWithinTwoSeconds) {
    for (const std::size_t victim : {0u, 2u}) {
        const auto client = running({"--local", "3"});
        const auto servers = children_named(*client, "swath-server");
        ASSERT_EQ(servers.size(), 3u);
        ASSERT_EQ(children_named(*client, "swath-display").size(), 1u);
        ::kill(servers[victim], SIGKILL);
        const Finished finished = client->wait(kSlowdown * seconds(2));
        expect_one_error(finished, 1, {"server "});
        EXPECT_TRUE(living_descendants(::getpid()).empty());
    }
}

TEST_F(Death, KilledRemoteServerIsNamedAndTheOthersGoOn) {
    const auto cluster = this->cluster(3);
    const auto client = running(cluster->flags());
    cluster->server(1).signal(SIGKILL);
    // The first peer that notices reports it.
    expect_one_error(client->wait(kSlowdown * seconds(2)), 1, {"server 1 at " + cluster->server_address(1)});
    const auto again =
        run("swath-client", Arguments{"builtin:knot:5000", "--size", "64x48", "--frames", "2", "--servers",
                                      cluster->server_address(0) + "," + cluster->server_address(2),
                                      "--display", cluster->display_address()});
    EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST_F(Death, KilledDisplayEndsTheRunWithinTwoSeconds) {
    const auto client = running({"--local", "2"});
    const auto displays = children_named(*client, "swath-display");
    ASSERT_EQ(displays.size(), 1u);
    ::kill(displays[0], SIGKILL);
    expect_one_error(client->wait(kSlowdown * seconds(2)), 1, {"display"});
    EXPECT_TRUE(living_descendants(::getpid()).empty());
}

// A frozen server's connections stay open; only its silence (limit: 1.8 s) tells.
TEST_F(Death, FrozenServerEndsTheRunAndIsKilled) {
    const auto client = running({"--local", "3", "--silence-ms", "1800"});
    const auto servers = children_named(*client, "swath-server");
    ASSERT_EQ(servers.size(), 3u);
    ::kill(servers[1], SIGSTOP);
    expect_one_error(client->wait(kSlowdown * milliseconds(2800)), 1, {"server 1", "silent"});
    EXPECT_TRUE(all_end_within(servers, kSlowdown * milliseconds(500)));
}

TEST_F(Death, FrozenDisplayEndsTheRunAndIsKilled) {
    const auto client = running({"--local", "2", "--silence-ms", "1800"});
    const auto displays = children_named(*client, "swath-display");
    ASSERT_EQ(displays.size(), 1u);
    ::kill(displays[0], SIGSTOP);
    expect_one_error(client->wait(kSlowdown * milliseconds(2800)), 1, {"display", "silent"});
    EXPECT_TRUE(all_end_within(displays, kSlowdown * milliseconds(500)));
}

TEST_F(Death, KilledClientTakesItsServersAlong) {
    const auto client = running({"--local", "4"});
    const auto family = living_descendants(client->pid());
    ASSERT_EQ(family.size(), 5u);
    client->signal(SIGKILL);
    EXPECT_EQ(client->wait(kPatience).signal, SIGKILL);
    EXPECT_TRUE(all_end_within(family, kSlowdown * seconds(1)));
}

TEST_F(Death, ClientKilledWhileItStartsTakesItsServersAlong) {
    const auto client = start("swath-client", {"builtin:knot:1000000", "--local", "4", "--frames", "100"});
    client->wait_for_line("triangles in", kPatience);
    client->signal(SIGKILL);
    EXPECT_EQ(client->wait(kPatience).signal, SIGKILL);
    // A starting program may not be our child yet if we look too early, so looks at all descendants.
    EXPECT_TRUE(all_end_within(living_descendants(::getpid()), kSlowdown * seconds(1)));
}

TEST_F(Death, InterruptedClientEndsAtOnceAndLeavesNothing) {
    for (const int number : {SIGINT, SIGTERM}) {
        const std::string out = files_.path_of("out_" + std::to_string(number));
        const auto client = running({"--local", "3", "--out", out});
        client->signal(number);
        expect_one_error(client->wait(kSlowdown * seconds(1)), 1, {"interrupted"});
        EXPECT_TRUE(living_descendants(::getpid()).empty());
        // Every picture is whole or not there.
        EXPECT_GE(file_names(out).size(), 60u);
        for (const std::string& name : file_names(out)) EXPECT_TRUE(name.ends_with(".png")) << name;
    }
}

TEST_F(Death, InterruptedClientEndsEvenWhileItConnects) {
    const auto cluster = this->cluster(1);
    const auto client =
        start("swath-client", Arguments{"builtin:knot:1000", "--connect-s", "100", "--servers", "127.0.0.1:1",
                                        "--display", cluster->display_address()});
    client->wait_for_line("triangles in", kPatience);
    client->signal(SIGTERM);
    const Finished finished = client->wait(kSlowdown * seconds(1));
    EXPECT_TRUE(finished.exit_code == 1 || finished.signal == SIGTERM) << finished.err;
}

TEST_F(Death, RemoteServersServeTheNextClientAfterOneWasKilled) {
    const auto cluster = this->cluster(2);
    for (const int number : {SIGKILL, SIGTERM, SIGKILL}) {
        const auto client = running(cluster->flags());
        client->signal(number);
        client->wait(kPatience);
        expect_served(*cluster);
    }
}

TEST_F(Death, ServerAndDisplayEndWhenTheyAreTold) {
    for (const int number : {SIGINT, SIGTERM}) {
        const auto cluster = this->cluster(1);
        const auto client = running(cluster->flags());
        for (Process* process : {&cluster->server(0), &cluster->display()}) {
            process->signal(number);
            const Finished finished = process->wait(kSlowdown * seconds(1));
            expect_no_crash(finished);
            EXPECT_EQ(finished.exit_code, 0) << finished.err;
        }
        EXPECT_EQ(client->wait(kSlowdown * seconds(2)).exit_code, 1);
    }
}

TEST_F(Death, ServerOnALifelineEndsWhenItsStdinIsClosed) {
    // stdin is empty from the start here.
    for (const char* program : {"swath-server", "swath-display"})
        EXPECT_EQ(run(program, {"--listen", "127.0.0.1:0", "--lifeline"}, kSlowdown * seconds(2)).exit_code,
                  0);
}

}  // namespace
}  // namespace swath::test
