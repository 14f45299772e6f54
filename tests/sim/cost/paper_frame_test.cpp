#include "sim/cost/paper_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include <map>

namespace swath::sim {
namespace {

// Round numbers: a pixel is read in 1 s and written in 2 s, an operation takes 100 s, a polygon 1 s, a pixel
// of the display 3 s.
Hardware slow() {
    Hardware hardware;
    hardware.server.polygon_s = 1;
    hardware.server.fill_pixels_per_s = 1e9;
    hardware.server.colour = {100, 1, 0.5};
    hardware.server.depth = {100, 1, 0.5};
    hardware.display.colour = {100, 1, 1.0 / 3};
    return hardware;
}

View screen() {
    View view;
    view.width = 40;
    view.height = 10;
    return view;
}

// Two servers whose groups overlap by [18,22) x [2,8): the tiles meet at 20.
struct Overlapping {
    std::vector<ProjectedObject> objects{{{4, 2, 22, 8}, 7, true}, {{18, 2, 36, 8}, 5, true}};
    FramePlan plan{
        0, screen(), {{{0}, {{0, 0, 20, 10}}, {4, 2, 22, 8}}, {{1}, {{20, 0, 40, 10}}, {18, 2, 36, 8}}}};
};

TEST(PaperFrame, OfAHybridReadsAndWritesSwathsBufferByBufferAndSendsWholeTiles) {
    const Overlapping scene;
    const PaperFrame frame = paper_frame(scene.plan, scene.objects, Algorithm::kHybrid, slow());
    ASSERT_EQ(frame.servers.size(), 2u);
    EXPECT_EQ(frame.servers[0].render_s, 7);
    EXPECT_EQ(frame.servers[1].render_s, 5);
    for (const ServerTimes& server : frame.servers) {
        EXPECT_EQ(server.read_s, 2 * (100 + 12));       // 2 x 6 pixels of the other's tile
        EXPECT_EQ(server.write_s, 2 * (100 + 2 * 12));  // and as many come
        EXPECT_EQ(server.final_s, 100 + 16 * 6);        // tile within the region [4,36) x [2,8)
    }
    EXPECT_DOUBLE_EQ(frame.display_s, 2 * (100 + 3 * 16 * 6));
}

TEST(PaperFrame, OfSortFirstRendersTwiceWhatSpansTilesAndExchangesNothing) {
    const std::vector<ProjectedObject> objects{
        {{4, 2, 22, 8}, 7, true}, {{18, 4, 30, 6}, 5, true}, {{35, 2, 36, 8}, 1, true}};
    const FramePlan plan{
        0,
        screen(),
        {{{0, 1}, {{0, 0, 20, 10}}, {4, 2, 20, 8}}, {{0, 1, 2}, {{20, 0, 40, 10}}, {20, 2, 36, 8}}}};
    for (const Algorithm algorithm : {Algorithm::kMahd, Algorithm::kKdSplit}) {
        const PaperFrame frame = paper_frame(plan, objects, algorithm, slow());
        EXPECT_EQ(frame.servers[0].render_s, 12);
        EXPECT_EQ(frame.servers[1].render_s, 13);
        EXPECT_EQ(frame.servers[0].read_s + frame.servers[0].write_s, 0);
        EXPECT_EQ(frame.servers[0].final_s, 100 + 16 * 6);
        EXPECT_EQ(frame.servers[1].final_s, 100 + 16 * 6);
        if (algorithm == Algorithm::kMahd)  // cells of 16 pixels: [0,40) x [0,10) of the screen
            EXPECT_DOUBLE_EQ(frame.display_s, 2 * (100 + 3 * 20 * 10));
        else
            EXPECT_DOUBLE_EQ(frame.display_s, 2 * (100 + 3 * 16 * 6));
    }
}

TEST(PaperFrame, OfSortFirstReadsOnlyWhatIsCovered) {
    const std::vector<ProjectedObject> objects{{{4, 2, 8, 8}, 7, true}, {{30, 4, 36, 6}, 5, true}};
    const FramePlan plan{
        0, screen(), {{{0}, {{0, 0, 20, 10}}, {4, 2, 8, 8}}, {{1}, {{20, 0, 40, 10}}, {30, 4, 36, 6}}}};
    const PaperFrame frame = paper_frame(plan, objects, Algorithm::kKdSplit, slow());
    EXPECT_EQ(frame.servers[0].final_s, 100 + 4 * 6);
    EXPECT_EQ(frame.servers[1].final_s, 100 + 6 * 2);
    EXPECT_DOUBLE_EQ(frame.display_s, 2 * (100 + 3 * 16 * 6));
}

// Server 0 owns the first and third square, server 1 the second and fourth. Server 0 drew in the first three,
// server 1 in the last two.
TEST(PaperFrame, OfSortLastExchangesAndSendsSquareBySquare) {
    const std::vector<ProjectedObject> objects{{{5, 0, 25, 10}, 7, true}, {{24, 0, 38, 10}, 5, true}};
    const FramePlan plan{0,
                         screen(),
                         {{{0}, {{0, 0, 10, 10}, {20, 0, 30, 10}}, {5, 0, 25, 10}},
                          {{1}, {{10, 0, 20, 10}, {30, 0, 40, 10}}, {24, 0, 38, 10}}}};
    const PaperFrame frame = paper_frame(plan, objects, Algorithm::kSortLast, slow());
    EXPECT_EQ(frame.servers[0].read_s, 2 * (100 + 100));
    EXPECT_EQ(frame.servers[1].read_s, 2 * (100 + 60));
    EXPECT_EQ(frame.servers[0].write_s, 2 * (100 + 2 * 60));
    EXPECT_EQ(frame.servers[0].final_s, 100 + 50 + 100 + 100);
    EXPECT_EQ(frame.servers[1].final_s, 100 + 100 + 100 + 80);
    EXPECT_DOUBLE_EQ(frame.display_s, 4 * 100 + 3.0 * (50 + 100 + 100 + 80));
}

TEST(PaperFrame, WithCompositingInHostMemoryReadsAllOnceAndMovesWhatIsActive) {
    Hardware hardware = slow();
    hardware.server.compositing = Compositing::kHost;
    hardware.server.pack_pixels_per_s = 0.1;
    hardware.server.merge_pixels_per_s = 0.05;
    hardware.network.active_share = 0.5;
    hardware.network.tile_active_share = 0.25;
    const Overlapping scene;
    const PaperFrame frame = paper_frame(scene.plan, scene.objects, Algorithm::kHybrid, hardware);
    for (const ServerTimes& server : frame.servers) {
        EXPECT_DOUBLE_EQ(server.read_s, 2 * (100 + 18 * 6) + 10 * 0.5 * 12);
        EXPECT_DOUBLE_EQ(server.write_s, 20 * 0.5 * 12);
        EXPECT_DOUBLE_EQ(server.final_s, 10 * 0.25 * 16 * 6);
    }
    EXPECT_DOUBLE_EQ(frame.display_s, 2 * (100 + 3 * 0.25 * 16 * 6));
}

TEST(PaperFrame, CountsObjectsThatNobodySees) {
    Overlapping scene;
    scene.objects.push_back({{19, 0, 20, 1}, 11, false});
    scene.plan.servers[1].group.push_back(2);  // the content is, as in every plan, of visible objects
    const PaperFrame frame = paper_frame(scene.plan, scene.objects, Algorithm::kHybrid, slow());
    EXPECT_EQ(frame.servers[1].render_s, 16);
    EXPECT_EQ(frame.servers[1].read_s, 2 * (100 + 2 * 8));  // its group now reaches down to y 0
    EXPECT_EQ(frame.servers[0].final_s, 100 + 16 * 8);      // and so does the region
}

// Two frames of two servers; the slower one takes 10 and 8 ms.
PaperMeans two_frames() {
    PaperMeans means;
    means.add({{{6e-3, 2e-3, 1e-3, 1e-3}, {4e-3, 2e-3, 1e-3, 1e-3}}, 4e-3, 30e-3});
    means.add({{{3e-3, 1e-3, 0, 1e-3}, {5e-3, 1e-3, 1e-3, 1e-3}}, 2e-3, 20e-3});
    return means;
}

std::map<std::string, double> columns(const std::vector<Row>& rows) {
    std::map<std::string, double> columns;
    for (const Row& row : rows) {
        EXPECT_EQ(row.algorithm, "any");
        EXPECT_EQ(row.model, "some");
        EXPECT_EQ(row.servers, 2u);
        columns[row.column] = row.value;
    }
    return columns;
}

const Row kOf{"any", "some", 2, "", 0};

TEST(PaperMeans, AreTheColumnsOfTable1AndSumToTheTotal) {
    auto once = columns(two_frames().table1(kOf, Grouping::kExactlyOnce, 4.5e-3));
    EXPECT_NEAR(once.at("server_total"), 9, 1e-9);
    EXPECT_NEAR(once.at("ideal_render"), 4.5, 1e-9);
    EXPECT_NEAR(once.at("pixel_read"), 1.5, 1e-9);
    EXPECT_NEAR(once.at("pixel_write"), 0.75, 1e-9);
    EXPECT_NEAR(once.at("final_read"), 1, 1e-9);
    EXPECT_NEAR(once.at("imbalance"), 1.25, 1e-9);
    EXPECT_NEAR(once.at("display_write"), 25, 1e-9);
    EXPECT_NEAR(once.at("speedup"), 2 * 4.5 / 9.0, 1e-9);
    EXPECT_EQ(once.count("overlap_render"), 0u);
}

TEST(PaperMeans, OfSortFirstHaveOverlapInPlaceOfExchange) {
    auto more = columns(two_frames().table1(kOf, Grouping::kAtLeastOnce, 4e-3));
    EXPECT_NEAR(more.at("overlap_render"), 0.5, 1e-9);
    EXPECT_EQ(more.count("pixel_read") + more.count("pixel_write"), 0u);
}

// Plots refuse negative numbers, and "-0.0" looks like a mistake.
TEST(PaperMeans, TakeNoRoundingForLessThanNothing) {
    PaperMeans means;
    for (int i = 0; i < 3; ++i) means.add({{{0.1, 0, 0, 0.2}, {0.1, 0, 0, 0.2}}, 0, 0});
    for (const double ideal_s : {0.1, 0.1 * (1 + 1e-15), 0.1 * (1 - 1e-15)}) {
        const auto found = columns(means.table1(kOf, Grouping::kAtLeastOnce, ideal_s));
        for (const char* column : {"overlap_render", "imbalance"}) {
            EXPECT_FALSE(std::signbit(found.at(column))) << column << " " << found.at(column);
            EXPECT_NEAR(found.at(column), 0, 1e-9);
        }
    }
}

TEST(PaperMeans, NameTheSlowestStage) {
    auto stages = columns(two_frames().stages(kOf));
    EXPECT_NEAR(stages.at("client"), 3, 1e-9);
    EXPECT_NEAR(stages.at("effective_frame"), 25, 1e-9);  // the display's
}

TEST(PaperMeans, OfPartsAreThoseOfTheWhole) {
    const PaperFrame first{{{6e-3, 2e-3, 1e-3, 1e-3}}, 4e-3, 30e-3};
    const PaperFrame second{{{3e-3, 1e-3, 0, 1e-3}}, 2e-3, 20e-3};
    PaperMeans whole;
    whole.add(first);
    whole.add(second);
    PaperMeans parts;
    PaperMeans part;
    part.add(second);
    parts.add(first);
    parts.add(part);
    EXPECT_EQ(parts.table1(kOf, Grouping::kExactlyOnce, 1), whole.table1(kOf, Grouping::kExactlyOnce, 1));
}

}  // namespace
}  // namespace swath::sim
