// The promises of docker/README.md, with a real engine. One image and a few clusters serve all tests.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <charconv>
#include <ctime>
#include <optional>
#include <thread>

#include "tests/e2e/docker/engine.h"
#include "tests/e2e/live_viewer.h"
#include "tests/support/web_client.h"

namespace swath::test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kModel = "builtin:knot:50000";
constexpr const char* kSize = "320x240";
constexpr auto kEnding = 2000ms;  // limit after SIGTERM
constexpr auto kPatience = 60s;

// The first test builds it; it is removed after the last.
std::optional<Image> image;
class Images : public testing::Environment {
    void TearDown() override { image.reset(); }
};
[[maybe_unused]] const auto* const kImages = testing::AddGlobalTestEnvironment(new Images);

// True if the condition becomes true in time.
bool soon(const std::function<bool()>& right) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!right()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(100ms);
    }
    return true;
}

class Compose : public testing::Test {
  protected:
    void SetUp() override {
        if (!no_engine().empty()) GTEST_SKIP() << no_engine();
        if (!image) image.emplace();
    }
    void TearDown() override {
        if (cluster_ && HasFailure()) std::cout << cluster_->logs();
    }

    Cluster& up(int servers, bool client = true, Arguments files = {"compose.yaml"}) {
        cluster_.emplace(*image, Cluster::Options{kModel, kSize, std::move(files)});
        cluster_->up(servers, client);
        return *cluster_;
    }
    // Connects a viewer to the client's run, once the page answers and a run has begun.
    LiveViewer viewer() {
        const auto address = *parse_address(cluster_->view());
        soon([&] { return http_get(address, "/").status == 200; });
        LiveViewer viewer("http://" + cluster_->view() + "/");
        viewer.note("audience", [](const Json& note) { return note["session"] == true; });
        return viewer;
    }
    // Expects that the viewer's picture by so many servers is that of one process in the same image.
    static void expect_exact(LiveViewer& viewer, std::size_t servers) {
        const auto session =
            viewer.note("session", [&](const Json& note) { return note["servers"].size() == servers; });
        ASSERT_TRUE(session.is_object()) << "never " << servers << " servers";
        // All viewers wish the same, which is not drawn again for each.
        viewer.wish(kView);
        const auto still = viewer.picture([&](const LiveViewer::Picture& p) {
            const Json& plan = p.header["plan"];
            return p.header["format"] == "png" && plan.is_object() && plan["wish"] > 0 &&
                   plan["servers"] == servers;
        });
        ASSERT_FALSE(still.file.empty());
        static std::string expected;
        if (expected.empty())
            expected = single("echo '" + viewer.camera_line() + "' >/tmp/camera", "--path /tmp/camera");
        EXPECT_TRUE(still.file == expected) << servers << " servers";
    }
    // The pictures of a single process in the image, one after another.
    static std::string single(const std::string& before, const std::string& options) {
        const Finished finished = docker(
            {"run", "--rm", "-e", "LP_NUM_THREADS=0", image->name(), "sh", "-ec",
             fmt::format("{}\nswath-client {} --single --size {} {} --out /tmp/out >&2; cat /tmp/out/*.png",
                         before, kModel, kSize, options)});
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        EXPECT_THAT(finished.out, HasSubstr("PNG"));
        return finished.out;
    }
    // Ends a container as `docker stop` does, with SIGTERM, and expects that it ends well and soon.
    // The engine's own clock says when, as its command may take a second to answer.
    static void expect_clean_end(const std::string& container) {
        const auto begin = std::chrono::system_clock::now();
        docker_says({"kill", "-s", "TERM", container});
        EXPECT_EQ(docker_says({"wait", container}), "0");
        const std::string text = docker_says({"inspect", "-f", "{{.State.FinishedAt}}", container});
        std::tm day{};
        const char* const fraction = ::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S", &day);
        ASSERT_NE(fraction, nullptr) << text;
        ASSERT_TRUE(text.ends_with('Z')) << text;
        const std::chrono::duration<double> end(static_cast<double>(::timegm(&day)) +
                                                std::strtod(fraction, nullptr));
        EXPECT_LT(end - begin.time_since_epoch(), kEnding);
        EXPECT_GT(end - begin.time_since_epoch(), 0s);
    }

    std::optional<Cluster> cluster_;
    inline static const Json kView{
        {"camera", {0.5, 1.25, 7.5, 0.1, 0, 0, 0, 1, 0, 34.5}}, {"width", 320}, {"height", 240}};
};

TEST_F(Compose, PictureOfOneServerIsExact) {
    up(1);
    LiveViewer page = viewer();
    expect_exact(page, 1);
}

