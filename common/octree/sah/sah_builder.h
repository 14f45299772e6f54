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

// Where trees are built: on threads of this machine, or on a CUDA device.
enum class SahDevice { kThreads, kCuda };

// Why kCuda cannot be had here: this build has no CUDA, the machine no device. Empty where it can.
std::string missing_cuda();

// Builds SAH octrees (Improved octree construction of the SAH octree paper, algorithm 1), one after another,
// and keeps its memory for the next one. The tree depends on the triangles and the settings alone, never on
// the device or the number of threads. A resource of one thread at a time.
class SahBuilder {
  public:
    // `threads`, at least 1, build together. Where kCuda is asked for and cannot be had it is kThreads, and
    // fallback() is missing_cuda().
    explicit SahBuilder(std::size_t threads, SahDevice device = SahDevice::kThreads);
    ~SahBuilder();

    SahDevice device() const { return device_; }
    const std::string& fallback() const { return fallback_; }  // empty: none

    // Fails without triangles, with coordinates that are not numbers or beyond kMaxSahCoordinate, with
    // indices beyond the positions, with settings out of range, and where the tree or the memory for building
    // it would be too large.
    Result<SahTree> build(const SahTriangles& triangles, const SahSettings& settings);

  private:
    std::size_t threads_;
    SahDevice device_ = SahDevice::kThreads;
    std::string fallback_;
    std::unique_ptr<SahBuild> build_;
};

}  // namespace swath
