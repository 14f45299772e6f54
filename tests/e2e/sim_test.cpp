// The simulator as somebody uses it: its output, files and errors, and that a sweep survives being killed.
#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

class Simulator : public EndToEnd {
  protected:
    Finished sim(const Arguments& arguments) const { return run("swath-sim", arguments); }
    Finished succeed(const Arguments& arguments) const {
        Finished finished = sim(arguments);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return finished;
    }
    // 20 experiments of some hundredths of a second each.
    Arguments sweep(const std::string& folder, const Arguments& more = {"--threads", "1"}) const {
        return Arguments{"sweep",
                         "--model",
                         "builtin:knot:5000",
                         "--algorithm",
                         "hybrid,sort-last",
                         "--servers",
                         "1,2,3,4,5,6,7,8,9,10",
                         "--frames",
                         "100",
                         "--out",
                         folder} +
               more;
    }
};

// Expects that one line, and nothing else.
void expect_one_line(const Finished& finished, int exit_code, const Arguments& words) {
    expect_one_error(finished, exit_code, words);
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_EQ(finished.out, "");
}

TEST_F(Simulator, HelpNamesEveryCommandAndFlag) {
    const std::string all = succeed({"--help"}).out;
    for (const char* word : {"run", "sweep", "hardware"}) EXPECT_NE(all.find(word), all.npos) << word;
    const std::string run_help = succeed({"run", "--help"}).out;
    for (const char* word :
         {"MODEL", "--csv", "--timeline", "--algorithm", "--servers", "--hardware", "--size"})
        EXPECT_NE(run_help.find(word), run_help.npos) << word;
    const std::string sweep_help = succeed({"sweep", "--help"}).out;
    for (const char* word : {"--model", "--out", "--quiet", "--algorithm", "--servers", "--threads",
                             "--seeds", "hybrid, mahd, kd-split, sort-last"})
        EXPECT_NE(sweep_help.find(word), sweep_help.npos) << word;
}

TEST_F(Simulator, TakesFlagsBeforeWhatTheyAreAbout) {
    succeed({"run", "--servers", "2", "--algorithm", "hybrid", "builtin:knot:500", "--frames", "2"});
    succeed({"study", "--model", "knot=builtin:knot:500", "--zoom", "knot=1", "scalability", "--frames", "2",
             "--seeds", "1", "--quiet", "--out", files_.path_of("study")});
}

TEST_F(Simulator, ListsAndExplainsHardware) {
    EXPECT_NE(succeed({"hardware"}).out.find("paper-2000"), std::string::npos);
    const std::string explained = succeed({"hardware", "paper-2000"}).out;
    EXPECT_NE(explained.find("1.33 us/polygon"), std::string::npos) << explained;
    expect_one_line(sim({"hardware", "cray-1"}), 1, {"cray-1"});
    const std::string wrong = files_.write("wrong.toml", "about = 3\n");
    expect_one_line(sim({"hardware", wrong}), 1, {"wrong.toml", "about"});
}

TEST_F(Simulator, RunPrintsATableAndWritesItAndTheTimeline) {
    const std::string csv = files_.path_of("t.csv");
    const std::string json = files_.path_of("t.json");
    const Finished finished = succeed(
        {"run", "builtin:knot:5000", "--servers", "3", "--frames", "4", "--csv", csv, "--timeline", json});
    for (const char* word : {"knot: 5010 polygons", "paper mode", "full mode", "hybrid", "busiest"})
        EXPECT_NE(finished.out.find(word), std::string::npos) << word << "\n" << finished.out;
    EXPECT_EQ(finished.err, "");
    EXPECT_TRUE(
        contents(csv).starts_with("algorithm,model,servers,column,value\nhybrid,knot,3,ideal_render,"))
        << contents(csv);
    const auto trace = nlohmann::json::parse(contents(json));
    std::set<std::string> machines;
    int pictures = 0;
    for (const auto& event : trace.at("traceEvents")) {
        if (event.at("ph") == "M" && event.at("name") == "process_name")
            machines.insert(event.at("args").at("name").get<std::string>());
        if (event.at("ph") == "X" && event.at("name") == "partition") ++pictures;
    }
    EXPECT_EQ(machines, (std::set<std::string>{"client", "display", "server 0", "server 1", "server 2"}));
    EXPECT_EQ(pictures, 4);
}

