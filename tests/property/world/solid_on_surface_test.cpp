// Contacts of convex solids, balls and capsules on meshes: points on both surfaces and on one line along the
// normal, whatever the margin; and the same pairs and depths as other queries.

#include <abut/vector.h>
#include <abut/world.h>

#include "geometry/point_triangle_distance.h"
#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

Mesh random_ground(Random& random) {
    switch (random.integer(0, 4)) {
    case 0:
        return grid_mesh(8, 8, false, false, [](double u, double v) {
            return Vec3{4 * u - 2, 4 * v - 2, 0};
        });
    case 1: {
        const double height = random.uniform(0.01, 0.2), waves = random.uniform(3, 20);
        return grid_mesh(12, 12, false, false, [=](double u, double v) {
            return Vec3{4 * u - 2, 4 * v - 2, height * std::cos(waves * u) * std::cos(waves * v)};
        });
    }
    case 2:
        return sphere_mesh(1, 16, 12);
    case 3:
        return torus_mesh(1, 0.4, 16, 10);
    default:
        return box_mesh({-1, -1, -1}, {1, 1, 1});
    }
}

/// A convex solid, and the hull of its corners.
struct SolidAndHull {
    AnyShape shape;
    Convex hull;
};
SolidAndHull random_polyhedron(Random& random) {
    const Vec3 half{random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)};
    const Mesh box = box_mesh(-half, half);
    std::vector<Vec3> points;
    for (int i = random.integer(6, 20); i > 0; --i)
        points.push_back(0.4 * random.direction());
    const Convex hull(points);
    switch (random.integer(0, 3)) {
    case 0:
        return {Box3{-half, half}, Convex(box)};
    case 1:
        return {Model(box), Convex(box)};
    case 2:
        return {hull, hull};
    default:
        return {Model(hull.mesh()), hull};
    }
}

/// How far a point lies outside a hull; negative inside.
double outside(const Convex& hull, const Transform& world_from_hull, const Vec3& p) {
    double most = -HUGE_VAL;
    for (std::size_t f = 0; f < hull.face_count(); ++f) {
        const auto loop = hull.face(f);
        const auto corner = [&](std::size_t k) {
            return apply(world_from_hull, hull.vertices()[loop[k]]);
        };
        Vec3 area;
        for (std::size_t k = 2; k < loop.size(); ++k)
            area = area + cross(corner(k - 1) - corner(0), corner(k) - corner(0));
        most = std::max(most, dot(normalized_or_zero(area), p - corner(0)));
    }
    return most;
}

double distance_from_mesh(const Mesh& mesh, const Vec3& p) {
    double least_sq = HUGE_VAL;
    for (const auto& [i, j, k] : mesh.triangles)
        least_sq = std::min(least_sq, nearest_on_triangle(p, {mesh.positions[i], mesh.positions[j],
                                                              mesh.positions[k]})
                                          .distance_sq);
    return std::sqrt(least_sq);
}

/// A world of a solid and a mesh, in either order.
struct GroundAndSolid {
    World world;
    BodyId solid;
    bool solid_first;
    GroundAndSolid(const AnyShape& shape, const Pose& pose, const Mesh& mesh, bool first)
        : solid_first(first) {
        if (first)
            solid = test::add(world, shape, pose);
        world.add(Model(mesh), {});
        if (!first)
            solid = test::add(world, shape, pose);
    }
};

/// A pose in which the solid is about a gap from the mesh; a depth if it is negative.
Pose pose_at_gap(Random& random, const AnyShape& shape, const Mesh& mesh, double gap) {
    Pose pose = random.pose(1);
    if (random.chance(0.5)) {
        const double turn = random.chance(0.5) ? 0 : random.uniform(0, 3);
        pose.rotation = {std::cos(turn), 0, 0, std::sin(turn)};
    }
    GroundAndSolid pair(shape, pose, mesh, false);
    for (int step = 0; step < 3; ++step) {
        const std::vector<BodyGap> found = pair.world.within(10);
        if (found.empty() || found[0].normal == Vec3{})
            break;
        pose.translation = pose.translation + (gap - found[0].distance) * found[0].normal;
        pair.world.move(pair.solid, pose);
        if (gap < 0)
            break;
    }
    return pose;
}

double random_gap(Random& random) {
    const double size = std::pow(10, random.uniform(-9, -1.2));
    return random.chance(0.1) ? 0 : random.chance(0.5) ? -size : size;
}

