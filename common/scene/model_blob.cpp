#include "common/scene/model_blob.h"

#include <openssl/evp.h>

#include <bit>
#include <cstring>
#include <string_view>

#include "common/base/check.h"

namespace swath {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the blob is the memory of a little-endian machine");

constexpr std::string_view kMagic = "SWMB";
constexpr std::uint32_t kVersion = 1;

struct Header {
    char magic[4];
    std::uint32_t version;
    std::uint64_t vertices;
    std::uint64_t indices;
};
static_assert(sizeof(Header) == 24);

}  // namespace

std::string to_hex(const Digest& digest) {
    std::string text;
    for (const std::uint8_t byte : digest) text += fmt::format("{:02x}", byte);
    return text;
}

Buffer write_blob(const Mesh& mesh) {
    Header header{};
    std::memcpy(header.magic, kMagic.data(), kMagic.size());
    header.version = kVersion;
    header.vertices = mesh.vertices.size();
    header.indices = mesh.indices.size();
    const std::size_t vertex_bytes = mesh.vertices.size() * sizeof(Vertex);
    const std::size_t index_bytes = mesh.indices.size() * sizeof(std::uint32_t);

    Buffer blob(sizeof(header) + vertex_bytes + index_bytes);
    std::memcpy(blob.data(), &header, sizeof(header));
    if (vertex_bytes > 0) std::memcpy(blob.data() + sizeof(header), mesh.vertices.data(), vertex_bytes);
    if (index_bytes > 0)
        std::memcpy(blob.data() + sizeof(header) + vertex_bytes, mesh.indices.data(), index_bytes);
    return blob;
}

Digest digest(std::span<const std::uint8_t> bytes) {
    Digest result{};
    unsigned int length = 0;
    CHECK(EVP_Digest(bytes.data(), bytes.size(), result.data(), &length, EVP_sha256(), nullptr) == 1);
    CHECK(length == result.size());
    return result;
}

Result<Mesh> read_blob(std::span<const std::uint8_t> bytes) {
    Header header{};
    if (bytes.size() < sizeof(header))
        return fail("model blob: {} bytes, its header alone has {}", bytes.size(), sizeof(header));
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (std::string_view(header.magic, kMagic.size()) != kMagic)
        return fail("model blob: does not start with {}", kMagic);
    if (header.version != kVersion)
        return fail("model blob: version {}, this program reads {}", header.version, kVersion);
    // With both counts below their limits the sum of the sizes cannot overflow 64 bits.
    if (header.vertices > kMaxVertices)
        return fail("model blob: {} vertices, the limit is {}", header.vertices, kMaxVertices);
    if (header.indices > 3 * kMaxTriangles)
        return fail("model blob: {} indices, the limit is {}", header.indices, 3 * kMaxTriangles);
    const std::uint64_t vertex_bytes = header.vertices * sizeof(Vertex);
    const std::uint64_t index_bytes = header.indices * sizeof(std::uint32_t);
    const std::uint64_t expected = sizeof(header) + vertex_bytes + index_bytes;
    if (bytes.size() != expected)
        return fail("model blob: {} bytes, {} vertices and {} indices need {}", bytes.size(), header.vertices,
                    header.indices, expected);

    Mesh mesh;
    mesh.vertices.resize(header.vertices);
    mesh.indices.resize(header.indices);
    const std::uint8_t* body = bytes.data() + sizeof(header);
    // (To void: GLM's vectors have assignments of their own, which do no more than copy the bytes.)
    if (vertex_bytes > 0) std::memcpy(static_cast<void*>(mesh.vertices.data()), body, vertex_bytes);
    if (index_bytes > 0) std::memcpy(mesh.indices.data(), body + vertex_bytes, index_bytes);
    if (const Status status = validate(mesh); !status) return fail_in("model blob", status.error());
    return mesh;
}

}  // namespace swath
