#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/include_graph.h"

namespace swath::architecture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const IncludeGraph& our_tree() {
    static const IncludeGraph graph = scan(SWATH_SOURCE_DIR);
    return graph;
}

std::string listed(const std::vector<std::string>& offences) {
    return fmt::format("\n  {}\n", fmt::join(offences, "\n  "));
}

// The rules hold in the tree.

TEST(Architecture, TheTreeIsThere) {
    ASSERT_TRUE(our_tree().contains("common/base/check.cpp"));
    EXPECT_THAT(our_tree().at("common/base/check.cpp"), ElementsAre("common/base/check.h"));
}

TEST(Architecture, NoFilesIncludeEachOtherInACircle) {
    const std::vector<std::string> cycles = file_cycles(our_tree());
    EXPECT_TRUE(cycles.empty()) << listed(cycles);
}

TEST(Architecture, NoFoldersIncludeEachOtherInACircle) {
    const std::vector<std::string> cycles = folder_cycles(our_tree());
    EXPECT_TRUE(cycles.empty()) << listed(cycles);
}

TEST(Architecture, ArrowsRunDownwards) {
    const std::vector<std::string> offences = forbidden_arrows(our_tree());
    EXPECT_TRUE(offences.empty()) << listed(offences);
}

TEST(Architecture, ProtobufAsioAndBeastStayWhereTheyBelong) {
    const std::vector<std::string> offences = forbidden_headers(our_tree());
    EXPECT_TRUE(offences.empty()) << listed(offences);
}

// The rules find faults in trees that break them.

TEST(IncludeLines, AreFoundInBothFormsAndNotInComments) {
    EXPECT_THAT(includes_of("#pragma once\n"
                            "#include <vector>\n"
                            "  #  include \"common/base/ids.h\"  // ids\r\n"
                            "// #include \"no.h\"\n"
                            "const char* text = \"#include <no>\";\n"
                            "#include MACRO\n"
                            "#include \"broken.h\n"
                            "#include\"last.h\""),
                ElementsAre("vector", "common/base/ids.h", "last.h"));
    EXPECT_THAT(includes_of(""), IsEmpty());
}

TEST(FolderOf, IsTheProgramAndItsPart) {
    EXPECT_EQ(folder_of("common/wire/framing.h"), "common/wire");
    EXPECT_EQ(folder_of("sim/hardware/profiles/paper.h"), "sim/hardware");
    EXPECT_EQ(folder_of("client/main.cpp"), "client");
}

TEST(FileCycles, AreReportedWithEveryFileOnThem) {
    EXPECT_THAT(file_cycles({{"common/plan/a.h", {"vector", "common/plan/b.h"}},
                             {"common/plan/b.h", {"common/plan/c.h"}},
                             {"common/plan/c.h", {"common/plan/b.h"}},
                             {"common/plan/d.h", {"common/plan/a.h"}}}),
                ElementsAre("common/plan/b.h -> common/plan/c.h -> common/plan/b.h"));
    EXPECT_THAT(file_cycles({{"sim/a.h", {"sim/a.h"}}}), ElementsAre("sim/a.h -> sim/a.h"));
}

TEST(FileCycles, AreNotSeenInADiamond) {
    EXPECT_THAT(file_cycles({{"sim/top.h", {"sim/left.h", "sim/right.h"}},
                             {"sim/left.h", {"sim/bottom.h"}},
                             {"sim/right.h", {"sim/bottom.h"}},
                             {"sim/bottom.h", {}}}),
                IsEmpty());
}

TEST(FolderCycles, AreFoundThoughNoFilesFormOne) {
    const IncludeGraph graph{{"client/cluster/a.h", {"client/launch/a.h"}},
                             {"client/launch/a.h", {}},
                             {"client/launch/b.h", {"client/cluster/b.h"}},
                             {"client/cluster/b.h", {}}};
    EXPECT_THAT(file_cycles(graph), IsEmpty());
    EXPECT_THAT(folder_cycles(graph), ElementsAre("client/cluster -> client/launch -> client/cluster"));
}

TEST(FolderCycles, AreNobodysBusinessInTests) {
    EXPECT_THAT(
        folder_cycles({{"tests/support/a.h", {"tests/e2e/a.h"}}, {"tests/e2e/b.h", {"tests/support/b.h"}}}),
        IsEmpty());
}

TEST(Arrows, UpwardAndSidewaysOnesAreReported) {
    EXPECT_THAT(forbidden_arrows({{"common/base/a.h", {"client/partition/a.h"}}}),
                ElementsAre("common/base/a.h -> client/partition/a.h: common stands on nothing else"));
    EXPECT_THAT(forbidden_arrows({{"server/main.cpp", {"client/path/a.h"}}}),
                ElementsAre("server/main.cpp -> client/path/a.h: only sim includes another program's code"));
    EXPECT_THAT(forbidden_arrows({{"client/partition/a.h", {"sim/engine/a.h"}}}), testing::SizeIs(1));
    EXPECT_THAT(
        forbidden_arrows({{"sim/engine/a.h", {"server/session/a.h"}}}),
        ElementsAre("sim/engine/a.h -> server/session/a.h: sim includes only decision code of the programs"));
    EXPECT_THAT(forbidden_arrows({{"display/present/a.h", {"tests/support/a.h"}}}),
                ElementsAre("display/present/a.h -> tests/support/a.h: nobody includes tests"));
}

