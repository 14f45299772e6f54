#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "common/base/result.h"
#include "common/wire/messages.h"

namespace swath {

// A message on the wire: prefix, head (protobuf), body (raw bytes). The prefix is 16 bytes, little-endian:
// "SWTH", u16 version, u16 zero, u32 head bytes, u32 body bytes.
inline constexpr std::uint16_t kWireVersion = 6;
inline constexpr std::size_t kPrefixBytes = 16;

struct Prefix {
    std::uint32_t head_bytes = 0;
    std::uint32_t body_bytes = 0;
    bool operator==(const Prefix&) const = default;
};

// What one end accepts. Checked before anything is allocated.
struct WireLimits {
    std::uint32_t max_head_bytes = 4u << 20;
    std::uint32_t max_body_bytes = 512u << 20;
};
// Until a peer has introduced itself it may say no more than this.
inline constexpr WireLimits kHelloLimits{1024, 0};

std::array<std::uint8_t, kPrefixBytes> encode_prefix(const Prefix& prefix);
Result<Prefix> decode_prefix(std::span<const std::uint8_t, kPrefixBytes> bytes, const WireLimits& limits);

std::string encode_head(const Message& message);
// Checks every field; errors name the message and the field.
Result<Message> decode_head(std::span<const std::uint8_t> bytes);

}  // namespace swath