void check_points(const std::vector<ContactManifold>& manifolds, double margin,
                  const GroundAndSolid& pair, const SolidAndHull& solid, const Pose& pose,
                  const Mesh& mesh) {
    for (const ContactManifold& m : manifolds) {
        std::set<std::uint64_t> names;
        EXPECT_NEAR(length(m.normal), 1, 1e-12);
        for (std::uint32_t i = 0; i < m.count; ++i) {
            const ContactPoint& p = m.points[i];
            names.insert(p.feature);
            const Vec3 on_solid = pair.solid_first ? p.point_a : p.point_b,
                       on_mesh = pair.solid_first ? p.point_b : p.point_a;
            // Where a face stands along the normal, to 2^-12, points are beside it by as much.
            EXPECT_NEAR(outside(solid.hull, pose, on_solid), 0, 1e-9 + 0x1p-12 * std::abs(p.depth));
            EXPECT_LE(distance_from_mesh(mesh, on_mesh), 1e-9);
            EXPECT_LE(p.depth, m.points[0].depth);
            EXPECT_GE(p.depth, -margin);
            for (std::uint32_t k = 0; k < i; ++k)
                EXPECT_GT(length(p.point_b - m.points[k].point_b), 1e-9);
        }
        EXPECT_EQ(names.size(), m.count);
    }
}

double deepest_of(const std::vector<ContactManifold>& manifolds) {
    double deepest = -HUGE_VAL;
    for (const ContactManifold& m : manifolds)
        deepest = std::max(deepest, m.points[0].depth);
    return deepest;
}

/// Returns whether all points lie on lines along their normals.
bool are_on_lines(const std::vector<ContactManifold>& manifolds) {
    return std::all_of(manifolds.begin(), manifolds.end(), [](const ContactManifold& m) {
        return std::all_of(m.points.begin(), m.points.begin() + m.count, [&](const auto& p) {
            return length(p.point_a - p.point_b - p.depth * m.normal) <= 1e-9;
        });
    });
}

TEST(SolidOnSurface, PointsLieOnBothSurfacesAndAlongTheNormal) {
    Random random(20261129);
    int met = 0, rounds = many(800), off_line = 0, changed = 0, shallow = 0;
    for (int round = 0; round < rounds; ++round) {
        const Mesh mesh = random_ground(random);
        const SolidAndHull solid = random_polyhedron(random);
        const Pose pose = pose_at_gap(random, solid.shape, mesh, random_gap(random));
        const double margin = random.chance(0.3) ? 0 : random.uniform(0.001, 0.1);
        SCOPED_TRACE("round " + std::to_string(round) + " margin " + std::to_string(margin));
        GroundAndSolid pair(solid.shape, pose, mesh, random.chance(0.5));
        const std::vector<ContactManifold> found = pair.world.contact_manifolds(margin);
        const bool is_near =
            margin == 0 ? !pair.world.collide().empty() : !pair.world.within(margin).empty();
        ASSERT_EQ(!found.empty(), is_near);
        if (!is_near)
            continue;
        ++met;
        check_points(found, margin, pair, solid, pose, mesh);
        off_line += are_on_lines(found) ? 0 : 1;
        const double distance = pair.world.within(margin).at(0).distance;
        if (distance > 1e-12) {
            EXPECT_LE(deepest_of(found), -distance + 1e-9);
            continue;
        }
        // The contacts of a shallow overlap are there whatever the margin is.
        if (distance > -1e-9 || distance < -0.02 || margin == 0)
            continue;
        ++shallow;
        for (const ContactManifold& m : pair.world.contact_manifolds())
            changed +=
                std::any_of(found.begin(), found.end(),
                            [&](const ContactManifold& n) {
                                return length(m.normal - n.normal) <= 1e-6 &&
                                       std::abs(m.points[0].depth - n.points[0].depth) <= 1e-9;
                            })
                    ? 0
                    : 1;
    }
    std::cout << met << " met, " << off_line << " off lines, " << changed << " of " << shallow
              << " changed by the margin\n";
    EXPECT_GT(met, rounds / 2);
    EXPECT_GT(shallow, rounds / 20);
    EXPECT_LE(off_line, 2 + rounds / 200);
    EXPECT_LE(changed, 2 + shallow / 50);
}

