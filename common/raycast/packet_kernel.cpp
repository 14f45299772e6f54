#include "common/raycast/packet_kernel.h"

#include "common/base/lanes/lanes.h"
#include "common/octree/sah/sah_settings.h"

namespace swath::SWATH_KERNEL {
namespace {

constexpr std::uint32_t kAllLanes = 0xffff;
constexpr float kFar = 3e38f;
// Deep enough for every SAH tree: a cut leaves at most seven children waiting, those of an octree node.
constexpr int kStack = 7 * static_cast<int>(kMaxSahDepth) + 2;

enum class Want { kNearest, kNearestByDepth, kAny };

// A node, or the part of an octree node that some of its planes have cut off.
struct Place {
    std::uint32_t node;
    std::uint32_t axes;   // whose planes are still to come
    std::uint32_t child;  // the child's number, as far as planes have decided it
    std::uint32_t bit;    // of that number, which the next plane decides
};

// A part that some rays go to later, and the t at which they enter and leave it.
struct Waiting {
    Floats enter;
    Floats leave;
    Place at;
};

inline std::uint32_t lowest_bit(std::uint32_t bits) {
    return static_cast<std::uint32_t>(__builtin_ctz(bits));
}
inline bool has(const std::uint32_t* bits, std::uint32_t i) {
    return bits == nullptr || (bits[i / 32] >> (i % 32) & 1) != 0;
}

// Walks a tree with rays of one kind: their directions have the same signs and the same largest axis.
template <Want kWant, bool kCount>
struct Walk {
    const KernelTree& tree;
    std::uint32_t active;  // lanes
    PacketWork* work;

    Floats origin[3];
    Floats origins;  // of one ray: x y z x y z x y z
    Floats direction[3];
    Floats inverse[3];
    // How far beyond a plane, in t, a ray goes on in the child before it, since rounding may move a hit so
    // far.
    Floats slack[3];
    bool negative[3];

    // Woop's shear, along the largest axis.
    int kx;
    int ky;
    int kz;
    Floats shear_x;
    Floats shear_y;
    Floats shear_z;

    // The best hit so far.
    Floats limit;  // in t: no hit beyond can be better
    Floats best;   // t or depth
    Words triangle;
    Floats weight[3];
    Floats depth_offset;
    Floats depth_scale;
    Floats inverse_scale;
    Floats least_inverse;  // in 1 / t: no hit below can be better
    Words but;
    // The last triangles that were tested, by number modulo kTested. A triangle may stand in several leaves;
    // all rays are tested at once, so a second test is needless.
    static constexpr std::uint32_t kTested = 64;
    alignas(64) std::uint32_t tested[kTested];

    Walk(const KernelTree& of, const RayPacket& rays, std::uint32_t lanes, std::uint32_t first,
         PacketWork* counts)
        : tree(of), active(lanes), work(counts) {
        Floats reach = all(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis] = load(rays.origin[axis]);
            direction[axis] = load(rays.direction[axis]);
            negative[axis] = rays.direction[axis][first] < 0.0f;
            reach = higher_of(reach, absolute(subtract(all(tree.low[axis]), origin[axis])));
            reach = higher_of(reach, absolute(subtract(all(tree.high[axis]), origin[axis])));
        }
        // Woop's test is off by a few roundings of coordinates of this size.
        const Floats off = multiply(reach, all(0x1p-17f));
        for (int axis = 0; axis < 3; ++axis) {
            // For a ray (almost) parallel to the planes the inverse is so large that slack decides.
            const Floats steep = all(negative[axis] ? -1e18f : 1e18f);
            const std::uint32_t flat = at_most(absolute(direction[axis]), all(1e-18f));
            inverse[axis] = divide(all(1.0f), where(flat, all(1.0f), direction[axis]));
            inverse[axis] = where(flat, steep, inverse[axis]);
            slack[axis] = multiply(off, absolute(inverse[axis]));
        }
        const float x = magnitude(rays.direction[0][first]);
        const float y = magnitude(rays.direction[1][first]);
        const float z = magnitude(rays.direction[2][first]);
        kz = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
        kx = (kz + 1) % 3;
        ky = (kz + 2) % 3;
        shear_z = inverse[kz];
        shear_x = multiply(direction[kx], shear_z);
        shear_y = multiply(direction[ky], shear_z);
        for (std::uint32_t i = 0; i < kTested; i += 16) store(tested + i, all(kNoTriangle));
        limit = all(kFar);
        best = all(kFar);
        triangle = all(kNoTriangle);
        for (Floats& w : weight) w = all(0.0f);
        if constexpr (kWant == Want::kNearestByDepth) {
            alignas(64) float repeated[16];
            for (int i = 0; i < 16; ++i) repeated[i] = rays.origin[i % 3][first];
            origins = load(repeated);
            depth_offset = load(rays.depth_offset);
            depth_scale = all(rays.depth_scale);
            inverse_scale = all(1.0f / rays.depth_scale);
            least_inverse = all(1e-30f);
        }
    }

