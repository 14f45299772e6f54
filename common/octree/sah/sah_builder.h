#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "common/base/result.h"
#include "common/octree/sah/sah_settings.h"
#include "common/octree/sah/sah_tree.h"
#include "common/octree/sah/sah_triangles.h"

namespace swath {

class SahBuild;

// The device that builds trees: threads of this machine, or CUDA.
enum class SahDevice { kThreads, kCuda };

// Says why kCuda is not available: the program is built without CUDA, or the machine has no device. Empty if
// it is.
std::string missing_cuda();

// Builds SAH octrees (improved octree construction of the SAH octree paper, algorithm 1), one after another,
// and keeps its memory for the next. A tree depends on triangles and settings alone, never on the device or
// the number of threads. One thread at a time.
class SahBuilder {
  public:
    // `threads`, at least 1, build together. If kCuda is asked for and not available, the device is kThreads
    // and fallback() says why, as missing_cuda() does.
    explicit SahBuilder(std::size_t threads, SahDevice device = SahDevice::kThreads);
    ~SahBuilder();

    SahDevice device() const { return device_; }
    const std::string& fallback() const { return fallback_; }  // empty: the device is what was asked for

    // Fails if there are no triangles, a coordinate is not a number or beyond kMaxSahCoordinate, an index is
    // beyond the positions, a setting is out of range, or the tree or the memory to build it is too large.
    Result<SahTree> build(const SahTriangles& triangles, const SahSettings& settings);

  private:
    std::size_t threads_;
    SahDevice device_ = SahDevice::kThreads;
    std::string fallback_;
    std::unique_ptr<SahBuild> build_;
};

}  // namespace swath
