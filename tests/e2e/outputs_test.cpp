// The output of a run: pictures, timelines, the summary, progress, and the help that explains all of it.
#include <fmt/core.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

class Output : public EndToEnd {
  protected:
    static constexpr int kFrames = 5;
    const Arguments run_{"builtin:knot:20000", "--size", "320x240", "--frames", std::to_string(kFrames)};
    const Arguments local_ = run_ + Arguments{"--local", "3"};

    Finished succeed(const Arguments& arguments) const {
        Finished finished = client(arguments);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return finished;
    }
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line)
        if (c == ',')
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

TEST_F(Output, CsvTimelineHasEveryPhaseOfEveryMachineInOrder) {
    const std::string file = files_.path_of("timeline.csv");
    const Finished finished = succeed(local_ + Arguments{"--out", files_.path_of("out"), "--timeline", file});
    EXPECT_NE(finished.out.find(file), std::string::npos);
    const auto lines = lines_of(contents(file));
    ASSERT_FALSE(lines.empty());
    ASSERT_EQ(lines[0], "frame,machine,kind,name,begin_ms,end_ms,cpu_ms,value");

    std::map<std::string, std::set<std::string>> phases;  // by machine
    std::map<std::pair<std::string, std::string>, std::map<std::string, double>>
        begins;  // by frame and machine
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const auto fields = fields_of(lines[i]);
        ASSERT_EQ(fields.size(), 8u) << lines[i];
        if (fields[2] != "span") continue;
        const double begin = std::stod(fields[4]);
        const double end = std::stod(fields[5]);
        EXPECT_LE(0, begin) << lines[i];
        EXPECT_LE(begin, end) << lines[i];
        EXPECT_LE(end, static_cast<double>(finished.took.count())) << lines[i];
        phases[fields[1]].insert(fields[3]);
        begins[{fields[0], fields[1]}][fields[3]] = begin;
    }
    EXPECT_EQ(phases.size(), 5u);
    EXPECT_EQ(phases["client"], std::set<std::string>{"partition"});
    for (const char* phase : {"assemble", "encode"}) EXPECT_TRUE(phases["display"].contains(phase)) << phase;
    std::set<std::string> of_servers;
    for (int i = 0; i < 3; ++i) {
        const auto& of_server = phases[fmt::format("server {}", i)];
        for (const char* phase : {"cull", "render", "pixel read", "final read", "send"})
            EXPECT_TRUE(of_server.contains(phase)) << phase << " of server " << i;
        of_servers.insert(of_server.begin(), of_server.end());
    }
    for (const char* phase : {"swap", "pixel write"}) EXPECT_TRUE(of_servers.contains(phase)) << phase;

    EXPECT_EQ(begins.size(), kFrames * 5u);
    for (const auto& [key, of] : begins) {
        if (!key.second.starts_with("server")) continue;
        SCOPED_TRACE(key.second + " in frame " + key.first);
        EXPECT_LE(of.at("cull"), of.at("render"));
        EXPECT_LE(of.at("render"), of.at("pixel read"));
        EXPECT_LE(of.at("pixel read"), of.at("final read"));
        EXPECT_LE(of.at("final read"), of.at("send"));
        // All times are on one clock, as exactly as a round trip on a busy machine allows.
        constexpr double kBlur = 20 * kSlowdown;
        EXPECT_LE(begins.at({key.first, "client"}).at("partition"), of.at("cull") + kBlur);
        EXPECT_LE(of.at("send"), begins.at({key.first, "display"}).at("encode") + kBlur);
    }
}

TEST_F(Output, JsonTimelineIsATraceWithEveryMachine) {
    const std::string file = files_.path_of("timeline.json");
    succeed(local_ + Arguments{"--timeline", file});
    const auto trace = nlohmann::json::parse(contents(file));
    std::set<std::string> machines;
    std::map<std::string, int> spans;
    for (const auto& event : trace.at("traceEvents")) {
        if (event.at("ph") == "M" && event.at("name") == "process_name")
            machines.insert(event.at("args").at("name").get<std::string>());
        if (event.at("ph") != "X") continue;
        EXPECT_GE(event.at("ts").get<double>(), 0);
        EXPECT_GE(event.at("dur").get<double>(), 0);
        ++spans[event.at("name").get<std::string>()];
    }
    EXPECT_EQ(machines, (std::set<std::string>{"client", "display", "server 0", "server 1", "server 2"}));
    EXPECT_EQ(spans["partition"], kFrames);
    EXPECT_EQ(spans["render"], kFrames * 3);
}

TEST_F(Output, SummaryNamesEveryMachineAndWhatWasSwapped) {
    const std::string out = succeed(local_).out;
    for (const char* word : {"client", "display", "server 0", "server 1", "server 2", "frames", "swapped",
                             "imbalance", "overlap", "drawn"})
        EXPECT_NE(out.find(word), std::string::npos) << word << "\n" << out;
    EXPECT_NE(succeed(run_ + Arguments{"--single"}).out.find("single"), std::string::npos);
}

