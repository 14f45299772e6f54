#include "common/raycast/raycast_renderer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "common/base/check.h"
#include "common/raycast/cast_scene.h"
#include "common/raycast/packets.h"
#include "common/raycast/pinhole.h"

namespace swath {
namespace {

// A thread takes squares of so many pixels a side, a multiple of a packet's side.
constexpr int kBlock = 32;
constexpr int kSide = 4;
static_assert(kSide * kSide == kPacketRays);

constexpr float kAmbient = 0.2f;

class RaycastRenderer final : public Renderer {
  public:
    RaycastRenderer(const RendererSetup& setup, const ObjectSet& scene)
        : setup_(setup),
          scene_(scene),
          kernels_(packet_kernels(best_instruction_set())),
          team_(setup.threads, clock_),
          cast_(scene, team_, setup.cuda ? SahDevice::kCuda : SahDevice::kThreads),
          objects_(scene.mesh.triangle_count()) {
        for (ObjectId id = 0; id < scene.objects.size(); ++id) {
            const Object& object = scene.objects[id];
            std::fill_n(objects_.begin() + object.first_triangle, object.triangle_count, id);
        }
    }

    Status build() { return setup_.flags.dynamic ? Status{} : cast_.build_all(kDefaultSah); }

    Status draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) override {
        CHECK(view.viewport().contains(rect) == true);
        SWATH_TRY(const auto rays, Pinhole::of(view, cast_.scale()));
        pixels_.reshape(rect);
        if (ranges.empty()) {
            pixels_.clear(rect);
            return {};
        }
        SWATH_TRY_VOID(prepare(ranges, view.pose));
        const int columns = (rect.width() + kBlock - 1) / kBlock;
        const int blocks = columns * ((rect.height() + kBlock - 1) / kBlock);
        std::atomic<int> next{0};
        team_.run([&](std::size_t) {
            for (int block; (block = next.fetch_add(1, std::memory_order_relaxed)) < blocks;) {
                const int x = rect.x0 + kBlock * (block % columns);
                const int y = rect.y0 + kBlock * (block / columns);
                cast_block({x, y, std::min(x + kBlock, rect.x1), std::min(y + kBlock, rect.y1)}, rays, view);
            }
        });
        return {};
    }

    Status read(const Rect& rect, PixelFrame& frame) override {
        frame.copy(pixels_, rect);
        return {};
    }

    std::string description() const override {
        return fmt::format("ray caster, {}, {} threads{}{}{}", name(best_instruction_set()), setup_.threads,
                           cast_.builder().device() == SahDevice::kCuda ? ", trees by CUDA" : "",
                           setup_.flags.shadows ? ", shadows" : "",
                           setup_.flags.dynamic ? ", a tree for each frame" : "");
    }

  private:
    Status prepare(std::span<const TriangleRange> ranges, float pose) {
        for (const TriangleRange& range : ranges) {
            CHECK(range.object < scene_.objects.size());
            const Object& object = scene_.objects[range.object];
            CHECK(range.first_triangle >= object.first_triangle);
            CHECK(range.first_triangle + range.triangle_count <=
                  object.first_triangle + object.triangle_count);
        }
        cast_.pose(pose);
        if (setup_.flags.dynamic && !setup_.flags.shadows) return cast_.build(ranges, kFastSah);
        // Triangles that are not drawn cast shadows, too, so the tree is over all.
        if (setup_.flags.dynamic || tree_pose_ != pose) {
            tree_pose_.reset();
            if (const auto status = cast_.build_all(setup_.flags.dynamic ? kFastSah : kDefaultSah); !status)
                return status;
            tree_pose_ = pose;
        }
        cast_.want(ranges);
        return {};
    }

    void cast_block(const Rect& block, const Pinhole& rays, const View& view) {
        const KernelTree tree = cast_.wanted();
        const KernelTree casters = cast_.all();
        for (int y = block.y0; y < block.y1; y += kSide)
            for (int x = block.x0; x < block.x1; x += kSide) {
                const RayPacket packet = rays.packet(x, y);
                PacketHits hits;
                kernels_.nearest_by_depth(tree, packet, hits);
                const std::uint32_t shadowed =
                    setup_.flags.shadows ? in_shadow(casters, packet, hits, view) : 0;
                for (int lane = 0; lane < kPacketRays; ++lane) {
                    const int px = x + lane % kSide;
                    const int py = y + lane / kSide;
                    if (px >= block.x1 || py >= block.y1) continue;
                    const std::uint32_t triangle = hits.triangle[lane];
                    if (triangle == kNoTriangle) {
                        *pixels_.depth(px, py) = kFarDepth;
                        continue;
                    }
                    *pixels_.depth(px, py) = hits.nearness[lane];
                    *pixels_.id(px, py) = objects_[triangle];
                    *pixels_.colour(px, py) =
                        shade(triangle, weights(hits, lane), view, (shadowed >> lane & 1) != 0);
                }
            }
    }

