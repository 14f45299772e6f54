#include "common/raycast/raycast_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "common/base/check.h"

namespace swath {
namespace {

// For the time being by brute force: every triangle against every pixel of its box on the screen.

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;
};

struct Hit {
    double t = 0;
    double u = 0;  // weights of the second and third corner
    double v = 0;
};

std::optional<Hit> intersect(const Ray& ray, const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 side = corners[1] - corners[0];
    const glm::dvec3 other = corners[2] - corners[0];
    const glm::dvec3 p = glm::cross(ray.direction, other);
    const double determinant = glm::dot(side, p);
    if (determinant == 0) return std::nullopt;
    const glm::dvec3 from = ray.origin - corners[0];
    const glm::dvec3 q = glm::cross(from, side);
    const Hit hit{glm::dot(other, q) / determinant, glm::dot(from, p) / determinant,
                  glm::dot(ray.direction, q) / determinant};
    // Written so that no NaN passes.
    if (!(hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1 && hit.t >= 0)) return std::nullopt;
    return hit;
}

// The rays of a view.
class Rays {
  public:
    static Result<Rays> of(const View& view) {
        Rays rays;
        rays.clip_from_model_ = glm::dmat4(view.clip_from_model);
        rays.model_from_clip_ = glm::inverse(rays.clip_from_model_);
        rays.width_ = view.width;
        rays.height_ = view.height;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                if (!std::isfinite(rays.model_from_clip_[column][row]))
                    return fail("ray caster: the view's matrix has no inverse");
        // What a perspective projects to the direction of its axis is the eye.
        if (rays.model_from_clip_[2][3] == 0) return fail("ray caster: the view is no perspective");
        return rays;
    }

    // From the near plane (t = 0) to the far one (t = 1).
    Ray at(int x, int y) const {
        const double u = 2 * (x + 0.5) / width_ - 1;
        const double v = 2 * (y + 0.5) / height_ - 1;
        const auto point = [&](double depth) {
            const glm::dvec4 p = model_from_clip_ * glm::dvec4(u, v, depth, 1);
            return glm::dvec3(p) / p.w;
        };
        const glm::dvec3 near = point(-1);
        return {near, point(1) - near};
    }
    float depth(const glm::dvec3& point) const {
        const glm::dvec4 clip = clip_from_model_ * glm::dvec4(point, 1);
        return static_cast<float>(0.5 * clip.z / clip.w + 0.5);
    }
    // Of `rect`, where the triangle may be seen.
    Rect place(const std::array<glm::dvec3, 3>& corners, const Rect& rect) const {
        glm::dvec2 low(std::numeric_limits<double>::infinity());
        glm::dvec2 high(-low);
        for (const glm::dvec3& corner : corners) {
            const glm::dvec4 clip = clip_from_model_ * glm::dvec4(corner, 1);
            if (!(clip.w > 0)) return rect;  // behind the eye
            const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        const auto within = [](double at, int least, int most) {
            return static_cast<int>(std::clamp(at, static_cast<double>(least), static_cast<double>(most)));
        };
        return {within(low.x - 1, rect.x0, rect.x1), within(low.y - 1, rect.y0, rect.y1),
                within(high.x + 2, rect.x0, rect.x1), within(high.y + 2, rect.y0, rect.y1)};
    }

  private:
    glm::dmat4 clip_from_model_;
    glm::dmat4 model_from_clip_;
    int width_ = 1;
    int height_ = 1;
};

class RaycastRenderer final : public Renderer {
  public:
    RaycastRenderer(const RendererSetup& setup, const ObjectSet& scene) : setup_(setup), scene_(scene) {}

    Status draw(std::span<const DrawRun> runs, const View& view, const Rect& rect) override {
        const auto rays = Rays::of(view);
        if (!rays) return tl::unexpected(rays.error());
        CHECK(view.viewport().contains(rect) == true);
        pixels_.reshape(rect);
        pixels_.clear(rect);
        for (const DrawRun& run : runs) {
            CHECK(run.object < scene_.objects.size());
            for (std::uint32_t t = 0; t < run.triangle_count; ++t)
                draw_triangle(run.first_triangle + t, run.object, *rays, view);
        }
        return {};
    }