TEST_F(Output, ProgressIsShownUnlessQuiet) {
    for (const Arguments& where : {Arguments{"--local", "2"}, Arguments{"--single"}}) {
        const Finished finished = succeed(run_ + where);
        EXPECT_NE(finished.err.find("5/5 frames"), std::string::npos) << finished.err;
        EXPECT_EQ(finished.out.find("5/5 frames"), std::string::npos);
        EXPECT_EQ(succeed(run_ + where + Arguments{"--quiet"}).err, "");
    }
}

TEST_F(Output, PicturesAreNumberedAndComplete) {
    for (const Arguments& where : {Arguments{"--local", "2"}, Arguments{"--single"}}) {
        const std::string folder = files_.path_of("deep/in/" + where[0]);
        succeed(run_ + where + Arguments{"--out", folder});
        EXPECT_EQ(file_names(folder),
                  (std::vector<std::string>{"frame_0000.png", "frame_0001.png", "frame_0002.png",
                                            "frame_0003.png", "frame_0004.png"}));
        for (const std::string& name : file_names(folder))
            EXPECT_TRUE(contents(folder + "/" + name).starts_with("\x89PNG\r\n")) << name;
    }
}

TEST_F(Output, JpegPicturesAreJpegs) {
    for (const Arguments& where : {Arguments{"--local", "2"}, Arguments{"--single"}}) {
        const std::string folder = files_.path_of("jpeg" + where[0]);
        succeed(run_ + where + Arguments{"--out", folder, "--format", "jpeg"});
        EXPECT_EQ(file_names(folder).size(), static_cast<std::size_t>(kFrames));
        for (const std::string& name : file_names(folder)) {
            EXPECT_TRUE(name.ends_with(".jpg")) << name;
            EXPECT_TRUE(contents(folder + "/" + name).starts_with("\xff\xd8")) << name;
        }
    }
}

TEST_F(Output, OnePictureCanHaveAFileOfItsOwn) {
    const Arguments one{"builtin:knot:2000", "--size", "64x48", "--frames", "1", "--single", "--out"};
    const std::string png = files_.path_of("new/still.png");
    const std::string jpg = files_.path_of("still.jpg");
    EXPECT_NE(succeed(one + Arguments{png}).out.find("pictures: " + png), std::string::npos);
    EXPECT_TRUE(contents(png).starts_with("\x89PNG\r\n"));
    succeed(one + Arguments{jpg});
    EXPECT_TRUE(contents(jpg).starts_with("\xff\xd8"));
    EXPECT_EQ(file_names(files_.path_of("new")), std::vector<std::string>{"still.png"});

    expect_one_error(client(run_ + Arguments{"--single", "--out", files_.path_of("many.png")}), 1,
                     {"--out", "many.png", "5 frames", "--frames 1"});
    EXPECT_FALSE(std::filesystem::exists(files_.path_of("many.png")));
    std::filesystem::create_directory(files_.path_of("folder.png"));
    succeed(run_ + Arguments{"--single", "--out", files_.path_of("folder.png")});
    EXPECT_EQ(file_names(files_.path_of("folder.png")).size(), static_cast<std::size_t>(kFrames));
}

TEST_F(Output, SummarySaysWhatBecameOfThePictures) {
    const Arguments run{"builtin:knot:2000", "--size", "64x48", "--single", "--frames"};
    const std::string folder = files_.path_of("out");
    const Finished none = succeed(run + Arguments{"2"});
    EXPECT_NE(none.out.find("pictures: none kept (--out FOLDER keeps them)\n"), std::string::npos)
        << none.out;
    EXPECT_NE(none.err.find("no pictures are kept"), std::string::npos) << none.err;
    const auto expect_said = [&](const Arguments& how, const std::string& said) {
        const Finished finished = succeed(run + how + Arguments{"--out", folder});
        EXPECT_NE(finished.out.find("pictures: " + said + "\n"), std::string::npos) << finished.out;
        EXPECT_EQ(finished.err.find("no pictures"), std::string::npos);
    };
    expect_said({"3"}, "3 in " + folder + "/");
    expect_said({"3"}, "3 in " + folder + "/");
    files_.write("out/frame_of_mine.txt", "kept");
    expect_said({"1"}, "1 in " + folder + "/, beside 2 of earlier runs");
    expect_said({"2", "--format", "jpeg"}, "2 in " + folder + "/, beside 3 of earlier runs");
    EXPECT_EQ(file_names(folder).size(), 6u);
}

