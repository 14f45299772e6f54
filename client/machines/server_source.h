#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/wire/address.h"

namespace swath {

// Where a run's servers come from.
struct ServerSource {
    enum class Kind {
        kList,  // these; a run begins with all of them
        kName,  // all addresses of a host name
        kFile,  // a file with an address a line
    };
    Kind kind = Kind::kList;
    std::vector<Address> list;
    Address name;
    std::string file;
    bool operator==(const ServerSource&) const = default;
};

// "HOST:PORT" each, or alone "dns:NAME:PORT" or "file:PATH".
Result<ServerSource> parse_server_source(const std::vector<std::string>& texts);
// As a person gave it.
std::string to_string(const ServerSource& source);

// The contents of a file: HOST:PORT a line; blanks, empty lines and what follows a # do not count. Errors
// name the line.
Result<std::vector<Address>> parse_server_list(std::string_view text);

}  // namespace swath
