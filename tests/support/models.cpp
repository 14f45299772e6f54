#include "tests/support/models.h"

#include <cstdlib>
#include <random>
#include <span>

#include "common/base/check.h"
#include "common/base/file.h"

namespace swath::test {

std::optional<std::filesystem::path> shared_model(std::string_view name) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::path(SWATH_SHARED_MODELS) / name;
    if (!std::filesystem::exists(path, error)) return std::nullopt;
    return path.lexically_normal();
}

Mesh cube(float size) {
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        Vertex vertex;
        vertex.position = size * glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        mesh.vertices.push_back(vertex);
    }
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    compute_normals(mesh);
    return mesh;
}

Mesh triangle_soup(std::size_t triangles, std::uint32_t seed) {
    std::mt19937 generator(seed);  // its numbers are the same everywhere, unlike those of distributions
    const auto number = [&] { return static_cast<float>(generator() >> 8) / 16777216.0f; };
    Mesh mesh;
    for (std::size_t t = 0; t < triangles; ++t) {
        const glm::vec3 place = glm::vec3(10, 3, 1) * glm::vec3(number(), number(), number());
        const float size = t % 17 == 0 ? 0.0f : 0.01f / (0.005f + number());
        for (int corner = 0; corner < 3; ++corner) {
            Vertex vertex;
            vertex.position = place + size * glm::vec3(number(), number(), number());
            vertex.colour = {static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(t >> 8), 0, 255};
            if (t % 5 != 4 || corner != 0) mesh.vertices.push_back(vertex);
        }
        // Every fifth triangle shares a corner with the one before; every eleventh comes twice.
        const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        mesh.indices.insert(mesh.indices.end(), {last - 2, last - 1, last});
        if (t % 11 == 10 && ++t < triangles)
            mesh.indices.insert(mesh.indices.end(), {last - 2, last - 1, last});
    }
    compute_normals(mesh);
    return mesh;
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "swath-test-XXXXXX").string();
    CHECK(::mkdtemp(name.data()) != nullptr);
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, std::string_view text) const {
    const std::string path = path_of(name);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    CHECK(write_file(path, std::span(bytes, text.size())).has_value());
    return path;
}

}  // namespace swath::test
