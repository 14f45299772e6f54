#include "common/raster/clip.h"

#include <cmath>
#include <cstddef>

namespace swath {
namespace {

constexpr float kAmbient = 0.2f;

// A triangle and six planes: each adds a vertex at most.
struct Polygon {
    std::array<ClipVertex, 9> vertices;
    std::size_t size = 0;
};

// Keeps the part where `distance` is not negative. The new vertices on an edge are computed from its inner end to
// its outer one, whichever triangle it belongs to.
template <class Distance>
void cut(Polygon& polygon, Distance distance) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const ClipVertex& from = polygon.vertices[i];
        const ClipVertex& to = polygon.vertices[(i + 1) % polygon.size];
        const double at_from = distance(from);
        const double at_to = distance(to);
        const bool from_inside = at_from >= 0;
        const bool to_inside = at_to >= 0;
        if (from_inside) kept.vertices[kept.size++] = from;
        if (from_inside == to_inside) continue;
        const ClipVertex& inner = from_inside ? from : to;
        const ClipVertex& outer = from_inside ? to : from;
        const double at_inner = from_inside ? at_from : at_to;
        const double at_outer = from_inside ? at_to : at_from;
        const double part = at_inner / (at_inner - at_outer);
        const auto between = [&](float a, float b) {
            return static_cast<float>(double{a} + part * (double{b} - double{a}));
        };
        ClipVertex& made = kept.vertices[kept.size++];
        for (std::size_t k = 0; k < 4; ++k) made.position[k] = between(inner.position[k], outer.position[k]);
        for (std::size_t k = 0; k < 3; ++k) made.colour[k] = between(inner.colour[k], outer.colour[k]);
    }
    polygon = kept;
}

struct Projected {
    float x;  // pixels from the screen's centre
    float y;
    float z;  // -1 to 1
    float inverse_w;
};
Projected project(const KernelView& view, const ClipVertex& vertex) {
    const float inverse = 1.0f / vertex.position[3];
    return {vertex.position[0] * inverse * view.half_width, vertex.position[1] * inverse * view.half_height,
            vertex.position[2] * inverse, inverse};
}

}  // namespace

ClipVertex clip_vertex(const KernelView& view, const KernelMeshlet& meshlet, std::uint32_t i) {
    const VertexBlock& block = meshlet.vertices[i / 16];
    std::array<float, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        at[axis] = block.position[axis][i % 16];
        if (meshlet.motion != nullptr) at[axis] += view.pose * meshlet.motion[i / 16].motion[axis][i % 16];
    }
    ClipVertex vertex;
    for (std::size_t k = 0; k < 4; ++k) {
        const float* const m = view.clip_from_model + k;
        vertex.position[k] = m[0] * at[0] + m[4] * at[1] + m[8] * at[2] + m[12];
    }
    constexpr float kPerUnit = 1.0f / 32767.0f;
    float cosine = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float part = static_cast<float>(block.normal[axis][i % 16]) * (view.to_light[axis] * kPerUnit);
        cosine = axis == 0 ? part : cosine + part;
    }
    const float light = kAmbient + (1.0f - kAmbient) * std::fabs(cosine);
    for (std::size_t k = 0; k < 3; ++k) {
        const float lit = static_cast<float>(block.colour[i % 16] >> 8 * k & 0xff) * light;
        vertex.colour[k] = lit < 255.0f ? lit : 255.0f;
    }
    return vertex;
}

bool needs_clipping(const KernelView& view, const ClipVertex& vertex) {
    const Projected at = project(view, vertex);
    const float w = vertex.position[3];
    return !(kLeastW < w && w < kMostW && 0.0f < vertex.position[2] + w && std::fabs(at.x) < view.guard &&
             std::fabs(at.y) < view.guard);
}

void clip(const KernelView& view, const std::array<ClipVertex, 3>& triangle, std::uint32_t number,
          std::vector<ScreenTriangle>& out) {
    Polygon polygon;
    for (const ClipVertex& vertex : triangle) polygon.vertices[polygon.size++] = vertex;
    cut(polygon, [](const ClipVertex& v) { return double{v.position[2]} + double{v.position[3]}; });
    const double guard = double{view.guard} - 1;
    for (const double sign : {1.0, -1.0}) {
        cut(polygon, [&](const ClipVertex& v) {
            return guard * v.position[3] - sign * view.half_width * v.position[0];
        });
        cut(polygon, [&](const ClipVertex& v) {
            return guard * v.position[3] - sign * view.half_height * v.position[1];
        });
    }
    if (polygon.size < 3) return;
    std::array<ScreenVertex, 9> corners;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const ClipVertex& vertex = polygon.vertices[i];
        const Projected at = project(view, vertex);
        // Only a matrix that is no projection, or coordinates near the largest float, come to this.
        if (!(kLeastW < vertex.position[3] && vertex.position[3] < kMostW && std::fabs(at.x) <= view.guard &&
              std::fabs(at.y) <= view.guard))
            return;
        const float depth = at.z * 0.5f + 0.5f;
        corners[i] = {static_cast<std::int32_t>(std::lrintf((at.x + view.half_width) * 256.0f)),
                      static_cast<std::int32_t>(std::lrintf((at.y + view.half_height) * 256.0f)),
                      depth > 0.0f ? depth : 0.0f,
                      at.inverse_w,
                      {vertex.colour[0], vertex.colour[1], vertex.colour[2]}};
    }
    for (std::size_t i = 1; i + 1 < polygon.size; ++i)
        out.push_back({{corners[0], corners[i], corners[i + 1]}, number});
}

}  // namespace swath
