#pragma once
#include <cstddef>
#include <cstdint>

namespace swath {

// A server's place in a frame, 0 to N-1; between programs its number in the session.
enum class ServerId : std::uint32_t {};
constexpr std::size_t index(ServerId id) { return static_cast<std::size_t>(id); }
constexpr ServerId server_id(std::size_t i) { return static_cast<ServerId>(i); }
inline constexpr std::size_t kMaxServers = 1024;

// An object's place in its ObjectSet. Ascending ids are the drawing order and break depth ties.
using ObjectId = std::uint32_t;

inline constexpr ObjectId kMaxObjects = 0x7fffffff;

using FrameNumber = std::uint64_t;

}  // namespace swath
