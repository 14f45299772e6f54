#pragma once
#include <vector>

#include "common/published/cull/member_lists.h"
#include "common/published/cull/published_walk.h"
#include "common/published/cull/split_level.h"
#include "common/published/cull/walks.h"

namespace swath {

// The two kinds of tree as the algorithms see them. Each has one type of node, found by level and code.
struct StoredTree {
    using Node = StoredNode;
    const PointerOctree& tree;

    const UniformOctree& shape() const { return tree.shape(); }
    Node node(int level, std::uint32_t code) const {
        const OctreeNode* node = &tree.root();
        for (int shift = 3 * level - 3; shift >= 0; shift -= 3) node = node->children[code >> shift & 7];
        return node;
    }
    static const NodeWalks<Node>& walks() { return best_walk_table().stored; }
};

struct ComputedTree {
    using Node = ComputedNode;
    UniformOctree tree;

    const UniformOctree& shape() const { return tree; }
    Node node(int level, std::uint32_t code) const { return computed_node(tree, level, code); }
    static const NodeWalks<Node>& walks() { return best_walk_table().computed; }
};

// The data of one member of the team. Members are two cache lines apart, because processors fetch lines in
// pairs.
template <class Node>
struct alignas(128) Member {
    MemberWalk walk{};
    OwnedList<WalkList<Node>> nodes;
    OwnedList<WalkQueue<Node>> queue;
    WorkSpan span;
    Nanoseconds busy{0};

    Member() = default;
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;
    ~Member() { std::free(walk.leaves.at); }

    void begin_frame(const WalkPlanes& planes, const UniformOctree& shape) {
        walk.planes = &planes;
        walk.last_level = static_cast<std::uint32_t>(shape.height());
        walk.leaves.size = 0;
        walk.tested = 0;
        nodes->size = 0;
        queue->head = queue->tail = 0;
        busy = Nanoseconds(0);
    }
    MemberReport report() const { return {walk.tested, busy, contents(walk.leaves)}; }
};

template <class Node>
void add(WalkQueue<Node>& queue, const Node& node) {
    if (queue.tail - queue.head == queue.capacity) grow(queue);
    queue.at[queue.tail++ & (queue.capacity - 1)] = node;
}

template <class Node>
Node take(WalkQueue<Node>& queue) {
    return queue.at[queue.head++ & (queue.capacity - 1)];
}

}  // namespace swath
