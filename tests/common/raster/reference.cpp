#include "tests/common/raster/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace swath::test {
namespace {

using Wide = std::int64_t;

struct Point {
    glm::vec4 clip;
    glm::vec3 colour;
};

struct Corner {
    Wide x;
    Wide y;
    float z;
    float q;  // 1 / w
    glm::vec3 colour;
};

struct Picture {
    PixelFrame frame;
    std::vector<std::uint32_t> triangle;
    const View& view;
    int width() const { return view.width; }
};

Point point_of(const ObjectSet& scene, std::uint32_t i, const View& view) {
    const Vertex& vertex = scene.mesh.vertices[i];
    const glm::vec3 p = posed(scene.mesh, i, view.pose);
    Point result;
    for (int k = 0; k < 4; ++k) {
        const auto& m = view.clip_from_model;
        result.clip[k] = ((m[0][k] * p.x + m[1][k] * p.y) + m[2][k] * p.z) + m[3][k];
    }
    float cosine = 0;
    for (int k = 0; k < 3; ++k) {
        const float part = float(vertex.normal[std::size_t(k)]) * (view.to_light[k] * (1.0f / 32767.0f));
        cosine = k == 0 ? part : cosine + part;
    }
    const float light = 0.2f + 0.8f * std::abs(cosine);
    for (int k = 0; k < 3; ++k)
        result.colour[k] = std::min(float(vertex.colour[std::size_t(k)]) * light, 255.0f);
    return result;
}

float screen_x(const Point& p, const View& view) {
    return p.clip.x * (1.0f / p.clip.w) * (0.5f * float(view.width));
}
float screen_y(const Point& p, const View& view) {
    return p.clip.y * (1.0f / p.clip.w) * (0.5f * float(view.height));
}

constexpr float kGuard = 16383.0f;

bool whole(const Point& p, const View& view) {
    return p.clip.w > 0x1p-60f && p.clip.w < 0x1p100f && p.clip.z + p.clip.w > 0 &&
           std::abs(screen_x(p, view)) < kGuard && std::abs(screen_y(p, view)) < kGuard;
}

Corner corner_of(const Point& p, const View& view) {
    const float q = 1.0f / p.clip.w;
    const float z = p.clip.z * q * 0.5f + 0.5f;
    return {std::lrint((screen_x(p, view) + 0.5f * float(view.width)) * 256.0f),
            std::lrint((screen_y(p, view) + 0.5f * float(view.height)) * 256.0f), std::max(z, 0.0f), q,
            p.colour};
}

Wide cross(Wide ax, Wide ay, Wide bx, Wide by) { return ax * by - ay * bx; }

void put(Picture& picture, int x, int y, float z, const glm::vec3& colour, std::uint32_t triangle,
         ObjectId object) {
    auto& old = picture.triangle[std::size_t(y) * std::size_t(picture.width()) + std::size_t(x)];
    float& depth = *picture.frame.depth(x, y);
    if (!(z < depth || (z == depth && triangle < old))) return;
    depth = z;
    old = triangle;
    *picture.frame.id(x, y) = object;
    std::uint32_t word = 0xff000000;
    for (int k = 0; k < 3; ++k) word |= std::uint32_t(std::lrint(colour[k])) << (8 * k);
    *picture.frame.colour(x, y) = word;
}

void draw(Picture& picture, const std::array<Corner, 3>& v, bool clipped, std::uint32_t triangle,
          ObjectId object) {
    const Wide area = cross(v[1].x - v[0].x, v[1].y - v[0].y, v[2].x - v[0].x, v[2].y - v[0].y);
    if (area == 0) return;
    const Wide sign = area < 0 ? -1 : 1;
    const auto [x_low, x_high] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [y_low, y_high] = std::minmax({v[0].y, v[1].y, v[2].y});
    const Wide x0 = (x_low + 127) >> 8;
    const Wide x1 = (x_high - 128) >> 8;
    const Wide y0 = (y_low + 127) >> 8;
    const Wide y1 = (y_high - 128) >> 8;
    const bool small = !clipped && x1 - x0 < 4 && y1 - y0 < 4;
    const auto plane_at = [&](float a, float b, float c, float x, float y) {
        const float scale = 1.0f / float(area);
        const float along_x = ((b - a) * float(v[2].y - v[0].y) - (c - a) * float(v[1].y - v[0].y)) * scale;
        const float along_y = ((c - a) * float(v[1].x - v[0].x) - (b - a) * float(v[2].x - v[0].x)) * scale;
        return (a + y * along_y) + x * along_x;
    };
    const float z_low = std::min({v[0].z, v[1].z, v[2].z});
    const float z_high = std::max({v[0].z, v[1].z, v[2].z});
    for (Wide y = std::max<Wide>(y0, 0); y <= std::min<Wide>(y1, picture.view.height - 1); ++y)
        for (Wide x = std::max<Wide>(x0, 0); x <= std::min<Wide>(x1, picture.view.width - 1); ++x) {
            const Wide px = 256 * x + 128;
            const Wide py = 256 * y + 128;
            std::array<Wide, 3> inside;
            bool covered = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const Corner& from = v[(k + 1) % 3];
                const Corner& to = v[(k + 2) % 3];
                inside[k] = sign * cross(from.x - px, from.y - py, to.x - px, to.y - py);
                const Wide dx = sign * (to.x - from.x);
                const Wide dy = sign * (to.y - from.y);
                covered &= inside[k] > 0 || (inside[k] == 0 && (dy < 0 || (dy == 0 && dx > 0)));
            }
            if (!covered) continue;
            float z;
            glm::vec3 colour;
            if (small) {
                const float a = float(inside[0]);
                const float b = float(inside[1]);
                const float c = float(inside[2]);
                z = v[0].z + (b * (v[1].z - v[0].z) + c * (v[2].z - v[0].z)) / ((a + b) + c);
                const float wa = a * v[0].q;
                const float wb = b * v[1].q;
                const float wc = c * v[2].q;
                const float scale = 1.0f / ((wa + wb) + wc);
                for (int k = 0; k < 3; ++k)
                    colour[k] = ((wa * v[0].colour[k] + wb * v[1].colour[k]) + wc * v[2].colour[k]) * scale;
            } else {
                const float fx = float(px - v[0].x);
                const float fy = float(py - v[0].y);
                z = plane_at(v[0].z, v[1].z, v[2].z, fx, fy);
                const float w = 1.0f / plane_at(v[0].q, v[1].q, v[2].q, fx, fy);
                for (int k = 0; k < 3; ++k) {
                    const float value = plane_at(v[0].colour[k] * v[0].q, v[1].colour[k] * v[1].q,
                                                 v[2].colour[k] * v[2].q, fx, fy) *
                                        w;
                    const float low = std::min({v[0].colour[k], v[1].colour[k], v[2].colour[k]});
                    const float high = std::max({v[0].colour[k], v[1].colour[k], v[2].colour[k]});
                    // No number becomes the lower bound.
                    colour[k] = value > low ? std::min(value, high) : low;
                }
            }
            put(picture, int(x), int(y), std::min(std::max(z, z_low), z_high), colour, triangle, object);
        }
}

