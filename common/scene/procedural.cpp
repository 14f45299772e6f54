#include "common/scene/procedural.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/scene/hand.h"
#include "common/scene/procedural_parts.h"

namespace swath {
namespace {

using namespace procedural;

constexpr std::size_t kMinTriangles = 12;
constexpr std::size_t kMaxBuiltinTriangles = 50'000'000;

// The trefoil winds twice around the axis of a torus and three times around its tube.
struct KnotPoint {
    glm::dvec3 at;
    glm::dvec3 tangent;  // its length is the speed
    glm::dvec3 outward;  // the torus' normal, of unit length; it closes without a twist
};

KnotPoint knot_point(double s) {
    constexpr double kAround = 2;
    constexpr double kThrough = 3;
    constexpr double kTube = 0.46;  // of a torus of radius 1
    const double ca = cosine(kAround * s);
    const double sa = sine(kAround * s);
    const double ct = cosine(kThrough * s);
    const double st = sine(kThrough * s);
    const double radius = 1 + kTube * ct;
    return {{radius * ca, radius * sa, kTube * st},
            {-kAround * radius * sa - kThrough * kTube * st * ca,
             kAround * radius * ca - kThrough * kTube * st * sa, kThrough * kTube * ct},
            {ct * ca, ct * sa, st}};
}

// The parameters of `count` points that are evenly spaced along the curve, and the curve's length.
std::vector<double> even_parameters(std::size_t count, double& length) {
    constexpr std::size_t kSteps = 8192;
    std::vector<double> lengths(kSteps + 1, 0);
    for (std::size_t i = 0; i < kSteps; ++i)
        lengths[i + 1] = lengths[i] + glm::distance(knot_point(static_cast<double>(i) / kSteps).at,
                                                    knot_point(static_cast<double>(i + 1) / kSteps).at);
    length = lengths.back();
    std::vector<double> parameters(count);
    std::size_t step = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double wanted = length * static_cast<double>(i) / static_cast<double>(count);
        while (step + 1 < kSteps && lengths[step + 1] <= wanted) ++step;
        const double within = (wanted - lengths[step]) / (lengths[step + 1] - lengths[step]);
        parameters[i] = (static_cast<double>(step) + within) / kSteps;
    }
    return parameters;
}

Mesh make_knot(std::size_t triangles) {
    constexpr double kRadius = 0.235;
    constexpr double kBumpHeight = 0.13;  // of the radius
    constexpr double kBumpRings = 66;     // along the length
    constexpr double kBumpsAround = 7;
    double length = 0;
    even_parameters(0, length);
    const double quads = static_cast<double>(triangles) / 2;
    const double aspect = length / (6.283185307179586 * kRadius);
    const std::size_t around = std::max<std::size_t>(3, rounded(std::sqrt(quads / aspect)));
    const std::size_t along = std::max<std::size_t>(2, rounded(quads / static_cast<double>(around)));

    Mesh mesh;
    mesh.vertices.reserve(along * around);
    mesh.indices.reserve(6 * along * around);
    const std::vector<double> parameters = even_parameters(along, length);
    for (std::size_t i = 0; i < along; ++i) {
        const KnotPoint point = knot_point(parameters[i]);
        const glm::dvec3 sideways = glm::cross(point.tangent / glm::length(point.tangent), point.outward);
        const double u = static_cast<double>(i) / static_cast<double>(along);
        const glm::dvec3 base = palette(u);
        for (std::size_t j = 0; j < around; ++j) {
            const double v = static_cast<double>(j) / static_cast<double>(around);
            // Makes studs where two families of spirals cross, and is flat in between.
            const double wave = 0.5 + 0.25 * (cosine(kBumpRings * u + kBumpsAround * v) +
                                              cosine(kBumpRings * u - kBumpsAround * v));
            const double bump = wave * wave;
            const double radius = kRadius * (1 + kBumpHeight * bump);
            Vertex vertex;
            vertex.position = point.at + radius * (cosine(v) * point.outward + sine(v) * sideways);
            vertex.colour = colour(base * (0.72 + 0.28 * bump) + glm::dvec3(0.16 * bump * bump));
            mesh.vertices.push_back(vertex);
        }
    }
    const auto number = [&](std::size_t i, std::size_t j) {
        return static_cast<std::uint32_t>(i % along * around + j % around);
    };
    for (std::size_t i = 0; i < along; ++i)
        for (std::size_t j = 0; j < around; ++j)
            mesh.indices.insert(mesh.indices.end(), {number(i, j), number(i, j + 1), number(i + 1, j + 1),
                                                     number(i, j), number(i + 1, j + 1), number(i + 1, j)});
    compute_normals(mesh);
    return mesh;
}

struct SphereGrid {
    std::size_t slices = 6;
    std::size_t stacks = 2;
    std::size_t triangles() const { return 2 * slices * (stacks - 1); }
};

// A grid of close to `triangles` triangles with about twice as many slices as stacks: a sphere of few stacks
// is a thin double cone.
SphereGrid sphere_grid(double triangles) {
    SphereGrid best;
    double best_badness = 1e300;
    const std::size_t likely = std::max<std::size_t>(4, rounded(std::sqrt(triangles / 4)));
    for (std::size_t stacks = likely - 2; stacks <= likely + 3; ++stacks) {
        const std::size_t slices =
            std::max<std::size_t>(3, rounded(triangles / static_cast<double>(2 * (stacks - 1))));
        const SphereGrid grid{slices, stacks};
        const double error = std::abs(static_cast<double>(grid.triangles()) / triangles - 1);
        const double thinness = std::abs(static_cast<double>(slices) / static_cast<double>(2 * stacks) - 1);
        const double badness = error + 0.05 * thinness;
        if (badness < best_badness) {
            best_badness = badness;
            best = grid;
        }
    }
    return best;
}

// Slices lie around the axis, stacks from pole to pole.
void add_sphere(Mesh& mesh, const glm::dvec3& centre, double radius, const Colour& paint,
                const SphereGrid& grid) {
    // Not a structured binding, which clang 14's lambdas cannot capture.
    const std::size_t slices = grid.slices;
    const std::size_t stacks = grid.stacks;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto add = [&](const glm::dvec3& direction) {
        Vertex vertex;
        vertex.position = centre + radius * direction;
        vertex.normal = pack_normal(direction);
        vertex.colour = paint;
        mesh.vertices.push_back(vertex);
    };
    add({0, 1, 0});
    for (std::size_t stack = 1; stack < stacks; ++stack) {
        const double polar = 0.5 * static_cast<double>(stack) / static_cast<double>(stacks);
        for (std::size_t slice = 0; slice < slices; ++slice) {
            const double angle = static_cast<double>(slice) / static_cast<double>(slices);
            add({sine(polar) * sine(angle), cosine(polar), sine(polar) * cosine(angle)});
        }
    }
    add({0, -1, 0});
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    const auto ring = [&](std::size_t stack, std::size_t slice) {
        return static_cast<std::uint32_t>(first + 1 + (stack - 1) * slices + slice % slices);
    };
    for (std::size_t slice = 0; slice < slices; ++slice) {
        mesh.indices.insert(mesh.indices.end(), {first, ring(1, slice), ring(1, slice + 1)});
        for (std::size_t stack = 1; stack + 1 < stacks; ++stack)
            mesh.indices.insert(mesh.indices.end(),
                                {ring(stack, slice), ring(stack + 1, slice), ring(stack + 1, slice + 1),
                                 ring(stack, slice), ring(stack + 1, slice + 1), ring(stack, slice + 1)});
        mesh.indices.insert(mesh.indices.end(), {ring(stacks - 1, slice + 1), ring(stacks - 1, slice), last});
    }
}

// A cube of 11 x 11 x 11 spheres of many sizes, each at a random place in its cell, so that a line along an
// axis meets about fifteen surfaces. With fewer than 48 triangles for each there are fewer spheres.
Mesh make_spheres(std::size_t triangles) {
    std::size_t side = 11;
    while (side > 1 && side * side * side * 48 > triangles) --side;
    const double each = static_cast<double>(triangles) / static_cast<double>(side * side * side);
    const SphereGrid grid = sphere_grid(each);

    Mesh mesh;
    const std::size_t spheres = side * side * side;
    mesh.vertices.reserve(spheres * (grid.triangles() / 2 + 2));
    mesh.indices.reserve(spheres * 3 * grid.triangles());
    for (std::size_t i = 0; i < spheres; ++i) {
        const auto seed = static_cast<std::uint32_t>(i);
        const glm::dvec3 place(static_cast<double>(i % side), static_cast<double>(i / side % side),
                               static_cast<double>(i / side / side));
        const glm::dvec3 jitter(random(seed, 0), random(seed, 1), random(seed, 2));
        const double radius = 0.38 + 0.2 * random(seed, 3);
        const glm::dvec3 paint = palette(random(seed, 4)) * (0.7 + 0.4 * random(seed, 5));
        add_sphere(mesh, place + (jitter - 0.5), radius, colour(paint), grid);
    }
    return mesh;
}

// A leaning ring of small spheres in all colours becomes a globe with the colours in order: each sphere flies
// through all others to a random place. With fewer than 96 triangles for each there are fewer spheres.
Mesh make_swarm(std::size_t triangles) {
    constexpr double kRing = 10;   // radius of the ring's middle
    constexpr double kTube = 2.5;  // ... and of its tube
    constexpr double kGlobe = 9;
    const std::size_t spheres = std::clamp<std::size_t>(triangles / 96, 1, 500);
    // A sphere gets triangles by its area, so that all triangles have about one size.
    std::vector<double> radii(spheres);
    double area = 0;
    for (std::size_t i = 0; i < spheres; ++i) {
        const double size = random(static_cast<std::uint32_t>(i), 0);
        radii[i] = 0.4 + 0.9 * size * size * size;
        area += radii[i] * radii[i];
    }

    Mesh mesh;
    mesh.vertices.reserve(triangles / 2 + 4 * spheres);
    mesh.indices.reserve(3 * (triangles + triangles / 8));
    mesh.motion.reserve(mesh.vertices.capacity());
    double owed = 0;  // triangles that earlier spheres did not use, so that the sum is right
    for (std::size_t i = 0; i < spheres; ++i) {
        const auto seed = static_cast<std::uint32_t>(i);
        const double around = random(seed, 1);
        const double tube = kTube * std::sqrt(random(seed, 2));
        const double turn = random(seed, 3);
        const double out = kRing + tube * cosine(turn);
        const double along = out * sine(around);
        const double across = tube * sine(turn);
        const glm::dvec3 start(out * cosine(around), 0.8 * along - 0.6 * across, 0.6 * along + 0.8 * across);
        // Even steps in height put equally many on equal areas of the globe. The ring has another order.
        const double up = (static_cast<double>(i) + 0.5) / static_cast<double>(spheres);
        const double height = 2 * up - 1;
        const double aside = std::sqrt(1 - height * height);
        const double angle = random(seed, 4);
        const glm::dvec3 end = kGlobe * glm::dvec3(aside * cosine(angle), height, aside * sine(angle));
        const glm::dvec3 paint = palette(0.85 * up) * (0.8 + 0.3 * random(seed, 5));

        owed += static_cast<double>(triangles) * radii[i] * radii[i] / area;
        const SphereGrid grid = sphere_grid(std::max(owed, 12.0));
        owed -= static_cast<double>(grid.triangles());
        add_sphere(mesh, start, radii[i], colour(paint), grid);
        mesh.motion.resize(mesh.vertices.size(), glm::vec3(end - start));
    }
    return mesh;
}

// Adds the town's quads until there are as many as wished.
class TownBuilder {
  public:
    explicit TownBuilder(std::size_t triangles) : left_(triangles / 2) {
        mesh_.vertices.reserve(4 * left_);
        mesh_.indices.reserve(6 * left_);
    }

