#include "sim/sweep/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sim/sweep/journal_file.h"
#include "tests/support/models.h"

namespace swath::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string contents(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

ScenarioOptions small_sweep() {
    ScenarioOptions options;
    options.models = {{"knot", "builtin:knot:300"}};
    options.algorithms = {Algorithm::kHybrid, Algorithm::kSortLast};
    options.servers = {1, 2};
    options.hardware = {"paper-2000"};
    options.sizes = {{64, 48}};
    options.granularities = {{1, 0}};
    options.path.frames = 2;
    options.path.seeds = 2;
    return options;
}

class Sweep : public testing::Test {
  protected:
    Result<SweepResult> run(const std::string& folder, std::size_t threads = 1) {
        return run_on(*scenario_, folder, threads);
    }
    Result<SweepResult> run_on(const Scenario& scenario, const std::string& folder, std::size_t threads = 1) {
        SweepOptions options{small_sweep(), files_.path_of(folder), true};
        options.scenario.threads = threads;
        testing::internal::CaptureStderr();
        auto result = run_sweep(scenario, options, SteadyClock());
        notices_ = testing::internal::GetCapturedStderr();
        return result;
    }
    std::string table(const std::string& folder) const {
        return contents(files_.path_of(folder + "/sweep.csv"));
    }
    std::string journal_path(const std::string& folder) const {
        return files_.path_of(folder + "/sweep.journal");
    }
    std::string journal(const std::string& folder) const { return contents(journal_path(folder)); }
    void write_journal(const std::string& folder, std::string_view text) const {
        std::filesystem::create_directories(files_.path_of(folder));
        files_.write(folder + "/sweep.journal", text);
    }

    swath::test::TemporaryFolder files_;
    const Result<Scenario> scenario_ = Scenario::load(small_sweep());
    std::string notices_;
};

TEST_F(Sweep, LeavesTheTableOfARun) {
    const auto result = run("out");
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->table, files_.path_of("out/sweep.csv"));
    EXPECT_EQ(result->experiments, 4u);
    EXPECT_EQ(result->from_before, 0u);
    EXPECT_EQ(notices_, "");
    const auto& experiments = scenario_->experiments();
    const auto outcomes = run_experiments(experiments, 1, [](std::size_t, const Outcome&) {});
    std::vector<Row> rows;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
        std::ranges::move(all_rows(experiments[i], outcomes[i]), std::back_inserter(rows));
    EXPECT_EQ(table("out"), to_csv(rows));
}

TEST_F(Sweep, LeavesTheSameBytesWhateverTheThreads) {
    ASSERT_TRUE(run("one", 1));
    for (int i = 0; i < 5; ++i) {
        const std::string folder = "three" + std::to_string(i);
        ASSERT_TRUE(run(folder, 3));
        EXPECT_EQ(table(folder), table("one"));
    }
}

TEST_F(Sweep, ThatIsCompleteRunsNothingAndWritesTheSameTable) {
    ASSERT_TRUE(run("out"));
    const std::string before = table("out");
    const std::string kept = journal("out");
    std::filesystem::remove(files_.path_of("out/sweep.csv"));
    const auto again = run("out");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->from_before, 4u);
    EXPECT_EQ(table("out"), before);
    EXPECT_EQ(journal("out"), kept);
    EXPECT_EQ(notices_, "");
}

TEST_F(Sweep, InterruptedAtAnyByteGoesOnToTheSameTable) {
    ASSERT_TRUE(run("whole"));
    const std::string whole = journal("whole");
    const std::string head = journal_head(scenario_->settings());
    ASSERT_TRUE(whole.starts_with(head));
    const std::size_t last =
        whole.rfind("# complete", whole.rfind("# complete") - 1);  // ends the last but one
    std::vector<std::size_t> sizes{0, 1, head.size() / 2, head.size() - 1, head.size()};
    for (std::size_t size = head.size(); size < last; size += 13) sizes.push_back(size);
    for (std::size_t size = last; size <= whole.size(); ++size) sizes.push_back(size);
    for (const std::size_t size : sizes) {
        write_journal("cut", std::string_view(whole).substr(0, size));
        const auto result = run("cut", 1 + size % 3);
        ASSERT_TRUE(result) << size << ": " << result.error().message;
        ASSERT_EQ(table("cut"), table("whole")) << size;
        // Only missing experiments are run: the entries that were there stay in place.
        ASSERT_EQ(journal("cut").size(), whole.size()) << size;
        const std::string_view lines = std::string_view(whole).substr(0, whole.rfind('\n', size - 1) + 1);
        if (const auto end = lines.rfind("\n# complete"); size > head.size() && end != lines.npos) {
            ASSERT_TRUE(journal("cut").starts_with(lines.substr(0, end))) << size;
        }
        ASSERT_LE(std::ranges::count(notices_, '\n'), 1) << notices_;
    }
}

