// Solids whose mesh has faults: shells that overlap, duplicates, cavities, sheets. The oracle counts
// the unit cells of boxes on a lattice.

#include <abut/convex_pieces.h>
#include <abut/penetration.h>
#include <abut/rigid.h>
#include <abut/shape_queries.h>

#include "clash/mesh_in_blocks.h"
#include "geometry/point_triangle_distance.h"
#include "rigid/penetration/overlap_volume.h"
#include "rigid/solid/placed_blocks.h"
#include "rigid/solid/placed_solid.h"
#include "tests/support/body.h"
#include "tests/support/lattice_shells.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace abut::test {
namespace {

/// Adds copies of random triangles: some, thousands, or one of each.
void add_duplicates(Random& random, Mesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    if (random.chance(0.2)) {
        for (std::size_t i = 0; i < count; ++i)
            mesh.triangles.push_back(mesh.triangles[i]);
        return;
    }
    const bool is_one_box = count == 12;
    const int copies = is_one_box && random.chance(0.3) ? 2000 : random.integer(1, 12);
    for (int i = 0; i < copies; ++i)
        mesh.triangles.push_back(mesh.triangles[std::size_t(random.integer(0, int(count) - 1))]);
}

void shuffle_triangles(Random& random, Mesh& mesh) {
    for (std::size_t i = mesh.triangles.size(); i > 1; --i)
        std::swap(mesh.triangles[i - 1],
                  mesh.triangles[std::size_t(random.integer(0, int(i) - 1))]);
}

Vec3 random_point(Random& random) {
    const auto coordinate = [&] {
        return random.chance(0.5) ? 0.5 * random.integer(-1, 2 * kCells + 1)
                                  : random.uniform(-0.5, kCells + 0.5);
    };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
}

/// Power-of-two scales, mirrors and moves, which round nothing.
Transform exact_placement(Random& random) {
    const double size = std::ldexp(1, random.integer(-1, 1));
    const auto sign = [&] { return random.chance(0.5) ? -size : size; };
    const double x = sign(), y = sign(), z = sign();
    return Transform({x, 0, 0, 0, y, 0, 0, 0, z, double(random.integer(-9, 9)), 4, -7});
}

/// Asks all queries about points, against the cells.
void check(Random& random, const Shells& s, int points) {
    const Model model(s.mesh);
    const Transform world = exact_placement(random);
    const double size = std::abs(world.m[0]);
    const Body body(s.mesh, world);
    const auto blocks = in_blocks(s.mesh, 16);
    const PlacedBlocks placed_blocks(*blocks, world);
    ASSERT_TRUE(body.solid.closed);
    ASSERT_TRUE(body.placed.knows_boundary());
    ASSERT_TRUE(blocks->solid().closed);
    int inside = 0;
    for (int i = 0; i < points; ++i) {
        const Vec3 p = random_point(random), q = apply(world, p);
        const Side side = s.cells.side(p);
        inside += side == Side::inside ? 1 : 0;
        const Containment found = contains(model, world, q);
        ASSERT_EQ(found.side, side) << p.x << ' ' << p.y << ' ' << p.z;
        ASSERT_EQ(found.method, ContainmentMethod::crossings);
        ASSERT_EQ(body.placed.contains(q), side == Side::inside);
        if (!body.placed.model().on_surface(q)) {
            ASSERT_EQ(placed_blocks.contains(q), side == Side::inside);
        }
        const Nearest nearest_point =
            nearest(model, world, q, NearestOptions{.signed_distance = true});
        const double distance = size * s.cells.distance(p);
        ASSERT_NEAR(nearest_point.distance, side == Side::inside ? -distance : distance, 1e-12)
            << p.x << ' ' << p.y << ' ' << p.z;
        ASSERT_NEAR(length(nearest_point.point - q), distance, 1e-12);
        ASSERT_NEAR(body.placed.nearest(q, HUGE_VAL).distance, distance, 1e-12);
    }
    ASSERT_LT(inside, points);
    const auto volume = solid_volume(body.placed);
    ASSERT_TRUE(volume);
    ASSERT_LE(std::abs(volume->volume - size * size * size * s.cells.count()), volume->error);
    ASSERT_LE(volume->error, 1e-6);
}

TEST(UnionOfShells, BoxesOnALattice) {
    Random random(3201);
    int overlap = 0, hidden = 0;
    for (int i = 0; i < many(150); ++i) {
        SCOPED_TRACE(i);
        const Shells s = random_shells(random, random.integer(2, 5));
        const Model model(s.mesh);
        overlap += model.data().solid().may_overlap ? 1 : 0;
        hidden += model.data().boundary().boundary != nullptr ? 1 : 0;
        check(random, s, 60);
        if (HasFatalFailure())
            return;
    }
    EXPECT_GT(overlap, many(150) / 2);
    EXPECT_GT(hidden, many(150) / 2);
}

/// Boxes that share faces, each turned inside out or not: cells of a grid of 2 by 2 by 2, so that no box
/// has neighbours all around.
TEST(UnionOfShells, BoxesThatShareFacesAndAreTurnedInsideOut) {
    Random random(3210);
    int mixed = 0;
    for (int i = 0; i < many(60); ++i) {
        SCOPED_TRACE(i);
        Shells s;
        int inwards = 0, boxes = 0;
        const bool are_fine = random.chance(0.3);
        for (int cell = 0; cell < 8; ++cell) {
            if (!random.chance(0.7))
                continue;
            const Vec3 low{2.0 * (cell & 1) + 1, double(cell >> 1 & 1), double(cell >> 2)},
                top = low + Vec3{2, 1, 1};
            Mesh box = random_box_mesh(random, low, top);
            if (are_fine)
                box = subdivided(box);
            const bool is_inwards = random.chance(0.5);
            s.mesh = joined(s.mesh, is_inwards ? reversed(box) : box);
            s.cells.set(low, top, true);
            inwards += is_inwards ? 1 : 0, ++boxes;
        }
        if (boxes == 0)
            continue;
        mixed += inwards > 0 && inwards < boxes ? 1 : 0;
        if (random.chance(0.5))
            shuffle_triangles(random, s.mesh);
        check(random, s, 40);
        if (HasFatalFailure())
            return;
    }
    EXPECT_GT(mixed, many(60) / 2);
}

TEST(UnionOfShells, InwardsAsAWholeAndInAnyOrder) {
    Random random(3202);
    for (int i = 0; i < many(40); ++i) {
        SCOPED_TRACE(i);
        Shells s = random_shells(random, 3);
        s.mesh = reversed(s.mesh);
        shuffle_triangles(random, s.mesh);
        check(random, s, 40);
        if (HasFatalFailure())
            return;
    }
}

TEST(UnionOfShells, DuplicatesChangeNothing) {
    Random random(3203);
    for (int i = 0; i < many(80); ++i) {
        SCOPED_TRACE(i);
        Shells s = random_shells(random, random.integer(1, 3));
        add_duplicates(random, s.mesh);
        if (random.chance(0.5))
            shuffle_triangles(random, s.mesh);
        check(random, s, 40);
        if (HasFatalFailure())
            return;
    }
}

/// One box of which some triangles are there a second time, reversed; and all of them.
TEST(UnionOfShells, ReversedDuplicatesChangeNothing) {
    Random random(3204);
    for (int i = 0; i < many(60); ++i) {
        SCOPED_TRACE(i);
        Shells s = random_shells(random, 1);
        const std::size_t copies = i % 4 == 0 ? 12 : std::size_t(random.integer(1, 6));
        for (std::size_t k = 0; k < copies; ++k) {
            auto t = s.mesh.triangles[(5 * k + std::size_t(i)) % 12];
            std::swap(t[0], t[1]);
            s.mesh.triangles.push_back(t);
        }
        shuffle_triangles(random, s.mesh);
        check(random, s, 30);
        if (HasFatalFailure())
            return;
    }
}

/// Shells that face inwards within another one are cavities, and what lies in them is solid.
TEST(UnionOfShells, Cavities) {
    Random random(3205);
    for (int i = 0; i < many(40); ++i) {
        SCOPED_TRACE(i);
        Shells s;
        s.mesh = box_mesh({0, 0, 0}, {5, 5, 5});
        s.cells.set({0, 0, 0}, {5, 5, 5}, true);
        const bool also_inside = random.chance(0.5), flush = random.chance(0.3);
        const Vec3 lower{1, 1, flush ? 0.0 : 1.0};
        s.mesh = joined(s.mesh, reversed(random_box_mesh(random, lower, {4, 4, 4})));
        s.cells.set(lower, {4, 4, 4}, false);
        if (also_inside) {
            s.mesh = joined(s.mesh, box_mesh({2, 2, 2}, {3, 3, 3}));
            s.cells.set({2, 2, 2}, {3, 3, 3}, true);
        }
        if (random.chance(0.5))
            s.mesh = reversed(s.mesh);
        if (!flush) {
            check(random, s, 60);
        } else {
            // The common faces lie between outside and outside: they are sheets.
            const Body body(s.mesh);
            for (int k = 0; k < 60; ++k) {
                const Vec3 p = random_point(random);
                if (!body.placed.model().on_surface(p)) {
                    ASSERT_EQ(body.placed.contains(p), s.cells.side(p) == Side::inside);
                }
            }
            const auto volume = solid_volume(body.placed);
            ASSERT_TRUE(volume);
            ASSERT_NEAR(volume->volume, s.cells.count(), 1e-6);
        }
        if (HasFatalFailure())
            return;
    }
}

/// Boxes side by side of which some face inwards: no orientation can be trusted, and all are solid.
TEST(UnionOfShells, ShellsThatFaceDifferentWaysAreAllSolid) {
    Random random(3206);
    for (int i = 0; i < many(40); ++i) {
        SCOPED_TRACE(i);
        Shells s;
        for (int k = 0; k < 3; ++k) {
            const Vec3 lower{double(random.integer(0, 1)), double(k), double(k)},
                upper{5, double(std::min(k + random.integer(1, 2), 5)), double(k + 2)};
            const Mesh box = random_box_mesh(random, lower, upper);
            s.mesh = joined(s.mesh, random.chance(0.5) ? reversed(box) : box);
            s.cells.set(lower, upper, true);
        }
        check(random, s, 40);
        if (HasFatalFailure())
            return;
    }
}

TEST(UnionOfShells, CommonVolumes) {
    Random random(3207);
    for (int i = 0; i < many(60); ++i) {
        SCOPED_TRACE(i);
        const Shells a = random_shells(random, random.integer(2, 4)),
                     b = random_shells(random, random.integer(1, 3));
        const Transform world = exact_placement(random);
        const double size = std::abs(world.m[0]);
        const Body body_a(a.mesh, world), body_b(b.mesh, world);
        int common = 0;
        for (std::size_t c = 0; c < a.cells.filled.size(); ++c)
            common += a.cells.filled.at(c) && b.cells.filled.at(c) ? 1 : 0;
        const auto found = overlap_volume(body_a.placed, body_b.placed);
        ASSERT_TRUE(found);
        ASSERT_LE(std::abs(found->volume - size * size * size * common), found->error + 1e-9);
        ASSERT_LE(found->error, 1e-6);
    }
}

/// The distance of a point from all triangles.
double point_off_shells(const Mesh& mesh, const Vec3& point) {
    double least = HUGE_VAL;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        least = std::min(least, point_triangle_distance(point, corners(mesh, t)).distance_sq);
    return std::sqrt(least);
}

/// A small box inside the union is as deep as the union says, not as its shells do.
TEST(UnionOfShells, DepthIgnoresFacesInside) {
    Random random(3208);
    int inside = 0, beyond_shells = 0;
    for (int i = 0; i < many(120); ++i) {
        SCOPED_TRACE(i);
        const Shells s = random_shells(random, random.integer(2, 4));
        const Vec3 middle = random_point(random);
        const double half = 0.01;
        const Vec3 radius{half, half, half};
        if (s.cells.side(middle - radius) != Side::inside ||
            s.cells.side(middle + radius) != Side::inside || s.cells.distance(middle) < 0.1)
            continue;
        ++inside;
        const Mesh box = box_mesh(middle - radius, middle + radius);
        const double deepest = s.cells.distance(middle);
        const Gap gap =
            distance(Model(s.mesh), {}, Model(box), {}, DistanceOptions{.signed_distance = true});
        ASSERT_NEAR(-gap.distance, deepest, 0.01 * deepest + 2 * half);
        const Depth depth = penetration(Model(box), {}, Model(s.mesh), {});
        ASSERT_TRUE(depth.interpenetrate);
        ASSERT_NEAR(depth.depth, deepest, 0.01 * deepest + 2 * half);
        beyond_shells += point_off_shells(s.mesh, middle) < 0.9 * deepest ? 1 : 0;
    }
    EXPECT_GT(inside, many(120) / 20);
    EXPECT_GT(beyond_shells, inside / 10);
}

/// A sheet that hangs by an edge, or lies beside, or within: the box contains what it contains.
TEST(UnionOfShells, SheetsDoNotOpenASolid) {
    for (const Vec3& tip : {Vec3{-1, 0, -1}, Vec3{2, 2, 2}, Vec3{4, 4, 6}}) {
        Mesh mesh = box_mesh({0, 0, 0}, {5, 5, 5});
        mesh.positions.push_back(tip);
        mesh.triangles.push_back({0, 4, 8});
        const Body body(mesh);
        ASSERT_TRUE(body.solid.closed);
        EXPECT_TRUE(body.placed.contains({2.5, 1, 1}));
        EXPECT_FALSE(body.placed.contains({-0.5, 0.1, 0.1}));
        // A sheet inside is no boundary: the depth is that to the box.
        EXPECT_NEAR(nearest(body.model, {}, {1.25, 1.5, 2}, {.signed_distance = true}).distance,
                    -1.25, 1e-12);
    }
    // A separate sheet.
    Mesh sheet{{{7, 0, 0}, {8, 0, 0}, {7, 5, 0}}, {{0, 1, 2}}};
    const Body body(joined(box_mesh({0, 0, 0}, {5, 5, 5}), sheet));
    EXPECT_TRUE(body.solid.closed);
    EXPECT_TRUE(body.placed.contains({1, 1, 1}));
    EXPECT_FALSE(body.placed.contains({7.2, 1, 0.1}));
}

/// How often a mesh winds around a point, by the sum of its solid angles.
int winding(const Mesh& mesh, const Vec3& point) {
    return int(std::lround(winding_number(mesh, point)));
}

/// Solids that are turned and far away, in one mesh. The ball around a point inside whose radius is the
/// signed distance lies inside, and ends at the outside.
TEST(UnionOfShells, TurnedSolids) {
    Random random(3210);
    int inside = 0, twice = 0, balls = 0;
    for (int i = 0; i < many(40); ++i) {
        SCOPED_TRACE(i);
        std::vector<Mesh> shells;
        Mesh mesh;
        const Vec3 away = random.chance(0.3) ? random.in_cube(1e6) : Vec3{};
        for (int k = random.integer(2, 4); k > 0; --k) {
            Mesh shell = random.chance(0.5) ? torus_mesh(1, 0.4, 9, 6) : gear_mesh(4, 0.5, 1, 0.7);
            shell = transformed(shell, random.pose(0.7));
            for (Vec3& p : shell.positions)
                p = p + away;
            shells.push_back(shell);
            mesh = joined(mesh, shell);
        }
        if (random.chance(0.5))
            mesh = reversed(mesh);
        const Model model(mesh);
        ASSERT_TRUE(model.data().boundary().is_known);
        const auto is_inside = [&](const Vec3& p) {
            return std::ranges::any_of(shells, [&](const Mesh& m) { return winding(m, p) > 0; });
        };
        for (int k = 0; k < 30; ++k) {
            const Vec3 p = away + random.in_cube(1.5);
            if (nearest(model, {}, p).distance < 1e-3)
                continue;
            const bool expected = is_inside(p);
            ASSERT_EQ(contains(model, {}, p).side == Side::inside, expected);
            inside += expected ? 1 : 0;
            twice += std::abs(winding(mesh, p)) > 1 ? 1 : 0;
            if (!expected)
                continue;
            const Nearest found = nearest(model, {}, p, {.signed_distance = true});
            ASSERT_LT(found.distance, 0);
            const double radius = -found.distance;
            ASSERT_NEAR(length(found.point - p), radius, 1e-9);
            for (int n = 0; n < 40; ++n)
                ASSERT_TRUE(is_inside(p + radius * random.uniform(0, 0.999) * random.direction()));
            bool any_outside = false; // it may be in a narrow notch
            for (int n = 0; n < 4000 && !any_outside; ++n)
                any_outside = !is_inside(found.point + 1e-4 * random.direction());
            ASSERT_TRUE(any_outside);
            ++balls;
        }
    }
    EXPECT_GT(inside, many(40));
    EXPECT_GT(twice, inside / 20);
    EXPECT_GT(balls, many(40));
}

/// ConvexPieces of shells that overlap or share faces, and of duplicates: a small box is at distance
/// 0 if it lies inside, else as far as the cells.
TEST(UnionOfShells, ConvexPieces) {
    Random random(3209);
    int inside = 0, asked = 0;
    for (int i = 0; i < many(150); ++i) {
        SCOPED_TRACE(i);
        Shells s = random_shells(random, random.integer(2, 4));
        if (random.chance(0.3))
            add_duplicates(random, s.mesh);
        const ConvexPieces pieces{Model(s.mesh)};
        const Vec3 middle = random_point(random);
        const double half = 0.001;
        const Vec3 radius{half, half, half};
        const double off = s.cells.distance(middle);
        if (off < 0.01)
            continue;
        const ConvexPieces box{Model(box_mesh(middle - radius, middle + radius))};
        const bool is_inside = s.cells.side(middle) == Side::inside;
        ++asked, inside += is_inside ? 1 : 0;
        const double found = distance(pieces, Transform{}, box, Transform{}).distance;
        if (is_inside)
            ASSERT_EQ(found, 0);
        else
            ASSERT_NEAR(found, off, 2 * half);
        ASSERT_EQ(collide(pieces, Transform{}, box, Transform{}).meet, is_inside);
    }
    EXPECT_GT(asked, many(150) / 2);
    EXPECT_GT(inside, asked / 20);
}

} // namespace
} // namespace abut::test