TEST(SolidOnSurface, BallsAndCapsulesHaveTheGapsOfOtherQueries) {
    Random random(20261130);
    int met = 0, ends = 0;
    const int rounds = many(1500);
    for (int round = 0; round < rounds; ++round) {
        const Mesh mesh = random_ground(random);
        const double radius = random.uniform(0.05, 0.4);
        const bool is_capsule = random.chance(0.6);
        const AnyShape shape =
            is_capsule ? AnyShape(Capsule{{random.in_cube(0.5), random.in_cube(0.5)}, radius})
                       : AnyShape(Sphere{{}, radius});
        const Pose pose = pose_at_gap(random, shape, mesh, random_gap(random));
        const double margin = random.chance(0.4) ? 0 : random.uniform(0.001, 0.1);
        SCOPED_TRACE("round " + std::to_string(round));
        GroundAndSolid pair(shape, pose, mesh, random.chance(0.5));
        const auto found = pair.world.contact_manifolds(margin);
        const auto gaps = margin == 0 ? pair.world.penetration() : pair.world.within(margin);
        ASSERT_EQ(found.empty(), gaps.empty());
        if (gaps.empty())
            continue;
        ++met, ends += found[0].count > 1 ? 1 : 0;
        // The nearest wall is that of the other queries.
        EXPECT_LE(length(found[0].normal - gaps[0].normal), 1e-9);
        EXPECT_TRUE(are_on_lines(found));
        // Along a line that lies flat, an end may be less deep by rounding of its place. The ends of an axis
        // that passes through the surface may be deeper than the bound of penetration.
        const double depth = found[0].points[0].depth;
        EXPECT_GE(depth, -gaps[0].distance - (is_capsule ? 1e-6 : 1e-12));
        if (gaps[0].status == Status::exact && !is_capsule) {
            EXPECT_LE(depth, -gaps[0].distance + 1e-12);
        }
    }
    std::cout << met << " met, " << ends << " with two ends\n";
    EXPECT_GT(met, rounds / 2);
    EXPECT_GT(ends, rounds / 50);
}

