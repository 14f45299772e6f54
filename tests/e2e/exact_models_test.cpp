// The same on real models, which have uneven triangles, real depth ties and many materials.
#include <fmt/core.h>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

class RealModel : public EndToEnd {
  protected:
    void compare(const Arguments& arguments, const std::vector<int>& servers) {
        const std::string expected = render(arguments + Arguments{"--single"});
        expect_not_only({16, 18, 24}, expected);
        const auto compare_one = [&](const char* algorithm, int n) {
            SCOPED_TRACE(fmt::format("{} with {} servers", algorithm, n));
            expect_same_pictures(expected, render_on(n, arguments + Arguments{"--algorithm", algorithm}));
        };
        for (const char* algorithm : {"hybrid", "sort-last"})
            for (const int n : servers) compare_one(algorithm, n);
        for (const char* algorithm : {"mahd", "kd-split"}) compare_one(algorithm, servers.back());
    }
};

TEST_F(RealModel, DragonLooksTheSameFromAnyNumberOfServers) {
    SWATH_SHARED_MODEL(dragon, "dragon.ply");
    compare({dragon, "--size", "1279x961", "--frames", "2"}, {1, 2, 3, 5, 8});
}

TEST_F(RealModel, DragonLooksTheSameFromARandomPathWithEgl) {
    SWATH_SHARED_MODEL(dragon, "dragon.ply");
    compare({dragon, "--size", "641x480", "--frames", "3", "--path", "random", "--renderer", "egl"}, {4});
}

TEST_F(RealModel, ConferenceRoomLooksTheSameFromInside) {
    SWATH_SHARED_MODEL(conference, "conference.ply");
    const std::string cameras = files_.write("cameras.txt",
                                             "-700 350 -700  1200 100 300  0 1 0  60\n"
                                             "330 250 -200  1400 150 -200  0 1 0  90\n");
    compare({conference, "--size", "1279x961", "--path", cameras}, {2, 3, 4, 7});
}

TEST_F(RealModel, ConferenceRoomLooksTheSameFromOutside) {
    SWATH_SHARED_MODEL(conference, "conference.ply");
    compare({conference, "--size", "641x480", "--frames", "3", "--objects", "300"}, {3});
}

TEST_F(RealModel, GltfEngineLooksTheSame) {
    SWATH_SHARED_MODEL(engine, "engine/2CylinderEngine.gltf");
    compare({engine, "--size", "641x480", "--frames", "2"}, {2, 5});
}

TEST_F(RealModel, GltfHouseLooksTheSame) {
    SWATH_SHARED_MODEL(house, "house/scene.gltf");
    compare({house, "--size", "641x480", "--frames", "2"}, {3});
}

TEST_F(RealModel, ObjFigureLooksTheSame) {
    SWATH_SHARED_MODEL(figure, "female02/female02.obj");
    compare({figure, "--size", "641x480", "--frames", "2", "--background", "ffffff"}, {3, 16});
}

}  // namespace
}  // namespace swath::test
