#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "common/base/result.h"
#include "common/scene/mesh.h"
#include "common/scene/model_blob.h"

namespace swath {

// Where a server finds models: by their name on this machine, then in the cache folder, which holds blobs
// under their digest. A file that does not have the wanted digest is passed over, and one that cannot be read
// is too: the client has the model. Blocking; one thread at a time. Several servers may share a cache folder.
class ModelStore {
  public:
    explicit ModelStore(std::filesystem::path cache) : cache_(std::move(cache)) {}

    std::optional<Mesh> find(const std::string& name, const Digest& digest) const;

    // A blob that a client sent: checked against the digest, parsed, and kept in the cache (if that fails,
    // only a line in the log).
    Result<Mesh> accept(std::span<const std::uint8_t> blob, const Digest& digest) const;

  private:
    std::filesystem::path file(const Digest& digest) const {
        return cache_ / (to_hex(digest) + ".swathmodel");
    }
    std::filesystem::path cache_;
};

}  // namespace swath
