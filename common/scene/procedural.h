#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// Built-in models, made from a formula: nothing to download, the same bits on every machine that has IEEE
// arithmetic (they use +, -, *, / and sqrt and our own sine; no libm).
//   knot     a bumpy torus knot, even small triangles, coloured along its length
//   spheres  a deep field of spheres: more than ten surfaces behind one another in the middle of the picture
//   town     boxes on a plane whose faces coincide with their neighbours': exact depth ties everywhere
//   hand     the bones of a human hand: a stand-in for the Hand of Samanta 2000, which is not to be had, with
//            as many triangles and, at octree depth 4, about as many objects (643)
//   swarm    five hundred spheres that move, each along a straight line of its own: what is near at pose 0 is
//            anywhere at pose 1
struct BuiltinModel {
    std::string name;
    std::string what;
    std::size_t default_triangles;
};
const std::vector<BuiltinModel>& builtin_models();

// The model with about `triangles` triangles: at least 12, at most 50 million; within a few per cent of the
// wish from a thousand on, roughly below. An unknown name's error lists the names.
Result<Mesh> make_builtin(const std::string& name, std::size_t triangles);

}  // namespace swath
