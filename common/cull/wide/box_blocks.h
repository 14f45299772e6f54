#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/cull/wide/aligned_array.h"
#include "common/geometry/box.h"

namespace swath {

// Boxes as wide culls read them: in blocks of 16, with an array for each coordinate (see hierarchy_kernel.h),
// 24 bytes a box. Copies of the last box, which no cull reports, fill the last block.
class BoxBlocks {
  public:
    // At most 2^31 boxes.
    explicit BoxBlocks(std::span<const Box> boxes);
    // Replaces the boxes by as many.
    void assign(std::span<const Box> boxes);

    std::uint32_t size() const { return size_; }
    std::uint32_t block_count() const { return (size_ + 15) / 16; }
    const float* data() const { return blocks_.data(); }

  private:
    std::uint32_t size_;
    AlignedArray<float> blocks_;
};

}  // namespace swath
