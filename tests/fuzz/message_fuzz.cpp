#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/wire/codec.h"

// A prefix, then a head: either an error of one line, or a message that survives being encoded and decoded
// again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swath;
    if (size < kPrefixBytes) return 0;
    const WireLimits limits;
    const auto prefix =
        decode_prefix(std::span<const std::uint8_t, kPrefixBytes>(data, kPrefixBytes), limits);
    if (!prefix && prefix.error().message.empty()) std::abort();
    if (prefix && (prefix->head_bytes > limits.max_head_bytes || prefix->body_bytes > limits.max_body_bytes))
        std::abort();
    // Ignores the prefix, which would keep the fuzzer from the heads.
    const auto message = decode_head({data + kPrefixBytes, size - kPrefixBytes});
    if (!message) {
        if (message.error().message.empty()) std::abort();
        return 0;
    }
    const std::string head = encode_head(*message);
    const auto again = decode_head({reinterpret_cast<const std::uint8_t*>(head.data()), head.size()});
    if (!again || *again != *message) std::abort();
    return 0;
}