TEST_F(Simulator, RunAndSweepWriteTheSameRows) {
    const std::string csv = files_.path_of("t.csv");
    const Arguments what{"--algorithm", "hybrid,mahd", "--servers", "2,5", "--frames", "3"};
    succeed(Arguments{"run", "builtin:knot:5000", "--csv", csv} + what);
    const Finished finished =
        succeed(Arguments{"sweep", "--model", "builtin:knot:5000", "--out", files_.path_of("s")} + what);
    EXPECT_EQ(contents(files_.path_of("s/sweep.csv")), contents(csv));
    EXPECT_NE(finished.out.find(files_.path_of("s/sweep.csv")), std::string::npos) << finished.out;
    EXPECT_NE(finished.err.find("4/4 experiments"), std::string::npos) << finished.err;
    EXPECT_EQ(file_names(files_.path_of("s")), (Arguments{"sweep.csv", "sweep.journal"}));
    EXPECT_EQ(
        succeed(Arguments{"sweep", "--quiet", "--model", "builtin:knot:5000", "--out", files_.path_of("q")} +
                what)
            .err,
        "");
}

TEST_F(Simulator, WrongUsageIsOneLineAndLeavesNoFile) {
    const std::string out = files_.path_of("out");
    const std::string csv = files_.path_of("t.csv");
    const auto expect_usage = [&](const Arguments& flags, const Arguments& words) {
        expect_one_line(sim(Arguments{"run", "builtin:knot:300", "--csv", csv} + flags), 2, words);
        expect_one_line(sim(Arguments{"sweep", "--model", "builtin:knot:300", "--out", out} + flags), 2,
                        words);
    };
    expect_usage({"--fast"}, {"--fast"});
    expect_usage({"--servers", "0"}, {"--servers", "'0'", "1 to 1024"});
    expect_usage({"--servers", "8,1025"}, {"--servers", "'1025'", "1 to 1024"});
    expect_usage({"--algorithm", "magic"}, {"magic", "hybrid, mahd, kd-split, sort-last"});
    expect_usage({"--zoom", "nan"}, {"--zoom", "nan"});
    expect_usage({"--size", "640"}, {"--size", "640", "WxH"});
    expect_usage({"--frames", "0"}, {"--frames"});
    expect_usage({"--seed", "-1"}, {"--seed", "-1"});
    expect_usage({"--threads", "0"}, {"--threads"});
    expect_usage({"--in-flight", "9"}, {"--in-flight"});
    expect_usage({"--octree-depth", "11"}, {"--octree-depth"});
    expect_usage({"--objects", "5", "--octree-depth", "3"}, {"--objects", "--octree-depth"});
    expect_one_line(sim({}), 2, {"subcommand"});
    expect_one_line(sim({"walk"}), 2, {"walk"});
    expect_one_line(sim({"run"}), 2, {"MODEL"});
    expect_one_line(sim({"sweep", "--model", "builtin:knot:300"}), 2, {"--out"});
    expect_one_line(sim({"sweep", "--out", out}), 2, {"--model"});
    expect_one_line(
        sim({"sweep", "--out", out, "--model", "builtin:knot:300", "--model", "builtin:knot:400"}), 2,
        {"knot"});
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_FALSE(std::filesystem::exists(csv));
}

