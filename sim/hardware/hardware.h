#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "client/cost/hardware.h"
#include "common/base/result.h"

namespace swath::sim {

// Reads a profile in TOML; README.md documents the format. Errors name the profile, the line and the key, and
// say what was expected.
Result<Hardware> parse_hardware(std::string_view toml, std::string name);

// Finds a built-in profile, or reads the file if the name ends in ".toml".
Result<Hardware> find_hardware(const std::string& name_or_file);
std::vector<std::string> builtin_hardware();

// Every value with its unit and its meaning, one a line.
std::string explain(const Hardware& hardware);

}  // namespace swath::sim
