#include "common/wire/codec.h"

#include <cstring>
#include <limits>
#include <type_traits>

#include "common/wire/field_reader.h"
#include "common/wire/field_writer.h"
#include "common/wire/fields.h"

namespace swath {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{'S', 'W', 'T', 'H'};

void put(std::uint8_t* to, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}
std::uint32_t get(const std::uint8_t* from, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::uint32_t{from[i]} << (8 * i);
    return value;
}

// What a message is called, here and in the head.
template <class M>
struct Kind;
#define KIND(Type, field, number)                                             \
    template <>                                                               \
    struct Kind<Type> {                                                       \
        static constexpr std::string_view kName = #Type;                      \
        static constexpr pb::Head::KindCase kNumber = pb::Head::number;       \
        static auto& part(pb::Head& head) { return *head.mutable_##field(); } \
    }
KIND(Hello, hello, kHello);
KIND(Ping, ping, kPing);
KIND(Pong, pong, kPong);
KIND(ServerSetup, server_setup, kServerSetup);
KIND(DisplaySetup, display_setup, kDisplaySetup);
KIND(NeedModel, need_model, kNeedModel);
KIND(ModelPart, model_part, kModelPart);
KIND(Ready, ready, kReady);
KIND(Connect, connect, kConnect);
KIND(Connected, connected, kConnected);
KIND(RenderFrame, render_frame, kRenderFrame);
KIND(AssembleFrame, assemble_frame, kAssembleFrame);
KIND(SwathPixels, swath, kSwath);
KIND(TilePixels, tile, kTile);
KIND(ServerReport, server_report, kServerReport);
KIND(DisplayReport, display_report, kDisplayReport);
KIND(Failed, failed, kFailed);
KIND(Bye, bye, kBye);
KIND(Reconfigure, reconfigure, kReconfigure);
KIND(Audience, audience, kAudience);
KIND(Wish, wish, kWish);
KIND(Note, note, kNote);
KIND(Leave, leave, kLeave);
KIND(Lost, lost, kLost);
#undef KIND

// Reads the head if its message is an M.
template <class M>
bool read(pb::Head& head, Result<Message>& message) {
    if (head.kind_case() != Kind<M>::kNumber) return false;
    M made;
    FieldReader reader;
    fields(reader, made, Kind<M>::part(head));
    if (reader.status())
        message = std::move(made);
    else
        message = tl::unexpected(reader.status().error());
    return true;
}
template <class... M>
Result<Message> read(pb::Head& head, std::type_identity<std::variant<M...>> /*any of these*/) {
    Result<Message> message = fail("a message of no kind that this version knows");
    (void)(read<M>(head, message) || ...);
    return message;
}

}  // namespace

std::array<std::uint8_t, kPrefixBytes> encode_prefix(const Prefix& prefix) {
    std::array<std::uint8_t, kPrefixBytes> bytes{};
    std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
    put(&bytes[4], kWireVersion, 2);
    put(&bytes[8], prefix.head_bytes, 4);
    put(&bytes[12], prefix.body_bytes, 4);
    return bytes;
}

Result<Prefix> decode_prefix(std::span<const std::uint8_t, kPrefixBytes> bytes, const WireLimits& limits) {
    if (std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) return fail("not a Swath message");
    if (const std::uint32_t version = get(&bytes[4], 2); version != kWireVersion)
        return fail("speaks version {} of the protocol, this program speaks {}", version, kWireVersion);
    if (get(&bytes[6], 2) != 0) return fail("a garbled message prefix");
    const Prefix prefix{get(&bytes[8], 4), get(&bytes[12], 4)};
    if (prefix.head_bytes > limits.max_head_bytes)
        return fail("a message head of {} bytes, the limit is {}", prefix.head_bytes, limits.max_head_bytes);
    if (prefix.body_bytes > limits.max_body_bytes)
        return fail("a message body of {} bytes, the limit is {}", prefix.body_bytes, limits.max_body_bytes);
    return prefix;
}

std::string encode_head(const Message& message) {
    pb::Head head;
    std::visit(
        [&head]<class M>(const M& one) {
            FieldWriter writer;
            fields(writer, one, Kind<M>::part(head));
        },
        message);
    return head.SerializeAsString();
}

Result<Message> decode_head(std::span<const std::uint8_t> bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        return fail("a message head that is too long");
    pb::Head head;
    if (!head.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
        return fail("a garbled message head");
    auto message = read(head, std::type_identity<Message>());
    if (!message && head.kind_case() != pb::Head::KIND_NOT_SET) {
        const auto* field = pb::Head::descriptor()->FindFieldByNumber(static_cast<int>(head.kind_case()));
        return fail("a garbled {} message: {}", field->name(), message.error().message);
    }
    return message;
}

std::string_view name(const Message& message) {
    return std::visit([]<class M>(const M&) { return Kind<M>::kName; }, message);
}

}  // namespace swath
