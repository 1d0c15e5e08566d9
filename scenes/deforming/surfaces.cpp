#include "scenes/deforming/surfaces.h"

#include "scenes/deforming/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace abut::scenes {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

int pieces_of(double length, double size) {
    return std::max(1, static_cast<int>(std::floor(length / size + 0.5)));
}

/// A ring of vertices first, first + 1, ... around the axis. Every other ring is offset by half a
/// step.
struct Ring {
    std::uint32_t first = 0;
    int count = 1;
    double offset = 0; ///< in steps
    [[nodiscard]] double turns(int k) const { return (k + offset) / count; }
    [[nodiscard]] std::uint32_t at(int k) const {
        return first + static_cast<std::uint32_t>(k % count);
    }
};

/// Joins two rings by triangles. Each triangle advances on the ring whose next vertex comes first.
void join(Mesh& mesh, const Ring& a, const Ring& b) {
    const int last_a = a.count > 1 ? a.count : 0, last_b = b.count > 1 ? b.count : 0;
    for (int i = 0, j = 0; i < last_a || j < last_b;)
        if (j == last_b || (i < last_a && a.turns(i + 1) <= b.turns(j + 1))) {
            mesh.triangles.push_back({a.at(i), a.at(i + 1), b.at(j)});
            ++i;
        } else {
            mesh.triangles.push_back({a.at(i), b.at(j + 1), b.at(j)});
            ++j;
        }
}

} // namespace

Mesh sheet(double length_x, double length_z, double size) {
    const int columns = pieces_of(length_x, size), rows = pieces_of(length_z, size);
    Mesh mesh;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            mesh.positions.push_back({length_x * (double(column) / columns - 0.5), 0,
                                      length_z * (0.5 - double(row) / rows)});
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto a = static_cast<std::uint32_t>(row * (columns + 1) + column), b = a + 1,
                       d = a + static_cast<std::uint32_t>(columns) + 1, c = d + 1;
            const bool rising = (row + column) % 2 == 0;
            mesh.triangles.push_back({a, b, rising ? c : d});
            mesh.triangles.push_back({rising ? a : b, c, d});
        }
    return mesh;
}

Mesh turned_surface(const std::vector<Point2>& profile, double size) {
    Mesh mesh;
    Ring before;
    for (std::size_t k = 0; k < profile.size(); ++k) {
        const auto& [x, radius] = profile[k];
        const Ring ring{static_cast<std::uint32_t>(mesh.positions.size()),
                        radius == 0 ? 1 : std::max(5, pieces_of(kTurn * radius, size)),
                        k % 2 == 0 ? 0 : 0.5};
        for (int i = 0; i < ring.count; ++i) {
            const Point2 c = on_circle(ring.turns(i));
            mesh.positions.push_back({x, radius * c.u, radius * c.v});
        }
        if (k > 0)
            join(mesh, before, ring);
        before = ring;
    }
    return mesh;
}

std::vector<Point2> straight_profile(const Point2& from, const Point2& to, double size) {
    constexpr double kHeight = 0.87; // of an equilateral triangle with side 1
    const double length = norm({to.u - from.u, to.v - from.v, 0});
    const int pieces = pieces_of(length, kHeight * size);
    std::vector<Point2> profile;
    for (int k = 0; k <= pieces; ++k) {
        const double t = double(k) / pieces;
        profile.push_back({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)});
    }
    return profile;
}

Mesh capsule(double length, double radius, double size) {
    const int quarter = std::max(2, pieces_of(kTurn / 4 * radius, size));
    const auto arc = [&](int k) { return on_circle(k, 4 * quarter); };
    std::vector<Point2> profile{{-radius, 0}};
    for (int k = quarter - 1; k > 0; --k)
        profile.push_back({-radius * arc(k).v, radius * arc(k).u});
    for (const Point2& p : straight_profile({0, radius}, {length, radius}, size))
        profile.push_back(p);
    for (int k = 1; k < quarter; ++k)
        profile.push_back({length + radius * arc(k).v, radius * arc(k).u});
    profile.push_back({length + radius, 0});
    return turned_surface(profile, size);
}

double size_for(std::uint64_t triangles, const std::function<Mesh(double)>& make) {
    // The number of triangles is proportional to size^-2, up to rounding.
    double size = 0.1, best = size, least_miss = 1e300;
    for (int i = 0; i < 8; ++i) {
        const double ratio =
            static_cast<double>(make(size).triangles.size()) / static_cast<double>(triangles);
        if (std::abs(ratio - 1) < least_miss) {
            least_miss = std::abs(ratio - 1);
            best = size;
        }
        size *= std::sqrt(ratio);
    }
    return best;
}

std::uint32_t append(Mesh& whole, const Mesh& piece, const Transform& whole_from_piece) {
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    for (const Vec3& p : piece.positions)
        whole.positions.push_back(apply(whole_from_piece, p));
    for (const auto& t : piece.triangles)
        whole.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    return first;
}

Point2 on_circle(double turns) {
    constexpr int kSteps = 1 << 20;
    return on_circle(static_cast<int>(std::floor((turns - std::floor(turns)) * kSteps + 0.5)),
                     kSteps);
}

Transform turned_about_x(double turns) {
    const Point2 c = on_circle(turns);
    return turned(kX, {0, c.u, c.v}, {});
}

Transform turned_about_y(double turns) {
    const Point2 c = on_circle(turns);
    return turned({c.u, 0, -c.v}, kY, {});
}

Transform turned_about_z(double turns) {
    const Point2 c = on_circle(turns);
    return turned({c.u, c.v, 0}, {-c.v, c.u, 0}, {});
}

void ruffle(std::span<Vec3> positions, double size, Random& random) {
    for (Vec3& p : positions) {
        const Vec3 direction{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        p = add(p, scaled(direction, 0.02 * size));
    }
}

Vec3 on_float_grid(const Vec3& p) {
    const auto rounded = [](double v) { return std::floor(v * 0x1p20 + 0.5) * 0x1p-20; };
    return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

double smooth_step(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace abut::scenes
