#include "common/timeline/timeline.h"

#include <fmt/core.h>

namespace swath {
namespace {

constexpr std::string_view kServerPrefix = "server ";

}  // namespace

std::string server_name(ServerId id) { return fmt::format("{}{}", kServerPrefix, index(id)); }

bool is_server(std::string_view machine) { return machine.starts_with(kServerPrefix); }

}  // namespace swath
