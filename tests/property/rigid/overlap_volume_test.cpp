// The volume that two solids have in common: against closed forms, and against counted points.

#include "rigid/penetration/overlap_volume.h"
#include "rigid/solid/placed_solid.h"
#include "tests/support/body.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>

namespace abut::test {
namespace {

Transform at(const Vec3& p) {
    return Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, p.x, p.y, p.z});
}

OverlapVolume common(const Body& a, const Transform& world_a, const Body& b,
                     const Transform& world_b) {
    const PlacedSolid placed_a(a.model, a.solid, world_a), placed_b(b.model, b.solid, world_b);
    const auto found = overlap_volume(placed_a, placed_b);
    EXPECT_TRUE(found);
    return found.value_or(OverlapVolume{-1, 0});
}

Body box_body(const Vec3& lower, const Vec3& upper) {
    return Body(box_mesh(lower, upper));
}

/// Volume of the tetrahedra of a mesh over the origin.
double volume_of(const Mesh& mesh) {
    double sum = 0;
    for (const auto& [i, j, k] : mesh.triangles)
        sum += dot(mesh.positions[i], cross(mesh.positions[j], mesh.positions[k])) / 6;
    return sum;
}

/// Boxes on a coarse lattice share faces, edges and corners all the time.
TEST(OverlapVolume, OfBoxesIsTheProductOfTheCommonEdges) {
    Random random(7301);
    std::size_t apart = 0, flush = 0;
    double largest = 0;
    for (int round = 0; round < many(400); ++round) {
        const auto random_box = [&] {
            const Vec3 lower = random.on_lattice(4);
            return Box3{lower, lower + random.on_lattice(3) + Vec3{1, 1, 1}};
        };
        const Box3 a = random_box(), b = random_box();
        double expected = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const double from = std::max(component(a.lower, axis), component(b.lower, axis));
            const double to = std::min(component(a.upper, axis), component(b.upper, axis));
            expected *= std::max(0.0, to - from);
            flush += component(a.upper, axis) == component(b.upper, axis) ? 1 : 0;
        }
        apart += expected == 0 ? 1 : 0;
        const double scale = std::pow(10.0, random.integer(-3, 3));
        const Vec3 far = random.chance(0.5) ? Vec3{} : random.in_cube(1e6);
        const Transform world =
            compose(at(far), Transform({scale, 0, 0, 0, scale, 0, 0, 0, scale}));
        const OverlapVolume found =
            common(box_body(a.lower, a.upper), world, box_body(b.lower, b.upper), world);
        EXPECT_LE(std::abs(found.volume - expected * scale * scale * scale), found.error)
            << "round " << round << " scale " << scale;
        // Far from the origin, positions are rounded: that moves faces, and the error counts it.
        const double moved = 0x1p-50 * max_abs(far) * 400 * scale * scale;
        EXPECT_LE(found.error, 1e-8 * scale * scale * scale + moved);
        largest = std::max(largest, std::abs(found.volume / std::pow(scale, 3) - expected));
    }
    std::cout << apart << " apart, " << flush << " flush, largest error " << largest << '\n';
    EXPECT_GT(apart, many(400) / 20);
    EXPECT_LT(apart, many(400) * 9 / 10);
    EXPECT_GT(flush, many(400) / 20);
}

/// A rotated pair has the volume of the pair before.
TEST(OverlapVolume, OfManyComponentsIsTheSumOfTheirs) {
    Mesh crates;
    for (int i = 0; i < 216; ++i) {
        const Vec3 corner{static_cast<double>(i % 6), static_cast<double>(i / 6 % 6),
                          static_cast<double>(i / 36)};
        crates = joined(crates, box_mesh(corner, corner + Vec3{0.5, 0.5, 0.5}));
    }
    // The last of six layers is cut in the middle.
    const OverlapVolume found = common(box_body({-1, -1, -1}, {5.25, 7, 7}), {}, Body(crates), {});
    EXPECT_NEAR(found.volume, 5.5 * 36 * 0.125, found.error);
}

TEST(OverlapVolume, OfRotatedBoxesIsThatOfTheBoxes) {
    Random random(7302);
    for (int round = 0; round < many(200); ++round) {
        const Transform world = random.pose(10);
        const Vec3 shift = random.on_lattice(2);
        const OverlapVolume found =
            common(box_body({0, 0, 0}, {2, 2, 2}), world,
                   box_body(shift + Vec3{-0.5, 0, 0.5}, shift + Vec3{1, 1, 1}), world);
        double expected = std::max(0.0, std::min(2.0, shift.x + 1) - std::max(0.0, shift.x - 0.5));
        expected *= std::max(0.0, std::min(2.0, shift.y + 1) - shift.y);
        expected *= std::max(0.0, std::min(2.0, shift.z + 1) - (shift.z + 0.5));
        EXPECT_NEAR(found.volume, expected, found.error + 1e-13) << "round " << round;
    }
}

