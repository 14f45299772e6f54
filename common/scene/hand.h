#pragma once
#include <cstddef>

#include "common/scene/mesh.h"

namespace swath {

// The `hand` of make_builtin, in millimetres: the 27 bones of a right hand and the ends of radius and ulna,
// seen from the back when looking along -z, fingers up. Each is a closed surface of its own. With fewer than
// 24 triangles for each, only the first bones are there.
Mesh make_hand(std::size_t triangles);

}  // namespace swath