TEST_F(Simulator, WhatCannotBeReadOrWrittenIsOneLineAndLeavesNoFile) {
    const std::string out = files_.path_of("out");
    const std::string csv = files_.path_of("t.csv");
    const std::string file = files_.write("file", "kept");
    const auto expect_failure = [&](const std::string& model, const Arguments& flags,
                                    const Arguments& words) {
        expect_one_line(sim(Arguments{"run", model, "--csv", csv} + flags), 1, words);
        expect_one_line(sim(Arguments{"sweep", "--model", model, "--out", out} + flags), 1, words);
    };
    expect_failure("no/such.ply", {}, {"no/such.ply"});
    expect_failure("builtin:teapot", {}, {"teapot"});
    expect_failure(file, {}, {file});
    expect_failure("builtin:knot:300", {"--hardware", "cray-1"}, {"--hardware", "cray-1"});
    expect_failure("builtin:knot:300", {"--hardware", "no/such.toml"}, {"no/such.toml"});
    expect_failure("builtin:knot:300", {"--path", "no/such.txt"}, {"no/such.txt"});
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_FALSE(std::filesystem::exists(csv));

    const Arguments sweep{"sweep", "--model", "builtin:knot:300", "--out"};
    expect_one_line(sim(sweep + Arguments{file}), 1, {"--out", file});
    expect_one_line(sim(sweep + Arguments{file + "/below"}), 1, {"--out", file});
    expect_one_line(sim(sweep + Arguments{"/proc/swath"}), 1, {"--out", "/proc/swath"});
    expect_one_line(sim({"run", "builtin:knot:300", "--timeline", files_.path_of("t.xls")}), 2,
                    {"--timeline", ".csv", ".json"});
    expect_one_line(
        sim({"run", "builtin:knot:300", "--servers", "2,4", "--timeline", files_.path_of("t.csv")}), 2,
        {"--timeline", "one number of servers"});
    EXPECT_EQ(contents(file), "kept");
}

TEST_F(Simulator, SweepThatWasKilledGoesOnToTheSameTable) {
    const std::string whole = files_.path_of("whole");
    const std::string killed = files_.path_of("killed");
    succeed(sweep(whole, {"--quiet"}));
    for (const char* when : {"4/20 experiments", "2/16 experiments"}) {
        const auto process = start("swath-sim", sweep(killed));
        process->wait_for_line(when, kPatience);
        process->signal(SIGKILL);
        ASSERT_EQ(process->wait(kPatience).signal, SIGKILL) << "it was over before it was killed";
        ASSERT_FALSE(std::filesystem::exists(killed + "/sweep.csv"));
        // As if it had died while it wrote the next entry, with 4 experiments complete.
        std::string journal = contents(killed + "/sweep.journal");
        std::size_t end = 0;
        for (int i = 0; i < 4; ++i) end = journal.find("# complete", end + 1);
        ASSERT_NE(end, journal.npos);
        files_.write("killed/sweep.journal",
                     journal.substr(0, journal.find('\n', end) + 1) + "hybrid,knot,9,pixel_re");
    }
    const Finished finished = succeed(sweep(killed, {"--quiet", "--threads", "3"}));
    EXPECT_NE(finished.err.find("notice: " + killed + "/sweep.journal"), std::string::npos) << finished.err;
    EXPECT_NE(finished.out.find("20 experiments"), std::string::npos) << finished.out;
    EXPECT_EQ(contents(killed + "/sweep.csv"), contents(whole + "/sweep.csv"));
    EXPECT_NE(contents(whole + "/sweep.csv"), "");
    EXPECT_NE(succeed(sweep(killed)).out.find("20 of them from before"), std::string::npos);
    EXPECT_EQ(contents(killed + "/sweep.csv"), contents(whole + "/sweep.csv"));
}

TEST_F(Simulator, SecondSweepIntoAFolderIsRefused) {
    const std::string folder = files_.path_of("shared");
    const auto first = start("swath-sim", sweep(folder));
    first->wait_for_line("2/20 experiments", kPatience);
    first->signal(SIGSTOP);
    expect_one_line(sim(sweep(folder)), 1, {"sweep.journal", "another sweep"});
    first->signal(SIGCONT);
    EXPECT_EQ(first->wait(kPatience).exit_code, 0);
    EXPECT_NE(contents(folder + "/sweep.csv"), "");
}

TEST_F(Simulator, SweepOfOtherSettingsIsRefusedAndTouchesNothing) {
    const std::string folder = files_.path_of("folder");
    const Arguments sweep{"sweep", "--model", "builtin:knot:300", "--quiet", "--out", folder, "--frames"};
    succeed(sweep + Arguments{"2"});
    const std::string journal = contents(folder + "/sweep.journal");
    const std::string table = contents(folder + "/sweep.csv");
    expect_one_line(sim(sweep + Arguments{"3"}), 1, {"sweep.journal:2", "2 frames", "3 frames"});
    EXPECT_EQ(contents(folder + "/sweep.journal"), journal);
    EXPECT_EQ(contents(folder + "/sweep.csv"), table);
}

}  // namespace
}  // namespace swath::test
