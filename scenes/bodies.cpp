#include "scenes/bodies.h"

#include "scenes/deforming/frame.h"
#include "scenes/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

namespace abut::scenes {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A sum of waves in space. Shorter waves are lower.
class Waves {
public:
    explicit Waves(std::uint64_t seed) {
        Random random(seed);
        double frequency = 3;
        for (Wave& w : waves_) {
            const double x = random.uniform(-1, 1), y = random.uniform(-1, 1),
                         z = random.uniform(-1, 1), phase = random.uniform(0, kTurn);
            w = {scaled(unit({x, y, z + 1e-3}), frequency), phase, 0.35 / frequency};
            frequency *= 1.35;
        }
    }
    [[nodiscard]] double at(const Vec3& p) const {
        double sum = 0;
        for (const Wave& w : waves_)
            sum += w.height * std::sin(dot(w.direction, p) + w.phase);
        return sum;
    }

private:
    struct Wave {
        Vec3 direction;
        double phase = 0, height = 0;
    };
    std::array<Wave, 10> waves_;
};

/// Vertices of a subdivided octahedron, by their integer coordinates: |x| + |y| + |z| = n.
class Lattice {
public:
    explicit Lattice(Mesh& mesh) : mesh_(mesh) {}
    std::uint32_t vertex(int x, int y, int z) {
        const auto [found, added] =
            index_.try_emplace({x, y, z}, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (added)
            mesh_.positions.push_back({double(x), double(y), double(z)});
        return found->second;
    }

private:
    Mesh& mesh_;
    std::map<std::array<int, 3>, std::uint32_t> index_;
};

} // namespace

Mesh sphere(std::uint32_t triangles) {
    const int n = std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 8.0))));
    Mesh mesh;
    Lattice lattice(mesh);
    for (int octant = 0; octant < 8; ++octant) {
        const int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
        const auto add = [&](std::array<int, 2> p, std::array<int, 2> q, std::array<int, 2> r) {
            if (sx * sy * sz < 0)
                std::swap(q, r);
            const auto at = [&](const std::array<int, 2>& c) {
                return lattice.vertex(sx * c[0], sy * c[1], sz * (n - c[0] - c[1]));
            };
            const std::uint32_t a = at(p), b = at(q), c = at(r);
            mesh.triangles.push_back({a, b, c});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add({i, j}, {i + 1, j}, {i, j + 1});
                if (i + j + 1 < n)
                    add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
            }
    }
    for (Vec3& p : mesh.positions)
        p = unit(p);
    return mesh;
}

Mesh boulder(std::uint32_t triangles, std::uint64_t seed) {
    Mesh mesh = sphere(triangles);
    const Waves waves(seed);
    for (Vec3& p : mesh.positions)
        p = scaled(p, 0.5 * (1 + waves.at(p)));
    return mesh;
}

Mesh knot(std::uint32_t triangles) {
    // The numbers of quads along and around have the ratio of the tube's length to its
    // circumference.
    const int around = std::max(3, static_cast<int>(std::lround(std::sqrt(triangles / 2.0 / 10))));
    const int along =
        std::max(3, static_cast<int>(std::lround(triangles / 2.0 / static_cast<double>(around))));
    const auto centre = [](double u) {
        const double r = 0.3 + 0.13 * std::cos(3 * u);
        return Vec3{r * std::cos(2 * u), r * std::sin(2 * u), 0.15 * std::sin(3 * u)};
    };
    Mesh mesh;
    for (int i = 0; i < along; ++i) {
        const double u = kTurn * i / along, step = 1e-4;
        const Vec3 c = centre(u);
        const Vec3 tangent = unit(add(centre(u + step), scaled(centre(u - step), -1)));
        const Vec3 side = unit(cross(tangent, kZ)), up = cross(side, tangent);
        for (int j = 0; j < around; ++j) {
            const double v = kTurn * j / around;
            const double radius =
                0.07 * (1 + 0.1 * std::sin(5 * v + 9 * u) + 0.05 * std::cos(60 * u));
            mesh.positions.push_back(
                add(c, add(scaled(side, radius * std::cos(v)), scaled(up, radius * std::sin(v)))));
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % along) * around + j % around);
    };
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < around; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

} // namespace abut::scenes
