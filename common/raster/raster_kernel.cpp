#include "common/raster/raster_kernel.h"

#include <cstddef>

#include "common/base/lanes/lanes.h"

namespace swath::SWATH_KERNEL {
namespace {

constexpr std::uint32_t kSigns = 0x80008000;  // of both halves
constexpr int kOnePixel = 256;
constexpr float kAmbient = 0.2f;

// A meshlet's vertices on the screen. Positions are 1/256 pixels from the bin's centre.
struct alignas(64) Vertices {
    std::uint32_t both[kMeshletVertices];  // x in the low half, y in the high one
    std::uint32_t x[kMeshletVertices];
    std::uint32_t y[kMeshletVertices];
    float z[kMeshletVertices];
    float inverse_w[kMeshletVertices];
    float colour[3][kMeshletVertices];
};

// Triangles of one class: local vertex numbers as in a meshlet, and above them the triangle's number in it.
struct List {
    alignas(64) std::uint32_t words[kMeshletTriangles + 16];
    std::uint32_t* end = words;
};

inline int clamp(int a, int low, int high) { return a < low ? low : (a > high ? high : a); }

inline Words lane_numbers() {
    alignas(64) static constexpr std::uint32_t kNumbers[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                               8, 9, 10, 11, 12, 13, 14, 15};
    return load(kNumbers);
}

inline int centre_x(const KernelBin& bin) { return bin.x + kBinWidth / 2; }
inline int centre_y(const KernelBin& bin) { return bin.y + kBinHeight / 2; }

struct Row {
    Floats x;
    Floats y;
    Floats z;
    Floats w;
};

inline Floats row(const KernelView& view, int i, Floats x, Floats y, Floats z) {
    const float* const m = view.clip_from_model + i;
    return add(add(add(multiply(all(m[0]), x), multiply(all(m[4]), y)), multiply(all(m[8]), z)), all(m[12]));
}

// Both coordinates in one word. Those far outside of the bin become other ones outside, so that sums of two
// halves do not overflow.
inline Words packed_position(Words x, Words y) {
    const Words low = all(static_cast<std::uint32_t>(-32000));
    const Words high = all(32000u);
    return either(both(lower_of(higher_of(x, low), high), all(0xffffu)),
                  shift_left<16>(lower_of(higher_of(y, low), high)));
}

// Projects and shades a meshlet's vertices. Returns a bit for each that has to be clipped.
template <bool kMayClip>
std::uint64_t transform(const KernelView& view, const KernelMeshlet& meshlet, const KernelBin& bin,
                        Vertices& out) {
    std::uint64_t clipped = 0;
    const Words centre_of_x = all(static_cast<std::uint32_t>(kOnePixel * centre_x(bin)));
    const Words centre_of_y = all(static_cast<std::uint32_t>(kOnePixel * centre_y(bin)));
    const Floats zero = all(0.0f);
    const Floats half = all(0.5f);
    const Floats half_width = all(kOnePixel * view.half_width);
    const Floats half_height = all(kOnePixel * view.half_height);
    constexpr float kPerUnit = 1.0f / 32767.0f;
    for (std::uint32_t block = 0; block < meshlet.blocks; ++block) {
        const VertexBlock& from = meshlet.vertices[block];
        Floats px = load(from.position[0]);
        Floats py = load(from.position[1]);
        Floats pz = load(from.position[2]);
        if (meshlet.motion != nullptr) {
            const MotionBlock& motion = meshlet.motion[block];
            const Floats pose = all(view.pose);
            px = add(px, multiply(pose, load(motion.motion[0])));
            py = add(py, multiply(pose, load(motion.motion[1])));
            pz = add(pz, multiply(pose, load(motion.motion[2])));
        }
        const Floats w = row(view, 3, px, py, pz);
        const Floats z = row(view, 2, px, py, pz);
        const Floats inverse = divide(all(1.0f), w);
        // 1/256 pixels from the screen's centre. Scaling by 256 changes no rounding.
        const Floats x = multiply(multiply(row(view, 0, px, py, pz), inverse), half_width);
        const Floats y = multiply(multiply(row(view, 1, px, py, pz), inverse), half_height);
        std::uint32_t good = 0xffff;
        if constexpr (kMayClip) {
            const Floats guard = all(kOnePixel * view.guard);
            good = bits(
                both(both(both(is_less(all(kLeastW), w), is_less(w, all(kMostW))), is_less(zero, add(z, w))),
                     both(is_less(absolute(x), guard), is_less(absolute(y), guard))));
            clipped |= std::uint64_t{~good & 0xffff} << (16 * block);
        }
        const auto snap = [&](Floats at, Floats to_corner) {
            const Floats units = add(at, to_corner);
            return rounded(good == 0xffff ? units : where(good, units, zero));
        };
        const Words sx = subtract(snap(x, half_width), centre_of_x);
        const Words sy = subtract(snap(y, half_height), centre_of_y);
        const std::uint32_t at = 16 * block;
        store(out.x + at, sx);
        store(out.y + at, sy);
        store(out.both + at, packed_position(sx, sy));
        store(out.z + at, higher_of(add(multiply(multiply(z, inverse), half), half), zero));
        store(out.inverse_w + at, inverse);

        const auto part = [&](int axis) {
            return multiply(to_floats(load_shorts(from.normal[axis])), all(view.to_light[axis] * kPerUnit));
        };
        const Floats cosine = absolute(add(add(part(0), part(1)), part(2)));
        const Floats light = add(all(kAmbient), multiply(all(1.0f - kAmbient), cosine));
        const Words colour = load(from.colour);
        const Words byte = all(0xffu);
        const Floats white = all(255.0f);
        store(out.colour[0] + at, lower_of(multiply(to_floats(both(colour, byte)), light), white));
        store(out.colour[1] + at,
              lower_of(multiply(to_floats(both(shift_right<8>(colour), byte)), light), white));
        store(out.colour[2] + at,
              lower_of(multiply(to_floats(both(shift_right<16>(colour), byte)), light), white));
    }
    return clipped;
}

// Local numbers of the corners of sixteen triangles.
inline Words corner(Words triangles, int k) {
    const Words byte = all(0xffu);
    return both(k == 0 ? triangles : (k == 1 ? shift_right<8>(triangles) : shift_right<16>(triangles)), byte);
}

// The first sample at or after positions, and the last at or before them, of both halves, in pixels.
inline Words first_sample(Words position) {
    return shift_right_halves<8>(add_halves(position, all(0x007f007fu)));
}
inline Words last_sample(Words position) {
    return shift_right_halves<8>(subtract_halves(position, all(0x00800080u)));
}
// A sample's position.
inline Words sample(Words pixel) { return add_halves(shift_left_halves<8>(pixel), all(0x00800080u)); }

// Vectors turned by a quarter, so that the dot product with them is a cross product: (x, y) to (y, -x).
inline Words turned(Words v) {
    return add_halves(exclusive(swap_halves(v), all(0xffff0000u)), all(0x00010000u));
}

struct Lists {
    List two;   // triangles of at most 2x2 samples
    List four;  // 4x4
    List large;
};

inline std::uint32_t packed_halves(int low, int high) {
    return (static_cast<std::uint32_t>(low) & 0xffff) | static_cast<std::uint32_t>(high) << 16;
}

// Sorts the triangles of a meshlet that may cover samples of the bin by their size.
void classify(const KernelMeshlet& meshlet, const KernelBin& bin, const Vertices& vertices,
              std::uint64_t clipped, Lists& lists) {
    const Words low = all(packed_halves(-kBinWidth / 2, -kBinHeight / 2));
    const Words high = all(packed_halves(bin.width - 1 - kBinWidth / 2, bin.height - 1 - kBinHeight / 2));
    Words number = shift_left<24>(add(lane_numbers(), all(meshlet.first)));
    for (std::uint32_t t = meshlet.first; t < meshlet.end; t += 16) {
        const Words triangles = load(meshlet.triangles + t);
        const Words a = look_up64(vertices.both, corner(triangles, 0));
        const Words b = look_up64(vertices.both, corner(triangles, 1));
        const Words c = look_up64(vertices.both, corner(triangles, 2));
        const Words first = first_sample(lower_halves(lower_halves(a, b), c));
        const Words last = last_sample(higher_halves(higher_halves(a, b), c));
        const Words extent = subtract_halves(last, first);
        const Words inside = subtract_halves(lower_halves(last, high), higher_halves(first, low));
        std::uint32_t live = ~non_zero(both(inside, all(kSigns)));
        live &= meshlet.end - t < 16 ? (1u << (meshlet.end - t)) - 1 : 0xffff;
        if (clipped != 0) {
            alignas(64) std::uint32_t corners[16];
            store(corners, triangles);
            for (std::uint32_t i = 0; i < 16; ++i)
                for (int k = 0; k < 3; ++k)
                    if ((clipped >> (corners[i] >> 8 * k & 0xff) & 1) != 0) live &= ~(1u << i);
        }
        if (live == 0) {
            number = add(number, all(16u << 24));
            continue;
        }
        const std::uint32_t over_two = non_zero(both(extent, all(0xfffefffeu)));
        const std::uint32_t over_four = non_zero(both(extent, all(0xfffcfffcu)));
        const Words words = either(triangles, number);
        const std::uint32_t two = live & ~over_two;
        const std::uint32_t four = live & over_two & ~over_four;
        const std::uint32_t large = live & over_four;
        if (two != 0) lists.two.end = packed(lists.two.end, words, two);
        if (four != 0) lists.four.end = packed(lists.four.end, words, four);
        if (large != 0) lists.large.end = packed(lists.large.end, words, large);
        number = add(number, all(16u << 24));
    }
}

// Fragments of small triangles: x and y in the bin's buffer, a byte each, and above them the triangle's
// number in its meshlet.
struct Fragments {
    alignas(64) std::uint32_t words[16 * kMeshletTriangles + 16];
    std::uint32_t* end = words;
};

// Finds the samples that triangles of at most kSize x kSize of them cover.
template <int kSize>
void cover(const List& list, const Vertices& vertices, Fragments& fragments) {
    const Words high_half = all(0xffff0000u);
    for (const std::uint32_t* from = list.words; from < list.end; from += 16) {
        const Words triangles = load(from);
        const Words a = look_up64(vertices.both, corner(triangles, 0));
        const Words b = look_up64(vertices.both, corner(triangles, 1));
        const Words c = look_up64(vertices.both, corner(triangles, 2));
        const Words first = first_sample(lower_halves(lower_halves(a, b), c));
        const Words at = sample(first);
        const Words from_a = subtract_halves(a, at);
        const Words from_b = subtract_halves(b, at);
        const Words from_c = subtract_halves(c, at);
        Words edge[3] = {dot_halves(from_b, turned(from_c)), dot_halves(from_c, turned(from_a)),
                         dot_halves(from_a, turned(from_b))};
        const Words along[3] = {subtract_halves(c, b), subtract_halves(a, c), subtract_halves(b, a)};
        const Words area = add(add(edge[0], edge[1]), edge[2]);
        // All ones where the corners turn right.
        const Words right = shift_right_signed<31>(area);
        Words step_x[3];
        Words step_y[3];
        for (int k = 0; k < 3; ++k) {
            const Words d = subtract_halves(exclusive(along[k], right), right);
            // -1 unless the edge owns samples on it: one that goes down, or to the right along a row.
            const Words other = shift_right_signed<31>(subtract(all(0x7fffu), d));
            edge[k] = add(subtract(exclusive(edge[k], right), right), other);
            step_x[k] = shift_right_signed<8>(both(d, high_half));  // to be subtracted
            step_y[k] = shift_right_signed<8>(shift_left<16>(d));
        }
        // Three equal corners have no edge that could leave a sample out.
        edge[0] = add(edge[0], shift_right_signed<31>(subtract(magnitude(area), all(1u))));
        // x and y in the buffer.
        const Words place =
            add_halves(first, all(packed_halves(kBinWidth / 2 + kBinMargin, kBinHeight / 2 + kBinMargin)));
        Words word = either(either(both(place, all(0xffu)), shift_right<8>(both(place, all(0x00ff0000u)))),
                            shift_left<16>(shift_right<24>(triangles)));
        for (int j = 0; j < kSize; ++j) {
            Words inside[3] = {edge[0], edge[1], edge[2]};
            for (int i = 0; i < kSize; ++i) {
                const std::uint32_t covered =
                    ~bits(negative(either(either(inside[0], inside[1]), inside[2]))) & 0xffff;
                fragments.end = packed(fragments.end, add(word, all(static_cast<std::uint32_t>(i))), covered);
                if (i + 1 < kSize)
                    for (int k = 0; k < 3; ++k) inside[k] = subtract(inside[k], step_x[k]);
            }
            word = add(word, all(0x100u));
            for (int k = 0; k < 3; ++k) edge[k] = add(edge[k], step_y[k]);
        }
    }
}

inline Words colour_of(Floats red, Floats green, Floats blue) {
    return either(either(rounded(red), shift_left<8>(rounded(green))),
                  either(shift_left<16>(rounded(blue)), all(0xff000000u)));
}

// Gives fragments of small triangles depth and colour, and writes what is nearest.
void shade(const Fragments& fragments, const KernelMeshlet& meshlet, const Vertices& vertices,
           BinPixels& pixels) {
    alignas(64) std::uint32_t offsets[16];
    alignas(64) std::uint32_t colours[16];
    alignas(64) float depths[16];
    alignas(64) std::uint32_t numbers[16];
    for (const std::uint32_t* from = fragments.words; from < fragments.end; from += 16) {
        const Words word = load(from);
        const Words x = both(word, all(0xffu));
        const Words y = both(shift_right<8>(word), all(0xffu));
        const Words triangle = shift_right<16>(word);
        const Words triangles = look_up(meshlet.triangles, triangle);
        const Words corners[3] = {corner(triangles, 0), corner(triangles, 1), corner(triangles, 2)};
        const Words pixel =
            add_halves(either(x, shift_left<16>(y)),
                       all(packed_halves(-kBinWidth / 2 - kBinMargin, -kBinHeight / 2 - kBinMargin)));
        const Words at = sample(pixel);
        const Words from_a = subtract_halves(look_up64(vertices.both, corners[0]), at);
        const Words from_b = subtract_halves(look_up64(vertices.both, corners[1]), at);
        const Words from_c = subtract_halves(look_up64(vertices.both, corners[2]), at);
        // The sample is inside, so that all of them have the area's sign, or are 0.
        const Floats part[3] = {to_floats(magnitude(dot_halves(from_b, turned(from_c)))),
                                to_floats(magnitude(dot_halves(from_c, turned(from_a)))),
                                to_floats(magnitude(dot_halves(from_a, turned(from_b))))};
        const Floats area = add(add(part[0], part[1]), part[2]);
        const Floats za = look_up64(vertices.z, corners[0]);
        const Floats zb = look_up64(vertices.z, corners[1]);
        const Floats zc = look_up64(vertices.z, corners[2]);
        const Floats rise =
            divide(add(multiply(part[1], subtract(zb, za)), multiply(part[2], subtract(zc, za))), area);
        const Floats z = lower_of(higher_of(add(za, rise), lower_of(lower_of(za, zb), zc)),
                                  higher_of(higher_of(za, zb), zc));
        Floats weight[3];
        for (int k = 0; k < 3; ++k) weight[k] = multiply(part[k], look_up64(vertices.inverse_w, corners[k]));
        const Floats scale = divide(all(1.0f), add(add(weight[0], weight[1]), weight[2]));
        Floats colour[3];
        for (int channel = 0; channel < 3; ++channel) {
            const float* const table = vertices.colour[channel];
            colour[channel] = multiply(add(add(multiply(weight[0], look_up64(table, corners[0])),
                                               multiply(weight[1], look_up64(table, corners[1]))),
                                           multiply(weight[2], look_up64(table, corners[2]))),
                                       scale);
        }
        store(offsets, add(add(shift_left<7>(y), shift_left<4>(y)), x));
        store(depths, z);
        store(colours, colour_of(colour[0], colour[1], colour[2]));
        store(numbers, add(triangle, all(meshlet.number)));
        const long left = fragments.end - from;
        const int count = left < 16 ? static_cast<int>(left) : 16;
        for (int i = 0; i < count; ++i) {
            const std::uint32_t to = offsets[i];
            if (depths[i] < pixels.depth[to] ||
                (depths[i] == pixels.depth[to] && numbers[i] < pixels.number[to])) {
                pixels.depth[to] = depths[i];
                pixels.number[to] = numbers[i];
                pixels.colour[to] = colours[i];
            }
        }
    }
}
static_assert(kBinStride == (1 << 7) + (1 << 4));

// Values that are linear on the screen, of sixteen triangles: at the anchor, and their slopes a 1/256 pixel.
struct alignas(64) Planes {
    float at[16];
    float along_x[16];
    float along_y[16];
};

// What of sixteen triangles is in a bin, as walk() wants it.
struct alignas(64) Walks {
    // Of the first sample: for each edge, what is negative outside of it, and its steps a pixel.
    std::int32_t edge[3][16];
    std::int32_t step_x[3][16];
    std::int32_t step_y[3][16];
    std::int32_t x[16];  // of the first sample, in the bin
    std::int32_t y[16];
    std::int32_t width[16];
    std::int32_t height[16];
    float from_x[16];  // of the first sample, from the anchor, in 1/256 pixels
    float from_y[16];
    Planes z;
    Planes inverse_w;
    Planes colour[3];  // over w
    float low[4][16];  // of depth and colours
    float high[4][16];
    std::uint32_t number[16];
};

// Walks the part of a triangle in a bin in blocks of 8x2 samples.
void walk(const Walks& of, int t, BinPixels& pixels) {
    alignas(64) static constexpr float kX[16] = {0, 256, 512, 768, 1024, 1280, 1536, 1792,
                                                 0, 256, 512, 768, 1024, 1280, 1536, 1792};
    const Words column = both(lane_numbers(), all(7u));
    const Words second_row = halves(0, 0xffffffff);
    Words lanes[3];
    Words block_step[3];
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t step = static_cast<std::uint32_t>(of.step_x[k][t]);
        lanes[k] = add(product(column, all(step)),
                       both(second_row, all(static_cast<std::uint32_t>(of.step_y[k][t]))));
        block_step[k] = all(8 * step);
    }
    const bool wide = of.width[t] > 16;
    float inverse_step[3];
    if (wide)
        for (int k = 0; k < 3; ++k)
            inverse_step[k] = of.step_x[k][t] == 0 ? 0.0f : 1.0f / static_cast<float>(of.step_x[k][t]);
    Floats y = add(all(of.from_y[t]), to_floats(both(second_row, all(256u))));
    for (int j = 0; j < of.height[t]; j += 2, y = add(y, all(512.0f))) {
        int begin = 0;
        int end = of.width[t];
        std::int32_t edge[3];
        for (int k = 0; k < 3; ++k) edge[k] = of.edge[k][t] + j * of.step_y[k][t];
        if (wide) {
            // Blocks outside of an edge are left out, with a pixel's width of slack for rounding.
            for (int k = 0; k < 3; ++k) {
                const std::int32_t most = of.step_y[k][t] > 0 ? edge[k] + of.step_y[k][t] : edge[k];
                if (of.step_x[k][t] == 0) {
                    if (most < 0) end = 0;
                    continue;
                }
                float cut = -static_cast<float>(most) * inverse_step[k];
                cut = cut < -1000.0f ? -1000.0f : (cut > 1000.0f ? 1000.0f : cut);
                if (of.step_x[k][t] > 0) {
                    const int from = static_cast<int>(cut) - 1;
                    begin = from > begin ? from : begin;
                } else {
                    const int to = static_cast<int>(cut) + 2;
                    end = to < end ? to : end;
                }
            }
        }
        if (begin >= end) continue;
        Words inside[3];
        for (int k = 0; k < 3; ++k)
            inside[k] = add(lanes[k], all(static_cast<std::uint32_t>(edge[k]) +
                                          static_cast<std::uint32_t>(begin) *
                                              static_cast<std::uint32_t>(of.step_x[k][t])));
        const auto in_row = [&](const Planes& plane) {
            return add(all(plane.at[t]), multiply(y, all(plane.along_y[t])));
        };
        const Floats z_row = in_row(of.z);
        const Floats w_row = in_row(of.inverse_w);
        const Floats red_row = in_row(of.colour[0]);
        const Floats green_row = in_row(of.colour[1]);
        const Floats blue_row = in_row(of.colour[2]);
        Floats x = add(load(kX), all(of.from_x[t] + 256.0f * static_cast<float>(begin)));
        int to = (of.y[t] + j + kBinMargin) * kBinStride + of.x[t] + begin + kBinMargin;
        for (int i = begin; i < end; i += 8, to += 8) {
            const Truths outside = negative(either(either(inside[0], inside[1]), inside[2]));
            const Floats z =
                lower_of(higher_of(add(z_row, multiply(x, all(of.z.along_x[t]))), all(of.low[0][t])),
                         all(of.high[0][t]));
            float* const depth = pixels.depth + to;
            std::uint32_t* const number = pixels.number + to;
            const Floats old = load_rows(depth, depth + kBinStride);
            Truths nearer = is_less(z, old);
            const Truths equal = without(is_equal(z, old), outside);
            if (any(equal))
                nearer = either(
                    nearer, both(equal, is_less(all(of.number[t]), load_rows(number, number + kBinStride))));
            nearer = without(nearer, outside);
            if (any(nearer)) {
                const Floats w = divide(all(1.0f), add(w_row, multiply(x, all(of.inverse_w.along_x[t]))));
                const auto channel = [&](Floats row, int k) {
                    const Floats value = multiply(add(row, multiply(x, all(of.colour[k].along_x[t]))), w);
                    return lower_of(higher_of(value, all(of.low[k + 1][t])), all(of.high[k + 1][t]));
                };
                const Words colour =
                    colour_of(channel(red_row, 0), channel(green_row, 1), channel(blue_row, 2));
                store_rows_where(depth, depth + kBinStride, nearer, z);
                store_rows_where(number, number + kBinStride, nearer, all(of.number[t]));
                std::uint32_t* const out = pixels.colour + to;
                store_rows_where(out, out + kBinStride, nearer, colour);
            }
            x = add(x, all(2048.0f));
            for (int k = 0; k < 3; ++k) inside[k] = add(inside[k], block_step[k]);
        }
    }
}

inline float lowest_of(float a, float b, float c) {
    const float ab = a < b ? a : b;
    return ab < c ? ab : c;
}
inline float highest_of(float a, float b, float c) {
    const float ab = a > b ? a : b;
    return ab > c ? ab : c;
}

// Corners are 1/256 pixels from the bin's lowest, leftmost corner.
void draw_large(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, std::uint32_t number,
                const KernelBin& bin) {
    const std::int64_t bx = std::int64_t{b.x} - a.x;
    const std::int64_t by = std::int64_t{b.y} - a.y;
    const std::int64_t cx = std::int64_t{c.x} - a.x;
    const std::int64_t cy = std::int64_t{c.y} - a.y;
    const std::int64_t area = bx * cy - cx * by;
    if (area == 0) return;
    const int sign = area < 0 ? -1 : 1;

    const auto lowest = [](std::int32_t p, std::int32_t q, std::int32_t r) {
        const std::int32_t pq = p < q ? p : q;
        return pq < r ? pq : r;
    };
    const auto highest = [](std::int32_t p, std::int32_t q, std::int32_t r) {
        const std::int32_t pq = p > q ? p : q;
        return pq > r ? pq : r;
    };
    Walks of;  // the first of them
    of.x[0] = clamp((lowest(a.x, b.x, c.x) + 127) >> 8, 0, bin.width);
    of.y[0] = clamp((lowest(a.y, b.y, c.y) + 127) >> 8, 0, bin.height);
    of.width[0] = clamp(((highest(a.x, b.x, c.x) - 128) >> 8) + 1, 0, bin.width) - of.x[0];
    of.height[0] = clamp(((highest(a.y, b.y, c.y) - 128) >> 8) + 1, 0, bin.height) - of.y[0];
    if (of.width[0] <= 0 || of.height[0] <= 0) return;
    const int last_x = of.width[0] - 1 + 7;  // a block may reach so far
    const int last_y = (of.height[0] + 1) / 2 * 2 - 1;

    const std::int64_t sample_x = kOnePixel * of.x[0] + kOnePixel / 2;
    const std::int64_t sample_y = kOnePixel * of.y[0] + kOnePixel / 2;
    const ScreenVertex* const corners[5] = {&a, &b, &c, &a, &b};
    for (int k = 0; k < 3; ++k) {
        const ScreenVertex& from = *corners[k + 1];
        const ScreenVertex& to = *corners[k + 2];
        const std::int64_t dx = sign * (std::int64_t{to.x} - from.x);
        const std::int64_t dy = sign * (std::int64_t{to.y} - from.y);
        const bool owns = dy < 0 || (dy == 0 && dx > 0);
        const std::int64_t cross =
            sign * ((from.x - sample_x) * (to.y - sample_y) - (from.y - sample_y) * (to.x - sample_x));
        const std::int64_t edge = (cross - (owns ? 0 : 1)) >> 8;
        const std::int64_t across_x = -dy * last_x;
        const std::int64_t across_y = dx * last_y;
        const std::int64_t least = edge + (across_x < 0 ? across_x : 0) + (across_y < 0 ? across_y : 0);
        const std::int64_t most = edge + (across_x > 0 ? across_x : 0) + (across_y > 0 ? across_y : 0);
        if (most < 0) return;
        const bool crosses = least < 0;  // so that all fit in 32 bits
        of.edge[k][0] = crosses ? static_cast<std::int32_t>(edge) : 0;
        of.step_x[k][0] = crosses ? static_cast<std::int32_t>(-dy) : 0;
        of.step_y[k][0] = crosses ? static_cast<std::int32_t>(dx) : 0;
    }

    of.from_x[0] = static_cast<float>(sample_x - a.x);
    of.from_y[0] = static_cast<float>(sample_y - a.y);
    const float inverse_area = 1.0f / static_cast<float>(area);
    const float fbx = static_cast<float>(bx);
    const float fby = static_cast<float>(by);
    const float fcx = static_cast<float>(cx);
    const float fcy = static_cast<float>(cy);
    const auto set = [&](Planes& plane, float at_a, float at_b, float at_c) {
        const float to_b = at_b - at_a;
        const float to_c = at_c - at_a;
        plane.at[0] = at_a;
        plane.along_x[0] = (to_b * fcy - to_c * fby) * inverse_area;
        plane.along_y[0] = (to_c * fbx - to_b * fcx) * inverse_area;
    };
    set(of.z, a.z, b.z, c.z);
    set(of.inverse_w, a.inverse_w, b.inverse_w, c.inverse_w);
    of.low[0][0] = lowest_of(a.z, b.z, c.z);
    of.high[0][0] = highest_of(a.z, b.z, c.z);
    for (int k = 0; k < 3; ++k) {
        set(of.colour[k], a.colour[k] * a.inverse_w, b.colour[k] * b.inverse_w, c.colour[k] * c.inverse_w);
        of.low[k + 1][0] = lowest_of(a.colour[k], b.colour[k], c.colour[k]);
        of.high[k + 1][0] = highest_of(a.colour[k], b.colour[k], c.colour[k]);
    }
    of.number[0] = number;
    walk(of, 0, *bin.pixels);
}

// Prepares sixteen triangles for walk(). Returns a bit for each that has samples in the bin; `too_large` gets one
// for each whose edges do not fit in 32 bits.
std::uint32_t set_up(Words triangles, const KernelMeshlet& meshlet, const KernelBin& bin,
                     const Vertices& vertices, Walks& of, std::uint32_t& too_large) {
    const Words corners[3] = {corner(triangles, 0), corner(triangles, 1), corner(triangles, 2)};
    Words x[3];
    Words y[3];
    for (int k = 0; k < 3; ++k) {
        x[k] = look_up64(vertices.x, corners[k]);
        y[k] = look_up64(vertices.y, corners[k]);
    }
    const Words low_x = lower_of(lower_of(x[0], x[1]), x[2]);
    const Words low_y = lower_of(lower_of(y[0], y[1]), y[2]);
    const Words high_x = higher_of(higher_of(x[0], x[1]), x[2]);
    const Words high_y = higher_of(higher_of(y[0], y[1]), y[2]);
    const Words limit = all(127u * kOnePixel);
    too_large = ~(less(subtract(high_x, low_x), limit) & less(subtract(high_y, low_y), limit)) & 0xffff;

    const auto first = [](Words low, int least) {
        return higher_of(shift_right_signed<8>(add(low, all(127u))), all(static_cast<std::uint32_t>(least)));
    };
    const auto size = [](Words high, int most, Words from) {
        const Words last =
            lower_of(shift_right_signed<8>(subtract(high, all(128u))), all(static_cast<std::uint32_t>(most)));
        return add(subtract(last, from), all(1u));
    };
    const Words first_x = first(low_x, -kBinWidth / 2);
    const Words first_y = first(low_y, -kBinHeight / 2);
    const Words width = size(high_x, bin.width - 1 - kBinWidth / 2, first_x);
    const Words height = size(high_y, bin.height - 1 - kBinHeight / 2, first_y);
    const auto put = [](std::int32_t* to, Words a) { store(reinterpret_cast<std::uint32_t*>(to), a); };
    put(of.x, add(first_x, all(static_cast<std::uint32_t>(kBinWidth / 2))));
    put(of.y, add(first_y, all(static_cast<std::uint32_t>(kBinHeight / 2))));
    put(of.width, width);
    put(of.height, height);

    const Words sample_x = add(shift_left<8>(first_x), all(128u));
    const Words sample_y = add(shift_left<8>(first_y), all(128u));
    const Words bx = subtract(x[1], x[0]);
    const Words by = subtract(y[1], y[0]);
    const Words cx = subtract(x[2], x[0]);
    const Words cy = subtract(y[2], y[0]);
    const Words area = subtract(product(bx, cy), product(cx, by));
    const Words right = shift_right_signed<31>(area);
    const auto turned_left = [&](Words a) { return subtract(exclusive(a, right), right); };
    for (int k = 0; k < 3; ++k) {
        const int from = (k + 1) % 3;
        const int to = (k + 2) % 3;
        const Words dx = turned_left(subtract(x[to], x[from]));
        const Words dy = turned_left(subtract(y[to], y[from]));
        const Words cross =
            turned_left(subtract(product(subtract(x[from], sample_x), subtract(y[to], sample_y)),
                                 product(subtract(y[from], sample_y), subtract(x[to], sample_x))));
        // All ones if the edge owns samples on it: one that goes down, or to the right along a row.
        const Words owns = shift_right_signed<31>(subtract(shift_left<16>(dy), dx));
        put(of.edge[k], shift_right_signed<8>(subtract(subtract(cross, all(1u)), owns)));
        put(of.step_x[k], subtract(all(0u), dy));
        put(of.step_y[k], dx);
    }

    store(of.from_x, to_floats(subtract(sample_x, x[0])));
    store(of.from_y, to_floats(subtract(sample_y, y[0])));
    const Floats inverse_area = divide(all(1.0f), to_floats(area));
    const Floats fbx = to_floats(bx);
    const Floats fby = to_floats(by);
    const Floats fcx = to_floats(cx);
    const Floats fcy = to_floats(cy);
    const auto set = [&](Planes& plane, const Floats(&at)[3]) {
        const Floats to_b = subtract(at[1], at[0]);
        const Floats to_c = subtract(at[2], at[0]);
        store(plane.at, at[0]);
        store(plane.along_x, multiply(subtract(multiply(to_b, fcy), multiply(to_c, fby)), inverse_area));
        store(plane.along_y, multiply(subtract(multiply(to_c, fbx), multiply(to_b, fcx)), inverse_area));
    };
    const auto bound = [&](int i, const Floats(&at)[3]) {
        store(of.low[i], lower_of(lower_of(at[0], at[1]), at[2]));
        store(of.high[i], higher_of(higher_of(at[0], at[1]), at[2]));
    };
    const auto of_corners = [&](const float* table, Floats(&at)[3]) {
        for (int k = 0; k < 3; ++k) at[k] = look_up64(table, corners[k]);
    };
    Floats at[3];
    Floats w[3];
    of_corners(vertices.z, at);
    set(of.z, at);
    bound(0, at);
    of_corners(vertices.inverse_w, w);
    set(of.inverse_w, w);
    for (int channel = 0; channel < 3; ++channel) {
        of_corners(vertices.colour[channel], at);
        bound(channel + 1, at);
        for (int k = 0; k < 3; ++k) at[k] = multiply(at[k], w[k]);
        set(of.colour[channel], at);
    }
    store(of.number, add(all(meshlet.number), shift_right<24>(triangles)));
    const Words missed = either(subtract(width, all(1u)), subtract(height, all(1u)));
    return ~bits(negative(missed)) & non_zero(area) & 0xffff;
}

void draw_middle(const List& list, const KernelMeshlet& meshlet, const KernelBin& bin,
                 const Vertices& vertices) {
    Walks walks;
    for (const std::uint32_t* from = list.words; from < list.end; from += 16) {
        std::uint32_t too_large = 0;
        std::uint32_t live = set_up(load(from), meshlet, bin, vertices, walks, too_large);
        const long left = list.end - from;
        const std::uint32_t wanted = left < 16 ? (1u << left) - 1 : 0xffff;
        for (live &= wanted & ~too_large; live != 0; live &= live - 1)
            walk(walks, __builtin_ctz(live), *bin.pixels);
        for (std::uint32_t large = too_large & wanted; large != 0; large &= large - 1) {
            const std::uint32_t word = from[__builtin_ctz(large)];
            const auto vertex = [&](std::uint32_t i) {
                return ScreenVertex{static_cast<std::int32_t>(vertices.x[i]) + kOnePixel * kBinWidth / 2,
                                    static_cast<std::int32_t>(vertices.y[i]) + kOnePixel * kBinHeight / 2,
                                    vertices.z[i],
                                    vertices.inverse_w[i],
                                    {vertices.colour[0][i], vertices.colour[1][i], vertices.colour[2][i]}};
            };
            draw_large(vertex(word & 0xff), vertex(word >> 8 & 0xff), vertex(word >> 16 & 0xff),
                       meshlet.number + (word >> 24), bin);
        }
    }
}

void draw(const KernelView& view, const KernelMeshlet& meshlet, const KernelBin& bin) {
    Vertices vertices;
    const std::uint64_t clipped = meshlet.may_clip ? transform<true>(view, meshlet, bin, vertices)
                                                   : transform<false>(view, meshlet, bin, vertices);
    Lists lists;
    classify(meshlet, bin, vertices, clipped, lists);
    // A triangle of three equal corners covers nothing.
    store(lists.two.end, all(0u));
    store(lists.four.end, all(0u));
    Fragments fragments;
    cover<2>(lists.two, vertices, fragments);
    cover<4>(lists.four, vertices, fragments);
    store(fragments.end, all(0u));
    shade(fragments, meshlet, vertices, *bin.pixels);
    store(lists.large.end, all(0u));
    draw_middle(lists.large, meshlet, bin, vertices);
}

void draw_triangle(const ScreenTriangle& triangle, const KernelBin& bin) {
    ScreenVertex corners[3] = {triangle.corner[0], triangle.corner[1], triangle.corner[2]};
    for (ScreenVertex& corner : corners) {
        corner.x -= kOnePixel * bin.x;
        corner.y -= kOnePixel * bin.y;
    }
    draw_large(corners[0], corners[1], corners[2], triangle.number, bin);
}

void clear(BinPixels& pixels) {
    const Floats far = all(1.0f);
    const Words none = all(0u);
    for (int i = 0; i < kBinStride * kBinRows; i += 16) {
        store(pixels.depth + i, far);
        store(pixels.number + i, none);
    }
}

bool hides(const BinPixels& pixels, int x0, int y0, int x1, int y1, float nearest) {
    const Floats limit = all(nearest);
    for (int y = y0; y < y1; ++y) {
        const float* const row = pixels.depth + (y + kBinMargin) * kBinStride + kBinMargin;
        for (int x = x0; x < x1; x += 16) {
            const std::uint32_t wanted = x1 - x < 16 ? (1u << (x1 - x)) - 1 : 0xffff;
            if ((~less(load(row + x), limit) & wanted) != 0) return false;
        }
    }
    return true;
}

void read(const BinPixels& pixels, int x, int y, int n, const std::uint32_t* objects, std::uint32_t* colour,
          float* depth, std::uint32_t* id) {
    const int from = (y + kBinMargin) * kBinStride + x + kBinMargin;
    const std::uint32_t* const numbers = pixels.number + from;
    __builtin_memcpy(colour, pixels.colour + from, static_cast<std::size_t>(n) * sizeof *colour);
    __builtin_memcpy(depth, pixels.depth + from, static_cast<std::size_t>(n) * sizeof *depth);
    int i = 0;
    for (; i + 16 <= n; i += 16)
        store(id + i, look_up(objects, shift_right<kMeshletBits>(load(numbers + i))));
    for (; i < n; ++i) id[i] = objects[numbers[i] >> kMeshletBits];
}

void project(const KernelView& view, const BoxBlock& boxes, BoundsBlock& bounds) {
    // Every coordinate of a vertex in clip space is off by a few roundings of the largest of its terms.
    constexpr float kOff = 0x1p-21f;
    Floats at[4][8];
    Floats off[4];
    Floats farthest[3];
    for (int axis = 0; axis < 3; ++axis)
        farthest[axis] = higher_of(absolute(load(boxes.low[axis])), absolute(load(boxes.high[axis])));
    for (int i = 0; i < 4; ++i) {
        const float* const m = view.clip_from_model + i;
        Floats term[3][2];
        Floats size = absolute(all(m[12]));
        for (int axis = 0; axis < 3; ++axis) {
            const Floats factor = all(m[4 * axis]);
            term[axis][0] = multiply(factor, load(boxes.low[axis]));
            term[axis][1] = multiply(factor, load(boxes.high[axis]));
            size = add(size, multiply(absolute(factor), farthest[axis]));
        }
        off[i] = multiply(size, all(kOff));
        for (int k = 0; k < 8; ++k)
            at[i][k] = add(add(add(term[0][k & 1], term[1][k >> 1 & 1]), term[2][k >> 2]), all(m[12]));
    }
    const Floats zero = all(0.0f);
    const auto largest = [&](auto of) {
        Floats most = of(0);
        for (int k = 1; k < 8; ++k) most = higher_of(most, of(k));
        return most;
    };
    const auto smallest = [&](auto of) {
        Floats least = of(0);
        for (int k = 1; k < 8; ++k) least = lower_of(least, of(k));
        return least;
    };
    // Boxes outside of one of five planes of the frustum.
    std::uint32_t out = 0;
    for (int i = 0; i < 3; ++i) {
        const Floats slack = add(off[i], off[3]);
        out |= below_zero(add(largest([&](int k) { return add(at[3][k], at[i][k]); }), slack));
        if (i < 2)
            out |= below_zero(add(largest([&](int k) { return subtract(at[3][k], at[i][k]); }), slack));
    }
    const Floats least_w = subtract(smallest([&](int k) { return at[3][k]; }), off[3]);
    const Floats most_w = largest([&](int k) { return at[3][k]; });
    const Floats before =
        subtract(subtract(smallest([&](int k) { return add(at[3][k], at[2][k]); }), off[2]), off[3]);
    std::uint32_t good =
        less(all(2 * kLeastW), least_w) & less(most_w, all(0.5f * kMostW)) & less(zero, before);

    Floats inverse[8];
    for (int k = 0; k < 8; ++k) inverse[k] = divide(all(1.0f), at[3][k]);
    const Floats most_inverse = divide(all(1.0f), where(good, least_w, all(1.0f)));
    // Bounds a coordinate divided by w, with what a vertex's may be off.
    Floats low[3];
    Floats high[3];
    for (int i = 0; i < 3; ++i) {
        const auto divided = [&](int k) { return multiply(at[i][k], inverse[k]); };
        low[i] = smallest(divided);
        high[i] = largest(divided);
        const Floats most = higher_of(absolute(low[i]), absolute(high[i]));
        const Floats error = add(multiply(add(off[i], multiply(most, off[3])), most_inverse),
                                 multiply(add(most, all(1.0f)), all(0x1p-21f)));
        low[i] = subtract(low[i], error);
        high[i] = add(high[i], error);
    }
    const float half[2] = {view.half_width, view.half_height};
    std::int32_t* const from[2] = {bounds.x0, bounds.y0};
    std::int32_t* const to[2] = {bounds.x1, bounds.y1};
    for (int i = 0; i < 2; ++i) {
        const Floats scale = all(half[i]);
        const Floats guard = all(view.guard - 1.0f);
        good &=
            less(absolute(multiply(low[i], scale)), guard) & less(absolute(multiply(high[i], scale)), guard);
    }
    // A sample is half a pixel inside of its pixel; snapping moves a vertex by 1/512.
    constexpr float kSlack = 0.5f + 0.01f;
    for (int i = 0; i < 2; ++i) {
        const Floats scale = all(half[i]);
        const Words first = rounded(where(good, add(multiply(low[i], scale), all(half[i] - kSlack)), zero));
        const Words last = rounded(
            where(good, add(multiply(high[i], scale), all(half[i] + kSlack)), all(2 * half[i] + 1.0f)));
        store(reinterpret_cast<std::uint32_t*>(from[i]), where(out, all(0u), first));
        store(reinterpret_cast<std::uint32_t*>(to[i]), where(out, all(0u), last));
    }
    const Floats nearest = add(multiply(low[2], all(0.5f)), all(0.5f - 0x1p-20f));
    store(bounds.nearest, where(good, higher_of(nearest, zero), zero));
    bounds.clipped = ~good & ~out & 0xffff;
}

}  // namespace

extern const RasterKernels kRasterKernels;
const RasterKernels kRasterKernels = {project, clear, hides, draw, draw_triangle, read};

}  // namespace swath::SWATH_KERNEL