    static float magnitude(float x) { return x < 0.0f ? -x : x; }

    void test(std::uint32_t number) {
        const float* const corner = tree.corners + std::uint64_t{9} * number;
        Floats az;
        Floats bz;
        Floats cz;
        Floats ax;
        Floats ay;
        Floats bx;
        Floats by;
        Floats cx;
        Floats cy;
        if constexpr (kWant == Want::kNearestByDepth) {
            // All rays have one origin, so the corners are moved once.
            alignas(64) float moved[16];
            store(moved, subtract(load(corner), origins));
            az = all(moved[kz]);
            bz = all(moved[3 + kz]);
            cz = all(moved[6 + kz]);
            ax = subtract(all(moved[kx]), multiply(shear_x, az));
            ay = subtract(all(moved[ky]), multiply(shear_y, az));
            bx = subtract(all(moved[3 + kx]), multiply(shear_x, bz));
            by = subtract(all(moved[3 + ky]), multiply(shear_y, bz));
            cx = subtract(all(moved[6 + kx]), multiply(shear_x, cz));
            cy = subtract(all(moved[6 + ky]), multiply(shear_y, cz));
        } else {
            az = subtract(all(corner[kz]), origin[kz]);
            bz = subtract(all(corner[3 + kz]), origin[kz]);
            cz = subtract(all(corner[6 + kz]), origin[kz]);
            ax = subtract(subtract(all(corner[kx]), origin[kx]), multiply(shear_x, az));
            ay = subtract(subtract(all(corner[ky]), origin[ky]), multiply(shear_y, az));
            bx = subtract(subtract(all(corner[3 + kx]), origin[kx]), multiply(shear_x, bz));
            by = subtract(subtract(all(corner[3 + ky]), origin[ky]), multiply(shear_y, bz));
            cx = subtract(subtract(all(corner[6 + kx]), origin[kx]), multiply(shear_x, cz));
            cy = subtract(subtract(all(corner[6 + ky]), origin[ky]), multiply(shear_y, cz));
        }
        const Floats u = subtract(multiply(cx, by), multiply(cy, bx));
        const Floats v = subtract(multiply(ax, cy), multiply(ay, cx));
        const Floats w = subtract(multiply(bx, ay), multiply(by, ax));
        const Floats zero = all(0.0f);
        const std::uint32_t below = less(lower_of(lower_of(u, v), w), zero);
        const std::uint32_t above = less(zero, higher_of(higher_of(u, v), w));
        std::uint32_t hit = active & ~(below & above);
        if (hit == 0) return;
        const Floats sum = add(add(u, v), w);
        hit &= ~equal(sum, zero);
        if (hit == 0) return;
        const Floats along = multiply(shear_z, add(add(multiply(u, az), multiply(v, bz)), multiply(w, cz)));
        // A triangle that is seen edge-on, or has no area, makes u, v and w meaningless: by their signs a ray
        // could hit it beside it. So a hit must also be within the corners as the ray sees them and in the
        // triangle's box, but for rounding. The walk relies on the box.
        const Floats deep = higher_of(higher_of(absolute(az), absolute(bz)), absolute(cz));
        const Floats off = multiply(deep, all(0x1p-21f));
        const Floats below_off = subtract(all(0.0f), off);
        hit &= at_most(lower_of(lower_of(ax, bx), cx), off) &
               at_most(below_off, higher_of(higher_of(ax, bx), cx)) &
               at_most(lower_of(lower_of(ay, by), cy), off) &
               at_most(below_off, higher_of(higher_of(ay, by), cy));
        if (hit == 0) return;
        // The box gets a larger margin, because t may be off by more where a ray grazes a triangle.
        const Floats far_off = multiply(deep, all(0x1p-18f));
        const auto least_of = [&](int axis) {
            const float a = corner[axis];
            const float b = corner[3 + axis];
            const float c = corner[6 + axis];
            const float least = b < a ? b : a;
            return subtract(subtract(all(c < least ? c : least), origin[axis]), far_off);
        };
        const auto most_of = [&](int axis) {
            const float a = corner[axis];
            const float b = corner[3 + axis];
            const float c = corner[6 + axis];
            const float most = b > a ? b : a;
            return add(subtract(all(c > most ? c : most), origin[axis]), far_off);
        };
        if constexpr (kWant == Want::kNearestByDepth) {
            // Depth needs no further division, and does not rise with 1 / t.
            const Floats inverse_t = divide(sum, along);
            const Floats depth = subtract(depth_offset, multiply(depth_scale, inverse_t));
            hit &= at_most(least_inverse, inverse_t) & at_least_zero(depth) & less(depth, all(1.0f));
            const auto in_box = [&](int axis) {
                return at_most(multiply(least_of(axis), inverse_t), direction[axis]) &
                       at_most(direction[axis], multiply(most_of(axis), inverse_t));
            };
            hit &= less(depth, best) | (equal(depth, best) & less(all(number), triangle));
            hit &= in_box(kx) & in_box(ky);
            if (hit == 0) return;
            keep(hit, number, depth, u, v, w);
            // Many t have the same depth, so the limit is a t whose depth is greater for sure.
            const Floats greater = add(depth, multiply(absolute(depth_offset), all(1e-6f)));
            const Floats least =
                higher_of(multiply(subtract(depth_offset, greater), inverse_scale), all(1e-30f));
            least_inverse = where(hit, least, least_inverse);
            limit = where(hit, divide(all(1.0f), least), limit);
        } else {
            const Floats t = divide(along, sum);
            hit &= less(all(0.0f), t) & at_most(t, limit);
            const auto in_box = [&](int axis) {
                const Floats at = multiply(t, direction[axis]);
                return at_most(least_of(axis), at) & at_most(at, most_of(axis));
            };
            hit &= in_box(kx) & in_box(ky);
            if constexpr (kWant == Want::kAny) {
                const Words number_of = all(number);
                hit &= less(number_of, but) | less(but, number_of);
                active &= ~hit;
                limit = where(hit, all(-1.0f), limit);
            } else {
                hit &= less(t, best) | (equal(t, best) & less(all(number), triangle));
                if (hit == 0) return;
                keep(hit, number, t, u, v, w);
                limit = where(hit, t, limit);
            }
        }
    }

