#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace swath {

// Where a program listens: "host:port", an IPv6 host in brackets.
struct Address {
    std::string host;
    std::uint16_t port = 0;
    bool operator==(const Address&) const = default;
};
Result<Address> parse_address(std::string_view text);
// "[HOST:]PORT" of something for this machine's own people: 127.0.0.1 unless it says otherwise.
Result<Address> parse_local_address(std::string_view text);
std::string to_string(const Address& address);

}  // namespace swath
