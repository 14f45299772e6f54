#include "sim/plot/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "common/base/check.h"
#include "sim/plot/gnuplot.h"
#include "tests/support/models.h"

namespace swath::sim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Plot speed_up() {
    return {"Speed-up",
            "servers",
            "speed-up",
            true,
            {{"ideal", {{8, 8}, {64, 64}}, Style::kReference},
             {"hybrid", {{8, 7.2}, {16, 13.7}, {64, 43.7}}, Style::kLine, 0},
             {"hybrid, published", {{8, 7.3}, {64, 44}}, Style::kPoints, 0},
             {"sort-last", {{8, 5.9}, {64, 30.4}}, Style::kDashed, 1}}};
}

Bars server_times() {
    return {"Server times",
            "ms",
            {"render", "read"},
            {{"hybrid", {{"8", {180.8, 2.4}}, {"64", {22.6, 0}}}}, {"sort-last", {{"8", {180.8, 14.2}}}}}};
}

struct Drawn {
    std::string svg;
    std::string png;
};

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

template <class Picture>
Drawn drawn(const Picture& picture, const std::string& name = "picture") {
    const swath::test::TemporaryFolder folder;
    const fs::path stem = folder.path_of(name);
    const Status status = draw(picture, stem);
    EXPECT_TRUE(status) << status.error().message;
    return {bytes_of(stem.string() + ".svg"), bytes_of(stem.string() + ".png")};
}

// The number of different colours in the PNG; 0 if it is no PNG.
std::size_t colours_in(const std::string& png) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0) return 0;
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return 0;
    std::set<std::tuple<int, int, int>> colours;
    for (std::size_t i = 0; i < pixels.size(); i += 3)
        colours.emplace(pixels[i], pixels[i + 1], pixels[i + 2]);
    return colours.size();
}

TEST(Draw, WritesAnSvgAndAPngOfCurves) {
    const Drawn picture = drawn(speed_up());
    EXPECT_THAT(picture.svg, StartsWith("<?xml"));
    EXPECT_THAT(picture.svg, HasSubstr("</svg>"));
    EXPECT_THAT(picture.svg, HasSubstr("hybrid, published"));
    EXPECT_GT(colours_in(picture.png), 20u) << "blank, or no PNG";
}

TEST(Draw, WritesAnSvgAndAPngOfBars) {
    const Drawn picture = drawn(server_times());
    for (const char* text : {"Server times", "render", "read", "hybrid", "sort-last"})
        EXPECT_THAT(picture.svg, HasSubstr(text));
    EXPECT_GT(colours_in(picture.png), 20u) << "blank, or no PNG";
}

TEST(Draw, ShowsTheNumbers) {
    Plot other = speed_up();
    other.series[1].points[1].second = 20;
    EXPECT_NE(drawn(speed_up()).svg, drawn(other).svg);
    Bars taller = server_times();
    taller.groups[0].bars[1].values[1] = 50;
    EXPECT_NE(drawn(server_times()).svg, drawn(taller).svg);
}

TEST(Draw, BeginsAxesAtZeroOrAtTheLeastNumber) {
    Plot plot{"", "", "", false, {{"a", {{20, 30}, {40, 90}}}}};
    EXPECT_THAT(drawn(plot).svg, testing::AllOf(HasSubstr("<text> 0</text>"), Not(HasSubstr("<text>-"))));
    plot.series[0].points[0] = {20, -30};
    EXPECT_THAT(drawn(plot).svg, HasSubstr("<text>-40</text>"));
}

TEST(Draw, MakesRoomForALegendOfManyNames) {
    Plot plot = speed_up();
    EXPECT_THAT(drawn(plot).svg, HasSubstr("viewBox=\"0 0 900 540\""));
    while (plot.series.size() < 30) plot.series.push_back(plot.series.front());
    EXPECT_THAT(drawn(plot).svg, HasSubstr("viewBox=\"0 0 900 1180\""));
    plot.series.front().name = std::string(60, 'n');
    EXPECT_THAT(drawn(plot).svg, HasSubstr("viewBox=\"0 0 1200 1180\""));
}

TEST(Draw, PutsTicsWhereThePointsAre) {
    Plot plot = speed_up();
    plot.series = {{"a", {{3, 1}, {7, 2}}, Style::kLine, {}}};
    EXPECT_THAT(drawn(plot).svg, testing::AllOf(HasSubstr("<text> 3</text>"), HasSubstr("<text> 7</text>")));
    plot.series.front().points.emplace_back(7.1, 3);  // too close
    EXPECT_THAT(drawn(plot).svg, Not(HasSubstr("<text> 7.1</text>")));
}

TEST(Draw, NamesTicsAsItIsTold) {
    Plot plot = speed_up();
    plot.x_tics = {{8, "eight"}, {64, "50%"}};
    EXPECT_THAT(drawn(plot).svg, testing::AllOf(HasSubstr("eight</text>"), HasSubstr("50%</text>"),
                                                Not(HasSubstr("16</text>"))));
}

TEST(Draw, DrawsYOnALogarithmicAxis) {
    Plot plot{"", "", "", false, {{"a", {{1, 0.01}, {2, 100}}}}, true};
    EXPECT_THAT(drawn(plot).svg, testing::AllOf(HasSubstr(">0.01</text>"), HasSubstr(">1</text>"),
                                                HasSubstr(">100</text>"), Not(HasSubstr(">0</text>"))));
    plot.series[0].points[0].second = 0;
    EXPECT_EQ(draw(plot, "/tmp/x").error().message, "cannot draw 'a': 0 is not on a logarithmic axis");
}

