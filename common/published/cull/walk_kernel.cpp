// The loops of the published algorithms, compiled once per instruction set. swath_kernel in
// cmake/compile_options.cmake says what may be included here.
#include "common/published/cull/walk_table.h"

#if defined(SWATH_KERNEL_avx2)
#include <immintrin.h>
#endif

namespace swath::SWATH_KERNEL {
namespace {

struct Corners {
    float low[3];
    float high[3];
};

// The same bit for bit as outside() of common/geometry/frustum.h.
inline bool is_outside(const WalkPlanes& planes, const Corners& box) {
#pragma GCC unroll 6  // each plane's branches on its signs go the same way all frame long
    for (const WalkPlane& p : planes.plane) {
        const float x = p.up_x ? box.high[0] : box.low[0];
        const float y = p.up_y ? box.high[1] : box.low[1];
        const float z = p.up_z ? box.high[2] : box.low[2];
        if (__builtin_fmaf(p.x, x, __builtin_fmaf(p.y, y, __builtin_fmaf(p.z, z, p.w))) < 0) return true;
    }
    return false;
}

inline bool is_outside(const WalkPlanes& planes, const float* box) {
    return is_outside(planes, Corners{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
}

inline void push(WalkList<std::uint32_t>& list, std::uint32_t value) {
    if (list.size == list.capacity) grow(list);
    list.at[list.size++] = value;
}

inline const OctreeNode& node_at(StoredNode node) { return *node; }
inline const ComputedNode& node_at(const ComputedNode& node) { return node; }

inline StoredNode child_of(StoredNode node, std::uint32_t child) { return node->children[child]; }

// It is exact, because coordinates are whole numbers below 2^11 (uniform_octree.h).
inline ComputedNode child_of(const ComputedNode& node, std::uint32_t child) {
    const float edge = 0.5f * (node.box[3] - node.box[0]);
    const float x = node.box[0] + ((child & 1) != 0 ? edge : 0.0f);
    const float y = node.box[1] + ((child & 4) != 0 ? edge : 0.0f);
    const float z = node.box[2] + ((child & 2) != 0 ? edge : 0.0f);
    return {{x, y, z, x + edge, y + edge, z + edge}, 8 * node.code + child, node.level + 1};
}

template <class Node>
void step_one_from(MemberWalk& walk, const Node& node, std::uint32_t split_level, WalkList<Node>& below) {
    ++walk.tested;
    if (is_outside(*walk.planes, node_at(node).box)) return;
    const std::uint32_t level = node_at(node).level;
    if (level == walk.last_level) {
        push(walk.leaves, node_at(node).code);
        return;
    }
    if (level == split_level) {
        if (below.capacity - below.size < 8) grow(below);
        for (std::uint32_t child = 0; child < 8; ++child) below.at[below.size++] = child_of(node, child);
        return;
    }
    for (std::uint32_t child = 0; child < 8; ++child)
        step_one_from(walk, child_of(node, child), split_level, below);
}

template <class Node>
void step_one(MemberWalk& walk, const Node* nodes, std::size_t count, std::uint32_t split_level,
              WalkList<Node>& below) {
    for (std::size_t i = 0; i < count; ++i) step_one_from(walk, nodes[i], split_level, below);
}

// Figure 3.8: how to move from child 0 to 1, 1 to 2 and so on, in edges along x, y, z. The rows there are
// numbered by where they lead, so row `child_id` here leads away from it.
constexpr float kTranslation[7][3] = {{1, 0, 0}, {-1, 0, 1}, {1, 0, 0}, {-1, 1, -1},
                                      {1, 0, 0}, {-1, 0, 1}, {1, 0, 0}};

void in_place_from(MemberWalk& walk, const float* from, std::uint32_t code, std::uint32_t level) {
    constexpr signed char kNobodysChild = -1;
    signed char child_stack[16];
    Corners box{{from[0], from[1], from[2]}, {from[3], from[4], from[5]}};
    const WalkPlanes& planes = *walk.planes;
    const std::uint32_t last_level = walk.last_level;
    std::uint64_t tested = 0;
    signed char child_id = kNobodysChild;
    child_stack[level] = child_id;
    for (;;) {
        while (++tested, !is_outside(planes, box)) {
            if (level == last_level) {
                push(walk.leaves, code);
                break;
            }
            for (int i = 0; i < 3; ++i) box.high[i] = (box.low[i] + box.high[i]) * 0.5f;  // equation 2
            child_id = 0;
            child_stack[++level] = child_id;
            code <<= 3;
        }
        while (child_id == 7) {
            for (int i = 0; i < 3; ++i) box.low[i] -= box.high[i] - box.low[i];  // equation 3
            child_id = child_stack[--level];
            code >>= 3;
        }
        if (child_id == kNobodysChild) break;
        for (int i = 0; i < 3; ++i) {  // equations 6 to 8
            const float delta = (box.high[i] - box.low[i]) * kTranslation[child_id][i];
            box.low[i] += delta;
            box.high[i] += delta;
        }
        child_stack[level] = ++child_id;
        ++code;
    }
    walk.tested += tested;
}

template <class Node>
void in_place(MemberWalk& walk, const Node* nodes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const auto& node = node_at(nodes[i]);
        in_place_from(walk, node.box, node.code, node.level);
    }
}

#if defined(SWATH_KERNEL_avx2)
// The six planes, one in each lane. Nothing is ever outside of the two lanes that are left.
struct LanePlanes {
    __m256 x, y, z, w;
    __m256 low_x, low_y, low_z;  // set where the p-vertex is the low corner

    explicit LanePlanes(const WalkPlanes& planes) {
        float of[4][8] = {{}, {}, {}, {1, 1, 1, 1, 1, 1, 1, 1}};
        float low[3][8] = {};
        for (int i = 0; i < 6; ++i) {
            const WalkPlane& p = planes.plane[i];
            of[0][i] = p.x;
            of[1][i] = p.y;
            of[2][i] = p.z;
            of[3][i] = p.w;
            low[0][i] = p.up_x ? 0.0f : -1.0f;  // a set sign is what blendv asks for
            low[1][i] = p.up_y ? 0.0f : -1.0f;
            low[2][i] = p.up_z ? 0.0f : -1.0f;
        }
        const auto mask = [](const float* signs) {
            return _mm256_cmp_ps(_mm256_loadu_ps(signs), _mm256_setzero_ps(), _CMP_LT_OQ);
        };
        x = _mm256_loadu_ps(of[0]);
        y = _mm256_loadu_ps(of[1]);
        z = _mm256_loadu_ps(of[2]);
        w = _mm256_loadu_ps(of[3]);
        low_x = mask(low[0]);
        low_y = mask(low[1]);
        low_z = mask(low[2]);
    }
};

// The box that moves, as the p-vertices of all planes. A move changes a lane only along axes on which its
// plane uses the corner that moves. It is exact, as the box is.
struct LaneBox {
    __m256 x, y, z;
    __m256 edge;

    LaneBox(const LanePlanes& p, const float* box)
        : x(_mm256_blendv_ps(_mm256_set1_ps(box[3]), _mm256_set1_ps(box[0]), p.low_x)),
          y(_mm256_blendv_ps(_mm256_set1_ps(box[4]), _mm256_set1_ps(box[1]), p.low_y)),
          z(_mm256_blendv_ps(_mm256_set1_ps(box[5]), _mm256_set1_ps(box[2]), p.low_z)),
          edge(_mm256_set1_ps(box[3] - box[0])) {}

    bool is_outside(const LanePlanes& p) const {
        const __m256 distance =
            _mm256_fmadd_ps(p.x, x, _mm256_fmadd_ps(p.y, y, _mm256_fmadd_ps(p.z, z, p.w)));
        return _mm256_movemask_ps(_mm256_cmp_ps(distance, _mm256_setzero_ps(), _CMP_LT_OQ)) != 0;
    }
    void to_first_child(const LanePlanes& p) {
        edge *= 0.5f;
        x -= _mm256_andnot_ps(p.low_x, edge);
        y -= _mm256_andnot_ps(p.low_y, edge);
        z -= _mm256_andnot_ps(p.low_z, edge);
    }
    void to_father(const LanePlanes& p) {
        x -= _mm256_and_ps(p.low_x, edge);
        y -= _mm256_and_ps(p.low_y, edge);
        z -= _mm256_and_ps(p.low_z, edge);
        edge += edge;
    }
    void to_brother(const float* translation) {
        x += edge * translation[0];
        y += edge * translation[1];
        z += edge * translation[2];
    }
};

// Does what in_place_from() does.
void in_lanes_from(MemberWalk& walk, const LanePlanes& planes, LaneBox box, std::uint32_t code,
                   std::uint32_t level) {
    constexpr signed char kNobodysChild = -1;
    signed char child_stack[16];
    const std::uint32_t last_level = walk.last_level;
    std::uint64_t tested = 0;
    signed char child_id = kNobodysChild;
    child_stack[level] = child_id;
    for (;;) {
        while (++tested, !box.is_outside(planes)) {
            if (level == last_level) {
                push(walk.leaves, code);
                break;
            }
            box.to_first_child(planes);
            child_id = 0;
            child_stack[++level] = child_id;
            code <<= 3;
        }
        while (child_id == 7) {
            box.to_father(planes);
            child_id = child_stack[--level];
            code >>= 3;
        }
        if (child_id == kNobodysChild) break;
        box.to_brother(kTranslation[child_id]);
        child_stack[level] = ++child_id;
        ++code;
    }
    walk.tested += tested;
}

template <class Node>
void in_lanes(MemberWalk& walk, const Node* nodes, std::size_t count) {
    const LanePlanes planes(*walk.planes);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& node = node_at(nodes[i]);
        in_lanes_from(walk, planes, LaneBox(planes, node.box), node.code, node.level);
    }
}
#else
template <class Node>
void in_lanes(MemberWalk& walk, const Node* nodes, std::size_t count) {
    in_place(walk, nodes, count);
}
#endif

template <class Node>
void depth_first_from(MemberWalk& walk, const Node& node) {
    ++walk.tested;
    if (is_outside(*walk.planes, node_at(node).box)) return;
    if (node_at(node).level == walk.last_level) {
        push(walk.leaves, node_at(node).code);
        return;
    }
    for (std::uint32_t child = 0; child < 8; ++child) depth_first_from(walk, child_of(node, child));
}

template <class Node>
void depth_first(MemberWalk& walk, const Node* nodes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) depth_first_from(walk, nodes[i]);
}

template <class Node>
void render_nodes(MemberWalk& walk, std::uint64_t budget, WalkQueue<Node>& queue) {
    std::uint64_t tested = 0;
    while (queue.head != queue.tail) {
        const Node node = queue.at[queue.head++ & (queue.capacity - 1)];
        ++tested;
        if (!is_outside(*walk.planes, node_at(node).box)) {
            if (node_at(node).level == walk.last_level) {
                push(walk.leaves, node_at(node).code);
            } else {
                if (queue.capacity - (queue.tail - queue.head) < 8) grow(queue);
                for (std::uint32_t child = 0; child < 8; ++child)
                    queue.at[queue.tail++ & (queue.capacity - 1)] = child_of(node, child);
            }
        }
        if (tested == budget) break;
    }
    walk.tested += tested;
}

template <class Node>
NodeWalks<Node> node_walks() {
    return {&step_one<Node>, &in_place<Node>, &in_lanes<Node>, &depth_first<Node>, &render_nodes<Node>};
}

void cull_boxes(const WalkPlanes& planes, const CellBoxes& of, std::size_t first, std::size_t last,
                WalkList<std::uint32_t>& ids) {
    for (std::size_t i = first; i < last; ++i)
        if (!is_outside(planes, of.boxes[i].numbers)) push(ids, of.ids[i]);
}

void cull_cells(const WalkPlanes& planes, const CellBoxes& of, const std::uint32_t* cells, std::size_t count,
                WalkList<std::uint32_t>& ids) {
    for (std::size_t i = 0; i < count; ++i)
        cull_boxes(planes, of, of.first[cells[i]], of.first[cells[i] + 1], ids);
}

void cull_tree(const WalkPlanes& planes, const CellBoxes& of, const BoxNode& node,
               WalkList<std::uint32_t>& ids) {
    if (is_outside(planes, node.box)) return;
    if (node.count != 0) {
        cull_boxes(planes, of, node.first, node.first + node.count, ids);
        return;
    }
    for (const BoxNode* child : node.children) {
        if (child == nullptr) return;
        cull_tree(planes, of, *child, ids);
    }
}

}  // namespace

WalkTable walk_table() {
    return {node_walks<StoredNode>(), node_walks<ComputedNode>(), &cull_cells, &cull_boxes, &cull_tree};
}

}  // namespace swath::SWATH_KERNEL
