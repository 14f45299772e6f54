#pragma once
#include <span>
#include <string>
#include <string_view>

#include "sim/hardware/hardware.h"

namespace swath::sim {

// A profile that is part of the program: its name and its text.
struct Builtin {
    std::string_view name;
    std::string_view toml;
};
std::span<const Builtin> builtins();
const Builtin* find_builtin(std::string_view name);  // null where there is none of the name

// parse_hardware() whose errors name `source`.
Result<Hardware> parse_profile(std::string_view toml, std::string name, std::string source);

}  // namespace swath::sim
