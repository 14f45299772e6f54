#pragma once
#include <span>
#include <string>
#include <string_view>

#include "sim/hardware/hardware.h"

namespace swath::sim {

// A profile that is compiled into the program.
struct Builtin {
    std::string_view name;
    std::string_view toml;
};
std::span<const Builtin> builtins();
const Builtin* find_builtin(std::string_view name);  // null if there is none of this name

// As parse_hardware(), but errors name `source`.
Result<Hardware> parse_profile(std::string_view toml, std::string name, std::string source);

}  // namespace swath::sim
