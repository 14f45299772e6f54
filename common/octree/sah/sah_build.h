#pragma once
// The builder's two device systems: the same source compiled for each. Without anything of ours that nvcc
// cannot compile.
#include <cstddef>
#include <memory>
#include <string>

#include "common/octree/sah/sah_settings.h"
#include "common/octree/sah/sah_tree.h"
#include "common/octree/sah/sah_triangles.h"

namespace swath {

struct SahOutcome {
    SahTree tree;
    std::string error;  // empty: none
};

// What a device system has of a builder. Not for several threads at once.
class SahBuild {
  public:
    virtual ~SahBuild() = default;
    // `settings` are in range. Throws std::bad_alloc.
    virtual SahOutcome build(const SahTriangles& triangles, const SahSettings& settings) = 0;
};

// On `threads` threads of this machine, at least 1.
std::unique_ptr<SahBuild> make_tbb_build(std::size_t threads);
// On the first CUDA device; none, and why, where there is none.
std::unique_ptr<SahBuild> make_cuda_build(std::string& why);

}  // namespace swath
