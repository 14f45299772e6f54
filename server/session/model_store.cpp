#include "server/session/model_store.h"

#include <new>

#include "common/base/file.h"
#include "common/base/log.h"
#include "common/scene/model.h"

namespace swath {
namespace {
constexpr std::uint64_t kMaxBlobBytes = std::uint64_t{64} << 30;
}

std::optional<Mesh> ModelStore::find(const std::string& name, const Digest& wanted) const try {
    if (auto mesh = load_model(name)) {
        if (digest(write_blob(*mesh).bytes()) == wanted) return std::move(*mesh);
        log_info("{}: this machine's file is not the client's model", name);
    } else {
        log_info("{}; looking in the cache", mesh.error().message);
    }
    std::error_code ignored;
    if (!std::filesystem::exists(file(wanted), ignored)) return std::nullopt;
    const auto blob = read_file(file(wanted), kMaxBlobBytes);
    if (!blob) {
        log_warning("model cache: {}", blob.error().message);
        return std::nullopt;
    }
    if (digest(blob->bytes()) != wanted) {
        log_warning("model cache: {} is damaged, fetching the model again", file(wanted).string());
        return std::nullopt;
    }
    auto mesh = read_blob(blob->bytes());
    if (!mesh) {
        log_warning("model cache: {}: {}; fetching the model again", file(wanted).string(),
                    mesh.error().message);
        return std::nullopt;
    }
    return std::move(*mesh);
} catch (const std::bad_alloc&) {
    log_warning("{}: not enough memory to read it", name);
    return std::nullopt;
}

Result<Mesh> ModelStore::accept(std::span<const std::uint8_t> blob, const Digest& wanted) const try {
    if (digest(blob) != wanted) return fail("the model that arrived does not have the announced SHA-256");
    auto mesh = read_blob(blob);
    if (!mesh) return mesh;
    if (const auto status = write_file(file(wanted), blob); !status)
        log_warning("model cache: {}", status.error().message);
    return mesh;
} catch (const std::bad_alloc&) {
    return fail("not enough memory for a model of {} bytes", blob.size());
}

}  // namespace swath
