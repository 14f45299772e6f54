#pragma once
#include <cstddef>
#include <cstdint>

namespace swath {

// A server: in a plan its rank, 0 to N-1; on the wire the number that it keeps for the whole run.
enum class ServerId : std::uint32_t {};
constexpr std::size_t index(ServerId id) { return static_cast<std::size_t>(id); }
constexpr ServerId server_id(std::size_t i) { return static_cast<ServerId>(i); }
inline constexpr std::size_t kMaxServers = 1024;

// An object's index in its ObjectSet. Objects are drawn in ascending order, and the smaller id wins where
// depths are equal.
using ObjectId = std::uint32_t;

inline constexpr ObjectId kMaxObjects = 0x7fffffff;

using FrameNumber = std::uint64_t;

}  // namespace swath
