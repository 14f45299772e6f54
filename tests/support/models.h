#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/scene/mesh.h"

namespace swath::test {

// Finds a file in the folder of real models beside the repository, by its path in there; nothing if it is
// missing. Tests skip then: SWATH_SHARED_MODEL(path, "dragon.ply");
std::optional<std::filesystem::path> shared_model(std::string_view name);

// A cube from 0 to `size` of 12 triangles that share 8 vertices.
Mesh cube(float size = 1);

// `triangles` triangles of all sizes in a box of unequal sides, some without area and some equal.
// Deterministic.
Mesh triangle_soup(std::size_t triangles, std::uint32_t seed);

// A folder for a test's files, removed with its contents at the end of the scope.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    // Writes the file and returns its path.
    std::string write(const std::string& name, std::string_view text) const;
    std::string path_of(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

}  // namespace swath::test

// Declares `variable`, the path of a shared model, or skips the test if there is none.
#define SWATH_SHARED_MODEL(variable, name)                                          \
    const auto variable##_found = ::swath::test::shared_model(name);                \
    if (!variable##_found) GTEST_SKIP() << "shared model " << name << " not found"; \
    const std::string variable = variable##_found->string()
