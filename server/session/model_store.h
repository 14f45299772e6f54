#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "common/base/result.h"
#include "common/scene/mesh.h"
#include "common/scene/model_blob.h"

namespace swath {

// Finds models: by their name on this machine, then in the cache folder, which holds blobs under their
// digest. It passes over a file without the wanted digest, and one that it cannot read: the client has the
// model. Blocking; one thread at a time. Several servers may share a cache folder.
class ModelStore {
  public:
    explicit ModelStore(std::filesystem::path cache) : cache_(std::move(cache)) {}

    std::optional<Mesh> find(const std::string& name, const Digest& digest) const;

    // Checks a client's blob against the digest, parses it, and keeps it in the cache (if that fails, it only
    // logs a line).
    Result<Mesh> accept(std::span<const std::uint8_t> blob, const Digest& digest) const;

  private:
    std::filesystem::path file(const Digest& digest) const {
        return cache_ / (to_hex(digest) + ".swathmodel");
    }
    std::filesystem::path cache_;
};

}  // namespace swath
