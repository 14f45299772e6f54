#include "sim/page/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swath::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Page, ListsItsSectionsAndKeepsTheOrder) {
    Page page("Title");
    page.section("First");
    page.text("one");
    page.section("Second");
    page.note("two");
    const std::string html = page.html();
    EXPECT_THAT(html, HasSubstr("<li><a href=\"#s1\">Second</a></li>"));
    EXPECT_LT(html.find("<p>one</p>"), html.find("<h2 id=\"s1\">Second</h2>"));
    EXPECT_LT(html.find("Second</h2>"), html.find("two"));
}

TEST(Page, SaysWhichCellsNameOthersAndWhatATableIs) {
    Page page("Title");
    page.table({{"servers", "speed-up"}, {{"8", "7.2"}}}, "first");
    page.table({{"a"}, {}}, "second");
    const std::string html = page.html();
    EXPECT_THAT(html, HasSubstr("<tr><th scope=\"col\">servers</th><th scope=\"col\">speed-up</th></tr>"));
    EXPECT_THAT(html, HasSubstr("<tr><th scope=\"row\">8</th><td>7.2</td></tr>"));
    EXPECT_THAT(html, HasSubstr("aria-labelledby=\"t0\""));
    EXPECT_THAT(html, HasSubstr("<figcaption id=\"t0\">first</figcaption>"));
    EXPECT_THAT(html, HasSubstr("<figcaption id=\"t1\">second</figcaption>"));
}

TEST(Page, EscapesWhatItIsGiven) {
    Page page("<title> & \"more\"");
    page.section("<script>");
    page.text("a < b");
    page.note("<b>");
    page.table({{"<th>"}, {{"<td>"}}}, "<caption>");
    page.figure({{"a\"b.png", "<alt>"}, {"c.png", "d"}}, "<fig>");
    page.link("d\"e.csv", "<what>");
    const std::string html = page.html();
    EXPECT_THAT(html, HasSubstr("<title>&lt;title&gt; &amp; &quot;more&quot;</title>"));
    EXPECT_THAT(html, HasSubstr("src=\"a&quot;b.png\" alt=\"&lt;alt&gt;\""));
    for (const char* raw :
         {"<script>", "a < b", "<b>", "><th>", "><td>", "<caption>", "<fig>", "<what>", "d\"e"})
        EXPECT_THAT(html, Not(HasSubstr(raw)));
}

}  // namespace
}  // namespace swath::sim
