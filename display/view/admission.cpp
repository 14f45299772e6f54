#include "display/view/admission.h"

#include <openssl/crypto.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace swath {
namespace {

constexpr std::uint16_t kHttpPort = 80;  // browsers leave this port out

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

// True for a name or address, with or without a port. It can mean nothing else in a header or a policy.
bool plausible_host(std::string_view host) {
    return !host.empty() && std::ranges::all_of(host, [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
               c == '-' || c == '_' || c == ':' || c == '[' || c == ']';
    });
}

// Cuts the next piece, up to the separator, off `text`. The piece has no blanks around it.
std::string_view next_piece(std::string_view& text, char separator) {
    const std::size_t end = std::min(text.find(separator), text.size());
    std::string_view piece = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (piece.starts_with(' ')) piece.remove_prefix(1);
    while (piece.ends_with(' ')) piece.remove_suffix(1);
    return piece;
}

// Compares in a time that does not tell where they differ.
bool same(std::string_view a, std::string_view b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace

Admission::Admission(const Address& reached, bool loopback, std::string token)
    : token_(std::move(token)), cookie_name_(fmt::format("swath-{}", reached.port)) {
    if (!loopback) return;
    for (const std::string& host :
         {std::string("localhost"), std::string("127.0.0.1"), std::string("::1"), lower(reached.host)}) {
        hosts_.push_back(to_string({host, reached.port}));
        if (reached.port != kHttpPort) continue;
        const std::string& with_port = hosts_.back();
        hosts_.push_back(with_port.substr(0, with_port.rfind(':')));
    }
}

std::string_view Admission::refusal(const Visitor& visitor) const {
    if (visitor.hosts.size() != 1 || !plausible_host(visitor.hosts[0])) return "no such host";
    if (!hosts_.empty() && std::ranges::count(hosts_, lower(visitor.hosts[0])) == 0) return "not this host";
    if (!token_.empty() && !has_token(visitor))
        return "this needs the token: open the address that swath-display printed";
    return {};
}

std::string_view Admission::upgrade_refusal(const Visitor& visitor) {
    if (visitor.origins.size() != 1) return "no origin";
    if (lower(visitor.origins[0]) != "http://" + lower(visitor.hosts[0])) return "a page of another origin";
    return {};
}

std::string Admission::cookie() const {
    if (token_.empty()) return {};
    return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name_, token_);
}

bool Admission::has_token(const Visitor& visitor) const {
    if (const auto mark = visitor.target.find('?'); mark != std::string_view::npos) {
        std::string_view query = visitor.target.substr(mark + 1);
        while (!query.empty()) {
            const std::string_view piece = next_piece(query, '&');
            if (piece.starts_with("token=") && same(piece.substr(6), token_)) return true;
        }
    }
    for (std::string_view cookies : visitor.cookies)
        while (!cookies.empty()) {
            std::string_view value = next_piece(cookies, ';');
            if (next_piece(value, '=') == cookie_name_ && same(value, token_)) return true;
        }
    return false;
}

std::string make_token() {
    std::array<std::uint8_t, 32> bytes{};
    if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
        throw std::runtime_error("no random bytes for the viewer's token");
    std::string token;
    for (const std::uint8_t byte : bytes) token += fmt::format("{:02x}", byte);
    return token;
}

}  // namespace swath
