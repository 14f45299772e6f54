// Servers with our own rasteriser or ray caster: their pictures are those of a single process that has it, byte for byte;
// in a cluster of several kinds they are nearly those of OpenGL.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>

#include "common/image/picture.h"
#include "common/octree/sah/sah_builder.h"
#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

constexpr const char* kAlgorithms[] = {"hybrid", "mahd", "kd-split", "sort-last"};
const Arguments kPicture{"--size", "83x62", "--frames", "2", "--path", "random", "--seed", "5"};

Result<Picture> picture_of(const std::string& file) {
    const std::string bytes = contents(file);
    return decode_png({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

class OwnRenderers : public EndToEnd {
  protected:
    // Tries all algorithms with all numbers of servers, or only one in `every` of these combinations.
    void compare(const Arguments& run, int every = 1) {
        const std::string expected = render(run + Arguments{"--single"});
        expect_not_only({16, 18, 24}, expected);
        int turn = 0;
        for (int servers = 1; servers <= 9; ++servers)
            for (const char* algorithm : kAlgorithms) {
                if (turn++ % every != 0) continue;
                SCOPED_TRACE(fmt::format("{} with {} servers", algorithm, servers));
                expect_same_pictures(expected, render_on(servers, run + Arguments{"--algorithm", algorithm}));
            }
    }
};

TEST_F(OwnRenderers, RasterisedPicturesEqualThoseOfASingleProcess) {
    compare(kPicture + Arguments{"builtin:knot:3000", "--renderer", "raster"});
    compare(kPicture + Arguments{"builtin:town:3000", "--renderer", "raster"}, 3);
    compare(kPicture + Arguments{"builtin:swarm:2000", "--renderer", "raster"}, 3);
    compare(kPicture + Arguments{"builtin:town:3000", "--renderer", "raster", "--objects-by", "sah",
                                 "--objects", "200"},
            5);
}

TEST_F(OwnRenderers, RasterisedPicturesDependNeitherOnThreadsNorOnCulling) {
    const Arguments run = Arguments{"builtin:town:3000", "--renderer", "raster", "--single"} + kPicture;
    const std::string expected = render(run);
    expect_same_pictures(expected, render(run + Arguments{"--threads", "3"}));
    for (const char* cull : {"none", "a2ssb", "adsb"})
        expect_same_pictures(expected, render(run + Arguments{"--cull", cull}));
}

TEST_F(OwnRenderers, PicturesOfRaysEqualThoseOfASingleProcess) {
    compare(kPicture + Arguments{"builtin:knot:3000", "--renderer", "raycast"});
}

TEST_F(OwnRenderers, PicturesWithShadowsEqualThoseOfASingleProcess) {
    compare(Arguments{"builtin:knot:1000", "--renderer", "raycast", "--shadows"} + kPicture);
}

TEST_F(OwnRenderers, PicturesOfTreesThatAreBuiltForEachFrameEqualThoseOfASingleProcess) {
    compare(Arguments{"builtin:spheres:3000", "--renderer", "raycast", "--dynamic"} + kPicture);
}

// Every frame has another pose.
TEST_F(OwnRenderers, PicturesOfAModelThatMovesEqualThoseOfASingleProcess) {
    const Arguments run = Arguments{"builtin:swarm:2000",
                                    "--renderer",
                                    "raycast",
                                    "--frames",
                                    "5",
                                    "--size",
                                    "61x47",
                                    "--path",
                                    "random"};
    compare(run + Arguments{"--dynamic"});
    // The trees over the whole model move as well.
    compare(run, 5);
    compare(run + Arguments{"--dynamic", "--shadows"}, 5);
}

// Where faces coincide, the order of the cut decides which shows.
TEST_F(OwnRenderers, PicturesOfSahObjectsEqualThoseOfASingleProcess) {
    const Arguments run =
        Arguments{"builtin:town:3000", "--objects-by", "sah", "--objects", "200"} + kPicture;
    compare(run + Arguments{"--renderer", "raycast"});
    // A fifth of the combinations still has every algorithm and nearly every number.
    compare(run + Arguments{"--renderer", std::string(name_of(gl_here()))}, 5);
}

TEST_F(OwnRenderers, PicturesDependNeitherOnThreadsNorOnATreeBuiltForEachFrame) {
    const Arguments run = Arguments{"builtin:knot:3000", "--renderer", "raycast", "--single"} + kPicture;
    const std::string expected = render(run);
    expect_same_pictures(expected, render(run + Arguments{"--threads", "3"}));
    expect_same_pictures(expected, render(run + Arguments{"--dynamic"}));
}

TEST_F(OwnRenderers, ShadowsMakePicturesDarker) {
    const Arguments run = Arguments{"builtin:town:2000", "--renderer", "raycast", "--single"} + kPicture;
    const std::string lit = render(run);
    const std::string shadowed = render(run + Arguments{"--shadows"});
    for (const std::string& name : file_names(lit)) {
        const auto light = picture_of(lit + "/" + name);
        const auto dark = picture_of(shadowed + "/" + name);
        ASSERT_TRUE(light && dark);
        for (std::size_t i = 0; i < light->rgb.size(); ++i) ASSERT_LE(dark->rgb[i], light->rgb[i]);
    }
}

// The share of pixels in which a channel differs by more than this.
double share_of_different(const std::string& one, const std::string& other, int more_than) {
    std::size_t pixels = 0;
    std::size_t different = 0;
    for (const std::string& name : file_names(one)) {
        const auto a = picture_of(one + "/" + name);
        const auto b = picture_of(other + "/" + name);
        if (!a || !b || a->rgb.size() != b->rgb.size()) return 1;
        for (std::size_t i = 0; i < a->rgb.size(); i += 3) {
            ++pixels;
            int most = 0;
            for (std::size_t k = i; k < i + 3; ++k) most = std::max(most, std::abs(a->rgb[k] - b->rgb[k]));
            if (most > more_than) ++different;
        }
    }
    return static_cast<double>(different) / static_cast<double>(pixels);
}

// Counts the log's lines that there is no device for building trees.
std::size_t times_missing(const std::string& log) {
    std::size_t times = 0;
    const std::string line = "--trees-on cuda: " + missing_cuda();
    for (std::size_t at = log.find(line); at != std::string::npos; at = log.find(line, at + 1)) ++times;
    return times;
}

TEST_F(OwnRenderers, WithoutACudaDeviceTheLogSaysOnceThatThreadsBuildTheTrees) {
    const std::size_t once = missing_cuda().empty() ? 0 : 1;
    const Arguments run = Arguments{"builtin:knot:2000", "--renderer", "raycast", "--dynamic"} + kPicture;
    const std::string expected = render(run + Arguments{"--single"});
    int number = 0;
    for (const Arguments& where : {Arguments{"--single"}, Arguments{"--local", "3"}}) {
        const std::string folder = files_.path_of(fmt::format("cuda_{}", ++number));
        const Finished finished = client(run + where + Arguments{"--trees-on", "cuda", "--out", folder});
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        EXPECT_EQ(times_missing(finished.err), once) << finished.err;
        expect_same_pictures(expected, folder);
    }
    // A server says so when it starts, not again for every client.
    RemoteCluster cluster(
        [&](const std::string& program, const Arguments& arguments) {
            return start(program,
                         program == "swath-server" ? arguments + Arguments{"--trees-on", "cuda"} : arguments);
        },
        1);
    for (int client = 0; client < 2; ++client) expect_same_pictures(expected, render(run + cluster.flags()));
    cluster.server(0).signal(SIGTERM);
    const Finished server = cluster.server(0).wait(kPatience);
    EXPECT_EQ(times_missing(server.err), once) << server.err;
}

// OpenGL renderers have no trees.
TEST_F(OwnRenderers, OnlyRayCastersAskForACudaDevice) {
    const Finished finished =
        client(Arguments{"builtin:knot:1000", "--single", "--trees-on", "cuda"} + kPicture);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(times_missing(finished.err), 0u) << finished.err;
}

// Measured: at most 3 of 153,600 pixels differ by more than 4 of 255. They are at edges, where rasterisers move
// corners to a grid within the pixel. The bound leaves room for other libraries.
TEST_F(OwnRenderers, PicturesOfAllKindsOfServerAreNearlyThoseOfOpenGl) {
    for (const char* model : {"builtin:knot:3000", "builtin:spheres:3000", "builtin:swarm:3000"}) {
        const Arguments run = Arguments{model, "--size", "320x240", "--frames", "2"};
        const std::string gl(name_of(gl_here()));
        const std::string expected = render(run + Arguments{"--single", "--renderer", gl});
        for (const char* ours : {"raster", "raycast"}) {
            const std::string alone = render(run + Arguments{"--single", "--renderer", ours});
            EXPECT_LT(share_of_different(expected, alone, 4), 0.001) << model << ' ' << ours;
        }
        for (const char* algorithm : kAlgorithms) {
            const std::string mixed =
                render_on(3, run + Arguments{"--renderer", fmt::format("raycast,{},raster", gl),
                                             "--algorithm", algorithm});
            EXPECT_LT(share_of_different(expected, mixed, 4), 0.001) << model << ' ' << algorithm;
        }
    }
}

}  // namespace
}  // namespace swath::test