TEST_F(Output, VersionNamesTheCommitTheProtocolAndWhatCanDraw) {
    for (const char* program : {"swath-client", "swath-server", "swath-display", "swath-sim"}) {
        const Finished finished = start(program, {"--version"})->wait(kPatience);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        EXPECT_TRUE(finished.out.starts_with(std::string(program) + " 0.")) << finished.out;
        const bool speaks = program != std::string("swath-sim");
        EXPECT_EQ(finished.out.find("\nprotocol ") != std::string::npos, speaks) << finished.out;
        const bool draws = program == std::string("swath-client") || program == std::string("swath-server");
        for (const char* renderer : {"raster", "osmesa", "egl", "raycast"})
            EXPECT_EQ(finished.out.find(std::string("\n") + renderer + " ") != std::string::npos, draws)
                << finished.out;
    }
}

TEST_F(Output, CameraFileGivesAsManyFramesAsItHasLines) {
    const std::string cameras =
        files_.write("cameras.txt", "0 0 5 0 0 0 0 1 0 40\n5 0 0 0 0 0 0 1 0 40 # side\n");
    const Arguments arguments{"builtin:knot:2000", "--size", "64x48", "--path", cameras, "--single"};
    EXPECT_EQ(file_names(render(arguments)).size(), 2u);
    EXPECT_EQ(file_names(render(arguments + Arguments{"--frames", "5"})).size(), 5u);
}

TEST_F(Output, FileInTheWayOfTheFolderIsNamed) {
    const std::string file = files_.write("file", "kept");
    for (const Arguments& where : {Arguments{"--local", "2"}, Arguments{"--single"}})
        expect_one_error(client(run_ + where + Arguments{"--out", file}), 1, {file});
    EXPECT_EQ(contents(file), "kept");
}

TEST_F(Output, FolderThatCannotBeWrittenIsNamed) {
    for (const Arguments& where : {Arguments{"--local", "2"}, Arguments{"--single"}})
        expect_one_error(client(run_ + where + Arguments{"--out", "/proc/swath"}), 1, {"/proc/swath"});
}

TEST_F(Output, PictureThatCannotBeWrittenIsNamedAndLeavesNoPiece) {
    const std::string folder = files_.path_of("out");
    std::filesystem::create_directories(folder + "/frame_0002.png");
    for (const Arguments& where : {Arguments{"--local", "2"}, Arguments{"--single"}}) {
        expect_one_error(client(run_ + where + Arguments{"--out", folder}), 1, {"frame_0002.png"});
        for (const std::string& name : file_names(folder)) EXPECT_TRUE(name.ends_with(".png")) << name;
    }
}

TEST_F(Output, TimelineThatCannotBeWrittenIsNamed) {
    expect_one_error(client(local_ + Arguments{"--timeline", "/proc/swath.csv"}), 1, {"/proc/swath.csv"});
}

TEST_F(Output, HelpIsOnePageAndNamesEveryFlag) {
    const std::map<std::string, std::vector<std::string>> flags{
        {"swath-client", {"MODEL",           "--local",        "--servers",    "--display",
                          "--single",        "--algorithm",    "--renderer",   "--objects",
                          "--size",          "--frames",       "--path",       "--seed",
                          "--zoom",          "--octree-depth", "--threads",    "--out",
                          "--format",        "--quiet",        "--timeline",   "--connect-s",
                          "--background",    "hybrid",         "mahd",         "kd-split",
                          "sort-last",       "osmesa",         "egl",          "--in-flight",
                          "--silence-ms",    "builtin:knot",   "orbit",        "random",
                          "builtin:spheres", "builtin:town",   "builtin:hand", "builtin:swarm",
                          "--light",         "--pose",         "--help",       "--shadows",
                          "--dynamic",       "--objects-by",   "raycast"}},
        {"swath-server",
         {"--listen", "--cache", "--max-model-mib", "--threads", "--quiet", "--lifeline", "--silence-ms",
          "--health", "--help"}},
        {"swath-display",
         {"--listen", "--view", "--view-at", "--quiet", "--lifeline", "--silence-ms", "--health", "--help"}}};
    for (const auto& [program, words] : flags) {
        const Finished finished = start(program, {"--help"})->wait(kPatience);
        EXPECT_EQ(finished.exit_code, 0);
        EXPECT_EQ(finished.err, "");
        // CLI11's versions differ in empty lines and in spaces at the ends of lines.
        std::size_t text_lines = 0;
        for (const std::string& line : lines_of(finished.out)) {
            const std::size_t length = line.find_last_not_of(' ') + 1;
            EXPECT_LE(length, 120u) << program << ": " << line;
            if (length > 0) ++text_lines;
        }
        EXPECT_LE(text_lines, 67u) << program;
        for (const std::string& word : words)
            EXPECT_NE(finished.out.find(word), std::string::npos) << program << " does not explain " << word;
    }
}

}  // namespace
}  // namespace swath::test