TEST_F(Sweep, TellsThatAnEntryWasCutOff) {
    ASSERT_TRUE(run("out"));
    const std::string whole = journal("out");
    write_journal("out", std::string_view(whole).substr(0, whole.size() - 5));
    const auto result = run("out");
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->from_before, 3u);
    EXPECT_EQ(notices_, "notice: " + journal_path("out") + ": the last entry was cut off and is run again\n");
}

TEST_F(Sweep, TouchesNothingWhereTheJournalIsNotItsOwn) {
    ASSERT_TRUE(run("out"));
    ScenarioOptions changed = small_sweep();
    changed.path.frames = 3;
    const auto other = Scenario::load(changed);
    ASSERT_TRUE(other);
    const std::string kept = journal("out") + "hybrid,";  // not even the cut-off entry goes
    write_journal("out", kept);
    files_.write("out/sweep.csv", "kept");
    const auto result = run_on(*other, "out");
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, StartsWith(journal_path("out") + ":2: the journal of another sweep"));
    EXPECT_EQ(journal("out"), kept);
    EXPECT_EQ(table("out"), "kept");
}

TEST_F(Sweep, TouchesNothingWhereTheJournalIsDamaged) {
    ASSERT_TRUE(run("out"));
    std::string damaged = journal("out");
    damaged.insert(damaged.find("# complete"), "garbage\n");
    damaged += "hybrid,";
    write_journal("out", damaged);
    files_.write("out/sweep.csv", "kept");
    const auto result = run("out");
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, StartsWith(journal_path("out") + ":"));
    EXPECT_EQ(journal("out"), damaged);
    EXPECT_EQ(table("out"), "kept");
}

TEST_F(Sweep, RefusesASecondOneInTheSameFolder) {
    std::filesystem::create_directories(files_.path_of("out"));
    std::vector<Row> labels;
    for (const Experiment& e : scenario_->experiments()) labels.push_back(e.label());
    {
        const auto first =
            JournalFile::open(journal_path("out"), journal_head(scenario_->settings()), labels);
        ASSERT_TRUE(first) << first.error().message;
        const auto second = run("out");
        ASSERT_FALSE(second);
        EXPECT_EQ(second.error().message, journal_path("out") + ": another sweep is at work in this folder");
    }
    EXPECT_TRUE(run("out"));
}

TEST_F(Sweep, NamesAFolderThatIsNone) {
    files_.write("file", "kept");
    EXPECT_THAT(run("file").error().message, AllOf(StartsWith("--out: "), HasSubstr(files_.path_of("file"))));
    EXPECT_EQ(contents(files_.path_of("file")), "kept");
    EXPECT_THAT(run("file/below").error().message, HasSubstr(files_.path_of("file/below")));
    std::filesystem::create_directories(files_.path_of("taken/sweep.csv"));
    EXPECT_EQ(run("taken").error().message,
              "--out: " + files_.path_of("taken/sweep.csv") + ": not a regular file");
    EXPECT_FALSE(std::filesystem::exists(journal_path("taken"))) << "nothing was begun";
    std::filesystem::create_directories(files_.path_of("odd/sweep.journal"));
    EXPECT_THAT(run("odd").error().message, StartsWith(journal_path("odd") + ": "));
}

// While this lives, files of this process end at so many bytes, as on a full disk.
class FullDisk {
  public:
    explicit FullDisk(std::size_t bytes) {
        before_signal_ = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, before_signal_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before_{};
    void (*before_signal_)(int) = nullptr;
};

TEST_F(Sweep, LosesNothingWhenTheDiskIsFull) {
    ASSERT_TRUE(run("whole"));
    const std::size_t head = journal_head(scenario_->settings()).size();
    const std::size_t size = journal("whole").size();
    std::size_t most = 0;
    for (const std::size_t limit : {head - 1, head + 1, (head + size) / 2, size - 1}) {
        const std::string folder = "full" + std::to_string(limit);
        {
            const FullDisk disk(limit);
            // CaptureStderr has a file, too.
            SweepOptions options{small_sweep(), files_.path_of(folder), true};
            options.scenario.threads = 3;
            const auto result = run_sweep(*scenario_, options, SteadyClock());
            ASSERT_FALSE(result) << limit;
            EXPECT_EQ(result.error().message, journal_path(folder) + ": File too large");
        }
        EXPECT_FALSE(std::filesystem::exists(files_.path_of(folder + "/sweep.csv")));
        const auto result = run(folder);
        ASSERT_TRUE(result) << result.error().message;
        most = std::max(most, result->from_before);
        EXPECT_EQ(table(folder), table("whole"));
    }
    EXPECT_EQ(most, 3u);
}

}  // namespace
}  // namespace swath::sim
