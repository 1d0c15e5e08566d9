// Shells that overlap or share faces, flush with each other and with another solid, turned and moved
// in doubles: faces that were meant to coincide are apart by rounding. The oracle counts the cells of
// the boxes before they are turned.

#include <abut/shape_queries.h>

#include "rigid/penetration/overlap_volume.h"
#include "tests/support/body.h"
#include "tests/support/lattice_shells.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/solids.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace abut::test {
namespace {

/// The rotation by an angle about an axis of unit length, then a move.
Transform turn(const Vec3& axis, double degrees, const Vec3& move) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const auto [x, y, z] = axis;
    const double d = 1 - c;
    return Transform({c + d * x * x, d * x * y + s * z, d * x * z - s * y, d * x * y - s * z,
                      c + d * y * y, d * y * z + s * x, d * x * z + s * y, d * y * z - s * x,
                      c + d * z * z, move.x, move.y, move.z});
}

const Vec3 kAskew = (1 / std::sqrt(14.0)) * Vec3{1, 2, 3};

/// A rotation about any axis, or about an axis of the lattice, by any angle or by whole degrees; and a
/// move: none, a few units, or far away.
Transform turned(Random& random) {
    const double degrees =
        random.chance(0.5) ? 15.0 * random.integer(0, 23) : random.uniform(0, 360);
    const Vec3 axis = random.chance(0.3)   ? Vec3{0, 0, 1}
                      : random.chance(0.3) ? kAskew
                                           : random.direction();
    const Vec3 move = random.chance(0.3)   ? Vec3{}
                      : random.chance(0.7) ? random.in_cube(100)
                                           : random.in_cube(1e6);
    return turn(axis, degrees, move);
}

