#pragma once
#include <cstddef>
#include <cstdint>

#include "common/published/octree/octree_node.h"

// walk_kernel.cpp, the kernel of the published algorithms, and the code around it share this: plain data, and
// functions that are somewhere else. A kernel source must not see containers or glm.
namespace swath {

struct WalkPlane {
    float x, y, z, w;
    bool up_x, up_y, up_z;  // not negative
};

struct WalkPlanes {
    WalkPlane plane[6];
};

// A node of an octree that is not stored: its children are computed.
struct ComputedNode {
    float box[6];
    std::uint32_t code;
    std::uint32_t level;
};
// A node that is stored.
using StoredNode = const OctreeNode*;

// A buffer that a walk appends to. OwnedList (member_lists.h) owns the memory.
template <class T>
struct WalkList {
    T* at;
    std::size_t size;
    std::size_t capacity;
};
// Makes room for eight more at least.
template <class T>
void grow(WalkList<T>& list);

// A queue in a ring: entries `head` to `tail`, which only grow, are at their number modulo the capacity,
// which is a power of two or 0.
template <class T>
struct WalkQueue {
    T* at;
    std::size_t head;
    std::size_t tail;
    std::size_t capacity;
};
// Makes room for eight more at least.
template <class T>
void grow(WalkQueue<T>& queue);

// One member's part of a frame.
struct MemberWalk {
    const WalkPlanes* planes;
    std::uint32_t last_level;
    WalkList<std::uint32_t> leaves;  // codes of leaves that the frustum intersects
    std::uint64_t tested;            // boxes
};

// The walks over one kind of node.
template <class Node>
struct NodeWalks {
    // A2SSB, algorithm 1, for each of `nodes`: a recursion that appends the children of intersected nodes on
    // `split_level` to `below`.
    void (*step_one)(MemberWalk& walk, const Node* nodes, std::size_t count, std::uint32_t split_level,
                     WalkList<Node>& below);
    // A2SSB, algorithm 2, for each of `nodes`: one box is moved through the tree, no node is read.
    void (*in_place)(MemberWalk& walk, const Node* nodes, std::size_t count);
    // Does the same with all planes tested at once, where there are vector registers.
    void (*in_lanes)(MemberWalk& walk, const Node* nodes, std::size_t count);
    // The canonical recursion, for each of `nodes`.
    void (*depth_first)(MemberWalk& walk, const Node* nodes, std::size_t count);
    // ADSB, figure 1: breadth first until the queue is empty or `budget` nodes are tested; 0 is no limit.
    void (*render_nodes)(MemberWalk& walk, std::uint64_t budget, WalkQueue<Node>& queue);
};

struct WalkBox {
    float numbers[6];  // min x, y, z, max x, y, z
};

// Boxes sorted by cell: those of cell c are `first[c]` to `first[c + 1]`.
struct CellBoxes {
    const std::uint32_t* first;
    const WalkBox* boxes;
    const std::uint32_t* ids;
};

// A node of an octree over boxes, whose box is as tight as possible. Leaves have boxes, other nodes children.
struct BoxNode {
    float box[6];
    std::uint32_t first;
    std::uint32_t count;         // 0 if it is no leaf
    const BoxNode* children[8];  // the first ones; null where a cell is empty
};

// All that is compiled per instruction set. All of it gives the same bits as outside() of
// common/geometry/frustum.h.
struct WalkTable {
    NodeWalks<StoredNode> stored;
    NodeWalks<ComputedNode> computed;
    // Appends the ids of boxes in the given cells that are not outside.
    void (*cull_cells)(const WalkPlanes& planes, const CellBoxes& of, const std::uint32_t* cells,
                       std::size_t count, WalkList<std::uint32_t>& ids);
    // Does the same for boxes `first` to `last`.
    void (*cull_boxes)(const WalkPlanes& planes, const CellBoxes& of, std::size_t first, std::size_t last,
                       WalkList<std::uint32_t>& ids);
    // Does the same by the canonical recursion.
    void (*cull_tree)(const WalkPlanes& planes, const CellBoxes& of, const BoxNode& root,
                      WalkList<std::uint32_t>& ids);
};

namespace portable {
WalkTable walk_table();
}
namespace avx2 {
WalkTable walk_table();  // not on every processor, nor in every build
}

}  // namespace swath
