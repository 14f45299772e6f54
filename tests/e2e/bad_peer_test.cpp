// Bad addresses and peers: the client says so in one line, servers and displays go on.
#include <csignal>

#include "common/wire/codec.h"
#include "tests/e2e/programs.h"
#include "tests/e2e/raw_peer.h"

namespace swath::test {
namespace {

class BadPeer : public EndToEnd {
  protected:
    std::unique_ptr<RemoteCluster> cluster(int servers) const {
        return std::make_unique<RemoteCluster>(
            [this](const std::string& program, const Arguments& arguments) {
                return start(program, arguments);
            },
            servers);
    }
    // Runs a client whose only server is a listener that sends `answer` and reads.
    Finished client_of_raw_server(const std::string& answer, const Arguments& more = {}) const {
        const RawListener listener;
        const auto display = start("swath-display", {"--listen", "127.0.0.1:0"});
        const auto process = start(
            "swath-client",
            kModel + Arguments{"--servers", listener.address(), "--display", listening_address(*display)} +
                more);
        const RawConnection connection = listener.accept(kPatience);
        connection.send(answer);
        const Finished finished = process->wait(kSlowdown * std::chrono::seconds(5));
        EXPECT_NE(finished.err.find("server 0 at " + listener.address()), std::string::npos) << finished.err;
        return finished;
    }
    const Arguments kModel{"builtin:knot:2000", "--size", "64x48", "--frames", "2"};
};

TEST_F(BadPeer, UnreachableServerIsNamed) {
    const auto cluster = this->cluster(1);
    const std::string nobody = closed_address();
    const Finished finished =
        client(kModel + Arguments{"--servers", cluster->server_address(0) + "," + nobody, "--display",
                                  cluster->display_address(), "--connect-s", "0.5"});
    expect_one_error(finished, 1, {"server 1 at " + nobody, "refused", "0.5 s"});
    EXPECT_LT(finished.took, kSlowdown * std::chrono::seconds(2));
}

TEST_F(BadPeer, UnreachableDisplayIsNamed) {
    const auto cluster = this->cluster(1);
    const std::string nobody = closed_address();
    expect_one_error(client(kModel + Arguments{"--servers", cluster->server_address(0), "--display", nobody,
                                               "--connect-s", "0.5"}),
                     1, {"display at " + nobody, "refused"});
}

TEST_F(BadPeer, UnknownHostIsNamed) {
    expect_one_error(client(kModel + Arguments{"--servers", "no-such-host.invalid:4000", "--display",
                                               "no-such-host.invalid:4100", "--connect-s", "0.5"}),
                     1, {"no-such-host.invalid:4"});
}

TEST_F(BadPeer, ModelMayFollowTheListOfServers) {
    const std::string nobody = closed_address();
    expect_one_error(
        client(Arguments{"--display", nobody, "--connect-s", "0.1", "--servers", nobody} + kModel), 1,
        {nobody, "refused"});
}

TEST_F(BadPeer, TakenPortEndsTheProgramThatWantsIt) {
    const RawListener taken;
    for (const char* program : {"swath-server", "swath-display"}) {
        const Finished finished =
            run(program, {"--listen", taken.address()}, kSlowdown * std::chrono::seconds(5));
        expect_one_error(finished, 1, {taken.address(), "in use"});
        EXPECT_EQ(finished.out, "");
    }
}

TEST_F(BadPeer, DisplayIsNotTakenForAServerNorTheOtherWayRound) {
    const auto cluster = this->cluster(1);
    const Finished swapped = client(
        kModel + Arguments{"--servers", cluster->display_address(), "--display", cluster->server_address(0)});
    expect_one_error(swapped, 1, {"this is a", "expected"});
    EXPECT_EQ(client(kModel + cluster->flags()).exit_code, 0);
}

TEST_F(BadPeer, SameServerTwiceIsRefused) {
    const auto cluster = this->cluster(1);
    const std::string twice = cluster->server_address(0) + "," + cluster->server_address(0);
    const Finished finished =
        client(kModel + Arguments{"--servers", twice, "--display", cluster->display_address()});
    expect_one_error(finished, 2, {"--servers", cluster->server_address(0), "twice"});
    EXPECT_EQ(client(kModel + cluster->flags()).exit_code, 0);
}

TEST_F(BadPeer, SecondClientIsToldThatTheServerIsBusy) {
    const auto cluster = this->cluster(1);
    const auto first =
        start("swath-client",
              Arguments{"builtin:knot:20000", "--frames", "100000", "--size", "64x48"} + cluster->flags());
    first->wait_for_line("are ready", kPatience);
    expect_one_error(client(kModel + cluster->flags()), 1, {"busy with another client"});
    first->signal(SIGINT);
    EXPECT_EQ(first->wait(kPatience).exit_code, 1);
    EXPECT_EQ(client(kModel + cluster->flags()).exit_code, 0);
}

TEST_F(BadPeer, OtherVersionIsNamedWithOurs) {
    const std::string head(8, '\1');
    expect_one_error(client_of_raw_server(raw_prefix(1, 8, 0) + head), 1, {"version 1", "2"});
    expect_one_error(client_of_raw_server(raw_prefix(999, 0, 0)), 1, {"version 999"});
}

TEST_F(BadPeer, SpeakerOfAnotherProtocolIsRecognised) {
    expect_one_error(client_of_raw_server("HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n"), 1,
                     {"Swath"});
    expect_one_error(client_of_raw_server("SSH-2.0-OpenSSH_9.2p1 Debian-2+deb12u3\r\n"), 1, {"Swath"});
}

TEST_F(BadPeer, MessageBeyondTheLimitsIsRefusedBeforeItComes) {
    expect_one_error(client_of_raw_server(raw_prefix(kWireVersion, 0xffffffff, 0)), 1,
                     {"4294967295", "1024"});
    expect_one_error(client_of_raw_server(raw_prefix(kWireVersion, 8, 0xffffffff)), 1, {"4294967295", "0"});
}

TEST_F(BadPeer, GarbledHelloIsRefused) {
    expect_one_error(client_of_raw_server(raw_prefix(kWireVersion, 16, 0) + std::string(16, '\xff')), 1, {});
    expect_one_error(client_of_raw_server(raw_prefix(kWireVersion, 0, 0)), 1, {});
}

TEST_F(BadPeer, ServerThatSaysNothingIsGivenUp) {
    expect_one_error(client_of_raw_server("", {"--silence-ms", std::to_string(300 * kSlowdown)}), 1,
                     {"silent"});
    // Half a message is silence, too.
    expect_one_error(client_of_raw_server("SWTH", {"--silence-ms", std::to_string(300 * kSlowdown)}), 1,
                     {"silent"});
}

TEST_F(BadPeer, GarbageLeavesServerAndDisplayServingTheNextClient) {
    const auto cluster = this->cluster(2);
    const std::string hello = client_hello();
    const std::vector<std::string> garbage{
        "",
        "SWTH",
        "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n",
        std::string(100'000, '\0'),
        std::string(100'000, '\xff'),
        raw_prefix(1, 4, 0) + "head",
        raw_prefix(kWireVersion, 0xffffffff, 0xffffffff),
        raw_prefix(kWireVersion, 1000, 0) + "cut off",
        raw_prefix(kWireVersion, 16, 0) + std::string(16, '\xff'),
        hello + hello,
        hello + raw_prefix(kWireVersion, 0xffffffff, 0),
        hello + raw_prefix(kWireVersion, 8, 0xffffffff),
        hello + raw_prefix(kWireVersion, 16, 0) + std::string(16, '\xff'),
        hello.substr(0, hello.size() - 1),
    };
    const std::string expected = render(kModel + Arguments{"--single"});
    for (const std::string& bytes : garbage) {
        SCOPED_TRACE(bytes.substr(0, 40));
        for (const std::string& address : {cluster->server_address(0), cluster->display_address()}) {
            const RawConnection connection(address);
            try {
                connection.send(bytes);
            } catch (const std::runtime_error&) {  // the program closed before all was sent, as it should
            }
        }
    }
    expect_same_pictures(expected, render(kModel + cluster->flags()));
    // All at once, with clients that hold on.
    std::vector<std::unique_ptr<RawConnection>> held;
    for (int i = 0; i < 20; ++i) held.push_back(std::make_unique<RawConnection>(cluster->server_address(0)));
    expect_same_pictures(expected, render(kModel + cluster->flags()));
}

TEST_F(BadPeer, GarbageDuringARunDoesNotDisturbIt) {
    const auto cluster = this->cluster(2);
    const Arguments arguments{"builtin:knot:20000", "--size", "320x240", "--frames", "60"};
    const std::string expected = render(arguments + Arguments{"--single"});
    const std::string out = files_.path_of("out");
    const auto process = start("swath-client", arguments + cluster->flags() + Arguments{"--out", out});
    process->wait_for_line("are ready", kPatience);
    for (const std::string& address : {cluster->server_address(0), cluster->display_address()}) {
        const RawConnection http(address);
        http.send("GET / HTTP/1.1\r\n\r\n");
        const RawConnection second(address);
        second.send(client_hello());
        EXPECT_NE(second.read_to_end(kPatience).find("busy with another client"), std::string::npos);
    }
    EXPECT_EQ(process->wait(kPatience).exit_code, 0);
    expect_same_pictures(expected, out);
}

}  // namespace
}  // namespace swath::test
