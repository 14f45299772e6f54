#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "common/wire/address.h"

namespace swath {

// The fields of a request's head that say who asks. Views live as long as the head.
struct Visitor {
    std::vector<std::string_view> hosts;  // the values of all its Host fields; the others likewise
    std::vector<std::string_view> origins;
    std::vector<std::string_view> cookies;
    std::string_view target;  // path and query
};

// Decides who may ask the web server anything. This protects a person's cluster from other pages in the same
// browser (docs/viewer.md, HTTP). On loopback the Host must be ours, which a stranger's name that was made to
// point here (DNS rebinding) is not. Elsewhere a token is needed. A value; any thread.
class Admission {
  public:
    // `reached` is the address that people use. `token` is empty on loopback.
    Admission(const Address& reached, bool loopback, std::string token);

    // The reason to refuse the request, or empty.
    std::string_view refusal(const Visitor& visitor) const;
    // The reason to refuse its upgrade to a WebSocket, or empty; asked in addition.
    static std::string_view upgrade_refusal(const Visitor& visitor);

    // The value of Set-Cookie after a request that has the token in its address; empty if there is no token.
    std::string cookie() const;
    const std::string& token() const { return token_; }

  private:
    bool has_token(const Visitor& visitor) const;

    std::vector<std::string> hosts_;  // ours, in lower case; empty: any
    std::string token_;
    std::string cookie_name_;
};

// 32 random bytes of OpenSSL's generator in hexadecimal. Throws std::runtime_error if the generator fails.
std::string make_token();

}  // namespace swath
