#pragma once
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace swath {

// Thrown when one of our own invariants is broken: a bug, never bad input.
struct CheckFailed : std::logic_error {
    using std::logic_error::logic_error;
};

namespace check_detail {

[[noreturn]] void failed(const char* expression, const char* file, int line, const std::string& values);

template <class T>
void print(std::ostream& out, const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
        out << (value ? "true" : "false");
    } else if constexpr (std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::int8_t>) {
        out << static_cast<int>(value);  // a byte, not a character
    } else if constexpr (requires { out << value; }) {
        out << value;
    } else if constexpr (std::is_enum_v<T>) {
        print(out, static_cast<std::underlying_type_t<T>>(value));  // ServerId and the like
    } else {
        out << "?";
    }
}

// The outcome of a comparison, and both sides as text if it failed.
struct Outcome {
    bool ok;
    std::string values;
};

template <class L>
struct Left {
    const L& left;

    template <class R>
    Outcome outcome(bool ok, const char* op, const R& right) const {
        if (ok) return {true, {}};
        std::ostringstream out;
        print(out, left);
        out << ' ' << op << ' ';
        print(out, right);
        return {false, out.str()};
    }
    // clang-format off
    template <class R> Outcome operator==(const R& r) const { return outcome(left == r, "==", r); }
    template <class R> Outcome operator!=(const R& r) const { return outcome(left != r, "!=", r); }
    template <class R> Outcome operator<(const R& r) const { return outcome(left < r, "<", r); }
    template <class R> Outcome operator<=(const R& r) const { return outcome(left <= r, "<=", r); }
    template <class R> Outcome operator>(const R& r) const { return outcome(left > r, ">", r); }
    template <class R> Outcome operator>=(const R& r) const { return outcome(left >= r, ">=", r); }
    // clang-format on
    operator Outcome() const { return {static_cast<bool>(left), "false"}; }
};

// <=> binds tighter than every comparison and looser than arithmetic and shifts, so it takes the left side.
struct Start {
    template <class L>
    Left<L> operator<=>(const L& left) const {
        return {left};
    }
};

}  // namespace check_detail
}  // namespace swath

// CHECK(a == b) throws CheckFailed, which names both values, if it does not hold. It stays on in release
// builds. It takes one comparison or one value that converts to bool: write two CHECKs for two conditions.
#define CHECK(expression)                                                                               \
    do {                                                                                                \
        const ::swath::check_detail::Outcome swath_check_outcome =                                      \
            ::swath::check_detail::Start{} <=> expression;                                              \
        if (!swath_check_outcome.ok)                                                                    \
            ::swath::check_detail::failed(#expression, __FILE__, __LINE__, swath_check_outcome.values); \
    } while (false)

// The same in debug and sanitizer builds only, where a CHECK would cost too much: of every pixel, say.
#ifdef SWATH_DCHECK
#define DCHECK(expression) CHECK(expression)
#else
#define DCHECK(expression)            \
    do {                              \
        if (false) CHECK(expression); \
    } while (false)
#endif