TEST(Draw, WritesTheSameBytesAgain) {
    const Drawn first = drawn(speed_up());
    const Drawn second = drawn(speed_up());
    EXPECT_TRUE(first.svg == second.svg);
    EXPECT_TRUE(first.png == second.png);
    EXPECT_TRUE(drawn(server_times()).svg == drawn(server_times()).svg);
}

TEST(Draw, ShowsHostileNamesAsTheyAre) {
    const swath::test::TemporaryFolder folder;
    const std::string witness = folder.path_of("witness");
    for (const std::string& name :
         {std::string("it's \"quoted\" `touch ") + witness + "`", "'; system('touch " + witness + "'); x='",
          "a\nEND\nset output '" + witness + "'", std::string("back\\slash\\"),
          std::string("under_score^2 @x {/Bold b}"), std::string("<b>&amp;]]>"),
          std::string("\xff\xfe\0\x01 end", 8), std::string(5000, 'x'), std::string("\xed\xa0\x80"),
          std::string("%s %d @ ~ $data0")}) {
        Plot plot = speed_up();
        plot.title = plot.x_label = plot.y_label = plot.series[1].name = name;
        const Drawn picture = drawn(plot, "hostile");
        EXPECT_THAT(picture.svg, HasSubstr("</svg>")) << name;
        EXPECT_GT(colours_in(picture.png), 20u) << name;
        Bars bars = server_times();
        bars.title = bars.segments[0] = bars.groups[0].name = bars.groups[0].bars[0].label = name;
        EXPECT_THAT(drawn(bars, "hostile").svg, HasSubstr("</svg>")) << name;
        EXPECT_FALSE(fs::exists(witness)) << name;
    }
    Plot plot = speed_up();
    plot.title = "a_b \\n {c} it's <i>";
    EXPECT_THAT(drawn(plot, "titled").svg, HasSubstr("a_b \\n {c} it's &lt;i"));
}

TEST(Draw, TakesFolderNamesAsTheyAre) {
    EXPECT_GT(drawn(speed_up(), "it's a \"new\" folder/speed up").svg.size(), 1000u);
}

TEST(Draw, NamesWhatCannotBeDrawn) {
    Plot plot = speed_up();
    plot.series[1].points[0].second = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(draw(plot, "/tmp/x").error().message, "cannot draw 'hybrid': nan is not a finite number");
    plot.series[1].points[0] = {0, 1};
    EXPECT_EQ(draw(plot, "/tmp/x").error().message, "cannot draw 'hybrid': 0 is not on a logarithmic axis");
    plot.series.clear();
    EXPECT_EQ(draw(plot, "/tmp/x").error().message, "nothing to draw in 'Speed-up'");
    Bars bars = server_times();
    bars.groups[0].bars[0].values[1] = -1;
    EXPECT_EQ(draw(bars, "/tmp/x").error().message, "cannot draw 'read': -1 is less than 0");
    bars.groups.clear();
    EXPECT_EQ(draw(bars, "/tmp/x").error().message, "nothing to draw in 'Server times'");
    EXPECT_THAT(draw(speed_up(), "/proc/no/such").error().message, StartsWith("/proc/no: "));
}

TEST(Draw, NeedsAValueForEverySegment) {
    Bars bars = server_times();
    bars.groups[0].bars[0].values.pop_back();
    EXPECT_THROW(static_cast<void>(draw(bars, "/tmp/x")), CheckFailed);
}

TEST(Gnuplot, ThatIsNotInstalledIsOneClearLine) {
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", "/proc/empty", 1);
    const auto result = run_gnuplot("print 1");
    ::setenv("PATH", path.c_str(), 1);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "gnuplot is not installed: plots need it (Debian: gnuplot-nox)");
}

TEST(Gnuplot, ThatFailsSaysWhy) {
    const auto result = run_gnuplot("set terminal svg\nplot nonsense\n");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "gnuplot failed: line 0: undefined variable: nonsense");
}

TEST(Printable, IsOneLineOfUtf8) {
    std::string umlauts;
    for (int i = 0; i < 100; ++i) umlauts += "\xc3\xa4";
    EXPECT_EQ(printable(umlauts), umlauts.substr(0, 80) + "...");
    EXPECT_EQ(printable(std::string(81, 'x')), std::string(80, 'x') + "...");
    EXPECT_EQ(printable(std::string(80, 'x')), std::string(80, 'x'));
    EXPECT_EQ(printable(""), "");
    EXPECT_EQ(printable("<![CDATA[ ]]>"), "<![CDATA[ ]] >") << "the SVG would not be XML";
    EXPECT_EQ(printable("it's a\r\n\tb"), "it's a   b");
    EXPECT_EQ(printable("\xc3"), "?");
    EXPECT_EQ(printable("\xed\xa0\x80"), "???");
}

TEST(Literal, LeavesNothingToInterpret) {
    EXPECT_EQ(literal("a b"), "\"a b\"");
    EXPECT_EQ(literal("\"`\\'8"), "\"\\042\\140\\134\\047\\070\"");
}

}  // namespace
}  // namespace swath::sim