/// Two cubes, one turned by 45 degrees about z: the common solid is a regular octagonal prism.
TEST(OverlapVolume, OfACubeAndATurnedOneIsAnOctagon) {
    const double h = std::numbers::sqrt2 / 2;
    const Transform turned({h, h, 0, -h, h, 0, 0, 0, 1, 0, 0, 0});
    const Body cube = box_body({-1, -1, -1}, {1, 1, 1});
    const OverlapVolume found = common(cube, Transform(), cube, turned);
    EXPECT_NEAR(found.volume, 8 * (std::numbers::sqrt2 - 1) * 2, found.error + 1e-14);
}

TEST(OverlapVolume, OfASolidWithItselfIsItsVolume) {
    for (const Mesh& mesh : {torus_mesh(1, 0.4, 24, 12), sphere_mesh(0.8, 18, 10),
                             ring_mesh(-0.2, 0.3, 0.5, 0.9, 14)}) {
        const Body body(mesh);
        const OverlapVolume found = common(body, Transform(), body, Transform());
        EXPECT_NEAR(found.volume, std::abs(volume_of(mesh)), found.error);
        const PlacedSolid placed(body.model, body.solid, Transform());
        const auto whole = solid_volume(placed);
        ASSERT_TRUE(whole);
        EXPECT_NEAR(whole->volume, std::abs(volume_of(mesh)), whole->error);
    }
}

TEST(OverlapVolume, OfAPartInsideIsItsVolume) {
    const Mesh torus = torus_mesh(1, 0.4, 24, 12);
    const Body outer = box_body({-5, -5, -5}, {5, 5, 5}), inner(torus);
    const OverlapVolume found = common(outer, Transform(), inner, Transform());
    EXPECT_NEAR(found.volume, volume_of(torus), found.error);
}

TEST(OverlapVolume, OfOpenSurfacesIsNotFound) {
    const Body open(open_box_mesh({0, 0, 0}, {1, 1, 1})), box = box_body({0, 0, 0}, {2, 2, 2});
    const PlacedSolid a(open.model, open.solid, Transform()), b(box.model, box.solid, Transform());
    EXPECT_FALSE(overlap_volume(a, b));
    EXPECT_FALSE(overlap_volume(b, a));
    EXPECT_FALSE(solid_volume(a));
}

/// Tori, spheres, rings and mirrored solids: points of the common box are counted that lie in both.
TEST(OverlapVolume, AgreesWithCountedPoints) {
    Random random(7303);
    std::size_t found_some = 0;
    for (int round = 0; round < many(30); ++round) {
        const auto random_body = [&] {
            switch (random.integer(0, 3)) {
            case 0:
                return Body(torus_mesh(1, 0.4, random.integer(5, 24), random.integer(4, 12)));
            case 1:
                return Body(sphere_mesh(0.9, random.integer(5, 18), random.integer(4, 10)));
            case 2:
                return Body(ring_mesh(-0.2, 0.3, 0.5, 0.9, random.integer(5, 14)));
            default:
                return box_body({-0.8, -0.5, -0.3}, {0.7, 0.6, 0.4});
            }
        };
        const Body a = random_body(), b = random_body();
        const Vec3 far = random.chance(0.3) ? random.in_cube(1e5) : Vec3{};
        const Transform world_a = compose(at(far), random.linear_map(random.chance(0.3)));
        const Transform world_b =
            compose(at(far + random.in_cube(0.7)), random.linear_map(random.chance(0.3)));
        const PlacedSolid placed_a(a.model, a.solid, world_a), placed_b(b.model, b.solid, world_b);
        const OverlapVolume found = common(a, world_a, b, world_b);
        EXPECT_NEAR(found.volume, common(b, world_b, a, world_a).volume, 2 * found.error + 1e-12);
        const Box3 box_a = placed_a.world_box(), box_b = placed_b.world_box();
        const Box3 box{max(box_a.lower, box_b.lower), min(box_a.upper, box_b.upper)};
        const Vec3 size = box.upper - box.lower;
        if (is_empty(box))
            continue;
        constexpr int kPoints = 4000;
        int inside = 0;
        for (int i = 0; i < kPoints; ++i) {
            const Vec3 p =
                box.lower + Vec3{random.uniform(0, 1) * size.x, random.uniform(0, 1) * size.y,
                                 random.uniform(0, 1) * size.z};
            inside += placed_a.contains(p) && placed_b.contains(p) ? 1 : 0;
        }
        const double whole = size.x * size.y * size.z, share = double(inside) / kPoints;
        const double deviation = whole * std::sqrt(std::max(share * (1 - share), 1e-3) / kPoints);
        EXPECT_NEAR(found.volume, share * whole, 5 * deviation) << "round " << round;
        found_some += inside > 0 ? 1 : 0;
    }
    EXPECT_GT(found_some, static_cast<std::size_t>(many(30)) / 2);
}

} // namespace
} // namespace abut::test
