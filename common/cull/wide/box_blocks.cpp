#include "common/cull/wide/box_blocks.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/cull/wide/hierarchy_kernel.h"

namespace swath {

BoxBlocks::BoxBlocks(std::span<const Box> boxes)
    : size_(static_cast<std::uint32_t>(boxes.size())), blocks_((boxes.size() + 15) / 16 * kBlockFloats) {
    CHECK(boxes.size() <= std::size_t{1} << 31);
    assign(boxes);
}

void BoxBlocks::assign(std::span<const Box> boxes) {
    CHECK(boxes.size() == std::size_t{size_});
    for (std::size_t first = 0; first < boxes.size(); first += kBlockBoxes) {
        float* const block = blocks_.data() + first / kBlockBoxes * kBlockFloats;
        for (std::size_t lane = 0; lane < kBlockBoxes; ++lane) {
            const Box& box = boxes[std::min(first + lane, boxes.size() - 1)];
            for (int axis = 0; axis < 3; ++axis) {
                block[16 * static_cast<std::size_t>(axis) + lane] = box.min[axis];
                block[16 * static_cast<std::size_t>(axis + 3) + lane] = box.max[axis];
            }
        }
    }
}

}  // namespace swath