    // Adds a face of n x n quads with a corner at `origin`. Its normal is along `right` x `up`. Quads with
    // odd row and column are windows.
    void face(const glm::dvec3& origin, const glm::dvec3& right, const glm::dvec3& up, std::size_t n,
              const Colour& wall, const Colour& window) {
        const glm::dvec3 across = glm::cross(right, up);
        const auto normal = pack_normal(across);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                if (left_ == 0) return;
                --left_;
                const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
                const bool is_window = i % 2 == 1 && j % 2 == 1;
                for (const auto& [a, b] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
                    Vertex vertex;
                    const auto steps = static_cast<double>(n);
                    vertex.position = origin + right * (static_cast<double>(a) / steps) +
                                      up * (static_cast<double>(b) / steps);
                    vertex.normal = normal;
                    vertex.colour = is_window ? window : wall;
                    mesh_.vertices.push_back(vertex);
                }
                mesh_.indices.insert(mesh_.indices.end(),
                                     {first, first + 1, first + 2, first, first + 2, first + 3});
            }
    }

    bool full() const { return left_ == 0; }
    Mesh take() { return std::move(mesh_); }

  private:
    std::size_t left_;
    Mesh mesh_;
};

constexpr std::size_t kBlockSide = 3;  // houses along a block's side
constexpr std::size_t kPitch = 4;      // from block to block, so a street is as wide as a house

