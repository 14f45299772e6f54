#include "sim/experiment/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "common/base/check.h"
#include "sim/hardware/hardware.h"

namespace swath::sim {
namespace {

// All algorithms on a small model, each on three paths.
class Experiments : public testing::Test {
  protected:
    Experiments() {
        for (const Algorithm algorithm : kAll<Algorithm>)
            for (const std::size_t servers : {1u, 3u, 8u}) {
                Experiment e;
                e.model = &model_;
                e.paths = &paths_;
                e.hardware = &hardware_;
                e.algorithm = algorithm;
                e.servers = servers;
                e.width = 320;
                e.height = 240;
                e.algorithm_name = std::string(name_of(algorithm));
                e.model_name = "knot";
                experiments_.push_back(e);
            }
    }

    std::vector<Row> rows(std::size_t threads) const {
        const auto outcomes = run_experiments(experiments_, threads, [](std::size_t, const Outcome&) {});
        std::vector<Row> rows;
        for (std::size_t i = 0; i < outcomes.size(); ++i)
            std::ranges::move(all_rows(experiments_[i], outcomes[i]), std::back_inserter(rows));
        return rows;
    }

    const StudyModel model_ = *load_study_model("knot", "builtin:knot:3000", {3, 0});
    const Hardware hardware_ = *find_hardware("paper-2000");
    const Paths paths_ = *make_paths({"random", 4, 1, 1, 3}, model_.scene.bounds, 320, 240);
    std::vector<Experiment> experiments_;
};

TEST_F(Experiments, HaveTheSameOutcomesOnAnyNumberOfThreads) {
    const std::vector<Row> expected = rows(1);
    EXPECT_FALSE(expected.empty());
    for (const std::size_t threads : {2u, 3u, 16u, 100u}) EXPECT_EQ(rows(threads), expected) << threads;
}

TEST_F(Experiments, AreReportedOnceEach) {
    std::vector<int> reported(experiments_.size());
    std::vector<std::vector<Row>> when_reported(experiments_.size());
    const auto outcomes = run_experiments(experiments_, 3, [&](std::size_t i, const Outcome& outcome) {
        ++reported[i];
        when_reported[i] = all_rows(experiments_[i], outcome);
    });
    for (std::size_t i = 0; i < experiments_.size(); ++i) {
        EXPECT_EQ(reported[i], 1) << i;
        EXPECT_EQ(when_reported[i], all_rows(experiments_[i], outcomes[i])) << i;
    }
    EXPECT_TRUE(run_experiments({}, 3, [](std::size_t, const Outcome&) { FAIL(); }).empty());
}

TEST_F(Experiments, AnExceptionInOneReachesTheCaller) {
    experiments_[5].servers = 0;  // no partitioner takes that
    for (const std::size_t threads : {1u, 3u}) EXPECT_THROW(rows(threads), CheckFailed) << threads;
}

TEST_F(Experiments, AnExceptionInTheReportReachesTheCallerAndEndsTheRun) {
    for (const std::size_t threads : {1u, 3u}) {
        std::size_t reports = 0;
        EXPECT_THROW(run_experiments(experiments_, threads,
                                     [&](std::size_t, const Outcome&) {
                                         ++reports;
                                         throw std::runtime_error("full");
                                     }),
                     std::runtime_error);
        EXPECT_LE(reports, threads);
    }
}

TEST_F(Experiments, PaperMeansAreThoseOfALoopOverAllFrames) {
    const auto outcomes = run_experiments(experiments_, 2, [](std::size_t, const Outcome&) {});
    for (std::size_t i = 0; i < experiments_.size(); ++i) {
        const Experiment& e = experiments_[i];
        const auto& objects = model_.scene.objects;
        const auto partitioner = make_partitioner(e.algorithm, objects);
        PaperMeans means;
        for (const auto& cameras : paths_)
            for (const Camera& camera : cameras) {
                const View view = make_view(camera, e.width, e.height);
                const auto projected = project(objects, view, Accounting::kPaper);
                const FramePlan plan = partitioner->partition({0, view, projected, e.servers});
                means.add(paper_frame(plan, projected, e.algorithm, hardware_));
            }
        const double ideal_s = static_cast<double>(model_.scene.mesh.triangle_count()) *
                               hardware_.server.polygon_s / static_cast<double>(e.servers);
        const auto expected = means.table1(e.label(), grouping_of(e.algorithm), ideal_s);
        const auto actual = table1_rows(e, outcomes[i]);
        ASSERT_EQ(actual.size(), expected.size());
        for (std::size_t r = 0; r < expected.size(); ++r) {
            EXPECT_EQ(actual[r].column, expected[r].column);
            EXPECT_NEAR(actual[r].value, expected[r].value, 1e-9 * (1 + expected[r].value))
                << e.algorithm_name << " " << e.servers << " " << expected[r].column;
        }
    }
}

TEST_F(Experiments, FullMeansAreThoseOfThePaths) {
    const Experiment& e = experiments_[2];
    FullMeans means;
    double frame_s = 0;
    for (const auto& cameras : paths_) {
        const auto costs = simulate({model_.scene.objects, cameras, e.width, e.height, e.algorithm, e.servers,
                                     e.frames_in_flight, hardware_, false});
        means.add(costs);
        frame_s += costs.frame_s / static_cast<double>(paths_.size());
    }
    EXPECT_DOUBLE_EQ(means.frame_s(), frame_s);
    const auto outcomes = run_experiments(experiments_, 2, [](std::size_t, const Outcome&) {});
    EXPECT_EQ(outcomes[2].full.rows(e.label()), means.rows(e.label()));
    experiments_[2].full = false;
    const auto without = run_experiments(experiments_, 2, [](std::size_t, const Outcome&) {});
    EXPECT_TRUE(without[2].full.empty());
    for (const Row& row : all_rows(experiments_[2], without[2]))
        EXPECT_FALSE(row.column.starts_with("full_") || row.column.starts_with("busy_")) << row.column;
}

}  // namespace
}  // namespace swath::sim
