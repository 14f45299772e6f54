#include "common/published/cull/walks.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace swath {
namespace {

constexpr std::size_t kFirstCapacity = 64;

template <class T>
T* resized(T* at, std::size_t capacity) {
    void* const memory = std::realloc(at, capacity * sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
}

}  // namespace

template <class T>
void grow(WalkList<T>& list) {
    const std::size_t capacity = std::max(kFirstCapacity, 2 * list.capacity);
    list.at = resized(list.at, capacity);
    list.capacity = capacity;
}

template <class T>
void grow(WalkQueue<T>& queue) {
    const std::size_t before = queue.capacity;
    const std::size_t capacity = std::max(kFirstCapacity, 2 * before);
    queue.at = resized(queue.at, capacity);
    queue.capacity = capacity;
    if (before == 0) return;
    // Entries move up whose number modulo the capacity has changed.
    for (std::size_t i = queue.head; i != queue.tail; ++i)
        if ((i & before) != 0) queue.at[i & (capacity - 1)] = queue.at[i & (before - 1)];
}

template void grow(WalkList<std::uint32_t>&);
template void grow(WalkList<StoredNode>&);
template void grow(WalkList<ComputedNode>&);
template void grow(WalkQueue<StoredNode>&);
template void grow(WalkQueue<ComputedNode>&);

const WalkTable& walk_table(InstructionSet set) {
    static const WalkTable portable_table = portable::walk_table();
#if defined(__x86_64__)
    static const WalkTable avx2_table = avx2::walk_table();
    if (set != InstructionSet::kPortable) return avx2_table;
#endif
    return portable_table;
}

WalkPlanes walk_planes(const Frustum& frustum) {
    WalkPlanes planes{};
    for (std::size_t i = 0; i < frustum.planes.size(); ++i) {
        const glm::vec4& p = frustum.planes[i];
        planes.plane[i] = {p.x, p.y, p.z, p.w, p.x >= 0, p.y >= 0, p.z >= 0};
    }
    return planes;
}

WalkBox walk_box(const Box& box) {
    return {{box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z}};
}

ComputedNode computed_node(const UniformOctree& tree, int level, std::uint32_t code) {
    const Box box = tree.box_of(level, code);
    return {{box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z},
            code,
            static_cast<std::uint32_t>(level)};
}

}  // namespace swath
