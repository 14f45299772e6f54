// With every algorithm and number of servers, the pictures are those of a single process, byte for byte.
#include <fmt/core.h>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

struct Scene {
    std::string name;
    Arguments arguments;
    std::vector<int> servers;
    std::string cameras = {};  // of a camera file; empty: --path is in `arguments`, or an orbit
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

const std::vector<int> kAll{1, 2, 3, 4, 5, 6, 7, 8, 9, 16};

const std::vector<Scene> kScenes{
    {"TownOfOddSize",
     {"builtin:town:30000", "--size", "1279x961", "--frames", "2", "--background", "ff8040"},
     kAll},
    {"DeepSpheres",
     {"builtin:spheres:40000", "--size", "320x240", "--frames", "4", "--path", "random", "--seed", "7"},
     kAll},
    {"KnotOnThreeLines", {"builtin:knot:60000", "--size", "641x3", "--frames", "4"}, kAll},
    {"TownOnThreeLines",
     {"builtin:town:20000", "--size", "641x3", "--frames", "4", "--path", "random", "--seed", "3"},
     {2, 5, 16}},
    {"SmallTown",
     {"builtin:town:20000", "--size", "320x240", "--frames", "6", "--path", "random", "--seed", "12345"},
     {3, 6, 7, 16}},
    {"SpheresOfOddSize", {"builtin:spheres:40000", "--size", "1279x961", "--frames", "2"}, {3, 8}},
    {"KnotBeyondTheScreen",
     {"builtin:knot:40000", "--size", "1279x961", "--frames", "2", "--zoom", "3", "--background", "ffffff"},
     {2, 4, 9}},
    {"KnotOfFewPixels",
     {"builtin:knot:20000", "--size", "320x240", "--frames", "3", "--zoom", "0.02", "--background", "000000"},
     {2, 5, 9}},
    {"OnePixel", {"builtin:knot:20000", "--size", "1x1", "--frames", "2"}, {1, 3, 16}},
    {"OneFrameInFlight",
     {"builtin:spheres:20000", "--size", "320x240", "--frames", "6", "--in-flight", "1"},
     {1, 3, 4}},
    {"EightFramesInFlight",
     {"builtin:spheres:20000", "--size", "320x240", "--frames", "12", "--in-flight", "8"},
     {1, 3, 4}},
    {"AllInOneObject",
     {"builtin:knot:20000", "--octree-depth", "0", "--size", "320x240", "--frames", "2"},
     {1, 2, 4, 16}},
    {"FewerObjectsThanServers",
     {"builtin:town:20000", "--octree-depth", "1", "--size", "320x240", "--frames", "2"},
     {7, 9, 16}},
    {"FromInsideTheKnot",
     {"builtin:knot:60000", "--size", "320x240"},
     {1, 2, 3, 5, 8},
     "0 0 0  1 0 0  0 0 1  70   # the middle of the ring\n"
     "1.46 0 0  0 0 0  0 0 1  100   # within the tube\n"
     "0.1 0 3  0 0 0  0 1 0  40\n"},
    {"FromInsideTheSpheres",
     {"builtin:spheres:40000", "--size", "320x240"},
     {2, 4, 7},
     "0 0 0  0 0 1  0 1 0  90\n0 0 0  1 0 0  0 1 0  90\n"},
    // From pose 0 to 1 and on its way back.
    {"SwarmOnItsWay", {"builtin:swarm:20000", "--size", "160x121", "--frames", "34"}, {1, 2, 3, 4}},
    {"SwarmOnARandomPath",
     {"builtin:swarm:30000", "--size", "321x240", "--frames", "16", "--path", "random", "--seed", "5",
      "--zoom", "2"},
     {1, 2, 3, 4}},
    {"SwarmHeldStill",
     {"builtin:swarm:20000", "--size", "320x240", "--frames", "2", "--pose", "0.62", "--objects", "60"},
     {2, 4, 7}},
    {"InLightFromTheSide",
     {"builtin:knot:20000", "--size", "320x240", "--frames", "2", "--light", "-3,0.5,1e-3"},
     {1, 3, 4}},
    {"DrawnWithEgl",
     {"builtin:town:20000", "--size", "641x480", "--frames", "2", "--renderer", "egl"},
     {1, 2, 5}},
};

class ClusterPictures : public EndToEnd, public testing::WithParamInterface<Scene> {
  protected:
    // Renders with every number of servers, with one algorithm each, in turn.
    void compare(const std::string& expected, const Arguments& arguments,
                 const std::vector<std::string>& algorithms) {
        const Scene& scene = GetParam();
        for (std::size_t i = 0; i < scene.servers.size(); ++i) {
            const int servers = scene.servers[i];
            const std::string& algorithm = algorithms[i % algorithms.size()];
            SCOPED_TRACE(fmt::format("{} with {} servers", algorithm, servers));
            expect_same_pictures(expected,
                                 render_on(servers, arguments + Arguments{"--algorithm", algorithm}));
        }
    }
};

TEST_P(ClusterPictures, EqualThoseOfASingleProcess) {
    const Scene& scene = GetParam();
    Arguments arguments = scene.arguments;
    if (!scene.cameras.empty())
        arguments = arguments + Arguments{"--path", files_.write("cameras.txt", scene.cameras)};
    const std::string expected = render(arguments + Arguments{"--single"});
    if (scene.name != "OnePixel") expect_not_only({16, 18, 24}, expected);
    compare(expected, arguments, {"hybrid"});
    compare(expected, arguments, {"sort-last"});
    // These two differ only in where they cut.
    compare(expected, arguments, {"mahd", "kd-split"});
    // The same from servers of its own.
    expect_same_pictures(expected,
                         render(arguments + Arguments{"--local", std::to_string(scene.servers.front())}));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ClusterPictures, testing::ValuesIn(kScenes),
                         [](const auto& scene) { return scene.param.name; });

class Pictures : public EndToEnd {};

TEST_F(Pictures, AreBackgroundWhenTheCameraLooksAway) {
    const Arguments arguments{"builtin:knot:20000",
                              "--size",
                              "320x240",
                              "--background",
                              "204060",
                              "--path",
                              files_.write("away.txt", "0 0 9 0 0 19 0 1 0 50\n")};
    const std::string expected = render(arguments + Arguments{"--single"});
    expect_only({0x20, 0x40, 0x60}, expected);
    for (const char* algorithm : {"hybrid", "mahd", "kd-split", "sort-last"})
        for (const int servers : {1, 4})
            expect_same_pictures(expected,
                                 render_on(servers, arguments + Arguments{"--algorithm", algorithm}));
}

TEST_F(Pictures, AreTheSameFromOsmesaAndEgl) {
    if (gl_here() != RendererKind::kOsmesa) GTEST_SKIP() << "no OSMesa here";
    const Arguments arguments{"builtin:town:20000", "--size", "641x480", "--frames", "2"};
    const std::string expected = render(arguments + Arguments{"--single", "--renderer", "osmesa"});
    expect_same_pictures(expected, render(arguments + Arguments{"--single", "--renderer", "egl"}));
    expect_same_pictures(expected, render(arguments + Arguments{"--local", "3", "--renderer", "egl"}));
}

TEST_F(Pictures, OfAPathHoldAMovingModelWhereverItIs) {
    const Arguments arguments{"builtin:swarm:20000", "--single", "--size", "64x48"};
    const auto picture = [&](const Arguments& more, const char* name) {
        return contents(render(arguments + more) + "/" + name);
    };
    const std::string camera = files_.write("camera.txt", "5 5 60  0 0 0  0 1 0  30\n");
    const Arguments path{"--path", camera, "--frames", "46"};
    const std::string moving = render(arguments + path);
    const auto frame = [&](const char* name) { return contents(moving + "/" + name); };
    EXPECT_NE(frame("frame_0000.png"), frame("frame_0030.png"));
    EXPECT_EQ(frame("frame_0015.png"), frame("frame_0045.png"));
    EXPECT_EQ(frame("frame_0000.png"), picture({"--path", camera, "--pose", "0"}, "frame_0000.png"));
    EXPECT_EQ(frame("frame_0015.png"), picture({"--path", camera, "--pose", "0.5"}, "frame_0000.png"));
    EXPECT_EQ(frame("frame_0030.png"),
              picture({"--path", camera, "--pose", "1", "--frames", "3"}, "frame_0002.png"));
}

TEST_F(Pictures, OfAStillModelKnowNoPose) {
    const Arguments arguments{"builtin:knot:20000", "--single", "--size", "64x48", "--frames", "2"};
    expect_same_pictures(render(arguments), render(arguments + Arguments{"--pose", "0.7"}));
}

TEST_F(Pictures, AreLitFromWhereTheLightIs) {
    const Arguments arguments{"builtin:knot:20000", "--single", "--size", "64x48", "--frames", "1"};
    const std::string light = render(arguments + Arguments{"--light", "-1,2,0.5"});
    const std::string name = "/frame_0000.png";
    EXPECT_NE(contents(render(arguments) + name), contents(light + name));
    // Only the direction counts.
    expect_same_pictures(light, render(arguments + Arguments{"--light=-1e30,2e30,5e29"}));
    EXPECT_NE(contents(render(arguments + Arguments{"--light", "1,2,0.5"}) + name), contents(light + name));
}

TEST_F(Pictures, DoNotDependOnHowFinelyAModelIsCut) {
    const Arguments arguments{"builtin:knot:40000", "--size", "641x480", "--frames", "2"};
    const std::string expected = render(arguments + Arguments{"--single"});
    for (const Arguments& cut :
         {Arguments{"--objects", "1"}, Arguments{"--objects", "60"}, Arguments{"--objects", "20000"},
          Arguments{"--octree-depth", "2"}, Arguments{"--octree-depth", "10"}}) {
        SCOPED_TRACE(fmt::format("{} {}", cut[0], cut[1]));
        expect_same_pictures(expected, render(arguments + cut + Arguments{"--single"}));
        expect_same_pictures(expected, render_on(3, arguments + cut));
    }
}

TEST_F(Pictures, AreTheSameInEveryRun) {
    const Arguments arguments{"builtin:town:30000",
                              "--local",
                              "4",
                              "--size",
                              "641x480",
                              "--frames",
                              "6",
                              "--path",
                              "random",
                              "--seed",
                              "99"};
    const std::string first = render(arguments);
    for (int run = 0; run < 3; ++run) expect_same_pictures(first, render(arguments));
    for (const char* in_flight : {"1", "8"})
        expect_same_pictures(first, render(arguments + Arguments{"--in-flight", in_flight}));
}

TEST_F(Pictures, DependOnTheSeedOfARandomPath) {
    const Arguments arguments{"builtin:knot:20000", "--single", "--size", "64x48",
                              "--frames",           "3",        "--path", "random"};
    const std::string one = render(arguments + Arguments{"--seed", "1"});
    const std::string two = render(arguments + Arguments{"--seed", "2"});
    for (const std::string& name : file_names(one))
        EXPECT_NE(contents(one + "/" + name), contents(two + "/" + name));
}

}  // namespace
}  // namespace swath::test
