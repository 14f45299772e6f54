#include "common/render/gl_packages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swath {
namespace {

using testing::HasSubstr;

std::string osmesa_on(std::string_view os_release) { return how_to_get(RendererKind::kOsmesa, os_release); }
std::string egl_on(std::string_view os_release) { return how_to_get(RendererKind::kEgl, os_release); }

TEST(GlPackages, OsmesaHasAPackageUntilMesaDropsIt) {
    const std::string package = "install the package libosmesa6";
    EXPECT_EQ(osmesa_on("PRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\nVERSION_ID=\"12\"\nID=debian\n"),
              package);
    EXPECT_EQ(osmesa_on("ID=debian\nVERSION_ID=\"13\"\nDEBIAN_VERSION_FULL=13.2"), package);
    EXPECT_EQ(osmesa_on("ID=ubuntu\nID_LIKE=debian\nVERSION_ID=\"24.04\"\n"), package);
    EXPECT_THAT(osmesa_on("ID=ubuntu\nVERSION_ID=\"25.10\"\n"), HasSubstr("--renderer egl"));
    EXPECT_THAT(osmesa_on("ID=debian\nVERSION_ID=\"14\"\n"), HasSubstr("--renderer egl"));
    // Debian sid and testing have no number.
    EXPECT_THAT(osmesa_on("ID=debian\nVERSION_CODENAME=forky\n"), HasSubstr("--renderer egl"));
}

TEST(GlPackages, EglHasThreeOfThem) {
    EXPECT_EQ(egl_on("ID=debian\n"), "install the packages libegl1, libegl-mesa0 and libgl1-mesa-dri");
    EXPECT_EQ(egl_on("ID=ubuntu\n"), egl_on("ID=debian\n"));
}

TEST(GlPackages, OtherSystemsAreToldWithoutAPackagesName) {
    for (const char* text : {"", "ID=fedora\nVERSION_ID=42\n", "ID", "ID=", "=\n\n=", "IDOL=debian\n"}) {
        EXPECT_THAT(osmesa_on(text), HasSubstr("OSMesa, which Mesa has until 25.0")) << text;
        EXPECT_THAT(egl_on(text), HasSubstr("Mesa's EGL")) << text;
    }
}

}  // namespace
}  // namespace swath