void draw_clipped(Picture& picture, const std::array<Point, 3>& points, std::uint32_t triangle,
                  ObjectId object) {
    std::vector<Point> polygon(points.begin(), points.end());
    const View& view = picture.view;
    const double guard = double(kGuard) - 1;
    for (int plane = 0; plane < 5; ++plane) {
        const auto distance = [&](const Point& p) {
            const double sign = plane < 3 ? 1 : -1;
            if (plane == 0) return double(p.clip.z) + double(p.clip.w);
            return plane % 2 == 1 ? guard * p.clip.w - sign * (0.5f * float(view.width)) * p.clip.x
                                  : guard * p.clip.w - sign * (0.5f * float(view.height)) * p.clip.y;
        };
        std::vector<Point> kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point& a = polygon[i];
            const Point& b = polygon[(i + 1) % polygon.size()];
            const double da = distance(a);
            const double db = distance(b);
            if (da >= 0) kept.push_back(a);
            if ((da >= 0) == (db >= 0)) continue;
            const Point& in = da >= 0 ? a : b;
            const Point& out = da >= 0 ? b : a;
            const double part = da >= 0 ? da / (da - db) : db / (db - da);
            Point made;
            for (int k = 0; k < 4; ++k)
                made.clip[k] = float(double(in.clip[k]) + part * (double(out.clip[k]) - double(in.clip[k])));
            for (int k = 0; k < 3; ++k)
                made.colour[k] =
                    float(double(in.colour[k]) + part * (double(out.colour[k]) - double(in.colour[k])));
            kept.push_back(made);
        }
        polygon = std::move(kept);
    }
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        draw(picture,
             {corner_of(polygon[0], view), corner_of(polygon[i], view), corner_of(polygon[i + 1], view)},
             true, triangle, object);
}

}  // namespace

PixelFrame reference_picture(const ObjectSet& scene, const View& view) {
    Picture picture{{}, {}, view};
    picture.frame.reshape(view.viewport());
    picture.frame.clear(view.viewport());
    picture.triangle.assign(std::size_t(view.width) * std::size_t(view.height), 0);
    for (ObjectId id = 0; id < scene.objects.size(); ++id) {
        const Object& object = scene.objects[id];
        for (std::uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count;
             ++t) {
            std::array<Point, 3> points;
            for (std::size_t k = 0; k < 3; ++k)
                points[k] = point_of(scene, scene.mesh.indices[3 * std::size_t{t} + k], view);
            if (whole(points[0], view) && whole(points[1], view) && whole(points[2], view))
                draw(picture,
                     {corner_of(points[0], view), corner_of(points[1], view), corner_of(points[2], view)},
                     false, t, id);
            else
                draw_clipped(picture, points, t, id);
        }
    }
    return std::move(picture.frame);
}

}  // namespace swath::test
