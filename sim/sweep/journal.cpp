#include "sim/sweep/journal.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "common/scene/model_blob.h"

namespace swath::sim {
namespace {

constexpr std::string_view kTitle = "# swath-sim sweep, journal 1: the same command goes on from here\n";
constexpr std::string_view kEnd = "# complete ";
constexpr std::size_t kSumDigits = 16;
constexpr std::size_t kShownCharacters = 80;  // of a line, in an error

std::string end_of(std::string_view rows) {
    const auto sum = digest({reinterpret_cast<const std::uint8_t*>(rows.data()), rows.size()});
    return fmt::format("{}{}", kEnd, to_hex(sum).substr(0, kSumDigits));
}

std::string_view first_line(std::string_view text) { return text.substr(0, text.find('\n')); }

std::size_t count_lines(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

// The error for a text that does not begin with `head`; names the first line that differs.
tl::unexpected<Error> difference(std::string_view text, std::string_view head, std::string_view source) {
    if (!text.starts_with(kTitle)) return fail("{}:1: not the journal of a sweep", source);
    const auto differs = static_cast<std::size_t>(std::ranges::mismatch(text, head).in2 - head.begin());
    const std::size_t begin = head.rfind('\n', differs - 1) + 1;
    return fail("{}:{}: the journal of another sweep: it has '{}', this one '{}'", source,
                1 + count_lines(head.substr(0, begin)),
                first_line(text.substr(begin)).substr(0, kShownCharacters),
                first_line(head.substr(begin)).substr(0, kShownCharacters));
}

class Reader {
  public:
    Reader(std::span<const Row> labels, std::string_view source) : source_(source) {
        for (const Row& label : labels) places_.emplace(key(label), places_.size());
        contents_.rows.resize(labels.size());
    }

    // Reads the entries behind the head.
    Result<JournalContents> read(std::string_view text, std::string_view head) {
        std::size_t begin = head.size();  // where the entry begins
        std::size_t at = begin;
        std::size_t line = 1 + count_lines(head);
        entry_line_ = line;
        for (std::size_t end; (end = text.find('\n', at)) != text.npos; at = end + 1, ++line) {
            const std::string_view one = text.substr(at, end - at);
            if (!one.starts_with('#')) continue;
            if (!one.starts_with(kEnd)) return fail("{}:{}: neither a row nor '{}'", source_, line, kEnd);
            const std::string_view rows = text.substr(begin, at - begin);
            SWATH_TRY_VOID(take(rows, one, line));
            begin = end + 1;
            entry_line_ = line + 1;
        }
        // Whole lines without an end are a cut-off entry, and must still be rows of this sweep.
        SWATH_TRY_VOID(experiment_of(text.substr(begin, at - begin)));
        contents_.intact_bytes = begin;
        return std::move(contents_);
    }

  private:
    using Key = std::tuple<std::string, std::string, std::size_t>;
    static Key key(const Row& row) { return {row.algorithm, row.model, row.servers}; }

    Status take(std::string_view rows, std::string_view end, std::size_t line) {
        if (rows.empty()) return fail("{}:{}: an end without rows", source_, line);
        SWATH_TRY(const auto place, experiment_of(rows));
        if (end != end_of(rows))
            return fail("{}:{}: the rows before are not as they were written", source_, line);
        contents_.rows[place] = rows;
        return {};
    }

    // The index of the experiment that all these rows belong to, which must not be complete.
    Result<std::size_t> experiment_of(std::string_view lines) const {
        SWATH_TRY(const auto rows, parse_table(to_csv({}).append(lines), source_, entry_line_ - 1));
        std::size_t place = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Row& row = rows[i];
            const auto found = places_.find(key(row));
            const auto wrong = [&](std::string_view what) {
                return fail("{}:{}: {}: {}, {}, {} servers", source_, entry_line_ + i, what, row.algorithm,
                            row.model, row.servers);
            };
            if (found == places_.end()) return wrong("no experiment of this sweep");
            if (i > 0 && found->second != place)
                return wrong("a row of another experiment than those before");
            place = found->second;
            if (!contents_.rows[place].empty()) return wrong("an experiment for the second time");
        }
        return place;
    }

    std::string_view source_;
    std::map<Key, std::size_t> places_;
    JournalContents contents_;
    std::size_t entry_line_ = 0;  // the line on which the entry begins
};

}  // namespace

std::string journal_head(std::span<const std::string> settings) {
    std::string head(kTitle);
    for (const std::string& setting : settings) head += fmt::format("# {}\n", setting);
    return head + to_csv({});
}

std::string journal_entry(std::string_view rows) { return fmt::format("{}{}\n", rows, end_of(rows)); }

std::string lines_of(std::span<const Row> rows) { return to_csv(rows).substr(to_csv({}).size()); }

Result<JournalContents> read_journal(std::string_view text, std::string_view head,
                                     std::span<const Row> labels, std::string_view source) {
    // After a power loss a file may end in zeros, where bytes were never written.
    if (const auto zero = text.find('\0'); zero != text.npos && text.find(kEnd, zero) == text.npos)
        text = text.substr(0, zero);
    if (text.size() < head.size() && head.starts_with(text))
        return JournalContents{std::vector<std::string>(labels.size()), 0};
    if (!text.starts_with(head)) return difference(text, head, source);
    auto contents = Reader(labels, source).read(text, head);
    // A damaged quote can take line ends into a field, but an error is one line.
    if (!contents) std::ranges::replace(contents.error().message, '\n', ' ');
    return contents;
}

}  // namespace swath::sim