    static glm::vec3 weights(const PacketHits& hits, int lane) {
        const glm::vec3 parts(hits.weight[0][lane], hits.weight[1][lane], hits.weight[2][lane]);
        return parts / (parts.x + parts.y + parts.z);
    }

    // Shades as the rasteriser does: Lambert of both sides at the vertices, and colours in between.
    std::uint32_t shade(std::uint32_t triangle, const glm::vec3& weights, const View& view,
                        bool shadowed) const {
        glm::vec3 sum(0);
        for (int k = 0; k < 3; ++k) {
            const Vertex& at =
                scene_.mesh
                    .vertices[scene_.mesh.indices[3 * std::size_t{triangle} + static_cast<std::size_t>(k)]];
            const glm::vec3 normal = glm::vec3(at.normal[0], at.normal[1], at.normal[2]) * (1.0f / 32767.0f);
            const float diffuse =
                shadowed ? 0.0f : (1.0f - kAmbient) * std::abs(glm::dot(normal, view.to_light));
            sum += weights[k] * (kAmbient + diffuse) * glm::vec3(at.colour[0], at.colour[1], at.colour[2]);
        }
        std::uint32_t colour = 0xff000000;
        for (int channel = 0; channel < 3; ++channel)
            colour |= static_cast<std::uint32_t>(std::clamp(sum[channel], 0.0f, 255.0f) + 0.5f)
                      << (8 * channel);
        return colour;
    }

    // A bit for each hit that does not see the light. Rays start a little off the surface, on the light's
    // side, and a triangle casts no shadow on itself.
    std::uint32_t in_shadow(const KernelTree& casters, const RayPacket& packet, const PacketHits& hits,
                            const View& view) const {
        RayPacket shadow{};
        for (int lane = 0; lane < kPacketRays; ++lane) {
            for (int axis = 0; axis < 3; ++axis) shadow.direction[axis][lane] = view.to_light[axis];
            const std::uint32_t triangle = hits.triangle[lane];
            if (triangle == kNoTriangle) continue;
            const std::array<glm::vec3, 3> corners{cast_.corner(triangle, 0), cast_.corner(triangle, 1),
                                                   cast_.corner(triangle, 2)};
            const glm::vec3 w = weights(hits, lane);
            const glm::vec3 point = w.x * corners[0] + w.y * corners[1] + w.z * corners[2];
            glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            const float length = glm::length(normal);
            normal = length > 0 ? normal / length : view.to_light;
            if (glm::dot(normal, view.to_light) < 0) normal = -normal;
            float away = 0;  // distance from the eye, which rounding is proportional to
            for (int axis = 0; axis < 3; ++axis)
                away = std::max(away, std::abs(point[axis] - packet.origin[axis][lane]));
            const glm::vec3 origin = point + normal * (0x1p-15f * away);
            for (int axis = 0; axis < 3; ++axis) shadow.origin[axis][lane] = origin[axis];
            shadow.active |= 1u << lane;
        }
        return shadow.active == 0 ? 0 : kernels_.any(casters, shadow, hits.triangle);
    }

    RendererSetup setup_;
    const ObjectSet& scene_;
    const PacketKernels& kernels_;
    SteadyClock clock_;  // the team needs one, though nobody asks for its times
    ThreadTeam team_;
    CastScene cast_;
    std::optional<float> tree_pose_ = 0.0f;  // of the tree over all; none if it could not be built
    std::vector<ObjectId> objects_;          // of each triangle
    PixelFrame pixels_;                      // of the last draw
};

}  // namespace

Result<std::unique_ptr<Renderer>> make_raycast_renderer(const RendererSetup& setup, const ObjectSet& scene) {
    CHECK(setup.threads > 0u);
    auto renderer = std::make_unique<RaycastRenderer>(setup, scene);
    SWATH_TRY_VOID(renderer->build());
    return renderer;
}

}  // namespace swath
