// Open plates that cross, divided into triangles at random: kinds and depths against lengths that follow
// from the plates' sizes.

#include "tests/support/classified_pair.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace abut::test {
namespace {

/// A parallelogram: a corner, and its two sides.
struct Plate {
    Vec3 corner, u, v;
    [[nodiscard]] Vec3 at(double s, double t) const { return corner + s * u + t * v; }
};

/// Two plates or more as two surfaces, and how far these go beyond each other.
struct Crossing {
    std::vector<Plate> a, b;
    double depth = 0;
};

/// A part of a plate, by shares of its sides.
struct Cell {
    double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
};

void add_triangle(Random& random, const std::array<Vec3, 3>& corners, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    if (random.chance(0.1)) // a surface that bounds no solid has no outside
        mesh.triangles.push_back({first, first + 2, first + 1});
    else
        mesh.triangles.push_back({first, first + 1, first + 2});
}

/// Divides a part of a plate at random. Vertices of one cell often lie on edges of another one.
void add_cell(Random& random, const Plate& plate, const Cell& cell, int depth, Mesh& mesh) {
    const auto& [u0, u1, v0, v1] = cell;
    if (depth > 0 && random.chance(0.7)) {
        const double share = random.chance(0.3) ? 0.5 : random.uniform(0.1, 0.9);
        const double u = u0 + share * (u1 - u0), v = v0 + share * (v1 - v0);
        const bool along_u = random.chance(0.5);
        add_cell(random, plate, along_u ? Cell{u0, u, v0, v1} : Cell{u0, u1, v0, v}, depth - 1,
                 mesh);
        add_cell(random, plate, along_u ? Cell{u, u1, v0, v1} : Cell{u0, u1, v, v1}, depth - 1,
                 mesh);
        return;
    }
    const std::array<Vec3, 4> corners{plate.at(u0, v0), plate.at(u1, v0), plate.at(u1, v1),
                                      plate.at(u0, v1)};
    if (random.chance(0.3)) {
        const Vec3 inner = plate.at(u0 + random.uniform(0.1, 0.9) * (u1 - u0),
                                    v0 + random.uniform(0.1, 0.9) * (v1 - v0));
        for (std::size_t i = 0; i < 4; ++i)
            add_triangle(random, {corners[i], corners[(i + 1) % 4], inner}, mesh);
        return;
    }
    const auto first = static_cast<std::size_t>(random.integer(0, 1));
    for (const std::size_t i : {first, first + 2})
        add_triangle(random, {corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]}, mesh);
}

Mesh divided(Random& random, const std::vector<Plate>& plates) {
    Mesh mesh;
    for (const Plate& plate : plates)
        add_cell(random, plate, {}, random.integer(0, 4), mesh);
    return mesh;
}

/// A plate [0, width] × [0, 2] in the plane z = 0 and a fin that is tilted over it.
///
/// On the side to which the fin leans, either one goes as far beyond the other as it is long, or to where it
/// leaves the other one over its border.
Crossing tilted_fin(Random& random) {
    const double width = random.uniform(0.5, 3), at = width * random.uniform(0.05, 0.95);
    const double angle =
        random.chance(0.3) ? std::numbers::pi / 2 : random.uniform(0.2, std::numbers::pi / 2);
    const double over = random.uniform(0.05, 2), under = random.uniform(0.05, 2);
    // The fin is narrower than the plate, wider, or beside its middle.
    const double from = random.uniform(-1, 1), to = from + random.uniform(1.1, 3);
    const Vec3 along{std::cos(angle), 0, std::sin(angle)}, foot{at, 0, 0};
    const double sine = std::sin(angle), tangent = std::tan(angle);
    Crossing c;
    c.a = {{{}, {width, 0, 0}, {0, 2, 0}}};
    c.b = {{foot - under * along + Vec3{0, from, 0}, (over + under) * along, {0, to - from, 0}}};
    const double plate_over = std::min((width - at) * sine, over * tangent),
                 plate_under = std::min(at * sine, under * tangent),
                 fin_over = std::min(over * sine, (width - at) * tangent),
                 fin_under = std::min(under * sine, at * tangent);
    c.depth = std::min({plate_over, plate_under, fin_over, fin_under});
    return c;
}

/// A plate and several fins, upright and as wide as the plate or wider.
Crossing upright_fins(Random& random) {
    const int count = random.integer(2, 5);
    const double beside = random.chance(0.5) ? 0 : random.uniform(0.01, 1);
    std::vector<double> feet{0}; // the plate's ends are the first one and the last one
    for (int i = 0; i <= count; ++i)
        feet.push_back(feet.back() + random.uniform(0.05, 1));
    Crossing c;
    c.a = {{{}, {feet.back(), 0, 0}, {0, 2, 0}}};
    for (std::size_t i = 1; i + 1 < feet.size(); ++i) {
        const double over = random.uniform(0.02, 1), under = random.uniform(0.02, 1);
        c.b.push_back({{feet[i], -beside, -under}, {0, 0, over + under}, {0, 2 + 2 * beside, 0}});
        // Half-way to the next fin, or to the plate's end.
        const double left = (feet[i] - feet[i - 1]) * (i == 1 ? 1 : 0.5),
                     right = (feet[i + 1] - feet[i]) * (i + 2 == feet.size() ? 1 : 0.5);
        c.depth = std::max(c.depth, std::min({over, under, left, right}));
    }
    return c;
}

