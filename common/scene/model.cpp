#include "common/scene/model.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "common/base/file.h"
#include "common/scene/assimp_model.h"
#include "common/scene/ply.h"
#include "common/scene/procedural.h"

namespace swath {
namespace {

constexpr std::uint64_t kMaxFileBytes = 8ull << 30;

bool is_ply(std::string_view name) {
    constexpr std::string_view kEnding = ".ply";
    if (name.size() < kEnding.size()) return false;
    name.remove_prefix(name.size() - kEnding.size());
    const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
    return std::equal(name.begin(), name.end(), kEnding.begin(), same);
}

// `rest` follows "builtin:" and is NAME or NAME:TRIANGLES.
Result<Mesh> load_builtin(std::string_view rest) {
    const std::size_t colon = rest.find(':');
    const std::string name(rest.substr(0, colon));
    std::size_t triangles = 0;
    for (const BuiltinModel& model : builtin_models())
        if (model.name == name) triangles = model.default_triangles;
    if (colon != std::string_view::npos) {
        const std::string_view wish = rest.substr(colon + 1);
        const auto [stop, error] = std::from_chars(wish.data(), wish.data() + wish.size(), triangles);
        if (error != std::errc{} || stop != wish.data() + wish.size())
            return fail("`{}` is no number of triangles", wish);
    }
    return make_builtin(name, triangles);
}

Result<Mesh> load(const std::string& name) {
    if (is_builtin(name))
        return load_builtin(std::string_view(name).substr(std::string_view("builtin:").size()));
    if (!is_ply(name)) return read_with_assimp(name);
    return read_file(name, kMaxFileBytes).and_then([](const Buffer& bytes) {
        return read_ply(bytes.bytes());
    });
}

}  // namespace

Result<Mesh> load_model(const std::string& name) {
    Result<Mesh> mesh = load(name);
    if (mesh) {
        if (const Status status = validate(*mesh); !status) return fail_in(name, status.error());
        return mesh;
    }
    if (mesh.error().message.starts_with(name + ": ")) return mesh;  // read_file names it already
    return fail_in(name, mesh.error());
}

}  // namespace swath
