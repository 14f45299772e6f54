// Live runs as a viewer sees them, without a browser (tests/e2e/browser has one).
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <csignal>
#include <set>

#include "tests/e2e/live_viewer.h"
#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kModel = "builtin:knot:20000";

class Live : public EndToEnd {
  protected:
    std::unique_ptr<Process> start_client(const Arguments& more) const {
        return start("swath-client", Arguments{kModel, "--view", "0"} + more);
    }
    static std::string page(Process& client) {
        return client.wait_for_line("viewer http://127.0.0.1:", kPatience);
    }
    // The picture that one process draws of the viewer's camera.
    std::string single(const LiveViewer& viewer, int width, int height) {
        const std::string camera = files_.write("view.camera", viewer.camera_line());
        const std::string folder =
            render({kModel, "--single", "--path", camera, "--size", fmt::format("{}x{}", width, height)});
        return contents(std::filesystem::path(folder) / "frame_0000.png");
    }
    static void expect_end(Process& client) {
        client.signal(SIGINT);
        const Finished finished = client.wait(kPatience);
        expect_no_crash(finished);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        EXPECT_THAT(finished.out, HasSubstr("frames/s"));
    }
    const Json home_{{"camera", {0.5, 1.25, 7.5, 0.1, 0, 0, 0, 1, 0, 34.5}}, {"width", 320}, {"height", 240}};
};

TEST_F(Live, StillPicturesEqualThoseOfOneProcessForEveryAlgorithmAndNumberOfServers) {
    const auto client = start_client({"--local", "3"});
    LiveViewer viewer(page(*client));
    viewer.wish(home_);
    const std::string expected = single(viewer, 320, 240);
    ASSERT_FALSE(expected.empty());
    for (const char* algorithm : {"hybrid", "mahd", "kd-split", "sort-last"})
        for (const int servers : {1, 2, 3}) {
            const auto id = viewer.wish({{"algorithm", algorithm}, {"servers", servers}});
            const auto still = viewer.still(id);
            EXPECT_EQ(still.header["plan"]["algorithm"], algorithm);
            EXPECT_EQ(still.header["plan"]["servers"], servers);
            EXPECT_TRUE(still.file == expected) << algorithm << " " << servers;
        }
    expect_end(*client);
}

TEST_F(Live, StillPicturesHaveTheRunsPoseAndLightWhichAreInTheCommandToo) {
    const Arguments look{"builtin:swarm:20000", "--pose", "0.4", "--light=-1,2,0.5"};
    const auto client = start("swath-client", look + Arguments{"--local", "2", "--view", "0"});
    LiveViewer viewer(page(*client));
    const auto still = viewer.still(
        viewer.wish({{"camera", {5, 5, 60, 0, 0, 0, 0, 1, 0, 30}}, {"width", 320}, {"height", 240}}));
    EXPECT_EQ(still.header["plan"]["pose"], 0.4);
    const std::string camera = files_.write("view.camera", viewer.camera_line());
    const std::string folder = render(look + Arguments{"--single", "--path", camera, "--size", "320x240"});
    EXPECT_TRUE(still.file == contents(std::filesystem::path(folder) / "frame_0000.png"));
    const Json objects = viewer.note("objects");
    EXPECT_EQ(objects["end_boxes"].size(), objects["boxes"].size());
    EXPECT_THAT(viewer.note("state")["command"].get<std::string>(),
                HasSubstr("--background 101218 --pose 0.4 --light=-1,2,0.5 --path view.camera"));
    expect_end(*client);
}

