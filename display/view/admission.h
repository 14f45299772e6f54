#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "common/wire/address.h"

namespace swath {

// What a request's head says about who asks. Views live as long as the head.
struct Visitor {
    std::vector<std::string_view> hosts;  // the values of all its Host fields, and so on
    std::vector<std::string_view> origins;
    std::vector<std::string_view> cookies;
    std::string_view target;  // path and query
};

// Decides who may ask the web server anything, which is what protects a person's cluster from the pages that
// the same browser shows (docs/viewer.md, HTTP). On loopback the Host must be ours: a stranger's name that
// was made to point here (DNS rebinding) is not. Elsewhere a token is needed. Values only; any thread.
class Admission {
  public:
    // Where people reach us; `token` is empty on loopback.
    Admission(const Address& reached, bool loopback, std::string token);

    // Why the request is refused; empty if it is not.
    std::string_view refusal(const Visitor& visitor) const;
    // Likewise for an upgrade to a WebSocket, in addition.
    static std::string_view upgrade_refusal(const Visitor& visitor);

    // What goes into Set-Cookie after a request with the token in its address; empty if there is no token.
    std::string cookie() const;
    const std::string& token() const { return token_; }

  private:
    bool has_token(const Visitor& visitor) const;

    std::vector<std::string> hosts_;  // that are ours, in lower case; any if empty
    std::string token_;
    std::string cookie_name_;
};

// 32 random bytes of OpenSSL's generator in hexadecimal. Throws std::runtime_error if that has none.
std::string make_token();

}  // namespace swath
