#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// Loads a model by its name as users write it: `builtin:NAME`, `builtin:NAME:TRIANGLES` (see procedural.h) or
// a file's path. Our own reader loads PLY, Assimp all other formats. The mesh is valid (see validate), and
// the same input gives the same bits. Errors begin with the name. Blocking; any thread.
Result<Mesh> load_model(const std::string& name);

inline bool is_builtin(std::string_view name) { return name.starts_with("builtin:"); }

}  // namespace swath