    Status read(const Rect& rect, PixelFrame& frame) override {
        if (rect.empty()) return {};
        CHECK(frame.rect().contains(rect) == true);
        CHECK(pixels_.rect().contains(rect) == true);
        const std::size_t bytes = 4 * static_cast<std::size_t>(rect.width());
        for (int y = rect.y0; y < rect.y1; ++y) {
            std::memcpy(frame.colour(rect.x0, y), pixels_.colour(rect.x0, y), bytes);
            std::memcpy(frame.depth(rect.x0, y), pixels_.depth(rect.x0, y), bytes);
            std::memcpy(frame.id(rect.x0, y), pixels_.id(rect.x0, y), bytes);
        }
        return {};
    }

    std::string description() const override {
        return fmt::format("ray caster (brute force){}{}", setup_.shadows ? ", shadows" : "",
                           setup_.dynamic ? ", dynamic" : "");
    }

  private:
    std::array<glm::dvec3, 3> corners(std::size_t triangle) const {
        std::array<glm::dvec3, 3> points;
        for (std::size_t k = 0; k < 3; ++k) points[k] = vertex(triangle, k).position;
        return points;
    }
    const Vertex& vertex(std::size_t triangle, std::size_t corner) const {
        return scene_.mesh.vertices[scene_.mesh.indices[3 * triangle + corner]];
    }

    // Runs come in ascending order, so of equal depths the first one stays.
    void draw_triangle(std::size_t triangle, ObjectId object, const Rays& rays, const View& view) {
        const auto points = corners(triangle);
        const Rect place = rays.place(points, pixels_.rect());
        for (int y = place.y0; y < place.y1; ++y)
            for (int x = place.x0; x < place.x1; ++x) {
                const Ray ray = rays.at(x, y);
                const auto hit = intersect(ray, points);
                if (!hit) continue;
                const glm::dvec3 point = ray.origin + hit->t * ray.direction;
                const float depth = rays.depth(point);
                if (!(depth >= 0 && depth < *pixels_.depth(x, y))) continue;
                *pixels_.depth(x, y) = depth;
                *pixels_.id(x, y) = object;
                *pixels_.colour(x, y) =
                    shade(triangle, *hit, view, setup_.shadows && in_shadow(triangle, point, view));
            }
    }

    // The rasteriser's shading: Lambert at the vertices, of both sides, and colours in between.
    std::uint32_t shade(std::size_t triangle, const Hit& hit, const View& view, bool shadowed) const {
        const std::array<double, 3> weights{1 - hit.u - hit.v, hit.u, hit.v};
        glm::dvec3 sum(0);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vertex& at = vertex(triangle, k);
            const glm::dvec3 normal = glm::dvec3(at.normal[0], at.normal[1], at.normal[2]) / 32767.0;
            const double light =
                0.2 + (shadowed ? 0 : 0.8) * std::abs(glm::dot(normal, glm::dvec3(view.to_light)));
            sum += weights[k] * light * glm::dvec3(at.colour[0], at.colour[1], at.colour[2]);
        }
        std::uint32_t colour = 0xff000000;
        for (int channel = 0; channel < 3; ++channel)
            colour |= static_cast<std::uint32_t>(std::clamp(std::round(sum[channel]), 0.0, 255.0))
                      << (8 * channel);
        return colour;
    }

    bool in_shadow(std::size_t triangle, const glm::dvec3& point, const View& view) const {
        const Ray ray{point, glm::dvec3(view.to_light)};
        const double near = 1e-4 * glm::length(glm::dvec3(scene_.bounds.size()));
        for (std::size_t t = 0; t < scene_.mesh.triangle_count(); ++t) {
            if (t == triangle) continue;
            const auto hit = intersect(ray, corners(t));
            if (hit && hit->t > near) return true;
        }
        return false;
    }

    RendererSetup setup_;
    const ObjectSet& scene_;
    PixelFrame pixels_;  // of the last draw
};

}  // namespace

Result<std::unique_ptr<Renderer>> make_raycast_renderer(const RendererSetup& setup, const ObjectSet& scene) {
    return std::make_unique<RaycastRenderer>(setup, scene);
}

}  // namespace swath
