#include "tests/bench/octree_embree.h"

#if SWATH_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <limits>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "common/base/check.h"

namespace swath::bench {
namespace {

RTCBuildQuality quality_of(EmbreeQuality quality) {
    switch (quality) {
        case EmbreeQuality::kLow:
            return RTC_BUILD_QUALITY_LOW;
        case EmbreeQuality::kMedium:
            return RTC_BUILD_QUALITY_MEDIUM;
        case EmbreeQuality::kHigh:
            break;
    }
    return RTC_BUILD_QUALITY_HIGH;
}

// What packets of rays from one eye are cast with, whose names are others in each version.
#if SWATH_EMBREE == 3
struct Coherent : RTCIntersectContext {
    Coherent() {
        rtcInitIntersectContext(this);
        flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
    void intersect(const int* valid, RTCScene scene, RTCRayHit16& packet) {
        rtcIntersect16(valid, scene, this, &packet);
    }
};
#else
struct Coherent : RTCIntersectArguments {
    Coherent() {
        rtcInitIntersectArguments(this);
        flags = RTC_RAY_QUERY_FLAG_COHERENT;
    }
    void intersect(const int* valid, RTCScene scene, RTCRayHit16& packet) {
        rtcIntersect16(valid, scene, &packet, this);
    }
};
#endif

// Makes denormal numbers 0, as Embree's manual asks of threads that cast rays.
class NoDenormals {
  public:
    NoDenormals(const NoDenormals&) = delete;
    NoDenormals& operator=(const NoDenormals&) = delete;
#if defined(__SSE__)
    NoDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
    ~NoDenormals() { _mm_setcsr(before_); }

  private:
    unsigned before_;
#else
    NoDenormals() {}
#endif
};

}  // namespace

struct EmbreeDevice::Parts {
    RTCDevice device = nullptr;
    std::atomic<std::ptrdiff_t> bytes{0};
};

EmbreeDevice::EmbreeDevice(std::size_t threads, const std::string& isa) : parts_(std::make_unique<Parts>()) {
    const std::string config =
        fmt::format("threads={},set_affinity=0{}{}", threads, isa.empty() ? "" : ",isa=", isa);
    parts_->device = rtcNewDevice(config.c_str());
    CHECK((parts_->device != nullptr) == true);
    rtcSetDeviceMemoryMonitorFunction(
        parts_->device,
        [](void* bytes, ssize_t more, bool) {
            static_cast<std::atomic<std::ptrdiff_t>*>(bytes)->fetch_add(more, std::memory_order_relaxed);
            return true;
        },
        &parts_->bytes);
}

EmbreeDevice::~EmbreeDevice() { rtcReleaseDevice(parts_->device); }

struct EmbreeScene::Parts {
    EmbreeDevice::Parts& device;
    RTCScene scene;
    RTCGeometry geometry;
    std::ptrdiff_t bytes_before;
};

EmbreeScene::EmbreeScene(EmbreeDevice& device, const Mesh& mesh, EmbreeQuality quality, bool rebuilt) {
    EmbreeDevice::Parts& on = *device.parts_;
    const std::ptrdiff_t before = on.bytes;
    const RTCScene scene = rtcNewScene(on.device);
    const RTCGeometry geometry = rtcNewGeometry(on.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSceneBuildQuality(scene, quality_of(quality));
    rtcSetGeometryBuildQuality(geometry, quality_of(quality));
    if (rebuilt) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(),
                               offsetof(Vertex, position), sizeof(Vertex), mesh.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                               3 * sizeof(std::uint32_t), mesh.triangle_count());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    parts_ = std::make_unique<Parts>(Parts{on, scene, geometry, before});
    CHECK(rtcGetDeviceError(on.device) == RTC_ERROR_NONE);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseGeometry(parts_->geometry);
    rtcReleaseScene(parts_->scene);
}

void EmbreeScene::commit() {
    rtcCommitScene(parts_->scene);
    CHECK(rtcGetDeviceError(parts_->device.device) == RTC_ERROR_NONE);
}

void EmbreeScene::touch() {
    rtcUpdateGeometryBuffer(parts_->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(parts_->geometry);
}

std::size_t EmbreeScene::bytes() const {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, parts_->device.bytes - parts_->bytes_before));
}

std::uint64_t EmbreeScene::cast(const RayView& view, int first_row, int last_row, float* distances) const {
    const NoDenormals no_denormals;
    const TileRays rays(view);
    Coherent coherent;
    alignas(64) int valid[kPacketRays];
    alignas(64) RTCRayHit16 packet{};
    for (int lane = 0; lane < kPacketRays; ++lane) {
        valid[lane] = -1;
        packet.ray.org_x[lane] = view.eye.x;
        packet.ray.org_y[lane] = view.eye.y;
        packet.ray.org_z[lane] = view.eye.z;
        packet.ray.tnear[lane] = view.near;
        packet.ray.mask[lane] = 0xffff'ffff;
    }
    std::uint64_t hits = 0;
    for (int y = first_row; y < last_row; y += kTile)
        for (int x = 0; x < view.width; x += kTile) {
            rays.directions(x, y, packet.ray.dir_x, packet.ray.dir_y, packet.ray.dir_z);
            for (int lane = 0; lane < kPacketRays; ++lane) {
                packet.ray.tfar[lane] = view.far;
                packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            }
            coherent.intersect(valid, parts_->scene, packet);
            for (int lane = 0; lane < kPacketRays; ++lane)
                hits += packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
            if (distances == nullptr) continue;
            for (int lane = 0; lane < kPacketRays; ++lane)
                distances[(y + lane / kTile) * view.width + x + lane % kTile] =
                    packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID
                        ? packet.ray.tfar[lane]
                        : std::numeric_limits<float>::infinity();
        }
    return hits;
}

}  // namespace swath::bench