TEST(Arrows, DownwardOnesAreFine) {
    EXPECT_THAT(
        forbidden_arrows({{"client/main.cpp", {"CLI/CLI.hpp", "client/director/a.h", "common/wire/a.h"}},
                          {"sim/engine/a.h",
                           {"client/partition/a.h", "client/director/a.h", "client/path/a.h",
                            "server/swap/a.h", "display/assemble/a.h", "sim/hardware/a.h"}},
                          {"tests/e2e/a.cpp", {"server/render/a.h", "tests/support/a.h"}}}),
        IsEmpty());
}

TEST(Arrows, WithinCommonGoToLowerLayersOnly) {
    EXPECT_THAT(forbidden_arrows({{"common/wire/a.h",
                                   {"common/wire/b.h", "common/plan/a.h", "common/image/a.h",
                                    "common/timeline/a.h", "common/scene/a.h"}}}),
                IsEmpty());
    for (const auto& [from, to] : {std::pair{"common/scene/a.h", "common/plan/a.h"},
                                   {"common/geometry/a.h", "common/scene/a.h"},
                                   {"common/timeline/a.h", "common/image/a.h"},
                                   {"common/render/a.h", "common/wire/a.h"},
                                   {"common/cull/a.h", "common/render/a.h"},
                                   {"common/base/a.h", "common/geometry/a.h"}})
        EXPECT_THAT(forbidden_arrows({{from, {to}}}),
                    ElementsAre(fmt::format("{} -> {}: not a lower layer of common", from, to)));
    EXPECT_THAT(forbidden_arrows({{"common/misc/a.h", {"common/base/a.h"}}}),
                ElementsAre("common/misc/a.h -> common/base/a.h: the including folder is not in the table of "
                            "common's layers"));
}

TEST(Arrows, ToWhatReproducesPapersComeFromCullersAndTestsOnly) {
    for (const char* from :
         {"client/single/a.cpp", "server/session/a.cpp", "display/main.cpp", "sim/cost/a.h"})
        EXPECT_THAT(
            forbidden_arrows({{from, {"common/published/cull/a.h"}}}),
            ElementsAre(fmt::format("{} -> common/published/cull/a.h: what only reproduces papers is for "
                                    "common/cullers and tests",
                                    from)));
    for (const char* from : {"common/cull/a.h", "common/scene/a.cpp", "common/raycast/a.cpp",
                             "common/renderers/a.cpp", "common/wire/a.cpp", "common/program/a.cpp"})
        EXPECT_THAT(
            forbidden_arrows({{from, {"common/published/octree/a.h"}}}),
            ElementsAre(fmt::format("{} -> common/published/octree/a.h: not a lower layer of common", from)));
    EXPECT_THAT(forbidden_arrows({{"common/cullers/a.cpp", {"common/published/cull/a.h"}},
                                  {"common/published/cull/a.h", {"common/cull/a.h"}},
                                  {"tests/bench/a.cpp", {"common/published/resource/a.h"}}}),
                IsEmpty());
}

TEST(Headers, OfProtobufAsioAndBeastAreReportedOutsideTheirFolders) {
    EXPECT_THAT(forbidden_headers({{"client/cluster/a.cpp", {"common/wire/swath.pb.h", "boost/asio.hpp"}}}),
                ElementsAre("client/cluster/a.cpp -> common/wire/swath.pb.h: protobuf stays in common/wire"));
    EXPECT_THAT(
        forbidden_headers({{"client/director/a.h", {"boost/asio/awaitable.hpp"}}}),
        ElementsAre("client/director/a.h -> boost/asio/awaitable.hpp: Asio stays in the networking folders"));
    EXPECT_THAT(
        forbidden_headers(
            {{"display/view/a.h", {"boost/beast/core.hpp"}}, {"display/session/a.cpp", {"boost/beast.hpp"}}}),
        ElementsAre("display/session/a.cpp -> boost/beast.hpp: Beast stays in sources of display/view "
                    "and tests/support",
                    "display/view/a.h -> boost/beast/core.hpp: Beast stays in sources of display/view "
                    "and tests/support"));
    EXPECT_THAT(forbidden_headers({{"common/wire/a.cpp", {"swath.pb.h", "boost/asio.hpp"}},
                                   {"server/session/a.cpp", {"boost/asio.hpp"}},
                                   {"display/view/a.cpp", {"boost/beast/http.hpp"}},
                                   {"display/main.cpp", {"boost/asio.hpp"}},
                                   {"tests/common/wire/a.cpp", {"boost/asio.hpp"}}}),
                IsEmpty());
}

}  // namespace
}  // namespace swath::architecture
