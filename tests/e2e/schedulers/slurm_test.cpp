// docker/slurm/swath.sbatch on a Slurm cluster of this machine.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "common/wire/address.h"
#include "tests/e2e/schedulers/slurm_cluster.h"
#include "tests/support/web_client.h"

namespace swath::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kNodes = 3;
constexpr std::chrono::seconds kJobGone(5);
const Arguments kFrames{"builtin:knot:20000", "--frames", "3", "--size", "320x240"};
const Arguments kEndless{"builtin:knot:20000", "--frames", "1000000", "--size", "160x120"};

class Slurm : public EndToEnd {
  protected:
    void SetUp() override {
        if (const std::string missing = SlurmCluster::missing(); !missing.empty()) GTEST_SKIP() << missing;
        fs::create_directories(submitted_from_);
        fs::create_directories(temporary_);
        cluster_ = std::make_unique<SlurmCluster>(files_.path_of("slurm"), kNodes);
    }
    void TearDown() override {
        cluster_.reset();
        if (HasFailure())
            for (const std::string& name : file_names(submitted_from_))
                if (name.starts_with("swath-"))
                    ADD_FAILURE() << name << ":\n" << contents(submitted_from_ / name);
        EXPECT_TRUE(!fs::exists(temporary_) || fs::is_empty(temporary_)) << "a cache is left";
        EndToEnd::TearDown();
    }

    std::string submit(const Arguments& sbatch, const Arguments& swath,
                       const std::string& programs = SWATH_PROGRAMS) const {
        return cluster_->submit(submitted_from_, sbatch, swath,
                                {"SWATH_BIN=" + programs, "TMPDIR=" + temporary_.string()});
    }
    std::string output(const std::string& job, const std::string& what = ".out") const {
        return contents(submitted_from_ / ("swath-" + job + what));
    }
    // Waits until the client has reached all servers and draws.
    bool draws(const std::string& job) const {
        return eventually([&] { return output(job).find(" are ready") != std::string::npos; });
    }
    static std::vector<pid_t> running(const std::string& program) {
        std::vector<pid_t> all = living_descendants(::getpid());
        std::erase_if(all, [&](pid_t pid) { return program_of(pid) != program; });
        return all;
    }
    static bool nothing_runs_after(std::chrono::milliseconds limit) {
        return eventually(
            [] {
                return running("swath-server").empty() && running("swath-display").empty() &&
                       running("swath-client").empty();
            },
            limit);
    }
    void expect_exact(const std::string& job, const Arguments& arguments) {
        EXPECT_EQ(cluster_->end_of(job), "COMPLETED 0:0");
        expect_same_pictures(render(arguments + Arguments{"--single"}), submitted_from_ / "out");
    }

    const fs::path submitted_from_ = files_.path_of("submitted from here");
    const fs::path temporary_ = files_.path_of("tmp");
    std::unique_ptr<SlurmCluster> cluster_;
};

TEST_F(Slurm, AJobOnSeveralNodesDrawsWhatOneProcessDraws) {
    const std::string job = submit({"--nodes=3"}, kFrames + Arguments{"--out", "out"});
    expect_exact(job, kFrames);
    EXPECT_THAT(output(job),
                AllOf(HasSubstr("server 0   n1, 127.0.0.1:"), HasSubstr("server 1   n2, 127.0.0.2:"),
                      HasSubstr("server 2   n3, 127.0.0.3:"), Not(HasSubstr("server 3   "))));
}

TEST_F(Slurm, EveryTaskOfANodeIsAServerWithTheCoresOfTheTask) {
    const std::string job = submit({"--nodes=2", "--ntasks-per-node=2", "--cpus-per-task=2"},
                                   kFrames + Arguments{"--out", "out"});
    expect_exact(job, kFrames);
    EXPECT_THAT(output(job), AllOf(HasSubstr("server 1   n1, "), HasSubstr("server 3   n2, ")));
    EXPECT_THAT(output(job, "-servers.log"),
                AllOf(HasSubstr("0: node n1, 2 cores"), HasSubstr("3: node n2, 2 cores")));
}

TEST_F(Slurm, TasksThatAskForNoCoresShareTheirNode) {
    const std::string job =
        submit({"--nodes=2", "--ntasks=3", "--exclusive"}, kFrames + Arguments{"--out", "out"});
    expect_exact(job, kFrames);
    EXPECT_THAT(output(job, "-servers.log"),
                AllOf(HasSubstr("0: node n1, 2 cores"), HasSubstr("1: node n1, 2 cores"),
                      HasSubstr("2: node n2, 4 cores")));
}

TEST_F(Slurm, AModelFileIsFoundFromTheFolderOfSubmission) {
    std::ofstream(submitted_from_ / "two triangles.ply")
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n0 1 0\n1 1 0.5\n3 0 1 2\n3 1 3 2\n";
    const Arguments flags{"--frames", "2", "--size", "160x120"};
    const std::string job =
        submit({"--ntasks=2"}, Arguments{"two triangles.ply"} + flags + Arguments{"--out", "out"});
    expect_exact(job, Arguments{(submitted_from_ / "two triangles.ply").string()} + flags);
}

