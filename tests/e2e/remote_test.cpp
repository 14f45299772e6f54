// Servers and a display that somebody started by hand, on the machine of the client or on others.
#include <fstream>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

class Remote : public EndToEnd {
  protected:
    // Servers run in a folder of their own, where a path through /proc/self/cwd does not find the client's
    // files.
    std::unique_ptr<RemoteCluster> cluster(int servers, const Arguments& server_arguments = {}) const {
        std::filesystem::create_directory(elsewhere_);
        return std::make_unique<RemoteCluster>(
            [&](const std::string& program, const Arguments& arguments) {
                return start(program, program == "swath-server" ? arguments + server_arguments : arguments,
                             elsewhere_);
            },
            servers);
    }
    // Writes a model that only the client can open, and returns its path.
    std::string model_of_the_client() const {
        files_.write("mine.ply", contents_of_model());
        return "/proc/self/cwd/mine.ply";
    }
    static std::string contents_of_model(int shift = 0) {
        std::string text =
            "ply\nformat ascii 1.0\nelement vertex 300\nproperty float x\nproperty float y\nproperty float "
            "z\n"
            "element face 100\nproperty list uchar int vertex_indices\nend_header\n";
        for (int i = 0; i < 300; ++i)
            text += std::to_string(i % 17 + shift) + " " + std::to_string(i % 13) + " " +
                    std::to_string(i % 7) + "\n";
        for (int i = 0; i < 300; i += 3)
            text +=
                "3 " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
        return text;
    }
    // Runs a client in the folder of its file.
    std::string render_here(const Arguments& arguments) {
        std::string out = files_.path_of("here_" + std::to_string(renders_++));
        const auto process = start("swath-client", arguments + Arguments{"--out", out}, files_.path_of(""));
        const Finished finished = process->wait(kPatience);
        expect_no_crash(finished);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return out;
    }
    std::filesystem::path only_file_in(const std::string& folder) const {
        const auto names = file_names(folder);
        EXPECT_EQ(names.size(), 1u) << folder;
        return names.empty() ? std::filesystem::path() : std::filesystem::path(folder) / names[0];
    }

    const std::string elsewhere_ = files_.path_of("elsewhere");
    const std::string cache_ = files_.path_of("models");
    const Arguments small_{"--size", "160x120", "--frames", "2"};
    int renders_ = 0;
};

TEST_F(Remote, ServersServeOneClientAfterAnother) {
    const auto cluster = this->cluster(3);
    for (const Arguments& arguments :
         {Arguments{"builtin:town:20000", "--size", "320x240", "--frames", "3"},
          Arguments{"builtin:knot:20000", "--size", "641x97", "--frames", "3", "--algorithm", "sort-last"},
          Arguments{"builtin:town:20000", "--size", "320x240", "--frames", "3", "--renderer", "egl"}}) {
        const std::string expected = render(arguments + Arguments{"--single"});
        for (int run = 0; run < 2; ++run)
            expect_same_pictures(expected, render(arguments + cluster->flags()));
    }
}

TEST_F(Remote, ServersTakeTurnsBetweenManyShortRuns) {
    const auto cluster = this->cluster(2);
    const Arguments arguments = Arguments{"builtin:knot:1000", "--frames", "1", "--size", "64x48"};
    const std::string expected = render(arguments + Arguments{"--single"});
    for (int run = 0; run < 15; ++run) expect_same_pictures(expected, render(arguments + cluster->flags()));
}

TEST_F(Remote, ServersReadAFileThatTheyHaveThemselves) {
    const auto cluster = this->cluster(2, {"--cache", cache_});
    const Arguments arguments = Arguments{files_.write("shared.ply", contents_of_model())} + small_;
    const std::string expected = render(arguments + Arguments{"--single"});
    expect_not_only({16, 18, 24}, expected);
    expect_same_pictures(expected, render(arguments + cluster->flags()));
    EXPECT_FALSE(std::filesystem::exists(cache_));
}