// Adds a house of 1 x height x 1 on the ground at (x, z), with all six faces.
void add_house(TownBuilder& town, double x, double z, double height, std::size_t n, std::uint32_t seed) {
    const Colour roof = colour({0.45 + 0.25 * random(seed, 3), 0.25, 0.2});
    const Colour floor = colour({0.25, 0.22, 0.2});
    const Colour window = random(seed, 4) < 0.5 ? colour({0.95, 0.85, 0.5}) : colour({0.2, 0.27, 0.36});
    const glm::dvec3 base = palette(random(seed, 2)) * 0.6 + glm::dvec3(0.3);
    const glm::dvec3 up(0, height, 0);
    // Every face has a shade of its own, so that a tie that is broken differently can be seen.
    town.face({x, 0, z + 1}, {1, 0, 0}, up, n, colour(base), window);
    town.face({x + 1, 0, z + 1}, {0, 0, -1}, up, n, colour(base * 0.9), window);
    town.face({x + 1, 0, z}, {-1, 0, 0}, up, n, colour(base * 0.8), window);
    town.face({x, 0, z}, {0, 0, 1}, up, n, colour(base * 0.95), window);
    town.face({x, height, z + 1}, {1, 0, 0}, {0, 0, -1}, n, roof, roof);
    town.face({x, 0, z}, {1, 0, 0}, {0, 0, 1}, n, floor, floor);
}

