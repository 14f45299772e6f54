#include "client/machines/server_source.h"

#include <algorithm>

#include "common/base/ids.h"

namespace swath {
namespace {

constexpr std::string_view kName = "dns:";
constexpr std::string_view kFile = "file:";

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// True for dns:NAME:PORT; "dns:4000" is an address of a host named dns.
bool is_name(std::string_view text) {
    return text.starts_with(kName) && text.substr(kName.size()).find(':') != std::string_view::npos;
}

}  // namespace

Result<ServerSource> parse_server_source(const std::vector<std::string>& texts) {
    ServerSource source;
    for (const std::string& text : texts) {
        const bool file = text.starts_with(kFile);
        if ((file || is_name(text)) && texts.size() > 1) return fail("'{}' must be the only one", text);
        if (file) {
            source.kind = ServerSource::Kind::kFile;
            source.file = text.substr(kFile.size());
            if (source.file.empty()) return fail("'{}': expected file:PATH", text);
            continue;
        }
        if (is_name(text)) source.kind = ServerSource::Kind::kName;
        SWATH_TRY(const auto address, parse_address(is_name(text) ? text.substr(kName.size()) : text));
        if (is_name(text))
            source.name = address;
        else if (std::count(source.list.begin(), source.list.end(), address) > 0)
            return fail("'{}' is there twice", text);
        else
            source.list.push_back(address);
    }
    if (source.list.size() > kMaxServers)
        return fail("{} addresses, the limit is {}", source.list.size(), kMaxServers);
    return source;
}

std::string to_string(const ServerSource& source) {
    switch (source.kind) {
        case ServerSource::Kind::kName:
            return fmt::format("{}{}", kName, to_string(source.name));
        case ServerSource::Kind::kFile:
            return fmt::format("{}{}", kFile, source.file);
        case ServerSource::Kind::kList:
            break;
    }
    std::string text;
    for (const Address& address : source.list)
        text += fmt::format("{}{}", text.empty() ? "" : ",", to_string(address));
    return text;
}

Result<std::vector<Address>> parse_server_list(std::string_view text) {
    std::vector<Address> addresses;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view what = trimmed(text.substr(0, std::min(end, text.find('#'))));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (what.empty()) continue;
        const auto address = parse_address(what);
        if (!address) return fail("line {}: {}", line, address.error().message);
        if (addresses.size() == kMaxServers)
            return fail("line {}: more than {} addresses", line, kMaxServers);
        addresses.push_back(*address);
    }
    return addresses;
}

}  // namespace swath
