// A wrong flag ends every program at once with exit code 2 and one line that names the flag and what it
// takes.
#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

struct Case {
    std::string name;
    std::string program;
    Arguments arguments;
    std::vector<std::string> words;  // of the line
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const std::vector<Case> kCases{
    {"NoModel", "swath-client", {}, {"MODEL"}},
    {"TwoModels", "swath-client", {"builtin:knot", "builtin:town"}, {"builtin:town"}},
    {"UnknownFlag", "swath-client", {"builtin:knot", "--fast"}, {"--fast"}},
    {"FlagWithoutItsValue", "swath-client", {"builtin:knot", "--frames"}, {"--frames"}},
    {"NoServers", "swath-client", {"builtin:knot", "--local", "0"}, {"--local", "1 to 64"}},
    {"TooManyServers", "swath-client", {"builtin:knot", "--local", "65"}, {"--local", "1 to 64"}},
    {"SizeWithoutHeight", "swath-client", {"builtin:knot", "--size", "640"}, {"--size", "640", "WxH"}},
    {"SizeOfNothing", "swath-client", {"builtin:knot", "--size", "0x480"}, {"--size", "0x480", "16384"}},
    {"SizeTooLarge", "swath-client", {"builtin:knot", "--size", "640x16385"}, {"--size", "16384"}},
    {"SizeWithATail", "swath-client", {"builtin:knot", "--size", "640x480p"}, {"--size", "640x480p"}},
    {"BackgroundTooShort",
     "swath-client",
     {"builtin:knot", "--background", "fff"},
     {"--background", "RRGGBB"}},
    {"UnknownAlgorithm",
     "swath-client",
     {"builtin:knot", "--algorithm", "magic"},
     {"algorithm", "magic", "hybrid, mahd, kd-split, sort-last"}},
    {"UnknownCulling",
     "swath-client",
     {"builtin:knot", "--cull", "fast"},
     {"--cull", "fast", "wide, a2ssb, adsb, none"}},
    {"UnknownRenderer",
     "swath-client",
     {"builtin:knot", "--renderer", "vulkan"},
     {"--renderer", "vulkan", "osmesa", "egl", "raycast"}},
    {"RendererThatIsMissing",
     "swath-client",
     {"builtin:knot", "--renderer", "raycast,"},
     {"--renderer", "''", "osmesa"}},
    {"ShadowsWithoutARayCaster",
     "swath-client",
     {"builtin:knot", "--shadows", "--renderer", "osmesa,egl"},
     {"--shadows", "ray caster", "osmesa,egl"}},
    {"DynamicWithoutARayCaster",
     "swath-client",
     {"builtin:knot", "--single", "--dynamic"},
     {"--dynamic", "osmesa"}},
    {"TwoRenderersOfOneProcess",
     "swath-client",
     {"builtin:knot", "--single", "--renderer", "raycast,osmesa"},
     {"--renderer", "raycast,osmesa", "--single"}},
    {"UnknownFormat",
     "swath-client",
     {"builtin:knot", "--format", "gif"},
     {"--format", "gif", "png", "jpeg"}},
    {"NoFrames", "swath-client", {"builtin:knot", "--frames", "0"}, {"--frames", "1 to 1000000"}},
    {"FramesInWords", "swath-client", {"builtin:knot", "--frames", "many"}, {"--frames", "many"}},
    {"NegativeObjects", "swath-client", {"builtin:knot", "--objects", "-5"}, {"--objects", "-5"}},
    {"OctreeTooDeep",
     "swath-client",
     {"builtin:knot", "--octree-depth", "11"},
     {"--octree-depth", "0 to 10"}},
    {"TooManyInFlight", "swath-client", {"builtin:knot", "--in-flight", "9"}, {"--in-flight", "1 to 8"}},
    {"ZoomIsNoNumber", "swath-client", {"builtin:knot", "--zoom", "nan"}, {"--zoom", "nan"}},
    {"PatienceIsNoNumber", "swath-client", {"builtin:knot", "--connect-s", "nan"}, {"--connect-s", "nan"}},
    {"PoseBeyondTheEnd", "swath-client", {"builtin:swarm", "--pose", "1.1"}, {"--pose", "0 to 1"}},
    {"PoseIsNoNumber", "swath-client", {"builtin:swarm", "--pose", "nan"}, {"--pose", "nan"}},
    {"LightFromNowhere", "swath-client", {"builtin:knot", "--light", "0,0,0"}, {"--light", "0,0,0", "X,Y,Z"}},
    {"LightOfTwoNumbers", "swath-client", {"builtin:knot", "--light", "1,2"}, {"--light", "'1,2'"}},
    {"LightOfFourNumbers", "swath-client", {"builtin:knot", "--light", "1,2,3,4"}, {"--light", "1,2,3,4"}},
    {"LightAtInfinity", "swath-client", {"builtin:knot", "--light", "1,inf,3"}, {"--light", "finite"}},
    {"LightIsNoNumber", "swath-client", {"builtin:knot", "--light", "nan,2,3"}, {"--light", "finite"}},
    {"LightTooLarge", "swath-client", {"builtin:knot", "--light", "1,2,1e99"}, {"--light", "1e99"}},
    {"LightOfNothing", "swath-client", {"builtin:knot", "--light", ""}, {"--light"}},
    {"NegativeSeed", "swath-client", {"builtin:knot", "--seed", "-1"}, {"--seed", "-1"}},
    {"SeedTooLarge",
     "swath-client",
     {"builtin:knot", "--seed", "18446744073709551616"},
     {"--seed", "18446744073709551616"}},
    {"LifelineOfTheClient", "swath-client", {"builtin:knot", "--lifeline"}, {"--lifeline"}},
    {"SilenceTooShort", "swath-client", {"builtin:knot", "--silence-ms", "99"}, {"--silence-ms", "100"}},
    {"TimelineOfUnknownKind",
     "swath-client",
     {"builtin:knot", "--timeline", "run.xls"},
     {"--timeline", "run.xls", ".csv", ".json"}},
    {"SingleAndLocal", "swath-client", {"builtin:knot", "--single", "--local", "2"}, {"--single", "--local"}},
    {"ObjectsAndDepth",
     "swath-client",
     {"builtin:knot", "--objects", "9", "--octree-depth", "2"},
     {"--objects", "--octree-depth"}},
    {"DepthOfASahOctree",
     "swath-client",
     {"builtin:knot", "--objects-by", "sah", "--octree-depth", "2"},
     {"--octree-depth", "--objects-by sah", "--objects"}},
    {"ObjectsByNobodyKnows",
     "swath-client",
     {"builtin:knot", "--objects-by", "kd"},
     {"--objects-by", "kd", "uniform, sah"}},
    {"ServersWithoutDisplay",
     "swath-client",
     {"builtin:knot", "--servers", "127.0.0.1:4000"},
     {"--servers", "--display"}},
    {"DisplayWithoutServers",
     "swath-client",
     {"builtin:knot", "--display", "127.0.0.1:4000"},
     {"--servers", "--display"}},
    {"ServerWithoutPort",
     "swath-client",
     {"builtin:knot", "--servers", "localhost", "--display", "localhost:4100"},
     {"--servers", "localhost", "HOST:PORT"}},
    {"PortTooLarge",
     "swath-client",
     {"builtin:knot", "--servers", "localhost:4000", "--display", "localhost:65536"},
     {"--display", "65535"}},
    {"ViewOfOneProcess", "swath-client", {"builtin:knot", "--view", "--single"}, {"--view", "--single"}},
    {"ViewWithPictures", "swath-client", {"builtin:knot", "--out", "x", "--view"}, {"--view", "--out"}},
    {"ViewOfSoManyFrames",
     "swath-client",
     {"builtin:knot", "--frames", "3", "--view"},
     {"--view", "--frames"}},
    {"ViewPortForADisplayThatRuns",
     "swath-client",
     {"builtin:knot", "--servers", "a:1", "--display", "b:2", "--view", "8080"},
     {"--view", "runs already"}},
    {"ViewPortInWords", "swath-client", {"builtin:knot", "--view", "web"}, {"--view", "web"}},
    {"LargestViewWithoutView", "swath-client", {"builtin:knot", "--view-max-size", "10x10"}, {"--view"}},
    {"LargestViewOfNothing",
     "swath-client",
     {"builtin:knot", "--view", "0", "--view-max-size", "10"},
     {"--view-max-size", "WxH"}},
    {"DisplayViewInWords", "swath-display", {"--view", "web"}, {"--view", "web"}},
    {"UnknownServerFlag", "swath-server", {"--local", "2"}, {"--local"}},
    {"ServerAddressWithoutPort",
     "swath-server",
     {"--listen", "localhost"},
     {"--listen", "localhost", "HOST:PORT"}},
    {"ServerThreads", "swath-server", {"--threads", "257"}, {"--threads", "0 to 256"}},
    {"ServerModelLimit", "swath-server", {"--max-model-mib", "0"}, {"--max-model-mib", "1 to"}},
    {"UnknownDisplayFlag", "swath-display", {"--cache", "x"}, {"--cache"}},
    {"DisplayPortInWords", "swath-display", {"--listen", "localhost:http"}, {"--listen", "port"}},
};

class WrongFlag : public EndToEnd, public testing::WithParamInterface<Case> {};

TEST_P(WrongFlag, EndsTheProgramWithOneLineAndExitCode2) {
    const Case& c = GetParam();
    const Finished finished = start(c.program, c.arguments)->wait(kPatience);
    expect_one_error(finished, 2, c.words);
    EXPECT_NE(finished.err.find("--help"), std::string::npos);
    EXPECT_EQ(finished.out, "");
    EXPECT_LT(finished.took, kSlowdown * std::chrono::seconds(5));
}

INSTANTIATE_TEST_SUITE_P(Cases, WrongFlag, testing::ValuesIn(kCases),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace swath::test
