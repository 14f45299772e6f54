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
constexpr std::uint32_t kVersion = 3;

struct Header {
    char magic[4];
    std::uint32_t version;
    std::uint64_t vertices;
    std::uint64_t indices;
    std::uint64_t materials;
    std::uint64_t motions;
};
static_assert(sizeof(Header) == 40);
static_assert(sizeof(glm::vec3) == 12);

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

// put() and get() copy values and advance the pointer. (The cast to void silences a warning: GLM's vectors
// have assignments of their own, which do no more than copy the bytes.)
template <class T>
void put(const std::vector<T>& values, std::uint8_t*& to) {
    if (!values.empty()) std::memcpy(to, values.data(), bytes_of(values));
    to += bytes_of(values);
}
template <class T>
void get(const std::uint8_t*& from, std::uint64_t count, std::vector<T>& values) {
    values.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), from, bytes_of(values));
    from += bytes_of(values);
}

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
    header.materials = mesh.materials.size();
    header.motions = mesh.motion.size();

    Buffer blob(sizeof(header) + bytes_of(mesh.vertices) + bytes_of(mesh.indices) + bytes_of(mesh.materials) +
                bytes_of(mesh.motion));
    std::memcpy(blob.data(), &header, sizeof(header));
    std::uint8_t* to = blob.data() + sizeof(header);
    put(mesh.vertices, to);
    put(mesh.indices, to);
    put(mesh.materials, to);
    put(mesh.motion, to);
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
    // With all counts within their limits the sum of sizes does not overflow 64 bits.
    if (header.vertices > kMaxVertices)
        return fail("model blob: {} vertices, the limit is {}", header.vertices, kMaxVertices);
    if (header.indices > 3 * kMaxTriangles)
        return fail("model blob: {} indices, the limit is {}", header.indices, 3 * kMaxTriangles);
    if (header.materials > kMaxTriangles)
        return fail("model blob: {} material numbers, the limit is {}", header.materials, kMaxTriangles);
    if (header.motions > kMaxVertices)
        return fail("model blob: {} motions, the limit is {}", header.motions, kMaxVertices);
    const std::uint64_t expected = sizeof(header) + header.vertices * sizeof(Vertex) +
                                   (header.indices + header.materials) * sizeof(std::uint32_t) +
                                   header.motions * sizeof(glm::vec3);
    if (bytes.size() != expected)
        return fail(
            "model blob: {} bytes, {} vertices, {} indices, {} material numbers and {} motions need {}",
            bytes.size(), header.vertices, header.indices, header.materials, header.motions, expected);

    Mesh mesh;
    const std::uint8_t* from = bytes.data() + sizeof(header);
    get(from, header.vertices, mesh.vertices);
    get(from, header.indices, mesh.indices);
    get(from, header.materials, mesh.materials);
    get(from, header.motions, mesh.motion);
    if (const Status status = validate(mesh); !status) return fail_in("model blob", status.error());
    return mesh;
}

}  // namespace swath
