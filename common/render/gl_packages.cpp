#include "common/render/gl_packages.h"

#include <charconv>

#include "common/base/file.h"

namespace swath {
namespace {

constexpr std::uint64_t kMaxOsReleaseBytes = 1 << 16;

// "12" of a line VERSION_ID="12"; empty when there is none.
std::string_view value_of(std::string_view key, std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!line.starts_with(key) || line.substr(key.size(), 1) != "=") continue;
        line.remove_prefix(key.size() + 1);
        if (line.size() >= 2 && line.front() == '"' && line.back() == '"')
            line = line.substr(1, line.size() - 2);
        return line;
    }
    return {};
}

// Mesa dropped OSMesa with 25.1. Testing and unstable have no VERSION_ID.
bool has_osmesa(std::string_view id, std::string_view version) {
    double number = 0;
    std::from_chars(version.data(), version.data() + version.size(), number);
    return number > 0 && (id == "debian" ? number <= 13 : number < 25.10);
}

}  // namespace

std::string how_to_get(RendererKind kind, std::string_view os_release) {
    const std::string_view id = value_of("ID", os_release);
    const bool known = id == "debian" || id == "ubuntu";
    if (kind == RendererKind::kEgl)
        return known ? "install the packages libegl1, libegl-mesa0 and libgl1-mesa-dri"
                     : "install Mesa's EGL and its software driver";
    if (!known) return "install OSMesa, which Mesa has until 25.0, or use --renderer egl";
    return has_osmesa(id, value_of("VERSION_ID", os_release))
               ? "install the package libosmesa6"
               : "this system has it no longer: use --renderer egl";
}

std::string how_to_get_here(RendererKind kind) {
    const auto text = read_file("/etc/os-release", kMaxOsReleaseBytes);
    return how_to_get(
        kind, text ? std::string_view(reinterpret_cast<const char*>(text->data()), text->size()) : "");
}

}  // namespace swath
