#include "common/scene/hand.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/scene/procedural_parts.h"

namespace swath {
namespace {

using namespace procedural;

// A bone is a shaft that flares out to both ends around an axis that may be bowed. Lengths are in
// millimetres.
struct Bone {
    glm::dvec3 start;
    glm::dvec3 direction;  // of unit length
    double length = 0;
    // The radii of the flare at the start, of the shaft, and of the flare at the end.
    double base = 0;
    double shaft = 0;
    double head = 0;
    // The length over which each end closes: a short one makes it flat, the radius makes it round.
    double base_cap = 0;
    double head_cap = 0;
    // Cross-sections are ellipses: factors of the radius across the back, and from back to palm.
    double base_width = 1;
    double head_width = 1;
    double base_depth = 1;
    double head_depth = 1;
    double bow = 0;       // how far the middle is lifted to the back, per length
    double lumps = 0.02;  // height of the bumps, per radius
};

double square(double x) { return x * x; }

// Falls from 1 at the end of a bone to 0 along it, and is a half at `reach`.
double flare(double z, double reach) { return 1 / (1 + square(z / reach) * (z / reach)); }

// Rises as a quarter of an ellipse from 0 at the end of a bone to 1 at `cap`, and stays there.
double closing(double z, double cap) { return std::sqrt(1 - square(std::clamp(1 - z / cap, 0.0, 1.0))); }

// The bone's radius at `t`, 0 to 1 along it. It is 0 at both ends.
double radius_at(const Bone& bone, double t) {
    const double z = t * bone.length;
    const double left = (1 - t) * bone.length;
    const double open = bone.shaft + (bone.base - bone.shaft) * flare(z, 1.7 * bone.base) +
                        (bone.head - bone.shaft) * flare(left, 1.5 * bone.head);
    return open * closing(z, bone.base_cap) * closing(left, bone.head_cap);
}

// A bone's outline from end to end, parametrised by its length.
class Outline {
  public:
    explicit Outline(const Bone& bone) {
        for (std::size_t i = 0; i <= kSteps; ++i) {
            // Steps are denser at the ends, where the radius changes most.
            t_[i] = 0.5 - 0.5 * cosine(0.5 * static_cast<double>(i) / kSteps);
            if (i == 0) continue;
            const double girth =
                0.25 * (bone.base_width + bone.head_width + bone.base_depth + bone.head_depth);
            const double middle = girth * radius_at(bone, 0.5 * (t_[i - 1] + t_[i]));
            const double rise = radius_at(bone, t_[i]) - radius_at(bone, t_[i - 1]);
            const double step = std::sqrt(square(rise) + square((t_[i] - t_[i - 1]) * bone.length));
            lengths_[i] = lengths_[i - 1] + step;
            area_ += 6.283185307179586 * middle * step;
        }
    }
    double length() const { return lengths_.back(); }
    double area() const { return area_; }  // about that of the surface

    // The t at which the part `share` of the length ends.
    double t_of(double share) const {
        const double wanted = share * length();
        std::size_t i = 0;
        while (i + 2 < lengths_.size() && lengths_[i + 1] <= wanted) ++i;
        const double within = (wanted - lengths_[i]) / (lengths_[i + 1] - lengths_[i]);
        return t_[i] + within * (t_[i + 1] - t_[i]);
    }

