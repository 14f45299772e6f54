#pragma once
// The builder's two backends, TBB and CUDA: one source that is compiled for each. nvcc compiles this header.
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

// A builder on one backend. One thread at a time.
class SahBuild {
  public:
    virtual ~SahBuild() = default;
    // `settings` must be in range. Throws std::bad_alloc.
    virtual SahOutcome build(const SahTriangles& triangles, const SahSettings& settings) = 0;
};

// A builder on `threads` threads of this machine, at least 1.
std::unique_ptr<SahBuild> make_tbb_build(std::size_t threads);
// A builder on the first CUDA device. Null where there is none, and `why` says the reason.
std::unique_ptr<SahBuild> make_cuda_build(std::string& why);

}  // namespace swath
