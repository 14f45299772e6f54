#pragma once
#include <string>

#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// Reads a model file of any format that Assimp knows (OBJ, STL, glTF, ...) and the files that it names.
// Flattens the node hierarchy, copies instances, cuts polygons into triangles and drops points and lines.
// Colours are the vertices', else the material's base or diffuse colour; missing normals are computed.
// Material numbers are the file's as Assimp counts them; a model with only one has none. Errors carry
// Assimp's message, to which the caller adds the file's name. Blocking; any thread.
Result<Mesh> read_with_assimp(const std::string& path);

}  // namespace swath