TEST_F(Live, GoFromServersOfBothKindsToOneAndSayHowToDrawThatAgain) {
    const std::string gl(name_of(gl_here()));
    const auto client = start_client({"--local", "2", "--renderer", "raycast," + gl, "--shadows",
                                      "--objects-by", "sah", "--objects", "200", "--size", "64x48"});
    LiveViewer viewer(page(*client));
    viewer.still(viewer.wish({{"camera", home_["camera"]}, {"width", 64}, {"height", 48}}));
    EXPECT_EQ(viewer.note("state")["renderer"], "raycast," + gl);
    for (const auto& [renderer, flags] :
         {std::pair(std::string("raycast"), Arguments{"--shadows"}), std::pair(gl, Arguments{})})
        for (const int objects : {200, 60}) {
            const auto still = viewer.still(viewer.wish({{"renderer", renderer}, {"objects", objects}}));
            const Json state = viewer.note("state", [&](const Json& note) {
                return note["renderer"] == renderer && note["objects"] == objects && note["busy"].is_null();
            });
            const std::string command = state["command"];
            EXPECT_THAT(command, HasSubstr(fmt::format("--renderer {} ",
                                                       fmt::join(Arguments{renderer} + flags, " "))));
            EXPECT_THAT(command, HasSubstr(fmt::format("--objects-by sah --objects {} ", objects)));
            const std::string camera = files_.write("view.camera", viewer.camera_line());
            const Arguments single{kModel,         "--single", "--path",     camera,
                                   "--size",       "64x48",    "--renderer", renderer,
                                   "--objects-by", "sah",      "--objects",  std::to_string(objects)};
            const std::filesystem::path folder = render(single + flags);
            EXPECT_TRUE(still.file == contents(folder / "frame_0000.png")) << renderer << ' ' << objects;
        }
    expect_end(*client);
}

TEST_F(Live, StillPicturesEqualThoseOfOneProcessForEveryCameraAndSize) {
    const auto client = start_client({"--local", "2", "--view-max-size", "600x400"});
    LiveViewer viewer(page(*client));
    viewer.wish(home_);
    const struct {
        Json camera;
        int width, height, drawn_width, drawn_height;
    } kViews[]{{{-3, 0.333, 2, 0, 0.1, 0, 0, 1, 0, 60}, 257, 129, 257, 129},
               {{0.01, 0.02, 0.3, 0, 0, 0, 0.1, 1, 0, 90}, 400, 400, 400, 400},
               {{0, -6, 0.5, 0, 0, 0, 0, 0, 1, 20.25}, 1200, 400, 600, 200},
               {{0, 0, 100, 0, 0, 200, 0, 1, 0, 30}, 64, 48, 64, 48}};  // looks away
    for (const auto& view : kViews) {
        const auto id =
            viewer.wish({{"camera", view.camera}, {"width", view.width}, {"height", view.height}});
        const auto still = viewer.still(id);
        EXPECT_EQ(still.header["width"], view.drawn_width);
        EXPECT_EQ(still.header["height"], view.drawn_height);
        EXPECT_TRUE(still.file == single(viewer, view.drawn_width, view.drawn_height)) << view.camera;
    }
    expect_end(*client);
}

TEST_F(Live, CutsDrawsAndCullsDifferentlyWithoutARestartAndWithoutChangingThePicture) {
    const auto client = start_client({"--local", "2"});
    LiveViewer viewer(page(*client));
    const std::string before = viewer.still(viewer.wish(home_)).file;
    const auto objects = viewer.note("objects")["count"].get<int>();
    EXPECT_TRUE(viewer.still(viewer.wish({{"objects", 60}})).file == before);
    EXPECT_LT(viewer.note("objects", [](const Json& note) { return note["generation"] > 1; })["count"],
              objects);
    EXPECT_TRUE(viewer.still(viewer.wish({{"cull", "none"}})).file == before);
    EXPECT_TRUE(viewer.still(viewer.wish({{"cull", "adsb"}, {"objects", 6000}})).file == before);
    // Without OSMesa EGL has drawn from the start, so this changes one thing more.
    EXPECT_TRUE(viewer.still(viewer.wish({{"renderer", "egl"}, {"objects", 900}})).file == before);
    const Json state = viewer.note("state", [](const Json& note) { return note["renderer"] == "egl"; });
    EXPECT_EQ(state["refused"], Json::object());
    EXPECT_EQ(state["cull"], "adsb");
    EXPECT_THAT(state["command"], HasSubstr("--local 2 --algorithm hybrid --renderer egl --cull adsb"));
    expect_end(*client);
}

