// Table 1 of Samanta 2000 with the real Dragon, as in the paper's study: 50 frames, several seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "sim/studies/published.h"
#include "sim/studies/study.h"
#include "tests/support/models.h"

namespace swath::sim {
namespace {

class Table1 : public testing::TestWithParam<std::uint64_t> {
  protected:
    void SetUp() override {
        SWATH_SHARED_MODEL(dragon, "dragon.ply");
        StudyOptions options;
        options.names = {"feasibility"};
        options.models = {{"dragon", dragon}};
        options.seed = GetParam();
        options.threads = std::max(1u, std::thread::hardware_concurrency());
        options.quiet = true;
        options.out = files_.path_of("out");
        const Status status = run_studies(options);
        ASSERT_TRUE(status) << status.error().message;
        auto table = read_table(options.out / "table1.csv");
        ASSERT_TRUE(table) << table.error().message;
        rows_ = std::move(*table);
    }

    // The table also has the Hand's stand-in.
    double ours(const std::string& algorithm, std::size_t servers, const std::string& column) const {
        for (const Row& row : rows_)
            if (row.algorithm == algorithm && row.model == "dragon" && row.servers == servers &&
                row.column == column)
                return row.value;
        ADD_FAILURE() << algorithm << ", " << servers << ": no " << column;
        return 0;
    }

    // |ours / paper - 1| over the numbers of servers, in per cent.
    struct Deviation {
        double mean = 0;
        double largest = 0;
    };
    Deviation deviation(const std::string& algorithm, const std::string& column) const {
        Deviation found;
        for (const std::size_t servers : {8u, 16u, 32u, 64u}) {
            const double paper = published(algorithm, "dragon", servers, column).value();
            const double off = std::abs(ours(algorithm, servers, column) / paper - 1) * 100;
            found.mean += off / 4;
            found.largest = std::max(found.largest, off);
        }
        return found;
    }

    swath::test::TemporaryFolder files_;
    std::vector<Row> rows_;
};

TEST_P(Table1, IsReproducedWithTheDragon) {
    if (IsSkipped()) return;
    EXPECT_LE(deviation("hybrid", "speedup").mean, 1.5);
    EXPECT_LE(deviation("hybrid", "speedup").largest, 3);
    EXPECT_LE(deviation("hybrid", "server_total").largest, 1.5);
    EXPECT_LE(deviation("hybrid", "display_write").largest, 3);
    EXPECT_LE(deviation("sort-first", "speedup").mean, 5);
    EXPECT_LE(deviation("sort-last", "speedup").mean, 6);
    for (const std::size_t servers : {8u, 16u, 32u, 64u})
        EXPECT_NEAR(ours("hybrid", servers, "ideal_render"),
                    published("hybrid", "dragon", servers, "ideal_render").value(), 0.1);
    EXPECT_GT(ours("hybrid", 64, "speedup"), ours("sort-last", 64, "speedup"));
    EXPECT_GT(ours("sort-last", 64, "speedup"), ours("sort-first", 64, "speedup"));
    EXPECT_EQ(ours("model", 0, "objects"), 1259);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Table1, testing::Values(1u, 101u, 1'000'003u));

}  // namespace
}  // namespace swath::sim
