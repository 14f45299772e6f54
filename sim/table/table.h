#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace swath::sim {

// One number of a study: tidy data in the schema of ../published/table1.csv. Times are in ms, shares in per
// cent.
struct Row {
    std::string algorithm;
    std::string model;
    std::size_t servers = 0;
    std::string column;
    double value = 0;
    bool operator==(const Row&) const = default;
};

// Writes "algorithm,model,servers,column,value", then a line a row; at most four decimals without trailing
// zeros; the same text in every locale.
std::string to_csv(std::span<const Row> rows);

// Errors name the source, the line and the field. `first_line` is the header's line, for a table within a
// file.
Result<std::vector<Row>> parse_table(std::string_view text, std::string_view source,
                                     std::size_t first_line = 1);
Result<std::vector<Row>> read_table(const std::filesystem::path& file);

}  // namespace swath::sim