  private:
    static constexpr std::size_t kSteps = 512;
    std::array<double, kSteps + 1> t_{};
    std::array<double, kSteps + 1> lengths_{};
    double area_ = 0;
};

// Adds a bone of about `triangles` triangles and returns how many it got.
std::size_t add_bone(Mesh& mesh, const Bone& bone, const Outline& outline, double triangles,
                     std::uint32_t seed) {
    const double aspect = outline.area() / square(outline.length());  // girth over length
    const std::size_t around = std::max<std::size_t>(3, rounded(std::sqrt(0.5 * triangles * aspect)));
    const std::size_t rings =
        std::max<std::size_t>(1, rounded(std::max(0.0, triangles) / static_cast<double>(2 * around)));
    const glm::dvec3 across = glm::cross(bone.direction, glm::dvec3(0, 0, 1));
    const glm::dvec3 side = across / glm::length(across);
    const glm::dvec3 back = glm::cross(side, bone.direction);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto add = [&](double t, double turn) {
        const double smooth = t * t * (3 - 2 * t);
        const double width = bone.base_width + (bone.head_width - bone.base_width) * smooth;
        const double depth = bone.base_depth + (bone.head_depth - bone.base_depth) * smooth;
        // The numbers of waves around are whole, so that the surface closes; each bone has phases of its own.
        const double coarse = sine(turn * 2 + t * 1.3 + random(seed, 0)) * sine(t * 2.1 + random(seed, 1)) +
                              sine(turn * 3 - t * 1.7 + random(seed, 2));
        const double fine =
            sine(turn * 7 + t * 5 + random(seed, 3)) * sine(t * 0.12 * bone.length - turn * 4);
        const double bump = bone.lumps * coarse + 0.008 * fine;
        const double radius = radius_at(bone, t) * (1 + bump);
        Vertex vertex;
        vertex.position = bone.start + t * bone.length * bone.direction +
                          (4 * bone.bow * bone.length * t * (1 - t)) * back +
                          radius * (width * cosine(turn) * side + depth * sine(turn) * back);
        // The bone is ivory, a little browner towards the joints and in hollows.
        const double joint = square(square(2 * t - 1));
        vertex.colour =
            colour(glm::dvec3(0.93, 0.88, 0.78) * (1 + 0.9 * bump) - joint * glm::dvec3(0.05, 0.09, 0.13));
        mesh.vertices.push_back(vertex);
    };
    add(0, 0);
    for (std::size_t ring = 1; ring <= rings; ++ring) {
        const double t = outline.t_of(static_cast<double>(ring) / static_cast<double>(rings + 1));
        for (std::size_t i = 0; i < around; ++i) add(t, static_cast<double>(i) / static_cast<double>(around));
    }
    add(1, 0);
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    const auto number = [&](std::size_t ring, std::size_t i) {
        return static_cast<std::uint32_t>(first + 1 + ring * around + i % around);
    };
    for (std::size_t i = 0; i < around; ++i) {
        mesh.indices.insert(mesh.indices.end(), {first, number(0, i), number(0, i + 1)});
        for (std::size_t ring = 0; ring + 1 < rings; ++ring)
            mesh.indices.insert(mesh.indices.end(),
                                {number(ring, i), number(ring + 1, i), number(ring + 1, i + 1),
                                 number(ring, i), number(ring + 1, i + 1), number(ring, i + 1)});
        mesh.indices.insert(mesh.indices.end(), {last, number(rings - 1, i + 1), number(rings - 1, i)});
    }
    return 2 * around * rings;
}

// A finger's ray: its metacarpal and phalanges. The thumb has no middle phalanx.
struct Ray {
    glm::dvec3 start;               // of the metacarpal
    double lean;                    // from the middle to the thumb's side, in turns
    double lean_step;               // what each joint adds to it
    std::array<double, 4> lengths;  // 0: the bone is missing
    double thickness;
};

// The fingers bend a little more to the palm at every joint. In turns, from the metacarpal on.
constexpr std::array<double, 4> kBend{0.006, 0.042, 0.1, 0.15};
constexpr double kGap = 1.2;  // in a joint

void add_ray(std::vector<Bone>& bones, const Ray& ray) {
    glm::dvec3 at = ray.start;
    double lean = ray.lean;
    for (std::size_t i = 0; i < 4; ++i) {
        if (ray.lengths[i] == 0) continue;
        const double flat = cosine(kBend[i]);
        const glm::dvec3 direction(-sine(lean) * flat, cosine(lean) * flat, -sine(kBend[i]));
        Bone bone;
        bone.start = at;
        bone.direction = direction;
        bone.length = ray.lengths[i];
        const double k = ray.thickness;
        if (i == 0) {
            bone.base = 7.0 * k, bone.shaft = 4.3 * k, bone.head = 7.0 * k;
            bone.base_width = 0.95, bone.head_width = 0.95, bone.head_depth = 1.05, bone.bow = 0.03;
        } else if (i == 3) {
            bone.base = 5.4 * k, bone.shaft = 2.4 * k, bone.head = 3.4 * k;
            bone.base_width = 1.1, bone.head_width = 1.3, bone.base_depth = 0.8, bone.head_depth = 0.6;
        } else {
            const double thin = i == 1 ? 1 : 0.88;
            bone.base = 7.0 * k * thin, bone.shaft = 4.2 * k * thin, bone.head = 5.4 * k * thin;
            bone.base_width = 1.08, bone.head_width = 1.12, bone.base_depth = 0.9, bone.head_depth = 0.85;
            bone.bow = 0.035;
        }
        bone.base_cap = 0.5 * bone.base;
        bone.head_cap = (i == 3 ? 1.3 : 0.9) * bone.head;
        bones.push_back(bone);
        at += (bone.length + kGap) * direction;
        lean += ray.lean_step;
    }
}

// A carpal bone, which is an uneven pebble.
Bone pebble(const glm::dvec3& centre, double lean, double width, double length, double depth) {
    Bone bone;
    bone.direction = {-sine(lean), cosine(lean), 0};
    bone.start = centre - 0.5 * length * bone.direction;
    bone.length = length;
    bone.base = bone.shaft = bone.head = 0.25 * (width + depth);
    bone.base_cap = bone.head_cap = 0.44 * length;
    bone.base_width = bone.head_width = 2 * width / (width + depth);
    bone.base_depth = bone.head_depth = 2 * depth / (width + depth);
    bone.lumps = 0.032;
    return bone;
}

// The end of a forearm's bone, from the wrist down.
Bone forearm(const glm::dvec3& wrist, double length, double end, double shaft, double width, double depth) {
    Bone bone;
    bone.start = wrist;
    bone.direction = {0, -1, 0};
    bone.length = length;
    bone.base = end;
    bone.shaft = bone.head = shaft;
    bone.base_cap = 0.5 * end;
    bone.head_cap = 0.4 * shaft;
    bone.base_width = width;
    bone.base_depth = depth;
    return bone;
}

// The proportions follow anatomical tables: the rounded lengths of an adult's bones.
std::vector<Bone> hand_bones() {
    std::vector<Bone> bones;
    add_ray(bones, {{0, 2, 1.5}, 0.004, 0.001, {65, 44, 27, 18}, 1.0});
    add_ray(bones, {{-14.5, 1, 0.5}, 0.022, 0.002, {67, 40, 24, 17}, 1.0});
    add_ray(bones, {{13.5, 0, 0.5}, -0.018, -0.001, {58, 41, 26, 18}, 0.93});
    add_ray(bones, {{25.5, -2.5, -2}, -0.045, -0.004, {53, 33, 19, 16}, 0.84});
    add_ray(bones, {{-31, -6.5, -6}, 0.115, -0.02, {46, 33, 0, 23}, 1.08});
    // Radius and ulna.
    bones.push_back(forearm({-8, -35, -1}, 56, 11, 6.3, 1.45, 0.9));
    bones.push_back(forearm({15.5, -37, 0}, 54, 7.2, 4.9, 1.1, 1));
    // Trapezium, trapezoid, capitate, hamate; scaphoid, lunate, triquetrum, pisiform.
    bones.push_back(pebble({-23.5, -11, -3.5}, 0.1, 14.5, 14, 14));
    bones.push_back(pebble({-11.5, -8.5, 0}, 0.02, 11, 14.5, 13));
    bones.push_back(pebble({0, -10, 1}, 0, 13, 22, 14));
    bones.push_back(pebble({14.5, -10.5, 0}, -0.04, 16, 18.5, 15));
    bones.push_back(pebble({-15, -24.5, -1}, 0.16, 13.5, 20, 13));
    bones.push_back(pebble({0.5, -27.5, 0}, 0.22, 13.5, 16, 13));
    bones.push_back(pebble({14.5, -26, -1}, -0.12, 14, 15, 12));
    bones.push_back(pebble({20.5, -24.5, -10}, 0, 9, 10.5, 8));
    return bones;
}

}  // namespace

Mesh make_hand(std::size_t triangles) {
    std::vector<Bone> bones = hand_bones();
    bones.resize(std::clamp<std::size_t>(triangles / 24, 1, bones.size()), bones.front());
    std::vector<Outline> outlines;
    double area = 0;
    for (const Bone& bone : bones) area += outlines.emplace_back(bone).area();

    Mesh mesh;
    mesh.vertices.reserve(triangles / 2 + triangles / 16 + 64);
    mesh.indices.reserve(3 * (triangles + triangles / 8));
    double owed = 0;  // triangles that earlier bones did not use, so that the sum is right
    for (std::size_t i = 0; i < bones.size(); ++i) {
        owed += static_cast<double>(triangles) * outlines[i].area() / area;
        owed -=
            static_cast<double>(add_bone(mesh, bones[i], outlines[i], owed, static_cast<std::uint32_t>(i)));
    }
    compute_normals(mesh);
    return mesh;
}

}  // namespace swath
