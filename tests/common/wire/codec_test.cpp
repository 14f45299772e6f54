#include "common/wire/codec.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/common/wire/sample_messages.h"

namespace swath {
namespace {

using namespace test;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}
std::string error_of(const auto& result) { return result ? "no error" : result.error().message; }

TEST(Head, OfEveryKindOfMessageComesBackAsItWas) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        const std::vector<Message> messages = sample_messages(seed);
        ASSERT_EQ(messages.size(), std::variant_size_v<Message>);
        for (std::size_t kind = 0; kind < messages.size(); ++kind) {
            ASSERT_EQ(messages[kind].index(), kind);
            const auto back = decode_head(bytes_of(encode_head(messages[kind])));
            ASSERT_TRUE(back.has_value()) << back.error().message << ", seed " << seed;
            ASSERT_TRUE(*back == messages[kind]) << name(messages[kind]) << ", seed " << seed;
        }
    }
}

TEST(Head, OfEveryKindHasANameOfItsOwn) {
    std::set<std::string_view> names;
    for (const Message& message : sample_messages(0)) names.insert(name(message));
    EXPECT_EQ(names.size(), std::variant_size_v<Message>);
    EXPECT_EQ(name(Message(RenderFrame{})), "RenderFrame");
    EXPECT_EQ(name(Message(Bye{})), "Bye");
}

TEST(Head, KeepsAWholeFrameTask) {
    const RenderFrame task = sample_render_frame();
    EXPECT_EQ(decode_head(bytes_of(encode_head(task))), Message(task));
}

TEST(Head, HasRoomForAReportOfTheMostAndTheLargestCounts) {
    ServerReport report;
    report.visible.assign(kMaxVisibleCounts, ~0u);
    report.spans.assign(4096,
                        {Phase::kWait, Nanoseconds(1), Nanoseconds(std::int64_t{1} << 60), Nanoseconds(1)});
    report.counters.fill(~std::uint64_t{0});
    const std::string head = encode_head(report);
    EXPECT_LT(head.size(), WireLimits{}.max_head_bytes);
    EXPECT_EQ(decode_head(bytes_of(head)), Message(report));
}

TEST(Head, CarriesPathsThatAreNotUtf8) {
    ServerSetup setup;
    setup.model = "/models/caf\xe9.ply";
    EXPECT_EQ(decode_head(bytes_of(encode_head(setup))), Message(setup));
    // A cut within a character must not lose the whole line.
    const Failed failed{std::string(4095, 'x') + "\xc3\xa9"};
    EXPECT_EQ(decode_head(bytes_of(encode_head(failed))), Message(Failed{failed.what.substr(0, 4096)}));
}

