#pragma once
#include <fmt/core.h>

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace swath {

// One line that a person can act on: it names the thing (file, flag, peer, field) and the limit.
struct Error {
    std::string message;
    bool operator==(const Error&) const = default;
};

// A value or an Error. What a file, a peer or a user gets wrong is reported this way and never asserted.
template <class T>
using Result = tl::expected<T, Error>;
using Status = tl::expected<void, Error>;

// return fail("{}: truncated after {} bytes", path, n);
template <class... Args>
tl::unexpected<Error> fail(fmt::format_string<Args...> format, Args&&... args) {
    return tl::unexpected<Error>(Error{fmt::format(format, std::forward<Args>(args)...)});
}

// Passes an error on with a prefix that says where it happened.
inline tl::unexpected<Error> fail_in(std::string_view where, const Error& error) {
    return tl::unexpected<Error>(Error{fmt::format("{}: {}", where, error.message)});
}

}  // namespace swath

// SWATH_TRY(const Mesh mesh, load(path)) puts a Result's value into a variable, a new one or one that is
// there. An error leaves the function, which itself returns a Result or a Status. It is several statements:
// an `if` around it needs braces.
#define SWATH_TRY(variable, ...)                                                              \
    auto SWATH_TRY_NAME(__LINE__) = (__VA_ARGS__);                                            \
    if (!SWATH_TRY_NAME(__LINE__))                                                            \
        return ::tl::unexpected<::swath::Error>(std::move(SWATH_TRY_NAME(__LINE__)).error()); \
    variable = *std::move(SWATH_TRY_NAME(__LINE__))

// SWATH_TRY_VOID(check(mesh)) does the same for a Status, or a Result whose value nobody wants. It is one
// statement.
#define SWATH_TRY_VOID(...)                                                                       \
    do {                                                                                          \
        if (auto SWATH_TRY_NAME(__LINE__) = (__VA_ARGS__); !SWATH_TRY_NAME(__LINE__))             \
            return ::tl::unexpected<::swath::Error>(std::move(SWATH_TRY_NAME(__LINE__)).error()); \
    } while (false)

#define SWATH_TRY_NAME(line) SWATH_TRY_JOIN(swath_try_, line)
#define SWATH_TRY_JOIN(a, b) a##b
