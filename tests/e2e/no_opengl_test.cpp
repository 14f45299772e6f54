// Machines without OSMesa, without EGL, or with neither. The loader looks into LD_LIBRARY_PATH first, and
// takes an empty file for a broken library.
#include <gmock/gmock.h>

#include "common/render/gl_packages.h"
#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

using testing::HasSubstr;

class WithoutOpenGl : public EndToEnd {
  protected:
    void hide(const std::vector<std::string>& libraries) {
        for (const std::string& library : libraries) files_.write(library, "");
        environment_ = {"LD_LIBRARY_PATH=" + files_.path_of("")};
    }
    void hide_all() { hide({"libOSMesa.so.8", "libEGL.so.1"}); }

    const Arguments run_{"builtin:knot:3000", "--size", "61x47", "--frames", "2"};
};

TEST_F(WithoutOpenGl, ACastOfRaysIsThePictureAndTheLogSaysWhatIsMissing) {
    const std::string expected = render(run_ + Arguments{"--single", "--renderer", "raycast"});
    hide_all();
    expect_same_pictures(expected, render(run_ + Arguments{"--local", "2"}));
    expect_same_pictures(expected, render(run_ + Arguments{"--local", "2", "--renderer", "raycast"}));
    const Finished finished = client(run_ + Arguments{"--single"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.err, HasSubstr("drawing with raycast (OSMesa: "));
    EXPECT_THAT(finished.err, HasSubstr(how_to_get_here(RendererKind::kOsmesa)));
    EXPECT_THAT(finished.err, HasSubstr(how_to_get_here(RendererKind::kEgl)));
}

TEST_F(WithoutOpenGl, EglTakesThePlaceOfOsmesa) {
    const std::string expected = render(run_ + Arguments{"--single", "--renderer", "egl"});
    hide({"libOSMesa.so.8"});
    expect_same_pictures(expected, render(run_ + Arguments{"--local", "2"}));
    const Finished finished = client(run_ + Arguments{"--single"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.err, HasSubstr("drawing with egl (llvmpipe"));
    EXPECT_THAT(finished.err, HasSubstr("Mesa 2"));
}

TEST_F(WithoutOpenGl, WhoAsksForItIsToldWhatToInstall) {
    hide_all();
    expect_one_error(client(run_ + Arguments{"--single", "--renderer", "osmesa"}), 1,
                     {"OSMesa: ", "libOSMesa.so.8", how_to_get_here(RendererKind::kOsmesa)});
    expect_one_error(client(run_ + Arguments{"--single", "--renderer", "egl"}), 1,
                     {"EGL: ", "libEGL.so.1", how_to_get_here(RendererKind::kEgl)});
}

TEST_F(WithoutOpenGl, AServerSaysWhatToInstallWhereItRuns) {
    hide_all();
    const RemoteCluster cluster(
        [this](const auto& program, const auto& arguments) { return start(program, arguments); }, 1);
    environment_.clear();
    expect_one_error(client(run_ + cluster.flags() + Arguments{"--renderer", "egl"}), 1,
                     {"server ", "EGL: ", "libEGL.so.1", how_to_get_here(RendererKind::kEgl)});
}

}  // namespace
}  // namespace swath::test
