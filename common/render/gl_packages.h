#pragma once
#include <string>
#include <string_view>

#include "common/render/renderer_kind.h"

namespace swath {

// What a person does about a machine without the library of `kind`, OSMesa or EGL: "install the package
// libosmesa6". `os_release` is the text of the machine's /etc/os-release.
std::string how_to_get(RendererKind kind, std::string_view os_release);

// The same for this machine.
std::string how_to_get_here(RendererKind kind);

}  // namespace swath
