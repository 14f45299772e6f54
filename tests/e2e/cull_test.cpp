// With every way to cull, the pictures are those of a single process that draws everything.
#include <fmt/core.h>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

const Arguments kCulls{"wide", "a2ssb", "adsb", "none"};
const Arguments kEveryAlgorithm{"hybrid", "mahd", "kd-split", "sort-last"};

class Culling : public EndToEnd {
  protected:
    // Compares every way to cull with every algorithm, on a few numbers of servers.
    void compare(const Arguments& arguments, const std::vector<int>& servers) {
        const std::string expected = render(arguments + Arguments{"--single", "--cull", "none"});
        expect_not_only({16, 18, 24}, expected);
        std::size_t turn = 0;
        for (const std::string& cull : kCulls) {
            expect_same_pictures(expected, render(arguments + Arguments{"--single", "--cull", cull}));
            for (const std::string& algorithm : kEveryAlgorithm) {
                const int n = servers[turn++ % servers.size()];
                SCOPED_TRACE(fmt::format("{} with {} servers that cull by {}", algorithm, n, cull));
                expect_same_pictures(
                    expected, render_on(n, arguments + Arguments{"--algorithm", algorithm, "--cull", cull}));
            }
        }
    }

    // The sum of a counter over the rows of a run's timeline.
    std::uint64_t counted(const Arguments& arguments, const std::string& counter) {
        const std::string file = files_.path_of("counted.csv");
        EXPECT_EQ(client(arguments + Arguments{"--timeline", file}).exit_code, 0);
        const std::string csv = contents(file);
        const std::string key = ",counter," + counter + ",,,,";
        std::uint64_t sum = 0;
        for (auto at = csv.find(key); at != csv.npos; at = csv.find(key, at + 1))
            sum += std::stoull(csv.substr(at + key.size()));
        return sum;
    }

    // Cameras in its streets and houses that look along, across and down.
    Arguments inside_the_town() {
        return {"builtin:town:20000", "--size", "320x240", "--path",
                files_.write("town.txt",
                             "3.5 0.5 3.5  3.5 0.5 20  0 1 0  70\n"
                             "1.5 0.4 1.5  4 0.4 1.2  0 1 0  110\n"
                             "7.5 3 7.5  6 0 6.1  0 1 0  20\n")};
    }
};

TEST_F(Culling, ChangesNoPixelInsideATown) { compare(inside_the_town(), {2, 5, 3}); }

TEST_F(Culling, ChangesNoPixelInsideTheConferenceRoom) {
    SWATH_SHARED_MODEL(conference, "conference.ply");
    const std::string cameras = files_.write("room.txt",
                                             "-700 350 -700  1200 100 300  0 1 0  60\n"
                                             "330 250 -200  1400 150 -200  0 1 0  90\n");
    compare({conference, "--size", "640x480", "--path", cameras}, {4, 2});
}

TEST_F(Culling, ChangesNoPixelInsideASwarmThatMoves) {
    std::string cameras;
    for (int i = 0; i < 8; ++i)
        cameras += fmt::format("{} {} 4  {} 0 0  0 1 0  60\n", 8 - 2 * i, i - 3, 2 * i - 9);
    compare({"builtin:swarm:20000", "--size", "320x240", "--path", files_.write("swarm.txt", cameras),
             "--frames", "32"},
            {3, 2});
}

TEST_F(Culling, ByFewLargeObjectsChangesNoPixelEither) {
    compare(inside_the_town() + Arguments{"--objects", "4"}, {3, 7});
}

TEST_F(Culling, ByThreadsThatWorkTogetherChangesNoPixel) {
    const std::string expected = render(inside_the_town() + Arguments{"--single", "--cull", "none"});
    for (const std::string& cull : kCulls)
        for (const Arguments& where :
             {Arguments{"--single"}, Arguments{"--local", "2", "--algorithm", "mahd"}}) {
            SCOPED_TRACE(cull + " " + where[0]);
            expect_same_pictures(
                expected, render(inside_the_town() + where + Arguments{"--cull", cull, "--threads", "2"}));
        }
}

TEST_F(Culling, DrawsFewerTrianglesThanAllOfThemAndSaysHowMany) {
    const Arguments run = inside_the_town();
    for (const Arguments& where : {Arguments{"--single"}, Arguments{"--local", "3"}}) {
        const std::uint64_t all = counted(run + where + Arguments{"--cull", "none"}, "triangles");
        const std::uint64_t left = counted(run + where, "triangles");
        EXPECT_GT(left, 0u);
        EXPECT_LT(left, all / 2);
        EXPECT_GT(counted(run + where, "leaves"), counted(run + where, "objects") / 2);
    }
    // All ways find the same.
    const std::uint64_t left = counted(run + Arguments{"--single"}, "triangles");
    for (const std::string cull : {"a2ssb", "adsb"})
        EXPECT_EQ(counted(run + Arguments{"--single", "--cull", cull}, "triangles"), left);
}

// Two carpets in one plane, woven of tiles of five materials, and posts of all five through them: depths tie
// between materials everywhere.
class ManyMaterials : public Culling {
  protected:
    std::string model() {
        std::string materials;
        for (int m = 0; m < 5; ++m)
            materials += fmt::format("newmtl m{}\nKd {} {} {}\n", m, 0.2 * m, 1 - 0.2 * m, m % 2);
        files_.write("woven.mtl", materials);
        std::string obj = "mtllib woven.mtl\n";
        int vertex = 0;
        const auto quad = [&](int material, double x, double y, double size) {
            for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
                obj += fmt::format("v {} {} {}\n", x + dx * size, y + dy * size, 0);
            obj += fmt::format("usemtl m{}\nf {} {} {} {}\n", material, vertex + 1, vertex + 2, vertex + 3,
                               vertex + 4);
            vertex += 4;
        };
        for (int i = 0; i < 24; ++i)
            for (int j = 0; j < 24; ++j) {
                quad((i + j) % 5, i, j, 1);
                quad((3 * i + j) % 5, i + 0.25, j + 0.25, 1.5);
            }
        return files_.write("woven.obj", obj);
    }
};

TEST_F(ManyMaterials, LookTheSameFromEveryClusterAndHoweverFinelyTheyAreCut) {
    const Arguments run{model(), "--size", "320x240", "--frames", "3", "--path", "random"};
    const std::string expected = render(run + Arguments{"--single", "--cull", "none"});
    expect_not_only({16, 18, 24}, expected);
    for (const char* depth : {"0", "1", "3", "5", "9"}) {
        const Arguments cut = run + Arguments{"--octree-depth", depth};
        SCOPED_TRACE(depth);
        expect_same_pictures(expected, render(cut + Arguments{"--single"}));
        for (const char* algorithm : {"hybrid", "mahd"})
            expect_same_pictures(expected, render_on(4, cut + Arguments{"--algorithm", algorithm}));
    }
    compare(run, {3});
}

// At depth 0 an object is all triangles of a material.
TEST_F(ManyMaterials, AreObjectsOfTheirOwn) {
    const Arguments run{model(),          "--size", "64x48",    "--frames", "1",
                        "--octree-depth", "0",      "--single", "--cull",   "none"};
    EXPECT_EQ(counted(run, "objects"), 5u);
}

}  // namespace
}  // namespace swath::test