    void keep(std::uint32_t hit, std::uint32_t number, const Floats& key, const Floats& u, const Floats& v,
              const Floats& w) {
        best = where(hit, key, best);
        triangle = where(hit, all(number), triangle);
        weight[0] = where(hit, u, weight[0]);
        weight[1] = where(hit, v, weight[1]);
        weight[2] = where(hit, w, weight[2]);
    }

    void run() {
        // The part of each ray that is in the tree's box.
        Floats enter = all(0.0f);
        Floats leave = all(kFar);
        for (int axis = 0; axis < 3; ++axis) {
            const Floats one = multiply(subtract(all(tree.low[axis]), origin[axis]), inverse[axis]);
            const Floats other = multiply(subtract(all(tree.high[axis]), origin[axis]), inverse[axis]);
            enter = higher_of(enter, subtract(negative[axis] ? other : one, slack[axis]));
            leave = lower_of(leave, add(negative[axis] ? one : other, slack[axis]));
        }
        leave = where(active, leave, all(-1.0f));
        Waiting stack[kStack];
        int waiting = 0;
        if (at_most(enter, leave) == 0) return;
        Place at = place_of(0);
        for (;;) {
            const KernelNode& node = tree.nodes[at.node];
            if (at.axes == 0) {
                look_at_leaf(node);
                if (kWant == Want::kAny && active == 0) return;
            } else {
                if constexpr (kCount) {
                    ++work->steps;
                    work->ray_steps += static_cast<std::uint64_t>(
                        __builtin_popcount(at_most(enter, lower_of(leave, limit))));
                }
                // Takes the node's next plane as if it were a kd node.
                const auto axis = lowest_bit(at.axes);
                const Floats t = multiply(subtract(all(node.plane[axis]), origin[axis]), inverse[axis]);
                const Floats near_leave = lower_of(leave, add(t, slack[axis]));
                const Floats far_enter = higher_of(enter, subtract(t, slack[axis]));
                Place near{at.node, at.axes & (at.axes - 1), at.child | (negative[axis] ? at.bit : 0),
                           at.bit << 1};
                Place far{at.node, near.axes, at.child | (negative[axis] ? 0 : at.bit), at.bit << 1};
                bool in_near = at_most(enter, lower_of(near_leave, limit)) != 0;
                bool in_far = at_most(far_enter, lower_of(leave, limit)) != 0;
                if (near.axes == 0) {
                    const std::uint32_t first = node.link >> 3;
                    in_near = in_near && enters(first + near.child, near);
                    in_far = in_far && enters(first + far.child, far);
                }
                if (in_near) {
                    if (in_far) stack[waiting++] = {far_enter, leave, far};
                    leave = near_leave;
                    at = near;
                    continue;
                }
                if (in_far) {
                    enter = far_enter;
                    at = far;
                    continue;
                }
            }
            // Goes on with the next part that can still hold a better hit.
            do {
                if (waiting == 0) return;
                const Waiting& next = stack[--waiting];
                enter = next.enter;
                leave = next.leave;
                at = next.at;
            } while (at_most(enter, lower_of(leave, limit)) == 0);
        }
    }

