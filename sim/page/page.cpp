#include "sim/page/page.h"

#include <fmt/core.h>

namespace swath::sim {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --ink: #1c1e21; --paper: #ffffff; --soft: #5b626a; --line: #d5d9de; --warn: #fff6dd; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e6e9; --paper: #17191c; --soft: #a2a9b1; --line: #3a3f45; --warn: #3a3320; } }
body { font: 16px/1.55 system-ui, sans-serif; color: var(--ink); background: var(--paper);
  max-width: 68rem; margin: 0 auto; padding: 1.5rem; }
h1 { font-size: 1.9rem; line-height: 1.2; } h2 { margin-top: 3rem; border-top: 1px solid var(--line); padding-top: 1.2rem; }
p, .note { max-width: 46rem; } a { color: inherit; }
.note { background: var(--warn); padding: .6rem .9rem; border-radius: .4rem; }
a:focus-visible, .scroll:focus-visible { outline: 2px solid var(--soft); outline-offset: 2px; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .5rem; text-align: right; border-bottom: 1px solid var(--line); }
tbody > tr > * { white-space: nowrap; } tbody th { font-weight: inherit; }
tr > :first-child { text-align: left; position: sticky; left: 0; background: var(--paper); } thead th { vertical-align: bottom; border-bottom: 2px solid var(--soft); }
figcaption { color: var(--soft); font-size: .88rem; padding: .3rem 0; max-width: 52rem; }
figure { margin: 1.5rem 0; } .row { display: flex; flex-wrap: wrap; gap: 1rem; }
.row > div { flex: 1 1 20rem; min-width: 0; overflow-x: auto; } img { width: 100%; height: auto; background: #fff; border-radius: .4rem; }
img[src$=".svg"] { min-width: 36rem; }
)css";

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string head_of(const std::vector<std::string>& cells) {
    std::string row = "<tr>";
    for (const std::string& cell : cells) row += fmt::format("<th scope=\"col\">{}</th>", escaped(cell));
    return row + "</tr>";
}

std::string row_of(const std::vector<std::string>& cells) {
    std::string row = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
        row += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", escaped(cells[i]))
                      : fmt::format("<td>{}</td>", escaped(cells[i]));
    return row + "</tr>\n";
}

}  // namespace

void Page::section(std::string_view title) {
    body_ += fmt::format("<h2 id=\"s{}\">{}</h2>\n", sections_.size(), escaped(title));
    sections_.emplace_back(title);
}

void Page::text(std::string_view paragraph) { body_ += fmt::format("<p>{}</p>\n", escaped(paragraph)); }

void Page::note(std::string_view paragraph) {
    body_ += fmt::format("<p class=\"note\">{}</p>\n", escaped(paragraph));
}

void Page::table(const PageTable& table, std::string_view caption) {
    // A wide table scrolls in its place, also by keys; its caption stays.
    body_ += fmt::format(
        "<figure><div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-labelledby=\"t{0}\"><table>\n"
        "<thead>{1}</thead>\n<tbody>\n",
        tables_, head_of(table.head));
    for (const auto& row : table.rows) body_ += row_of(row);
    body_ += fmt::format("</tbody></table></div><figcaption id=\"t{}\">{}</figcaption></figure>\n", tables_++,
                         escaped(caption));
}

void Page::figure(const std::vector<Picture>& pictures, std::string_view caption) {
    body_ += "<figure><div class=\"row\">\n";
    for (const Picture& picture : pictures) {
        body_ += fmt::format("<div><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>", escaped(picture.file),
                             escaped(picture.caption));
        if (pictures.size() > 1)
            body_ += fmt::format("<figcaption>{}</figcaption>", escaped(picture.caption));
        body_ += "</div>\n";
    }
    body_ += fmt::format("</div><figcaption>{}</figcaption></figure>\n", escaped(caption));
}

void Page::link(std::string_view file, std::string_view what) {
    body_ += fmt::format("<p><a href=\"{0}\">{0}</a>: {1}</p>\n", escaped(file), escaped(what));
}

std::string Page::html() const {
    std::string contents;
    for (std::size_t i = 0; i < sections_.size(); ++i)
        contents += fmt::format("<li><a href=\"#s{}\">{}</a></li>\n", i, escaped(sections_[i]));
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
        "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<nav><ol>\n{2}</ol></nav>\n{3}</body>\n</html>\n",
        escaped(title_), kStyle, contents, body_);
}

}  // namespace swath::sim