/// The part of a convex polygon where dot(normal, x) is at least `from`.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Vec3& normal, double from) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = dot(normal, p) - from, at_q = dot(normal, q) - from;
        if (at_p >= 0)
            kept.push_back(p);
        if ((at_p < 0) != (at_q < 0))
            kept.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    return kept;
}

/// How far one plate goes beyond another one on the side on which it goes less far, up to the planes through
/// the border of that one; 0 if they cross along less than `least`.
double beyond(const Plate& plate, const Plate& other, double least) {
    const Vec3 normal = normalized_or_zero(cross(other.u, other.v));
    std::vector<Vec3> part{plate.at(0, 0), plate.at(1, 0), plate.at(1, 1), plate.at(0, 1)};
    for (const auto& [on, side, across] : {std::tuple(other.at(0, 0), other.u, other.v),
                                           std::tuple(other.at(0, 0), other.v, other.u),
                                           std::tuple(other.at(1, 1), other.u, -other.v),
                                           std::tuple(other.at(1, 1), other.v, -other.u)}) {
        const Vec3 upright = normalized_or_zero(cross(normal, side));
        const Vec3 inward = dot(upright, across) > 0 ? upright : -upright;
        part = clipped(part, inward, dot(inward, on));
    }
    const double height = dot(normal, other.corner);
    double over = 0, under = 0, common = 0;
    for (const Vec3& p : part)
        over = std::max(over, dot(normal, p) - height),
        under = std::max(under, height - dot(normal, p));
    const std::vector<Vec3> line = clipped(clipped(part, normal, height), -normal, -height);
    for (const Vec3& p : line)
        common = std::max(common, length(p - line[0]));
    return common < least ? 0 : std::min(over, under);
}

/// Two parallelograms, often narrow, that cross anyhow.
Crossing strips(Random& random) {
    const auto plate = [&] {
        const Vec3 u = random.uniform(0.5, 3) * random.direction(), v = random.direction();
        const Vec3 across = normalized_or_zero(v - (dot(u, v) / dot(u, u)) * u);
        const double width =
            random.chance(0.6) ? random.uniform(0.005, 0.05) : random.uniform(0.1, 2);
        const Vec3 skewed = width * (across + random.uniform(-1, 1) * normalized_or_zero(u));
        return Plate{{}, u, skewed};
    };
    for (;;) {
        Plate a = plate(), b = plate();
        if (length(cross(normalized_or_zero(cross(a.u, a.v)),
                         normalized_or_zero(cross(b.u, b.v)))) < 0.2)
            continue;
        // A point of one lies on the other.
        b.corner = a.at(random.uniform(0.02, 0.98), random.uniform(0.1, 0.9)) -
                   (b.at(random.uniform(0.02, 0.98), random.uniform(0.1, 0.9)) - b.corner);
        const double least = 1e-3, depth = std::min(beyond(a, b, least), beyond(b, a, least));
        if (depth > 1e-3)
            return {{a}, {b}, depth};
    }
}

/// Places where coordinates are rounded by at most 2^-36.
Transform somewhere(Random& random) {
    switch (random.integer(0, 3)) {
    case 0:
        return {};
    case 1:
        return random.pose(1);
    case 2:
        return random.pose(1e4);
    default:
        return Pose{random.in_cube(1e3), {1, 0, 0, 0}};
    }
}

TEST(CrossingPlates, AreHardOrTouchForAnyTriangles) {
    Random random(20'261'128);
    const int rounds = many(600);
    for (int round = 0; round < rounds; ++round) {
        const Crossing c = random.chance(0.3)   ? strips(random)
                           : random.chance(0.6) ? tilted_fin(random)
                                                : upright_fins(random);
        const Mesh a = divided(random, c.a), b = divided(random, c.b);
        const Transform world = somewhere(random);
        for (const bool swap : {false, true}) {
            SCOPED_TRACE("round " + std::to_string(round) + (swap ? ", swapped" : ""));
            const Mesh &first = swap ? b : a, &second = swap ? a : b;
            const auto above = classified(first, second, 1.001 * c.depth, world, world),
                       below = classified(first, second, 0.999 * c.depth, world, world);
            ASSERT_TRUE(above && below);
            ASSERT_EQ(above->kind, ClashKind::touch) << above->distance << " of " << c.depth;
            ASSERT_EQ(below->kind, ClashKind::hard) << below->distance << " of " << c.depth;
            const double of_depth = random.uniform(0.001, 0.9);
            const auto deep = classified(first, second, of_depth * c.depth, world, world);
            ASSERT_TRUE(deep);
            ASSERT_EQ(deep->kind, ClashKind::hard);
            // Where no corner reaches the depth, it is found to 2^-15.
            ASSERT_NEAR(-deep->distance, c.depth, 4e-5 * c.depth + 1e-9) << of_depth;
        }
    }
}

} // namespace
} // namespace abut::test