/// A table of two triangles at z = 0, without thickness.
Model table() {
    return Model(Mesh{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
}
const Box3 kUnitBox{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};

TEST(SolidOnSurface, ABoxThatOverhangsATableByRoundingStandsOnIt) {
    Random random(20261202);
    for (int round = 0; round < many(300); ++round) {
        const double tilt = std::pow(10, random.uniform(-10, -4)),
                     overlap = random.chance(0.2) ? 0 : std::pow(10, random.uniform(-16, -12));
        const Pose pose{{random.uniform(0.6, 1.2), random.uniform(-1.2, 1.2), 0.5},
                        {1, tilt * random.uniform(-1, 1), tilt * random.uniform(-1, 1), 0}};
        World world;
        world.add(table(), {});
        const BodyId box = world.add(kUnitBox, pose);
        // The lowest point over the table is at z = 0, less the overlap.
        const std::vector<BodyGap> first = world.within(1);
        ASSERT_EQ(first.size(), 1U);
        Pose lower = pose;
        lower.translation.z -= first[0].distance * first[0].normal.z + overlap;
        world.move(box, lower);
        for (const BodyGap& gap : world.within(1e-9))
            EXPECT_GT(gap.normal.z, std::abs(gap.distance) <= 1e-12 ? 0.99 : -0.5)
                << "round " << round << " tilt " << tilt << " gap " << gap.distance;
        for (const ContactManifold& m : world.contact_manifolds(0.01)) {
            EXPECT_GT(m.normal.z, 0.99) << "round " << round << " tilt " << tilt;
            EXPECT_LE(m.points[0].depth, 4 * tilt + 1e-12);
        }
    }
}

TEST(SolidOnSurface, ASolidBesideTheWallsOfARoomIsInNoContact) {
    const Model room(box_mesh({0, 0, 0}, {1, 1, 1}));
    for (const double gap : {3e-17, 1e-15, 1e-13, 1e-12}) {
        World world;
        world.add(room, {});
        world.add(Convex(box_mesh({-0.17, -0.15, -0.37}, {0.17, 0.15, 0.37})),
                  {{0.17 + gap, 0.5, 0.5}, {0, 0, 0, 1}});
        EXPECT_EQ(world.contact_manifolds().size(), world.collide().size()) << gap;
    }
}

TEST(SolidOnSurface, ABoxBeyondATinyMarginIsInNoContact) {
    for (const double margin : {1e-12, 1e-9, 1e-8, 1e-6})
        for (const double factor : {0.9, 1.1, 1.3, 2.0})
            for (const Vec3& way : {Vec3{1, 0, 1}, Vec3{1, 1, 1}, Vec3{0, 0, 1}}) {
                World world;
                world.add(table(), {});
                const Vec3 corner{way.x > 0 ? 1.5 : 0, way.y > 0 ? 1.5 : 0, 0.5};
                world.add(kUnitBox, {corner + (factor * margin / length(way)) * way, {1, 0, 0, 0}});
                EXPECT_EQ(world.contact_manifolds(margin).size(), world.within(margin).size())
                    << margin << ' ' << factor;
            }
}

TEST(SolidOnSurface, ABoxOverTheBorderOfAThinPlateLeavesItUpwards) {
    for (const double depth : {0.0005, 0.001, 0.01, 0.05})
        for (const double margin : {0.0, 0.01, 0.5}) {
            World world;
            world.add(Model(box_mesh({-2, -2, -0.001}, {2, 2, 0})), {});
            world.add(Box3{{-1, -0.75, -0.5}, {1, 0.75, 0.5}},
                      {{-1.5, 0, 0.5 - depth}, {1, 0, 0, 0}});
            const auto found = world.contact_manifolds(margin);
            ASSERT_GE(found.size(), 1U);
            EXPECT_EQ(found[0].normal, (Vec3{0, 0, 1})) << depth << ' ' << margin;
            EXPECT_NEAR(found[0].points[0].depth, depth, 1e-12);
            EXPECT_EQ(found[0].count, 4U);
        }
}

TEST(SolidOnSurface, TheEndsOfALeaningCapsuleLieOnIt) {
    for (const double angle : {0.05, 0.2, 0.5, 1.2, 1.5707}) {
        World world;
        world.add(table(), {});
        const Capsule capsule{{{-0.5, 0, 0}, {0.5, 0, 0}}, 0.25};
        const Pose pose{{0, 0, 0.24 + 0.5 * std::sin(angle)},
                        {std::cos(angle / 2), 0, std::sin(angle / 2), 0}};
        world.add(capsule, pose);
        const auto found = world.contact_manifolds(1.5);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_NEAR(found[0].points[0].depth, 0.01, 1e-12);
        for (std::uint32_t i = 0; i < found[0].count; ++i) {
            EXPECT_NEAR(distance_from_surface(capsule, pose, found[0].points[i].point_b), 0, 1e-9)
                << angle;
            EXPECT_NEAR(found[0].points[i].point_a.z, 0, 1e-12);
            for (std::uint32_t k = 0; k < i; ++k)
                EXPECT_GT(length(found[0].points[i].point_a - found[0].points[k].point_a), 1e-6);
        }
    }
}

TEST(SolidOnSurface, TheEndsOfALeaningCapsuleDeepInASolidLieOnIt) {
    int both = 0;
    for (const double angle : {0.0, 0.05, 0.2, 0.4, 1.2})
        for (const double height_of_lower_end : {-0.2, -0.1, 0.1}) {
            SCOPED_TRACE(std::to_string(angle) + ' ' + std::to_string(height_of_lower_end));
            World world;
            world.add(Model(box_mesh({-4, -4, -8}, {4, 4, 0})), {});
            const Capsule capsule{{{-0.5, 0, 0}, {0.5, 0, 0}}, 0.25};
            const Pose pose{{0, 0, height_of_lower_end + 0.5 * std::sin(angle)},
                            {std::cos(angle / 2), 0, std::sin(angle / 2), 0}};
            world.add(capsule, pose);
            const auto found = world.contact_manifolds();
            ASSERT_EQ(found.size(), 1U);
            EXPECT_NEAR(found[0].points[0].depth, 0.25 - height_of_lower_end, 1e-12);
            for (std::uint32_t i = 0; i < found[0].count; ++i) {
                const ContactPoint& point = found[0].points[i];
                EXPECT_NEAR(distance_from_surface(capsule, pose, point.point_b), 0, 1e-9)
                    << angle << ' ' << height_of_lower_end;
                EXPECT_NEAR(point.point_a.z, 0, 1e-12);
                EXPECT_LE(length(point.point_a - point.point_b - point.depth * found[0].normal),
                          1e-12);
            }
            both += found[0].count > 1 ? 1 : 0;
        }
    EXPECT_GE(both, 8);
}

} // namespace
} // namespace abut::test
