#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace swath::sim {

// A table of text. The first column names the rows and is aligned left, all others right.
struct PageTable {
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

// An HTML page, light or dark as the reader's system is, that needs no files but its pictures. All text is
// escaped. Parts appear in the order of the calls.
class Page {
  public:
    explicit Page(std::string title) : title_(std::move(title)) {}

    void section(std::string_view title);  // listed at the top
    void text(std::string_view paragraph);
    void note(std::string_view paragraph);  // a warning, set apart
    void table(const PageTable& table, std::string_view caption);
    // The file lies beside the page. Several pictures stand side by side if there is room.
    struct Picture {
        std::string file;
        std::string caption;
    };
    void figure(const std::vector<Picture>& pictures, std::string_view caption);
    void link(std::string_view file, std::string_view what);  // to a file beside the page

    std::string html() const;

  private:
    std::string title_;
    std::vector<std::string> sections_;
    std::size_t tables_ = 0;
    std::string body_;
};

}  // namespace swath::sim
