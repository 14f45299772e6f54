#include "common/timeline/timeline.h"

#include <fmt/format.h>

#include "common/base/check.h"

namespace swath {
namespace {

constexpr std::array<std::string_view, kPhaseCount> kPhaseNames{
    "partition",  "cull", "render",   "pixel read", "swap", "pixel write",
    "final read", "send", "assemble", "encode",     "wait"};
static_assert(static_cast<std::size_t>(Phase::kWait) + 1 == kPhaseCount);

constexpr std::array<std::string_view, kCounterCount> kCounterNames{
    "triangles",  "objects",         "swap_pixels", "swap_bytes", "tile_pixels",
    "tile_bytes", "received_pixels", "leaves",      "split_level"};
static_assert(static_cast<std::size_t>(Counter::kSplitLevel) + 1 == kCounterCount);

constexpr std::string_view kServerPrefix = "server ";

}  // namespace

std::string_view name(Phase phase) {
    const auto i = static_cast<std::size_t>(phase);
    CHECK(i < kPhaseCount);
    return kPhaseNames[i];
}

std::string_view name(Counter counter) {
    const auto i = static_cast<std::size_t>(counter);
    CHECK(i < kCounterCount);
    return kCounterNames[i];
}

std::string server_name(ServerId id) { return fmt::format("{}{}", kServerPrefix, index(id)); }

bool is_server(std::string_view machine) { return machine.starts_with(kServerPrefix); }

}  // namespace swath