TEST_F(Live, ChangesBackAndForthWhileAPathPlays) {
    const auto client = start_client({"--local", "2"});
    LiveViewer viewer(page(*client));
    viewer.wish(home_);
    viewer.wish({{"path", "orbit"}});
    std::uint64_t id = 0;
    for (int i = 0; i < 6; ++i)
        for (const int objects : {60, 1500}) id = viewer.wish({{"objects", objects}});
    viewer.picture(
        [&](const auto& p) { return p.header["plan"].is_object() && p.header["plan"]["wish"] == id; });
    EXPECT_EQ(viewer.note("state", [&](const Json& note) { return note["wish"] == id; })["objects"], 1500);
    expect_end(*client);
}

// A terminal's Ctrl-C reaches every program of the run.
TEST_F(Live, EndsWellWhenAllOfItsProgramsAreInterrupted) {
    const auto client = start_client({"--local", "2"});
    LiveViewer viewer(page(*client));
    viewer.still(viewer.wish(home_));
    for (const pid_t program : living_descendants(client->pid())) ::kill(program, SIGINT);
    viewer.still(viewer.wish({{"width", 200}}));  // no program has left
    expect_end(*client);
}

TEST_F(Live, RefusesWhatCannotBeHadAndDrawsTheRest) {
    const auto client = start_client({"--local", "2"});
    LiveViewer viewer(page(*client));
    viewer.wish(home_);
    const auto id = viewer.wish({{"servers", 3}, {"algorithm", "magic"}, {"height", 200}});
    EXPECT_EQ(viewer.still(id).header["height"], 200);
    const Json state = viewer.note("state", [&](const Json& note) { return note["wish"] == id; });
    EXPECT_THAT(state["refused"]["servers"], HasSubstr("from 1 to 2"));
    EXPECT_THAT(state["refused"]["algorithm"], HasSubstr("'magic' is not known"));
    EXPECT_EQ(state["servers"], nullptr);  // all of them, as before
    expect_end(*client);
}

TEST_F(Live, ComparesTwoAlgorithmsOnTheSameCamera) {
    const auto client = start_client({"--local", "3"});
    LiveViewer viewer(page(*client));
    viewer.wish(home_);
    const auto id = viewer.wish({{"algorithm", "sort-last"}, {"against", "mahd"}});
    const auto one = viewer.still(id, 0);
    const auto two = viewer.still(id, 1);
    EXPECT_EQ(one.header["plan"]["algorithm"], "sort-last");
    EXPECT_EQ(two.header["plan"]["algorithm"], "mahd");
    EXPECT_EQ(one.header["plan"]["camera"], two.header["plan"]["camera"]);
    EXPECT_GT(one.header["plan"]["links"].size(), 0u);
    EXPECT_EQ(two.header["plan"]["links"].size(), 0u);
    EXPECT_GT(two.header["plan"]["overlap"], 1);
    EXPECT_TRUE(one.file == two.file);
    expect_end(*client);
}

TEST_F(Live, PlaysAPathAndStopsOnAFrameThatAFileOfItsCameraDrawsToo) {
    const auto client = start_client({"--local", "2"});
    LiveViewer viewer(page(*client));
    viewer.wish(home_);
    const auto playing = viewer.wish({{"path", "orbit"}});
    std::set<std::string> cameras;
    while (cameras.size() < 5) {
        const auto picture =
            viewer.picture([&](const auto& p) { return p.header["plan"]["wish"] == playing; });
        if (!picture.header.is_object()) return;
        cameras.insert(picture.header["plan"]["camera"].dump());
    }
    viewer.wish({{"paused", true}});
    const auto still = viewer.picture(
        [](const auto& p) { return p.header["format"] == "png" && p.header["plan"]["wish"] > 1; });
    viewer.wish({{"camera", still.header["plan"]["camera"]}});
    EXPECT_TRUE(still.file == single(viewer, 320, 240));
    expect_end(*client);
}

