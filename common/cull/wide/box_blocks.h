#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/cull/wide/aligned_array.h"
#include "common/geometry/box.h"

namespace swath {

// Boxes as wide culls read them: blocks of 16, an array for each coordinate (see hierarchy_kernel.h). 24
// bytes a box. The last block is filled up with copies of the last box, which no cull reports.
class BoxBlocks {
  public:
    // At most 2^31.
    explicit BoxBlocks(std::span<const Box> boxes);
    // As many as there were.
    void assign(std::span<const Box> boxes);

    std::uint32_t size() const { return size_; }
    std::uint32_t block_count() const { return (size_ + 15) / 16; }
    const float* data() const { return blocks_.data(); }

  private:
    std::uint32_t size_;
    AlignedArray<float> blocks_;
};

}  // namespace swath