    void look_at_leaf(const KernelNode& node) {
        const std::uint32_t* const numbers = tree.triangles + bits(node.plane[0]);
        const std::uint32_t count = bits(node.plane[1]);
        if constexpr (kCount) ++work->leaves;
        for (std::uint32_t i = 0; i < count; ++i) {
            std::uint32_t& last = tested[numbers[i] % kTested];
            if (last == numbers[i] || !has(tree.wanted_triangles, numbers[i])) continue;
            last = numbers[i];
            test(numbers[i]);
            if constexpr (kCount) ++work->triangles;
        }
    }

    Place place_of(std::uint32_t node) const { return {node, tree.nodes[node].link & 7, 0, 1}; }

    static std::uint32_t bits(float x) {
        std::uint32_t result;
        __builtin_memcpy(&result, &x, sizeof result);
        return result;
    }
    // Sets `place` to a child. Returns whether anything in it is wanted.
    bool enters(std::uint32_t number, Place& place) const {
        const KernelNode& node = tree.nodes[number];
        place = {number, node.link & 7, 0, 1};
        return (place.axes != 0 || bits(node.plane[1]) != 0) && has(tree.wanted_nodes, number);
    }
};

// The lanes of the same kind as the first of `lanes`.
inline std::uint32_t of_one_kind(const RayPacket& rays, std::uint32_t lanes) {
    const std::uint32_t first = lowest_bit(lanes);
    const Floats x = load(rays.direction[0]);
    const Floats y = load(rays.direction[1]);
    const Floats z = load(rays.direction[2]);
    const auto like_first = [&](std::uint32_t mask) { return (mask >> first & 1) != 0 ? mask : ~mask; };
    lanes &= like_first(below_zero(x)) & like_first(below_zero(y)) & like_first(below_zero(z));
    const std::uint32_t x_largest = at_most(absolute(y), absolute(x)) & at_most(absolute(z), absolute(x));
    const std::uint32_t y_largest = ~x_largest & at_most(absolute(z), absolute(y));
    return lanes & like_first(x_largest) & like_first(y_largest);
}

template <Want kWant, bool kCount>
void find(const KernelTree& tree, const RayPacket& rays, PacketHits& hits, PacketWork* work) {
    if constexpr (kCount) ++work->packets;
    std::uint32_t left = rays.active & kAllLanes;
    if (left != kAllLanes) store(hits.triangle, all(kNoTriangle));
    while (left != 0) {
        const std::uint32_t lanes = of_one_kind(rays, left);
        Walk<kWant, kCount> walk(tree, rays, lanes, lowest_bit(left), work);
        walk.run();
        left &= ~lanes;
        if (lanes == kAllLanes) {
            store(hits.triangle, walk.triangle);
            store(hits.nearness, walk.best);
            for (int corner = 0; corner < 3; ++corner) store(hits.weight[corner], walk.weight[corner]);
        } else {
            store(hits.triangle, where(lanes, walk.triangle, load(hits.triangle)));
            store(hits.nearness, where(lanes, walk.best, load(hits.nearness)));
            for (int corner = 0; corner < 3; ++corner)
                store(hits.weight[corner], where(lanes, walk.weight[corner], load(hits.weight[corner])));
        }
    }
}

void nearest(const KernelTree& tree, const RayPacket& rays, PacketHits& hits) {
    find<Want::kNearest, false>(tree, rays, hits, nullptr);
}
void nearest_by_depth(const KernelTree& tree, const RayPacket& rays, PacketHits& hits) {
    find<Want::kNearestByDepth, false>(tree, rays, hits, nullptr);
}
void count(const KernelTree& tree, const RayPacket& rays, PacketHits& hits, PacketWork& work) {
    find<Want::kNearest, true>(tree, rays, hits, &work);
}
std::uint32_t any(const KernelTree& tree, const RayPacket& rays, const std::uint32_t* but) {
    std::uint32_t left = rays.active & kAllLanes;
    std::uint32_t found = 0;
    while (left != 0) {
        const std::uint32_t lanes = of_one_kind(rays, left);
        Walk<Want::kAny, false> walk(tree, rays, lanes, lowest_bit(left), nullptr);
        walk.but = load(but);
        walk.run();
        found |= lanes & ~walk.active;
        left &= ~lanes;
    }
    return found;
}

}  // namespace

extern const PacketKernels kPacketKernels;
const PacketKernels kPacketKernels{nearest, nearest_by_depth, any, count};

}  // namespace swath::SWATH_KERNEL
