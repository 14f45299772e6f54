#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace swath {

// What the values of an enumeration are called, wherever people or files name them: one table beside each
// enumeration.
//
//     enum class Colour { kRed, kBlue };
//     template <>
//     inline constexpr auto kNames<Colour> = names_of<Colour>("colour", {{Colour::kRed, "red"}, ...});

template <class E>
struct Named {
    E value;
    std::string_view name;
};
template <class E, std::size_t N>
struct NameTable {
    std::string_view what;  // one of them is, for errors; may be empty
    std::array<Named<E>, N> rows;
};
template <class E, std::size_t N>
consteval NameTable<E, N> names_of(std::string_view what, const Named<E> (&rows)[N]) {
    return {what, std::to_array(rows)};
}

template <class E>
inline constexpr std::nullptr_t kNames = nullptr;

template <class E>
concept NamedEnum = requires {
    kNames<E>.rows;
};

// All values, in the order of the table.
template <NamedEnum E>
inline constexpr auto kAll = [] {
    std::array<E, kNames<E>.rows.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = kNames<E>.rows[i].value;
    return all;
}();

namespace names_detail {
// Throws CheckFailed: a value without a name is a bug.
[[noreturn]] void fail_unnamed(std::string_view what);
Error not_known(std::string_view what, std::string_view name, std::string_view known);
}  // namespace names_detail

template <NamedEnum E>
std::string_view name_of(E value) {
    for (const Named<E>& row : kNames<E>.rows)
        if (row.value == value) return row.name;
    names_detail::fail_unnamed(kNames<E>.what);
}

// The value that has this number, in files and messages; or none.
template <NamedEnum E>
std::optional<E> value_of(std::uint64_t number) {
    for (const Named<E>& row : kNames<E>.rows)
        if (static_cast<std::uint64_t>(row.value) == number) return row.value;
    return std::nullopt;
}

// "red, blue"
template <NamedEnum E>
std::string name_list() {
    std::string list;
    for (const Named<E>& row : kNames<E>.rows) {
        if (!list.empty()) list += ", ";
        list += row.name;
    }
    return list;
}

// The error names what there is.
template <NamedEnum E>
Result<E> parse(std::string_view name) {
    for (const Named<E>& row : kNames<E>.rows)
        if (row.name == name) return row.value;
    return tl::unexpected(names_detail::not_known(kNames<E>.what, name, name_list<E>()));
}

}  // namespace swath
