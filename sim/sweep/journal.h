#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "sim/table/table.h"

namespace swath::sim {

// The complete experiments of a sweep, as text that only grows at its end:
//   # LINE           what this is, then the sweep's settings
//   the header of a table (see to_csv)
//   ROWS             of one experiment, as they are in the table
//   # complete SUM   ends them; SUM is the beginning of their SHA-256
//   ROWS ...         in the order in which experiments become complete

std::string journal_head(std::span<const std::string> settings);
std::string journal_entry(std::string_view rows);

struct JournalContents {
    std::vector<std::string> rows;  // by experiment: its lines in the table; empty if it is not complete
    std::size_t intact_bytes = 0;   // after these comes an entry (or a head) that was cut off
};

// Reads a journal. `labels` are those of the sweep's experiments, in order; no two are equal. A last entry
// that was cut off when the machine or the program died is no error; any other damage, or settings of another
// sweep, are. Errors name `source`, the line, and the first setting that differs.
Result<JournalContents> read_journal(std::string_view text, std::string_view head,
                                     std::span<const Row> labels, std::string_view source);

// A table's lines for these rows, without the header.
std::string lines_of(std::span<const Row> rows);

}  // namespace swath::sim