// Adds houses wall to wall. Their floors lie in the plane of the block's paving and of the ground, and a
// banner hangs across each of the four fronts in the plane of the walls. All of these coincide and differ in
// colour, and the large faces have their centres, and so their octree cells, far from much that they coincide
// with.
void add_block(TownBuilder& town, std::size_t column, std::size_t row, std::size_t n) {
    const auto x0 = static_cast<double>(column * kPitch);
    const auto z0 = static_cast<double>(row * kPitch);
    const auto side = static_cast<double>(kBlockSide);
    const auto block = static_cast<std::uint32_t>(row * 65536 + column) * 16;
    double lowest = 1e300;
    for (std::size_t i = 0; i < kBlockSide * kBlockSide; ++i) {
        const auto seed = block + static_cast<std::uint32_t>(i);
        // Multiples of a quarter are exact in floats, so equal heights coincide.
        const double height = 0.75 + 0.25 * std::floor(10 * random(seed, 0) * random(seed, 1));
        lowest = std::min(lowest, height);
        add_house(town, x0 + static_cast<double>(i % kBlockSide), z0 + static_cast<double>(i / kBlockSide),
                  height, n, seed);
    }
    const Colour banner = colour(palette(random(block, 6)));
    const Colour paving = colour({0.55, 0.55, 0.58});
    const Colour ground = colour({0.38, 0.5, 0.3});
    const glm::dvec3 up(0, 0.25, 0);
    const double y = lowest - 0.25;
    town.face({x0, y, z0 + side}, {side, 0, 0}, up, 1, banner, banner);
    town.face({x0 + side, y, z0 + side}, {0, 0, -side}, up, 1, banner, banner);
    town.face({x0 + side, y, z0}, {-side, 0, 0}, up, 1, banner, banner);
    town.face({x0, y, z0}, {0, 0, side}, up, 1, banner, banner);
    town.face({x0 - 0.25, 0, z0 + side + 0.25}, {side + 0.5, 0, 0}, {0, 0, -side - 0.5}, 1, paving, paving);
    town.face({x0 - 0.5, 0, z0 + side + 0.5}, {kPitch, 0, 0}, {0, 0, -1.0 * kPitch}, 1, ground, ground);
}

constexpr std::size_t block_triangles(std::size_t n) {
    return kBlockSide * kBlockSide * 6 * 2 * n * n + 6 * 2;
}

Mesh make_town(std::size_t triangles) {
    std::size_t n = 1;  // quads along a face's side; it grows before there are more than 240 blocks
    while (n < 12 && triangles > 240 * block_triangles(n)) ++n;
    const double blocks = static_cast<double>(triangles) / static_cast<double>(block_triangles(n));
    const std::size_t columns = std::max<std::size_t>(1, rounded(std::ceil(std::sqrt(blocks))));
    TownBuilder town(triangles);
    for (std::size_t i = 0; !town.full(); ++i) add_block(town, i % columns, i / columns, n);
    return town.take();
}

}  // namespace

const std::vector<BuiltinModel>& builtin_models() {
    static const std::vector<BuiltinModel> kModels = {
        {"knot", "a bumpy torus knot, even small triangles, coloured along its length", 1'000'000},
        {"spheres", "a deep field of spheres, more than ten surfaces behind one another", 1'000'000},
        {"town", "boxes whose faces coincide with their neighbours', exact depth ties everywhere", 1'000'000},
        {"hand", "the bones of a human hand, 29 smooth closed surfaces, thin in one direction", 654'666},
        {"swarm", "spheres that fly through one another: a model that moves", 1'000'000},
    };
    return kModels;
}

Result<Mesh> make_builtin(const std::string& name, std::size_t triangles) {
    std::string names;
    for (const BuiltinModel& model : builtin_models()) {
        names += names.empty() ? model.name : ", " + model.name;
        if (model.name != name) continue;
        if (triangles < kMinTriangles || triangles > kMaxBuiltinTriangles)
            return fail("{} triangles asked for, the limits are {} and {}", triangles, kMinTriangles,
                        kMaxBuiltinTriangles);
        if (name == "knot") return make_knot(triangles);
        if (name == "spheres") return make_spheres(triangles);
        if (name == "hand") return make_hand(triangles);
        if (name == "swarm") return make_swarm(triangles);
        return make_town(triangles);
    }
    return fail("no built-in model `{}`, there are: {}", name, names);
}

}  // namespace swath