/// A bar whose end is bent up, back and down onto the bar again: one shell, of which an end face lies on
/// a side that is larger.
Mesh bar_bent_onto_itself() {
    const std::vector<Vec3> outline{{-1, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 1, 0},
                                    {1, 1, 0},  {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {-1, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> caps{
        {0, 1, 8}, {0, 8, 9}, {1, 7, 8}, {1, 2, 7}, {2, 3, 6}, {2, 6, 7}, {3, 4, 5}, {3, 5, 6}};
    Mesh m;
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const double z : {0.0, 1.0})
        for (const Vec3& p : outline)
            m.positions.push_back({p.x, p.y, z});
    for (const auto& [a, b, c] : caps) {
        m.triangles.push_back({a, c, b});
        m.triangles.push_back({n + a, n + b, n + c});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        m.triangles.push_back({i, j, n + j});
        m.triangles.push_back({i, n + j, n + i});
    }
    return m;
}

int common_cells(const Cells& a, const Cells& b) {
    int common = 0;
    for (std::size_t c = 0; c < a.filled.size(); ++c)
        common += a.filled.at(c) && b.filled.at(c) ? 1 : 0;
    return common;
}

/// The volume that two solids have in common, each under a transform or with turned vertices.
TEST(TurnedUnions, CommonVolumes) {
    Random random(3271);
    int common_count = 0, unions = 0;
    for (int i = 0; i < many(400); ++i) {
        SCOPED_TRACE(i);
        const Shells a = random_shells(random, random.integer(1, 4)),
                     b = random_shells(random, random.integer(1, 3));
        const double size = random.chance(0.6) ? 1 : random.chance(0.5) ? 1e-3 : 1e3;
        const double mirror = random.chance(0.2) ? -size : size;
        const Transform world = compose(turned(random), scaling(mirror, size, size));
        const bool baked_a = random.chance(0.5), baked_b = random.chance(0.5);
        const Body body_a(baked_a ? transformed(a.mesh, world) : a.mesh,
                          baked_a ? Transform{} : world),
            body_b(baked_b ? transformed(b.mesh, world) : b.mesh, baked_b ? Transform{} : world);
        const int common = common_cells(a.cells, b.cells);
        common_count += common > 0 ? 1 : 0;
        unions += body_a.placed.boundary() != nullptr || body_b.placed.boundary() != nullptr;
        const auto found = overlap_volume(body_a.placed, body_b.placed);
        ASSERT_TRUE(found);
        const double volume = size * size * size * common;
        ASSERT_LE(std::abs(found->volume - volume), found->error) << found->volume << ' ' << volume;
        const double far = std::abs(world.m[9]) + std::abs(world.m[10]) + std::abs(world.m[11]);
        ASSERT_LE(found->error, size * size * (1e-6 * size + 1e-8 * far));
    }
    EXPECT_GT(common_count, many(400) / 3);
    EXPECT_GT(unions, many(400) / 3);
}

/// Boxes with vertices in the middle of their edges and faces, many of them inside flush faces of the other
/// solid. At an edge in the plane of a face, rounding decides where the edge passes the plane.
TEST(TurnedUnions, VerticesInsideFlushFaces) {
    Random random(3274);
    int common_count = 0;
    for (int i = 0; i < many(150); ++i) {
        SCOPED_TRACE(i);
        std::array<Cells, 2> cells;
        std::array<Mesh, 2> meshes;
        for (std::size_t k = 0; k < 2; ++k)
            for (int boxes = random.integer(1, 3); boxes > 0; --boxes) {
                const Shells box = random_shells(random, 1);
                meshes.at(k) =
                    joined(meshes.at(k), random.chance(0.6) ? subdivided(box.mesh) : box.mesh);
                for (std::size_t c = 0; c < box.cells.filled.size(); ++c)
                    cells.at(k).filled.at(c) |= box.cells.filled.at(c);
            }
        const int common = common_cells(cells[0], cells[1]);
        common_count += common > 0 ? 1 : 0;
        const Transform world = turned(random);
        const Body a(meshes[0], world), b(meshes[1], world);
        const auto found = overlap_volume(a.placed, b.placed);
        ASSERT_TRUE(found);
        ASSERT_LE(std::abs(found->volume - common), found->error);
        const double far = std::abs(world.m[9]) + std::abs(world.m[10]) + std::abs(world.m[11]);
        ASSERT_LE(found->error, 1e-6 + 1e-8 * far);
    }
    EXPECT_GT(common_count, many(150) / 3);
}

/// Contents, depths and volumes of one solid with turned vertices.
TEST(TurnedUnions, InsideDepthAndVolume) {
    Random random(3272);
    int hidden = 0, inside = 0;
    for (int i = 0; i < many(150); ++i) {
        SCOPED_TRACE(i);
        const Shells s = random_shells(random, random.integer(2, 5));
        const Transform world = turned(random);
        const double far = std::abs(world.m[9]) + std::abs(world.m[10]) + std::abs(world.m[11]);
        const double rounding = 1e-9 + 1e-13 * far * 100;
        const Body body(transformed(s.mesh, world));
        ASSERT_TRUE(body.placed.knows_boundary());
        hidden += body.placed.boundary() != nullptr ? 1 : 0;
        for (int k = 0; k < 40; ++k) {
            Vec3 p = random.in_cube(0.5 * kCells + 0.5);
            p = p + Vec3{0.5 * kCells, 0.5 * kCells, 0.5 * kCells};
            const double distance = s.cells.distance(p);
            if (distance < 1e-3)
                continue;
            const bool is_inside = s.cells.side(p) == Side::inside;
            inside += is_inside ? 1 : 0;
            const Vec3 q = apply(world, p);
            ASSERT_EQ(contains(body.model, {}, q).side, s.cells.side(p));
            const Nearest found = nearest(body.model, {}, q, {.signed_distance = true});
            ASSERT_NEAR(found.distance, is_inside ? -distance : distance, rounding)
                << p.x << ' ' << p.y << ' ' << p.z;
        }
        const auto volume = solid_volume(body.placed);
        ASSERT_TRUE(volume);
        ASSERT_LE(std::abs(volume->volume - s.cells.count()), volume->error);
        ASSERT_LE(volume->error, 1e-6 + 1e-8 * far);
    }
    EXPECT_GT(hidden, many(150) / 3);
    EXPECT_GT(inside, many(150) * 5);
}

/// Prisms on one axis whose shells overlap, so that their sides lie on each other, in a slab that they end
/// flush with; and a shell whose two legs touch each other.
TEST(TurnedUnions, PrismsOnOneAxisAndLegsThatTouch) {
    Random random(3273);
    for (int i = 0; i < many(60); ++i) {
        SCOPED_TRACE(i);
        const int corners = random.integer(3, 12);
        std::vector<Vec3> polygon;
        double area = 0;
        for (int k = 0; k < corners; ++k) {
            const double angle = 2 * std::numbers::pi * k / corners;
            polygon.push_back({std::cos(angle), std::sin(angle), 0});
        }
        for (std::size_t k = 0; k < polygon.size(); ++k)
            area += 0.5 * cross(polygon[k], polygon[(k + 1) % polygon.size()]).z;
        const double low = 0.25 * random.integer(0, 3), top = 0.25 * random.integer(5, 8);
        const Mesh lower = star_prism(polygon, 1),
                   upper = transformed(star_prism(polygon, top - low),
                                       Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, low}));
        const Mesh slab = box_mesh({-1, -1, 0}, {1, 1, top});
        const Transform world = turned(random);
        const bool baked = random.chance(0.5);
        const auto placed = [&](const Mesh& m) { return baked ? transformed(m, world) : m; };
        const Transform place = baked ? Transform{} : world;
        const Body body(placed(joined(lower, upper)), place), beside(placed(slab), place);
        const double far = std::abs(world.m[9]) + std::abs(world.m[10]) + std::abs(world.m[11]);
        const auto alone = solid_volume(body.placed);
        ASSERT_TRUE(alone);
        ASSERT_LE(std::abs(alone->volume - area * top), alone->error);
        ASSERT_LE(alone->error, 1e-6 + 1e-8 * far);
        const auto found = overlap_volume(body.placed, beside.placed);
        ASSERT_TRUE(found);
        ASSERT_LE(std::abs(found->volume - area * top), found->error);
        ASSERT_LE(found->error, 1e-6 + 1e-8 * far);
        const Mesh bent = joined(bar_bent_onto_itself(), box_mesh({0, 0, 1}, {3, 3, 2})),
                   through = box_mesh({0, 1, -1}, {3, 2, 2});
        const Body body_bent(placed(bent), place), body_through(placed(through), place);
        const auto in_bent = overlap_volume(body_bent.placed, body_through.placed);
        ASSERT_TRUE(in_bent);
        ASSERT_LE(std::abs(in_bent->volume - 5), in_bent->error); // 2 of the bar, 3 of the slab
        ASSERT_LE(in_bent->error, 1e-6 + 1e-8 * far);
    }
}

/// The clash job tells the same volume: two boxes that overlap, one mesh, with a slab that is flush.
TEST(TurnedUnions, VolumeOfAClash) {
    const Mesh a = joined(box_mesh({0, 0, 0}, {2, 1, 1}), box_mesh({1, 0.1, 0.1}, {3, 0.9, 0.9})),
               b = box_mesh({0, 0, 0.5}, {3, 1, 2});
    for (const double degrees : {0.0, 10.0, 30.0, 40.0, 45.0, 90.0, 137.0}) {
        SCOPED_TRACE(degrees);
        const Transform world = turn(kAskew, degrees, {});
        const auto found = overlap_volume(Body(a, world).placed, Body(b, world).placed);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->volume, 1.32, 1e-8);
        EXPECT_LE(std::abs(found->volume - 1.32), found->error);
        EXPECT_LE(found->error, 1e-6);
    }
}

} // namespace
} // namespace abut::test
