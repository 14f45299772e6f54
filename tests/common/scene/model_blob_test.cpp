#include "common/scene/model_blob.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string_view>
#include <vector>

#include "tests/support/models.h"

namespace swath {
namespace {

using ::testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kVersionAt = 4;
constexpr std::size_t kVerticesAt = 8;
constexpr std::size_t kIndicesAt = 16;
constexpr std::size_t kMaterialsAt = 24;
constexpr std::size_t kMotionsAt = 32;
constexpr std::size_t kBodyAt = 40;

Bytes cube_blob() {
    const Buffer blob = write_blob(test::cube());
    return Bytes(blob.data(), blob.data() + blob.size());
}

template <class T>
Bytes with(Bytes bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof(value));
    return bytes;
}

std::string why_not(const Bytes& bytes) {
    const Result<Mesh> mesh = read_blob(bytes);
    return mesh ? "valid" : mesh.error().message;
}

TEST(ModelBlobTest, a_mesh_survives_the_round_trip_bit_for_bit) {
    Mesh painted = test::cube();
    for (std::uint32_t t = 0; t < painted.triangle_count(); ++t) painted.materials.push_back(7 * t);
    Mesh moving = painted;
    for (int v = 0; v < 8; ++v) moving.motion.emplace_back(v, 0.5f, -v);
    for (const Mesh& mesh : {test::cube(), test::triangle_soup(1000, 1), painted, moving}) {
        const Buffer blob = write_blob(mesh);
        EXPECT_EQ(blob.size(), 40 + 24 * mesh.vertices.size() +
                                   4 * (mesh.indices.size() + mesh.materials.size()) +
                                   12 * mesh.motion.size());
        const Result<Mesh> again = read_blob(blob.bytes());
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(*again, mesh);
    }
}

TEST(ModelBlobTest, the_digest_is_sha_256) {
    constexpr std::string_view kText = "abc";
    const Digest abc = digest({reinterpret_cast<const std::uint8_t*>(kText.data()), kText.size()});
    EXPECT_EQ(to_hex(abc), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(to_hex(digest({})), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(ModelBlobTest, every_prefix_is_refused) {
    const Bytes blob = cube_blob();
    for (std::size_t size = 0; size < blob.size(); ++size) {
        // Copies exactly that many bytes, so that the sanitizers see a read past the end.
        EXPECT_NE(why_not(Bytes(blob.begin(), blob.begin() + static_cast<std::ptrdiff_t>(size))), "valid")
            << size;
    }
}

TEST(ModelBlobTest, bytes_after_the_end_are_refused) {
    Bytes blob = cube_blob();
    blob.push_back(0);
    EXPECT_THAT(why_not(blob),
                HasSubstr("377 bytes, 8 vertices, 36 indices, 0 material numbers and 0 motions need 376"));
}

TEST(ModelBlobTest, another_magic_or_version_is_refused) {
    EXPECT_THAT(why_not(with(cube_blob(), 0, 'X')), HasSubstr("SWMB"));
    EXPECT_EQ(why_not(with(cube_blob(), kVersionAt, std::uint32_t{1})),
              "model blob: version 1, this program reads 3");
    EXPECT_THAT(why_not(with(cube_blob(), kVersionAt, std::uint32_t{4})), HasSubstr("version 4"));
}

TEST(ModelBlobTest, counts_that_overflow_are_refused_by_their_limits) {
    EXPECT_THAT(why_not(with(cube_blob(), kVerticesAt, std::uint64_t{0xffff'fff1})),
                HasSubstr("the limit is"));
    EXPECT_THAT(why_not(with(cube_blob(), kIndicesAt, ~std::uint64_t{0})), HasSubstr("the limit is"));
    EXPECT_THAT(why_not(with(cube_blob(), kMaterialsAt, ~std::uint64_t{0})), HasSubstr("the limit is"));
    EXPECT_THAT(why_not(with(cube_blob(), kMotionsAt, std::uint64_t{1} << 62)), HasSubstr("the limit is"));
    EXPECT_THAT(why_not(with(cube_blob(), kMotionsAt, std::uint64_t{8})), HasSubstr("8 motions need 472"));
    // 24 * 2^61 and 4 * 2^62 are 0 in 64 bits.
    EXPECT_THAT(why_not(with(cube_blob(), kVerticesAt, std::uint64_t{1} << 61 | 8)),
                HasSubstr("the limit is"));
    EXPECT_THAT(why_not(with(cube_blob(), kIndicesAt, std::uint64_t{1} << 62 | 36)),
                HasSubstr("the limit is"));
    EXPECT_THAT(why_not(with(cube_blob(), kVerticesAt, std::uint64_t{4'000'000'000})),
                HasSubstr("need 96000000184"));
}

TEST(ModelBlobTest, a_mesh_that_cannot_be_rendered_is_refused) {
    EXPECT_THAT(why_not(with(cube_blob(), kBodyAt, std::uint32_t{0x7fc00000})), HasSubstr("not finite"));
    EXPECT_THAT(why_not(with(cube_blob(), kBodyAt + 8 * 24, std::uint32_t{8})), HasSubstr("out of range"));
    Mesh painted = test::cube();
    painted.materials.assign(12, 0);
    const Buffer blob = write_blob(painted);
    EXPECT_THAT(why_not(with(Bytes(blob.data(), blob.data() + blob.size()), blob.size() - 4, ~0u)),
                HasSubstr("1 material numbers out of range"));
    Mesh moving = test::cube();
    moving.motion.assign(8, glm::vec3(0));
    const Buffer fast = write_blob(moving);
    EXPECT_THAT(why_not(with(Bytes(fast.data(), fast.data() + fast.size()), fast.size() - 4, 0x7f800000u)),
                HasSubstr("1 vertices move to"));
    moving.motion.pop_back();
    EXPECT_THAT(why_not([&] {
                    const Buffer few = write_blob(moving);
                    return Bytes(few.data(), few.data() + few.size());
                }()),
                HasSubstr("7 motions for 8 vertices"));
    Mesh empty = test::cube();
    empty.indices.clear();
    EXPECT_FALSE(read_blob(write_blob(empty).bytes()));
}

}  // namespace
}  // namespace swath