TEST_F(Compose, PicturesStayExactWhileServersComeAndGo) {
    up(3);
    LiveViewer page = viewer();
    expect_exact(page, 3);
    cluster_->up(8);
    expect_exact(page, 8);

    const std::string leaving = cluster_->running("server").front();
    expect_clean_end(leaving);
    expect_exact(page, 7);
    EXPECT_THAT(cluster_->running("server"), SizeIs(7));
    EXPECT_THAT(cluster_->running("client"), SizeIs(1));
    EXPECT_EQ(docker_says({"inspect", "-f", "{{.RestartCount}}", cluster_->running("client").front()}), "0");
}

TEST_F(Compose, BatchRunOfThreeServersIsExact) {
    up(3, false);
    // A run begins with the servers whose names are known by then, and names lag behind containers; some
    // engines stall for seconds when a name is asked for while a container starts.
    const Finished finished = cluster_->compose(
        {"run", "--rm", "-T", "--no-deps", "client", "sh", "-ec",
         fmt::format("sleep 2\n"
                     "for try in $(seq 100); do\n"
                     "  [ $(getent ahostsv4 server | grep -c STREAM) = 3 ] && break; sleep 0.2\n"
                     "done\n"
                     "swath-client {} --servers dns:server:4000 --display display:4100 --connect-s 30 "
                     "--frames 3 --size {} --out /tmp/out >&2; cat /tmp/out/*.png",
                     kModel, kSize)});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("3 servers and the display are ready"));
    EXPECT_TRUE(finished.out == single("true", "--frames 3")) << finished.out.size() << " bytes";
}

TEST_F(Compose, EveryProgramEndsAtOnceAndNothingIsLeft) {
    up(2);
    LiveViewer page = viewer();
    expect_exact(page, 2);
    const auto healthy = [](const std::string& container) {
        return docker_says({"inspect", "-f", "{{.State.Health.Status}}", container}) == "healthy";
    };
    for (const char* service : {"display", "server"})
        for (const std::string& container : cluster_->running(service))
            EXPECT_TRUE(soon([&] { return healthy(container); })) << service;
    const auto address = *parse_address(cluster_->view());
    EXPECT_THAT(http_get(address, "/").body, HasSubstr("<title>"));
    EXPECT_THAT(cluster_->logs(), HasSubstr("viewer http://" + cluster_->view() + "/"));

    for (const char* service : {"client", "display", "server"}) {
        const auto containers = cluster_->running(service);
        ASSERT_FALSE(containers.empty()) << service;
        expect_clean_end(containers.front());
    }
    cluster_->down();
    EXPECT_THAT(cluster_->left(), IsEmpty());
}

// The client ends with its display, and compose starts it again.
TEST_F(Compose, DisplayThatIsStartedAnewGetsItsClientBack) {
    up(2);
    {
        LiveViewer page = viewer();
        expect_exact(page, 2);
    }
    cluster_->compose({"restart", "display"});
    LiveViewer page = viewer();
    expect_exact(page, 2);
}

// compose.paper.yaml: the program that shapes has no other right, and data takes the time that it should.
TEST_F(Compose, PapersNetworkIsThatSlowAndItsProgramsHaveNoRights) {
    up(2, true, {"compose.yaml", "compose.paper.yaml"});
    LiveViewer page = viewer();
    expect_exact(page, 2);
    for (const char* service : {"client", "display", "server"}) {
        const std::string container = cluster_->running(service).front();
        EXPECT_THAT(docker_says({"exec", container, "tc", "qdisc", "show", "dev", "eth0"}),
                    HasSubstr("rate 800Mbit"));
        const std::string status = docker_says({"exec", container, "cat", "/proc/1/status"});
        EXPECT_THAT(status, HasSubstr("Uid:\t10001\t10001\t10001\t10001"));
        EXPECT_THAT(status, HasSubstr("CapPrm:\t0000000000000000"));
        EXPECT_THAT(status, HasSubstr("CapBnd:\t0000000000000000"));
    }
    const auto servers = cluster_->running("server");
    expect_clean_end(servers.front());
}

TEST_F(Compose, ImageIsSmall) {
    const auto bytes = [](const std::string& name) {
        const std::string text = docker_says({"image", "inspect", "-f", "{{.Size}}", name});
        double number = 0;
        std::from_chars(text.data(), text.data() + text.size(), number);
        return number;
    };
    // Bases differ: with the official one, of 75 MB, the image is to stay under 350 MB.
    EXPECT_LT(bytes(image->name()) - bytes("debian:bookworm-slim"), 275e6);
}

}  // namespace
}  // namespace swath::test
