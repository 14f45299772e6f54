#include "common/base/csv.h"

#include <algorithm>

namespace swath {
namespace {

constexpr std::size_t kShownCharacters = 80;  // of a line in an error

class Reader {
  public:
    Reader(std::string_view text, std::size_t first_line) : text_(text), line_(first_line) {}

    bool at_end() const { return at_ == text_.size(); }
    std::size_t line() const { return line_; }

    Result<CsvRecord> record() {
        CsvRecord record{line_, {}};
        for (;;) {
            SWATH_TRY(std::string field, at_end() || text_[at_] != '"' ? plain() : quoted());
            record.fields.push_back(std::move(field));
            if (take("\n") || take("\r\n")) {
                ++line_;
                return record;
            }
            if (at_end()) return fail("cut off: the last line has no end");
            if (!take(",")) return fail("text after a closing quote");
        }
    }

  private:
    bool take(std::string_view token) {
        if (!text_.substr(at_).starts_with(token)) return false;
        at_ += token.size();
        return true;
    }

    Result<std::string> plain() {
        const std::size_t end = std::min(text_.find_first_of(",\n\"", at_), text_.size());
        if (end < text_.size() && text_[end] == '"') return fail("a quote inside of a field without quotes");
        std::string_view field = text_.substr(at_, end - at_);
        if (end < text_.size() && text_[end] == '\n' && field.ends_with('\r')) field.remove_suffix(1);
        at_ += field.size();
        return std::string(field);
    }

    Result<std::string> quoted() {
        std::string field;
        for (++at_;; ++at_) {
            if (at_end()) return fail("cut off: a quoted field has no end");
            if (text_[at_] == '"' && !text_.substr(at_ + 1).starts_with('"')) break;
            if (text_[at_] == '"') ++at_;
            if (text_[at_] == '\n') ++line_;
            field += text_[at_];
        }
        ++at_;
        return field;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_;
};

}  // namespace

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

Result<std::vector<CsvRecord>> parse_csv(std::string_view text, std::string_view header,
                                         std::string_view source, std::size_t first_line) {
    std::string_view first = text.substr(0, text.find('\n'));
    if (first.ends_with('\r')) first.remove_suffix(1);
    if (first != header)
        return fail("{}:{}: the header is '{}', expected '{}'", source, first_line,
                    first.substr(0, kShownCharacters), header);
    std::vector<CsvRecord> records;
    for (Reader reader(text, first_line); !reader.at_end();) {
        auto record = reader.record();
        if (!record) return fail("{}:{}: {}", source, reader.line(), record.error().message);
        records.push_back(std::move(*record));
        const std::size_t expected = records.front().fields.size();
        if (records.back().fields.size() != expected)
            return fail("{}:{}: {} fields, the header has {}", source, records.back().line,
                        records.back().fields.size(), expected);
    }
    return records;
}

}  // namespace swath
