#include "sim/table/table.h"

#include <charconv>
#include <cmath>

#include "common/base/check.h"
#include "common/base/csv.h"
#include "common/base/file.h"

namespace swath::sim {
namespace {

constexpr std::string_view kHeader = "algorithm,model,servers,column,value";
constexpr std::uint64_t kMaxFileBytes = 64 << 20;
constexpr std::size_t kMaxServers = 1'000'000;

template <class T>
bool parse_all(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

// At most four decimals without trailing zeros: "0.25", "12", "-3.1".
std::string number(double value) {
    std::string text = fmt::format("{:.4f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

Result<Row> parse_row(CsvRecord record) {
    std::vector<std::string>& fields = record.fields;
    Row row{std::move(fields[0]), std::move(fields[1]), 0, std::move(fields[3]), 0};
    if (row.algorithm.empty()) return fail("algorithm is empty");
    if (row.model.empty()) return fail("model is empty");
    if (!parse_all(fields[2], row.servers) || row.servers > kMaxServers)
        return fail("servers: '{}' is not a whole number of 0 to {}", fields[2], kMaxServers);
    if (row.column.empty()) return fail("column is empty");
    if (!parse_all(fields[4], row.value) || !std::isfinite(row.value))
        return fail("value: '{}' is not a number", fields[4]);
    return row;
}

}  // namespace

std::string to_csv(std::span<const Row> rows) {
    std::string csv = fmt::format("{}\n", kHeader);
    for (const Row& row : rows) {
        CHECK(std::isfinite(row.value));
        csv += fmt::format("{},{},{},{},{}\n", csv_field(row.algorithm), csv_field(row.model), row.servers,
                           csv_field(row.column), number(row.value));
    }
    return csv;
}

Result<std::vector<Row>> parse_table(std::string_view text, std::string_view source, std::size_t first_line) {
    SWATH_TRY(auto records, parse_csv(text, kHeader, source, first_line));
    std::vector<Row> rows;
    for (std::size_t i = 1; i < records.size(); ++i) {
        const std::size_t line = records[i].line;
        auto row = parse_row(std::move(records[i]));
        if (!row) return fail_in(fmt::format("{}:{}", source, line), row.error());
        rows.push_back(std::move(*row));
    }
    return rows;
}

Result<std::vector<Row>> read_table(const std::filesystem::path& file) {
    SWATH_TRY(const Buffer bytes, read_file(file, kMaxFileBytes));
    return parse_table({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace swath::sim
