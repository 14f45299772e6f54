#if defined(__SANITIZE_THREAD__)
#define THRUST_DEVICE_SYSTEM THRUST_DEVICE_SYSTEM_CPP  // see for_all()
#else
#define THRUST_DEVICE_SYSTEM THRUST_DEVICE_SYSTEM_TBB
#endif
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "common/octree/sah/sah_build.h"

namespace swath {
namespace {
constexpr bool kOnHost = true;
// A thread works on so many references at once: 128 KiB.
constexpr std::uint32_t kChunk = 4096;
}  // namespace
}  // namespace swath
#include "common/octree/sah/sah_build.inl"

namespace swath {
namespace {

class TbbBuild final : public SahBuild {
  public:
    // TBB warns on standard error about more threads than processors, which would only wait for each other.
    explicit TbbBuild(std::size_t threads)
        : arena_(std::min(static_cast<int>(threads), tbb::info::default_concurrency())),
          build_(static_cast<std::uint32_t>(4 * threads)) {}
    SahOutcome build(const SahTriangles& triangles, const SahSettings& settings) override {
        return arena_.execute([&] { return build_.build(triangles, settings); });
    }

  private:
    tbb::task_arena arena_;
    ThrustBuild build_;
};

}  // namespace

std::unique_ptr<SahBuild> make_tbb_build(std::size_t threads) { return std::make_unique<TbbBuild>(threads); }

}  // namespace swath
