#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/scene/mesh.h"

namespace swath {

// A model that is made from a formula. It has the same bits on every machine with IEEE arithmetic: formulas
// use +, -, *, /, sqrt and a sine of our own. builtin_models() says what each shows. `hand` stands in for the
// Hand of Samanta 2000, which is not available: it has as many triangles and, at octree depth 4, about as
// many objects (643).
struct BuiltinModel {
    std::string name;
    std::string what;
    std::size_t default_triangles;
};
const std::vector<BuiltinModel>& builtin_models();

// Makes a model of about `triangles` triangles, 12 to 50 million: within a few per cent from a thousand on.
// The error for an unknown name lists the names.
Result<Mesh> make_builtin(const std::string& name, std::size_t triangles);

}  // namespace swath