TEST_F(Live, TellsWhatEveryMachineDidAndHandsOutATrace) {
    const auto client = start_client({"--local", "2"});
    LiveViewer viewer(page(*client));
    viewer.still(viewer.wish(home_));
    const Json frame = viewer.note("frame");
    ASSERT_EQ(frame["machines"].size(), 4u);
    EXPECT_EQ(frame["machines"][0]["name"], "client");
    EXPECT_EQ(frame["machines"][2]["name"], "server 1");
    EXPECT_GT(frame["machines"][1]["counters"]["triangles"], 0);
    EXPECT_EQ(frame["machines"][3]["name"], "display");
    viewer.wish({{"trace", 1}});
    const Json trace = viewer.note("trace");
    EXPECT_GT(trace["trace"]["traceEvents"].size(), 10u);
    const Json session = viewer.note("session");
    EXPECT_EQ(session["live"], true);
    EXPECT_EQ(session["servers"].size(), 2u);
    expect_end(*client);
}

TEST_F(Live, MeasuresSpeedUpsWithEveryNumberOfServers) {
    const auto client = start_client({"--local", "3"});
    LiveViewer viewer(page(*client));
    viewer.still(viewer.wish(home_));
    viewer.wish({{"measure", 1}});
    const Json found = viewer.note(
        "speedup", [](const Json& note) { return note["running"] == false && note["points"].size() == 3; });
    ASSERT_TRUE(found.is_object());
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(found["points"][i]["servers"], i + 1);
        EXPECT_GT(found["points"][i]["interval"], 0);
        EXPECT_GT(found["points"][i]["busiest_cpu"], 0);
    }
    expect_end(*client);
}

TEST_F(Live, RunAlongAPathCanBeWatchedAndNotSteered) {
    const auto display = start("swath-display", {"--listen", "127.0.0.1:0", "--view", "0"});
    const std::string display_address = listening_address(*display);
    LiveViewer viewer(page(*display));
    viewer.note("audience", [](const Json& note) { return note["session"] == false; });
    const auto server = start("swath-server", {"--listen", "127.0.0.1:0"});
    const auto client =
        start("swath-client", {kModel, "--servers", listening_address(*server), "--display", display_address,
                               "--frames", "40", "--size", "320x240", "--out", files_.path_of("out")});
    const Json session = viewer.note("session");
    EXPECT_EQ(session["live"], false);
    EXPECT_THAT(session["why"], HasSubstr("--view"));
    viewer.wish({{"servers", 1}});
    const auto picture = viewer.picture([](const auto& p) { return p.header["plan"].is_object(); });
    EXPECT_EQ(picture.header["plan"]["width"], 320);
    const Finished finished = client->wait(kPatience);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(file_names(files_.path_of("out")).size(), 40u);
    viewer.note("audience", [](const Json& note) { return note["session"] == false; });
}

TEST_F(Live, ClientCanComeBackToADisplayThatPeopleLookAt) {
    const auto display = start("swath-display", {"--listen", "127.0.0.1:0", "--view", "0"});
    const std::string display_address = listening_address(*display);
    const auto server = start("swath-server", {"--listen", "127.0.0.1:0"});
    const std::string server_address = listening_address(*server);
    LiveViewer viewer(page(*display));
    for (int run = 0; run < 2; ++run) {
        const auto client = start(
            "swath-client", {kModel, "--servers", server_address, "--display", display_address, "--view"});
        viewer.note("audience", [](const Json& note) { return note["session"] == true; });
        viewer.still(viewer.wish(home_));
        expect_end(*client);
        viewer.note("audience", [](const Json& note) { return note["session"] == false; });
    }
}

TEST_F(Live, NeedsADisplayWithAPage) {
    const auto display = start("swath-display", {"--listen", "127.0.0.1:0"});
    const auto server = start("swath-server", {"--listen", "127.0.0.1:0"});
    expect_one_error(client({kModel, "--servers", listening_address(*server), "--display",
                             listening_address(*display), "--view"}),
                     1, {"display at", "--view"});
}

TEST_F(Live, PortThatIsTakenIsAnError) {
    const auto one = start_client({"--local", "1"});
    const std::string taken = page(*one);
    const std::size_t colon = taken.rfind(':');
    const std::string port = taken.substr(colon + 1, taken.size() - colon - 2);
    const Finished finished = client({kModel, "--local", "1", "--view", port});
    EXPECT_EQ(finished.exit_code, 1);
    EXPECT_THAT(finished.err, HasSubstr(port));
    expect_end(*one);
}

}  // namespace
}  // namespace swath::test