TEST(Head, CutsWhatFailedToItsLimit) {
    const auto back = decode_head(bytes_of(encode_head(Failed{std::string(10'000, 'x')})));
    EXPECT_EQ(back, Message(Failed{std::string(4096, 'x')}));
}

TEST(Head, OfNoKindIsRefused) {
    EXPECT_EQ(error_of(decode_head({})), "a message of no kind that this version knows");
    const std::string unknown("\xfa\x01\x00", 3);  // field 31, empty
    EXPECT_EQ(error_of(decode_head(bytes_of(unknown))), "a message of no kind that this version knows");
    EXPECT_EQ(error_of(decode_head(bytes_of(unknown).first(2))), "a garbled message head");
}

TEST(Head, ThatIsCutShortOrDamagedIsRefusedOrAMessage) {
    std::mt19937 random(1);
    for (std::uint32_t seed = 0; seed < 40; ++seed)
        for (const Message& message : sample_messages(seed)) {
            const std::string head = encode_head(message);
            for (std::size_t length = 0; length < head.size(); ++length) {
                const auto part = decode_head(bytes_of(head).first(length));
                ASSERT_TRUE(part.has_value() || !part.error().message.empty());
            }
            for (int round = 0; round < 20 && !head.empty(); ++round) {
                std::string damaged = head;
                for (std::size_t i = random() % 3 + 1; i > 0; --i)
                    damaged[random() % damaged.size()] = static_cast<char>(random());
                const auto back = decode_head(bytes_of(damaged));
                if (!back) continue;
                // A head that is decoded can be sent on.
                ASSERT_EQ(decode_head(bytes_of(encode_head(*back))), *back);
            }
        }
}

TEST(Head, OfRandomBytesIsRefusedOrAMessage) {
    std::mt19937 random(2);
    for (int round = 0; round < 20'000; ++round) {
        std::string garbage(random() % 64, '\0');
        for (char& c : garbage) c = static_cast<char>(random());
        const auto back = decode_head(bytes_of(garbage));
        ASSERT_TRUE(back.has_value() || !back.error().message.empty());
    }
}

class PrefixTest : public testing::Test {
  protected:
    std::string refused(const std::array<std::uint8_t, kPrefixBytes>& bytes) {
        return error_of(decode_prefix(bytes, limits_));
    }
    const WireLimits limits_{1000, 2000};
    std::array<std::uint8_t, kPrefixBytes> bytes_ = encode_prefix({300, 0x01020304 % 2000});
};

TEST_F(PrefixTest, HasTheseBytes) {
    const std::array<std::uint8_t, kPrefixBytes> expected{'S',  'W',  'T',  'H',  6,    0,    0,    0,
                                                          0x04, 0x03, 0x02, 0x01, 0x08, 0x07, 0x06, 0x05};
    EXPECT_EQ(encode_prefix({0x01020304, 0x05060708}), expected);
    EXPECT_EQ(decode_prefix(expected, {0xffffffff, 0xffffffff}), (Prefix{0x01020304, 0x05060708}));
}

TEST_F(PrefixTest, MayAnnounceAsMuchAsTheLimits) {
    EXPECT_EQ(decode_prefix(encode_prefix({1000, 2000}), limits_), (Prefix{1000, 2000}));
    EXPECT_EQ(refused(encode_prefix({1001, 0})), "a message head of 1001 bytes, the limit is 1000");
    EXPECT_EQ(refused(encode_prefix({0, 2001})), "a message body of 2001 bytes, the limit is 2000");
    EXPECT_EQ(refused(encode_prefix({0xffffffff, 0xffffffff})),
              "a message head of 4294967295 bytes, the limit is 1000");
    EXPECT_EQ(error_of(decode_prefix(encode_prefix({1, 1}), kHelloLimits)),
              "a message body of 1 bytes, the limit is 0");
}

TEST_F(PrefixTest, OfAnotherProtocolIsRefused) {
    for (std::size_t i = 0; i < 4; ++i) {
        auto other = bytes_;
        other[i] ^= 0x20;
        EXPECT_EQ(refused(other), "not a Swath message");
    }
}

TEST_F(PrefixTest, OfAnotherVersionNamesBoth) {
    bytes_[4] = 1;
    EXPECT_EQ(refused(bytes_), "speaks version 1 of the protocol, this program speaks 6");
    bytes_[4] = 2;
    bytes_[5] = 1;
    EXPECT_EQ(refused(bytes_), "speaks version 258 of the protocol, this program speaks 6");
}

TEST_F(PrefixTest, WithBitsWhereNoneBelongIsRefused) {
    bytes_[6] = 1;
    EXPECT_EQ(refused(bytes_), "a garbled message prefix");
}

// The example of docs/wire.md; tests/common/image holds its body to the same bytes.
TEST(Head, OfTheWorkedExampleIsWhatTheDocumentShows) {
    const std::string swath = encode_head(SwathPixels{7, {3, 6, 6}});
    EXPECT_EQ(swath, std::string("\x6a\x08\x08\x07\x10\x03\x18\x06\x20\x06", 10));
    EXPECT_EQ(encode_head(TilePixels{7, {3, 6, 0}}), std::string("\x72\x06\x08\x07\x10\x03\x18\x06", 8));
    EXPECT_EQ(encode_head(Bye{}), std::string("\x92\x01\x00", 3));
    const auto prefix = encode_prefix({static_cast<std::uint32_t>(swath.size()), 33});
    EXPECT_EQ(std::string(prefix.begin(), prefix.end()),
              std::string("SWTH\x06\0\0\0\x0a\0\0\0\x21\0\0\0", 16));
}

}  // namespace
}  // namespace swath
