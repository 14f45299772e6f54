// Several viewers, clients and displays that come and go, and runs that nobody steers.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <csignal>

#include "tests/e2e/browser/live_page.h"

namespace swath::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LiveViewers : public LivePage {
  protected:
    void TearDown() override {
        leave_page();
        cluster_.reset();
        LivePage::TearDown();
    }
    // Starts a display with a page at this port, and servers, as somebody would by hand.
    void start_cluster(const std::string& view = "127.0.0.1:0") {
        cluster_ = std::make_unique<RemoteCluster>(
            [&](const std::string& program, const Arguments& arguments) {
                return program == "swath-display" ? start(program, arguments + Arguments{"--view", view})
                                                  : start(program, arguments);
            },
            2);
    }
    void start_client_of_cluster(const Arguments& how) {
        client_ = start("swath-client", Arguments{kModel, "--objects", "200"} + cluster_->flags() + how);
    }
    std::unique_ptr<RemoteCluster> cluster_;

    json camera() { return drawn().plan.at("camera"); }
};

TEST_F(LiveViewers, ServersThatJoinAndLeaveAreShown) {
    start_cluster();
    start_client_of_cluster({"--view"});
    open_page(page_address(*client_));
    wait_for_rest();
    drag_picture(100, 50);
    wait_for_rest();
    EXPECT_EQ(text_of("servers-of"), "2 of 2");
    const json steered = camera();

    cluster_->server(1).signal(SIGTERM);
    EXPECT_EQ(cluster_->server(1).wait(kPatience).exit_code, 0);
    wait_until("swath.session.servers.length === 1");
    wait_for_rest();
    EXPECT_EQ(text_of("servers-of"), "1 of 1");
    EXPECT_EQ(drawn().plan.at("servers"), 1);
    // The camera stays in place.
    EXPECT_EQ(camera(), steered);
    expect_exact();
    EXPECT_EQ(browser().evaluate("swath.leads"), true);

    const auto back = start("swath-server", {"--listen", cluster_->server_address(1)});
    wait_until("swath.session.servers.length === 2");
    wait_for_rest();
    EXPECT_EQ(text_of("servers-of"), "2 of 2");
    EXPECT_EQ(drawn().plan.at("servers"), 2);
    expect_exact();
    end_client();
}

TEST_F(LiveViewers, OneSteersAndTheOtherFollowsUntilItTakesOver) {
    start_view({.width = 1000, .height = 700});
    const std::string first = browser().window();
    const std::string address = browser().evaluate("location.href");
    const std::string second = browser().open_window();
    browser().set_viewport({.width = 800, .height = 600});
    open_page(address);
    EXPECT_EQ(browser().evaluate("swath.leads"), false);
    EXPECT_THAT(text_of("status"), HasSubstr("you follow"));

    // A follower sees the leader's changes, and cannot steer.
    browser().use_window(first);
    drag_picture(100, 50);
    wait_for_rest();
    const json steered = camera();
    const std::string bytes = drawn().bytes;
    browser().use_window(second);
    wait_for_rest();
    EXPECT_TRUE(drawn().bytes == bytes);
    drag_picture(60, 60);
    EXPECT_TRUE(browser().evaluate("swath.wish").is_null());
    EXPECT_EQ(browser().evaluate("document.getElementById('algorithm').disabled"), true);
    EXPECT_THAT(text_of("controls-why"), HasSubstr("steers"));
    keep_screenshot("follower");

    // To take over leaves the view as it is, at the size of the other window.
    browser().click("#lead");
    wait_until("swath.leads && swath.wish");
    wait_for_window_size();
    EXPECT_EQ(camera(), steered);
    drag_picture(-80, 30);
    wait_for_rest();
    EXPECT_NE(camera(), steered);
    expect_exact();
    const std::string taken_over = drawn().bytes;
    browser().use_window(first);
    wait_until("!swath.leads");
    wait_for_rest();
    EXPECT_TRUE(drawn().bytes == taken_over);

    // When the leader leaves, the other viewer steers.
    browser().use_window(second);
    browser().close_window();
    browser().use_window(first);
    wait_until("swath.leads && swath.wish");
    wait_for_window_size();
    drag_picture(20, 20);
    expect_exact();
}

TEST_F(LiveViewers, ThePageWaitsForAClientAndForTheNextOne) {
    start_cluster();
    browser().open(page_address(cluster_->display()));
    wait_until("document.getElementById('status').textContent.includes('Waiting for a client')");
    keep_screenshot("waiting");
    for (int i = 0; i < 2; ++i) {
        start_client_of_cluster({"--view"});
        wait_until("swath.leads && swath.wish");
        wait_for_window_size();
        drag_picture(50, 20);
        expect_exact();
        end_client();
        wait_until("document.getElementById('status').textContent.includes('Waiting for a client')");
    }
}

TEST_F(LiveViewers, ThePageSaysThatItsConnectionIsLostAndGetsItBack) {
    // The browser's own messages while nobody listens.
    allow_console_errors("WebSocket connection to");
    allow_console_errors("ERR_CONNECTION_REFUSED");
    start_cluster();
    const std::string page = page_address(cluster_->display());
    browser().open(page);
    start_client_of_cluster({"--view"});
    wait_until("swath.leads && swath.wish");
    wait_for_window_size();

    cluster_->display().signal(SIGKILL);
    wait_until("document.getElementById('status').textContent.includes('Connection lost')");
    keep_screenshot("connection_lost");
    EXPECT_EQ(browser().evaluate("document.getElementById('algorithm').disabled"), true);
    const Finished broken = client_->wait(kPatience);
    EXPECT_EQ(broken.exit_code, 1) << "a client cannot go on without its display";

    const std::string port = page.substr(page.rfind(':') + 1);
    cluster_.reset();
    start_cluster("127.0.0.1:" + port.substr(0, port.find('/')));
    start_client_of_cluster({"--view"});
    wait_until("swath.leads && swath.wish && document.getElementById('picture-0').dataset.format");
    wait_for_window_size();
    drag_picture(50, 20);
    expect_exact();
}

TEST_F(LiveViewers, ARunAlongAPathIsWatchedButNotSteered) {
    start_cluster();
    browser().open(page_address(cluster_->display()));
    start_client_of_cluster({"--frames", "100000", "--size", "320x240", "--out", files_.path_of("out")});
    browser().evaluate("window.seen = new Set()");
    wait_until("seen.add(document.getElementById('picture-0').dataset.frame).size > 3");
    EXPECT_EQ(drawn().width, 320);
    EXPECT_THAT(text_of("status"), HasSubstr("annot be steered"));
    EXPECT_EQ(browser().evaluate("swath.session.live"), false);
    EXPECT_THAT(browser().evaluate("swath.session.why").get<std::string>(), testing::Not(testing::IsEmpty()));
    for (const char* control : {"algorithm", "servers", "pause", "reset"})
        EXPECT_EQ(browser().evaluate("document.getElementById(argument).disabled", control), true) << control;
    keep_screenshot("path_watched");
    end_client();
}

}  // namespace
}  // namespace swath::test
