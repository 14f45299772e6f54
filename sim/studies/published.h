#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "sim/table/table.h"

namespace swath::sim {

// Table 1 of Samanta 2000, from published/table1.csv.
const std::vector<Row>& published_table1();
std::optional<double> published(std::string_view algorithm, std::string_view model, std::size_t servers,
                                std::string_view column);

}  // namespace swath::sim
