#include "common/base/buffer.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string_view>
#include <type_traits>

namespace swath {
namespace {

// The tests read only bytes that they wrote: resize leaves new bytes undefined.
void fill(Buffer& buffer) { std::iota(buffer.data(), buffer.data() + buffer.size(), std::uint8_t{1}); }

std::string_view text(const Buffer& buffer) {
    return {reinterpret_cast<const char*>(buffer.data()), buffer.size()};
}

TEST(Buffer, StartsEmptyWithoutMemory) {
    const Buffer buffer;
    EXPECT_TRUE(buffer.empty());
    EXPECT_EQ(buffer.data(), nullptr);
    EXPECT_TRUE(buffer.bytes().empty());
}

TEST(Buffer, GrowthKeepsTheContents) {
    Buffer buffer(100);
    fill(buffer);
    buffer.resize(100'000);
    EXPECT_EQ(buffer.size(), 100'000u);
    for (std::size_t i = 0; i < 100; ++i) ASSERT_EQ(buffer.data()[i], i + 1);
}

TEST(Buffer, ShrinkingAndGrowingWithinTheCapacityStaysInPlace) {
    Buffer buffer(100);
    const std::uint8_t* const block = buffer.data();
    fill(buffer);
    buffer.resize(3);
    EXPECT_EQ(buffer.bytes().size(), 3u);
    buffer.resize(100);
    EXPECT_EQ(buffer.data(), block);
    EXPECT_EQ(buffer.data()[2], 3);
    buffer.resize(0);
    EXPECT_TRUE(buffer.empty());
    EXPECT_EQ(buffer.data(), block);
}

TEST(Buffer, AppendsPieceByPiece) {
    Buffer buffer;
    std::string expected;
    for (int i = 0; i < 1000; ++i) {
        buffer.append("swath", 5);
        expected += "swath";
    }
    EXPECT_EQ(text(buffer), expected);
    buffer.append(nullptr, 0);
    EXPECT_EQ(buffer.size(), 5000u);
}

TEST(Buffer, MovesItsBlockAndCannotBeCopied) {
    static_assert(!std::is_copy_constructible_v<Buffer> && !std::is_copy_assignable_v<Buffer>);
    Buffer buffer;
    buffer.append("tile", 4);
    const std::uint8_t* const block = buffer.data();
    const Buffer taken = std::move(buffer);
    EXPECT_EQ(taken.data(), block);
    EXPECT_EQ(text(taken), "tile");
}

TEST(Buffer, IsEmptyAndUsableAfterBeingMovedFrom) {
    Buffer buffer(64);
    const Buffer taken = std::move(buffer);
    EXPECT_TRUE(buffer.empty());
    buffer.append("again", 5);
    EXPECT_EQ(text(buffer), "again");

    Buffer other;
    other.append("other", 5);
    buffer = std::move(other);
    EXPECT_EQ(text(buffer), "other");
    other.resize(2);
    EXPECT_NE(other.data(), nullptr);
}

}  // namespace
}  // namespace swath
