#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace swath {

// The text as a field of a comma-separated table (RFC 4180), quoted where it must be.
std::string csv_field(std::string_view text);

struct CsvRecord {
    std::size_t line = 0;  // the first of the record, from 1
    std::vector<std::string> fields;
    bool operator==(const CsvRecord&) const = default;
};

// Reads a table: its header, which must be `header`, then records with as many fields. Lines end with \n or
// \r\n, the last one too, so that a file that was cut off is an error, like quotes that RFC 4180 does not
// allow. Errors name `source` and the line; the header is on line `first_line`.
Result<std::vector<CsvRecord>> parse_csv(std::string_view text, std::string_view header,
                                         std::string_view source, std::size_t first_line = 1);

}  // namespace swath
