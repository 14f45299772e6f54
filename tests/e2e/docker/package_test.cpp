// These tests install the Debian package on a system that has nothing else.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/e2e/docker/engine.h"

namespace swath::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Package, OnABareDebianNeedsUnder120MbAndDrawsWithoutOpenGl) {
    if (!no_engine().empty()) GTEST_SKIP() << no_engine();
    const Image bare(
        "RUN dpkg-query -Wf '${Installed-Size}\\n' >/before && apt-get update"
        " && apt-get install -y --no-install-recommends /swath_*.deb\n");
    const auto says = [&](const std::string& script) {
        const Finished finished = docker({"run", "--rm", bare.name(), "sh", "-ec", script});
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return finished.out;
    };
    const std::string packages = says("dpkg-query -Wf '${Installed-Size} ${Package}\\n' | sort -n");
    EXPECT_THAT(packages, Not(HasSubstr("mesa")));
    EXPECT_THAT(packages, Not(HasSubstr("libegl")));
    const int kib =
        std::stoi(says("echo $(($(dpkg-query -Wf '${Installed-Size}+')0 - ($(tr '\\n' + </before)0)))"));
    std::cout << "apt installs " << kib << " KiB of packages\n";
    EXPECT_LT(kib, 120'000);

    EXPECT_EQ(
        says("swath-client builtin:knot:20000 --local 2 --frames 2 --size 64x48 --out /tmp/cluster >&2\n"
             "swath-client builtin:knot:20000 --single --frames 2 --size 64x48 --out /tmp/one >&2\n"
             "cmp /tmp/cluster/frame_0001.png /tmp/one/frame_0001.png\n"
             "cd /tmp/one && ls"),
        "frame_0000.png\nframe_0001.png\n");
}

}  // namespace
}  // namespace swath::test