TEST_F(Remote, ServerWithoutTheFileGetsItFromTheClientAndKeepsIt) {
    const auto cluster = this->cluster(1, {"--cache", cache_});
    const Arguments arguments = Arguments{model_of_the_client()} + small_;
    const std::string expected = render_here(arguments + Arguments{"--single"});
    expect_not_only({16, 18, 24}, expected);

    expect_same_pictures(expected, render_here(arguments + cluster->flags()));
    cluster->server(0).wait_for_line("asking the client for it", kPatience);
    const auto cached = only_file_in(cache_);
    const std::string blob = contents(cached);
    const auto written = std::filesystem::last_write_time(cached);

    expect_same_pictures(expected, render_here(arguments + cluster->flags()));
    EXPECT_EQ(only_file_in(cache_), cached);
    EXPECT_EQ(std::filesystem::last_write_time(cached), written) << "the second run did not use the cache";

    std::string damaged = blob;
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
    for (const std::string& wrong : {damaged, blob.substr(0, blob.size() / 2), std::string()}) {
        files_.write("models/" + cached.filename().string(), wrong);
        expect_same_pictures(expected, render_here(arguments + cluster->flags()));
        EXPECT_EQ(contents(only_file_in(cache_)), blob);
    }
    cluster->server(0).wait_for_line("is damaged, fetching the model again", kPatience);
}

TEST_F(Remote, ServersWithoutTheFileMayShareACache) {
    const auto cluster = this->cluster(3, {"--cache", cache_});
    const Arguments arguments = Arguments{model_of_the_client()} + small_;
    const std::string expected = render_here(arguments + Arguments{"--single"});
    for (int run = 0; run < 2; ++run)
        expect_same_pictures(expected, render_here(arguments + cluster->flags()));
    only_file_in(cache_);
}

TEST_F(Remote, ServerDoesNotDrawAnotherFileOfTheSameName) {
    const auto cluster = this->cluster(2, {"--cache", cache_});
    std::ofstream(elsewhere_ + "/mine.ply") << contents_of_model(5);
    const Arguments arguments = Arguments{model_of_the_client()} + small_;
    const std::string expected = render_here(arguments + Arguments{"--single"});
    expect_same_pictures(expected, render_here(arguments + cluster->flags()));
    cluster->server(0).wait_for_line("is not the client's model", kPatience);
}

TEST_F(Remote, LargeModelReachesServersWithoutTheFileInParts) {
    const auto dragon = shared_model("bunny.ply");
    if (!dragon) GTEST_SKIP() << "shared model bunny.ply not found";
    const auto cluster = this->cluster(2, {"--cache", cache_});
    // A larger model would have many parts of 4 MiB; this one has a part and a rest.
    std::filesystem::copy_file(*dragon, files_.path_of("mine.ply"));
    const Arguments arguments{"/proc/self/cwd/mine.ply", "--size", "320x240", "--frames", "2"};
    const std::string expected = render_here(arguments + Arguments{"--single"});
    expect_same_pictures(expected, render_here(arguments + cluster->flags()));
    only_file_in(cache_);
}

TEST_F(Remote, CacheThatCannotBeWrittenIsNoHarm) {
    const auto cluster = this->cluster(1, {"--cache", files_.write("file", "in the way")});
    const Arguments arguments = Arguments{model_of_the_client()} + small_;
    const std::string expected = render_here(arguments + Arguments{"--single"});
    for (int run = 0; run < 2; ++run)
        expect_same_pictures(expected, render_here(arguments + cluster->flags()));
}

TEST_F(Remote, ModelBeyondAServersLimitIsRefusedWithTheLimit) {
    const auto cluster = this->cluster(1, {"--max-model-mib", "1"});
    expect_one_error(client(Arguments{"builtin:knot:60000"} + small_ + cluster->flags()), 1,
                     {"server 0 at " + cluster->server_address(0), "limit is 1048576"});
    EXPECT_EQ(client(Arguments{"builtin:knot:6000"} + small_ + cluster->flags()).exit_code, 0);
}

}  // namespace
}  // namespace swath::test
