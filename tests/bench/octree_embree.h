#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "common/scene/mesh.h"
#include "tests/bench/octree_scenes.h"

// Embree 3, a peer in the benchmarks.
namespace swath::bench {

enum class EmbreeQuality { kLow, kMedium, kHigh };

// Must outlive its scenes.
class EmbreeDevice {
  public:
    // Builds with `threads`. `isa` is as in Embree's configuration ("avx2"); empty: the processor's best.
    explicit EmbreeDevice(std::size_t threads, const std::string& isa = {});
    ~EmbreeDevice();

  private:
    friend class EmbreeScene;
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// A hierarchy over a mesh whose buffers it shares: the mesh must outlive it.
class EmbreeScene {
  public:
    // `rebuilt`: it will be built again and again, so it keeps its memory.
    EmbreeScene(EmbreeDevice& device, const Mesh& mesh, EmbreeQuality quality, bool rebuilt = false);
    ~EmbreeScene();

    void commit();
    // Says that all positions have changed, so that commit() builds it again.
    void touch();
    // Bytes that the device has allocated since it was made, for this, its only scene.
    std::size_t bytes() const;

    // Counts the rays of these rows of the view that hit something, in packets of 16 with the hint that they
    // are coherent. `distances`, unless null, get a value for each pixel of the whole view: along the view,
    // infinite if the ray hits nothing.
    std::uint64_t cast(const RayView& view, int first_row, int last_row, float* distances) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace swath::bench