TEST_F(Slurm, ACancelledJobEndsWithinSecondsAndLeavesNothing) {
    const std::string job = submit({"--nodes=2", "--ntasks-per-node=2"}, kEndless);
    ASSERT_TRUE(draws(job));
    ASSERT_EQ(running("swath-server").size(), 4U);
    cluster_->cancel(job);
    EXPECT_TRUE(nothing_runs_after(kJobGone));
    EXPECT_THAT(cluster_->end_of(job), HasSubstr("CANCELLED"));
}

TEST_F(Slurm, AServerThatDiesFailsTheJobWithALineThatNamesIt) {
    const std::string job = submit({"--nodes=3"}, kEndless);
    ASSERT_TRUE(draws(job));
    ::kill(running("swath-server").front(), SIGKILL);
    EXPECT_EQ(cluster_->end_of(job), "FAILED 1:0");
    EXPECT_THAT(output(job), testing::ContainsRegex("error: .*server [0-2] at 127\\.0\\.0\\.[1-3]:"));
    EXPECT_TRUE(nothing_runs_after(kJobGone));
}

TEST_F(Slurm, ADisplayThatDiesFailsTheJobWithALineThatNamesIt) {
    const std::string job = submit({"--ntasks=2"}, kEndless);
    ASSERT_TRUE(draws(job));
    ::kill(running("swath-display").front(), SIGKILL);
    EXPECT_EQ(cluster_->end_of(job), "FAILED 1:0");
    // A server may notice before the client does: "error: server 0 at ...: lost the display at ...".
    EXPECT_THAT(output(job), AllOf(testing::ContainsRegex("error: .*display at 127\\.0\\.0\\.1:"),
                                   HasSubstr("the display ended: code 137")));
    EXPECT_TRUE(nothing_runs_after(kJobGone));
}

TEST_F(Slurm, WhatCannotBeDoneFailsTheJobWithOneClearLine) {
    // One node lacks the server that the first one has.
    const fs::path some = files_.path_of("some");
    fs::create_directories(some);
    for (const char* program : {"swath-client", "swath-display"})
        fs::create_symlink(fs::path(SWATH_PROGRAMS) / program, some / program);
    const std::string no_model = submit({"--ntasks=2"}, {"nosuch.ply"});
    const std::string bad_flag = submit({"--ntasks=2"}, {"builtin:knot", "--nosuch"});
    const std::string no_programs = submit({"--ntasks=2"}, kFrames, "/nosuch");
    const std::string no_server = submit({"--nodes=2"}, kFrames, some);

    EXPECT_EQ(cluster_->end_of(no_model), "FAILED 1:0");
    EXPECT_THAT(output(no_model), HasSubstr("error: nosuch.ply: No such file or directory\n"));
    EXPECT_EQ(cluster_->end_of(bad_flag), "FAILED 2:0");
    EXPECT_THAT(output(bad_flag), HasSubstr("--nosuch"));
    EXPECT_EQ(cluster_->end_of(no_programs), "FAILED 1:0");
    EXPECT_THAT(output(no_programs),
                testing::ContainsRegex("^swath.sbatch: no /nosuch/swath-client on n[1-3]: "));
    EXPECT_EQ(cluster_->end_of(no_server), "FAILED 1:0");
    EXPECT_THAT(output(no_server),
                testing::ContainsRegex("^swath.sbatch: a server did not start: [01]: error: "
                                       "no .*/some/swath-server on n[1-3] "));
}

TEST_F(Slurm, TheLivePageIsReachedThroughATunnelWithItsToken) {
    const std::string job = submit({"--nodes=2"}, {"builtin:knot:20000", "--view"});
    ASSERT_TRUE(draws(job));
    const std::string out = output(job);
    const auto after = [&](const std::string& text, char end) {
        const auto begin = out.find(text) + text.size();
        return out.substr(begin, out.find(end, begin) - begin);
    };
    // Asks as the tunnel does: at the node's address, with the Host that the person's browser sends.
    const auto page = parse_address(after("ssh -L 8080:", ' '));
    ASSERT_TRUE(page.has_value()) << out;
    const std::string path = after("then open:  http://127.0.0.1:8080", '\n');
    const auto get = [&](const std::string& target) {
        return http_exchange(
                   *page, "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:8080\r\nConnection: close\r\n\r\n")
            .status;
    };
    EXPECT_EQ(get(path), 200) << path;
    EXPECT_EQ(get("/"), 403);
    // Nobody else may read the token.
    for (const char* file : {".out", "-display.log"}) {
        struct stat status {};
        ASSERT_EQ(::stat((submitted_from_ / ("swath-" + job + file)).c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 077U, 0U) << file;
    }
    cluster_->cancel(job);
    EXPECT_TRUE(nothing_runs_after(kJobGone));
    EXPECT_THAT(cluster_->end_of(job), HasSubstr("CANCELLED"));
}

TEST(SlurmScript, ExplainsItselfWithoutSlurm) {
    const auto run = [](const Arguments& arguments) {
        return Process(SWATH_SBATCH, arguments, {{"SLURM_JOB_ID=", "SLURMD_NODENAME="}, {}}).wait(kPatience);
    };
    EXPECT_EQ(run({"--help"}).exit_code, 0);
    EXPECT_THAT(run({"--help"}).out, HasSubstr("Usage: sbatch "));
    const Finished outside = run({"builtin:knot"});
    EXPECT_EQ(outside.exit_code, 1);
    EXPECT_EQ(outside.err, "swath.sbatch: not on a node of a job: submit it with sbatch (see --help)\n");
}

}  // namespace
}  // namespace swath::test
