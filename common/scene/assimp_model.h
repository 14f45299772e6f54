#pragma once
#include <string>

#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// Reads a model file of any format that Assimp knows (OBJ, STL, glTF, ...) and the files that it names. The
// node hierarchy is flattened, instances are copied; polygons become triangles; points and lines are dropped.
// Colours are the vertices', else the material's base or diffuse colour; missing normals are computed.
// Material numbers are the file's as Assimp counts them; a model that uses one only has none. Errors
// carry Assimp's message; the file's name is the caller's to add.
Result<Mesh> read_with_assimp(const std::string& path);

}  // namespace swath
