#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/wire/address.h"

namespace swath {

// The origin of a run's servers.
struct ServerSource {
    enum class Kind {
        kList,  // these addresses; a run begins with all of them
        kName,  // all addresses of a host name
        kFile,  // a file with an address a line
    };
    Kind kind = Kind::kList;
    std::vector<Address> list;
    Address name;
    std::string file;
    bool operator==(const ServerSource&) const = default;
};

// Reads "HOST:PORT" each, or alone "dns:NAME:PORT" or "file:PATH".
Result<ServerSource> parse_server_source(const std::vector<std::string>& texts);
// The text that a person gave.
std::string to_string(const ServerSource& source);

// Reads the contents of a file: HOST:PORT a line; ignores blanks, empty lines and text after a #. Errors name
// the line.
Result<std::vector<Address>> parse_server_list(std::string_view text);

}  // namespace swath
