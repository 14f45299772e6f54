#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "common/scene/mesh.h"
#include "tests/bench/octree_scenes.h"

// Embree 3, which we measure against.
namespace swath::bench {

enum class EmbreeQuality { kLow, kMedium, kHigh };

// Must outlive its scenes.
class EmbreeDevice {
  public:
    // `threads` build together. `isa` as its configuration has it ("avx2"); empty: what the processor has.
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
    // `rebuilt`: made for being built again and again, so that it keeps its memory.
    EmbreeScene(EmbreeDevice& device, const Mesh& mesh, EmbreeQuality quality, bool rebuilt = false);
    ~EmbreeScene();

    // Builds it.
    void commit();
    // Says that all positions have changed, so that commit() builds it again.
    void touch();
    // What the device has allocated for it: of the only scene since it was made.
    std::size_t bytes() const;

    // How many rays of these rows of the view hit something, by packets of 16 with the hint that they are
    // coherent. Where `distances` are asked for, pixel by pixel of the whole view: along the view, infinite
    // for none.
    std::uint64_t cast(const RayView& view, int first_row, int last_row, float* distances) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace swath::bench
