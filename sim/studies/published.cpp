#include "sim/studies/published.h"

#include "common/base/check.h"
#include "sim/studies/published_text.h"

namespace swath::sim {

const std::vector<Row>& published_table1() {
    static const std::vector<Row> rows = [] {
        auto table = parse_table(kPublishedTable1, "published/table1.csv");
        if (!table) throw CheckFailed(table.error().message);
        return std::move(*table);
    }();
    return rows;
}

std::optional<double> published(std::string_view algorithm, std::string_view model, std::size_t servers,
                                std::string_view column) {
    for (const Row& row : published_table1())
        if (row.algorithm == algorithm && row.model == model && row.servers == servers &&
            row.column == column)
            return row.value;
    return std::nullopt;
}

}  // namespace swath::sim
