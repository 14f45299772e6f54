// The TBB build in the same program has another version of Thrust, so this one gets a namespace of its own.
#define THRUST_CUB_WRAPPED_NAMESPACE swath_cuda
#include <cuda_runtime.h>
#include <thrust/version.h>

#include <cstdint>

namespace swath {
namespace thrust = ::swath_cuda::thrust;
namespace {
constexpr bool kOnHost = false;
// So few that every multiprocessor has work while the root is cut.
constexpr std::uint32_t kChunk = 256;
constexpr std::uint32_t kWorkers = 4096;
}  // namespace
}  // namespace swath
#include "common/octree/sah/sah_build.inl"

namespace swath {
namespace {

class CudaBuild final : public SahBuild {
  public:
    SahOutcome build(const SahTriangles& triangles, const SahSettings& settings) override {
        try {
            return build_.build(triangles, settings);
        } catch (const thrust::system_error& error) {
            return {{}, std::string("CUDA: ") + error.what()};
        }
    }

  private:
    ThrustBuild build_{kWorkers};
};

}  // namespace

std::unique_ptr<SahBuild> make_cuda_build(std::string& why) {
    int devices = 0;
    if (const cudaError_t error = cudaGetDeviceCount(&devices); error != cudaSuccess)
        why = std::string("no CUDA device: ") + cudaGetErrorString(error);
    else if (devices == 0)
        why = "no CUDA device";
    else
        return std::make_unique<CudaBuild>();
    return nullptr;
}

}  // namespace swath
