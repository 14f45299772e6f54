#include "common/wire/address.h"

#include <charconv>

namespace swath {

Result<Address> parse_address(std::string_view text) {
    const auto colon = text.rfind(':');
    if (colon == std::string_view::npos || colon == 0) return fail("address '{}': expected HOST:PORT", text);
    std::string_view host = text.substr(0, colon);
    const std::string_view digits = text.substr(colon + 1);
    if (host.starts_with('[') && host.ends_with(']')) {
        host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string_view::npos) {
        return fail("address '{}': put an IPv6 host in brackets", text);
    }
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
    if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size())
        return fail("address '{}': the port must be a number from 0 to 65535", text);
    return Address{std::string(host), port};
}

Result<Address> parse_local_address(std::string_view text) {
    if (text.find(':') != std::string_view::npos) return parse_address(text);
    return parse_address("127.0.0.1:" + std::string(text));
}

std::string to_string(const Address& address) {
    return address.host.find(':') == std::string::npos ? fmt::format("{}:{}", address.host, address.port)
                                                       : fmt::format("[{}]:{}", address.host, address.port);
}

}  // namespace swath
