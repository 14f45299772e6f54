#include "common/raycast/pinhole.h"

#include <algorithm>
#include <cmath>

namespace swath {

// Let M be the matrix's rows for x, y and w, and the direction M^-1 (u, v, 1). Then eye + t direction has
// clip coordinates w = t, x = t u and y = t v, and z / w = z . direction + (z . eye + z's constant) / t.
Result<Pinhole> Pinhole::of(const View& view, float scale) {
    const glm::dmat4 clip(view.clip_from_model);
    const auto row = [&](int r) { return glm::dvec3(clip[0][r], clip[1][r], clip[2][r]); };
    const glm::dmat3 inverse = glm::inverse(glm::transpose(glm::dmat3(row(0), row(1), row(3))));
    const glm::dvec3 eye = -(inverse * glm::dvec3(clip[3][0], clip[3][1], clip[3][3]));
    const double depth_scale = -0.5 * (glm::dot(row(2), eye) + clip[3][2]);
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(eye[i]) || !std::isfinite(glm::dot(inverse[i], inverse[i])))
            return fail("ray caster: the view's matrix has no inverse, or is no perspective");
    if (!(depth_scale > 0) || !std::isfinite(depth_scale))
        return fail("ray caster: the view is no perspective that looks ahead");

    // (u, v, 1) for the centre of pixel (x, y) is linear in x and y.
    const glm::dvec3 per_x = inverse[0] * (2.0 / view.width);
    const glm::dvec3 per_y = inverse[1] * (2.0 / view.height);
    const glm::dvec3 at_zero =
        inverse[0] * (1.0 / view.width - 1) + inverse[1] * (1.0 / view.height - 1) + inverse[2];
    const auto largest = [](const glm::dvec3& v) {
        return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    // A power of two, so that no digit changes.
    int exponent = 0;
    std::frexp(largest(inverse[2]), &exponent);
    const double unit = std::ldexp(1.0, -exponent);
    for (const double x : {0, view.width})
        for (const double y : {0, view.height}) {
            const double size = unit * largest(at_zero + x * per_x + y * per_y);
            if (!(size > 0x1p-20 && size < 0x1p20)) return fail("ray caster: the view is too wide");
        }

    Pinhole rays;
    rays.eye_ = glm::vec3(eye * static_cast<double>(scale));
    for (int axis = 0; axis < 3; ++axis)
        rays.direction_[axis] = {unit * at_zero[axis], unit * per_x[axis], unit * per_y[axis]};
    rays.depth_offset_ = {0.5 + 0.5 * glm::dot(row(2), at_zero), 0.5 * glm::dot(row(2), per_x),
                          0.5 * glm::dot(row(2), per_y)};
    rays.depth_scale_ = static_cast<float>(depth_scale * static_cast<double>(scale) / unit);
    if (!(rays.depth_scale_ > 1e-30f && rays.depth_scale_ < 1e30f))
        return fail("ray caster: the view's near plane is too near, or too far");
    return rays;
}

RayPacket Pinhole::packet(int x, int y) const {
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) {
        const int column = x + lane % 4;
        const int line = y + lane / 4;
        for (int axis = 0; axis < 3; ++axis) {
            packet.origin[axis][lane] = eye_[axis];
            packet.direction[axis][lane] = direction_[axis].at(column, line);
        }
        packet.depth_offset[lane] = depth_offset_.at(column, line);
    }
    packet.depth_scale = depth_scale_;
    packet.active = 0xffff;
    return packet;
}

}  // namespace swath
