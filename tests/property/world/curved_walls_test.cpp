// Cylinders, cones and ellipsoids in the hollows of one mesh: each wall that they touch has a manifold with
// the depth below that wall.

#include <abut/vector.h>
#include <abut/world.h>

#include "math/transform.h"
#include "tests/support/curved_depth.h"
#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

namespace abut::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A curved body in a hollow: the shape, how it is turned, and where its frame's origin is.
struct BodyInHollow {
    std::string name;
    AnyShape shape;
    std::array<double, 4> rotation{1, 0, 0, 0};
    Vec3 place{};
};

std::vector<BodyInHollow> curved_bodies(Random& random) {
    const double r = random.uniform(0.2, 0.4), l = random.uniform(0.2, 0.6);
    const auto any = [&] { return random.pose(0).rotation; };
    return {{"cylinder along the valley", Cylinder{{{0, -l, 0}, {0, l, 0}}, r}},
            {"ellipsoid along the valley", Ellipsoid{{}, {r, l, r}}},
            {"cylinder", Cylinder{{{0, 0, -l}, {0, 0, l}}, r}, any()},
            {"cone", Cone{{0, 0, l}, {0, 0, -l}, r}, any()},
            {"ellipsoid", Ellipsoid{{0.1, 0, 0}, {r, l, 0.5 * l}}, any()}};
}

Vec3 normal_of_slope(double angle, double side) {
    return {-side * std::sin(angle), 0, std::cos(angle)};
}

/// Two planes that meet in the line x = z = 0; the right one rises at one angle, the left one at another.
Mesh hollow_of(double right, double left, int cells) {
    return grid_mesh(2 * cells, cells, false, false, [=](double u, double v) {
        const double x = 8 * u - 4, angle = x > 0 ? right : left;
        return Vec3{x * std::cos(angle), 8 * v - 4, std::abs(x) * std::sin(angle)};
    });
}

/// Moves a body so that it is as deep in both slopes as given.
void place_in_hollow(BodyInHollow& body, const Vec3& n, const Vec3& m, double depth,
                     double depth_in_left) {
    body.place = {0, body.place.y, 0};
    const Pose at_origin{{}, body.rotation};
    const double p = depth_below(n, {}, body.shape, at_origin) - depth,
                 q = depth_below(m, {}, body.shape, at_origin) - depth_in_left;
    const double det = n.x * m.z - n.z * m.x; // n . place = p, m . place = q
    body.place.x = (p * m.z - n.z * q) / det, body.place.z = (n.x * q - p * m.x) / det;
}

/// Whether a body that is as deep in both slopes touches each of them where it is, not beyond the other one.
bool touches_both(const BodyInHollow& body, const Vec3& n, const Vec3& m, double depth) {
    constexpr double kStep = 1e-6; // the support point is the gradient of the reach
    const Pose pose{body.place, body.rotation};
    const auto point_along = [&](const Vec3& direction) {
        Vec3 p;
        for (const auto& [axis, component] :
             {std::pair(Vec3{1, 0, 0}, &p.x), {Vec3{0, 0, 1}, &p.z}}) {
            const auto reach = [&](const Vec3& d) {
                return length(d) * depth_below(-1 / length(d) * d, {}, body.shape, pose);
            };
            *component =
                (reach(direction + kStep * axis) - reach(direction - kStep * axis)) / (2 * kStep);
        }
        return p;
    };
    return dot(m, point_along(-n) + depth * n) > 0.01 && dot(n, point_along(-m) + depth * m) > 0.01;
}

struct Hollow {
    Mesh mesh;
    Pose pose;
    double margin = 0;
    bool body_first = false;
};

std::vector<ContactManifold> contacts_in(const Hollow& hollow, const BodyInHollow& body) {
    World world;
    const Transform to_world = hollow.pose;
    const auto add_mesh = [&] { world.add(Model(hollow.mesh), hollow.pose); };
    if (!hollow.body_first)
        add_mesh();
    const auto& [aw, ax, ay, az] = hollow.pose.rotation;
    const auto& [bw, bx, by, bz] = body.rotation;
    const Pose pose{apply(to_world, body.place),
                    {aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                     aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw}};
    add(world, body.shape, pose);
    if (hollow.body_first)
        add_mesh();
    return world.contact_manifolds(hollow.margin);
}

/// Expects a manifold for each wall, as deep as given, with points on both surfaces.
void expect_walls(const std::vector<ContactManifold>& found, const Hollow& hollow,
                  const BodyInHollow& body, const std::vector<Vec3>& normals, double depth) {
    ASSERT_EQ(found.size(), normals.size());
    const Transform to_world = hollow.pose;
    const double error = 1e-9 + 1e-14 * sum_of_sizes(hollow.pose.translation);
    std::vector<bool> is_found(normals.size(), false);
    for (const ContactManifold& m : found) {
        const Vec3 up = (hollow.body_first ? -1.0 : 1.0) * pull_back(to_world, m.normal);
        for (std::size_t k = 0; k < normals.size(); ++k)
            if (length(up - normals[k]) < 1e-6)
                is_found[k] = true;
        EXPECT_NEAR(m.points[0].depth, depth, error);
        for (std::uint32_t i = 0; i < m.count; ++i) {
            const ContactPoint& p = m.points.at(i);
            EXPECT_LE(p.depth, m.points[0].depth);
            EXPECT_GE(p.depth, -hollow.margin);
            EXPECT_LE(length(p.point_a - p.point_b - p.depth * m.normal), error);
            const auto own = [&](const Vec3& at) {
                return pull_back(to_world,
                                 at - Vec3{to_world.m[9], to_world.m[10], to_world.m[11]});
            };
            const Vec3 on_body = own(hollow.body_first ? p.point_a : p.point_b),
                       on_mesh = own(hollow.body_first ? p.point_b : p.point_a);
            EXPECT_LE(
                std::abs(distance_from_surface(body.shape, {body.place, body.rotation}, on_body)),
                error);
            EXPECT_LE(distance_from_surface(Model(hollow.mesh), {}, on_mesh), error);
        }
    }
    for (std::size_t k = 0; k < normals.size(); ++k)
        EXPECT_TRUE(is_found[k]) << "wall " << k;
}

Pose pose_somewhere(Random& random) {
    return random.pose(random.chance(0.3) ? 1e4 : 1);
}

TEST(CurvedWalls, AHollowHoldsABodyOnBothSides) {
    Random random(20261501);
    int met = 0, left_out = 0;
    for (int round = 0; round < many(60); ++round) {
        // Valleys, gutters, and corners of a floor and a wall.
        double right = random.uniform(0, 60) * kDegree, left = random.uniform(20, 88) * kDegree;
        if (random.chance(0.2))
            right = left = 45 * kDegree;
        if (random.chance(0.2))
            right = 0, left = 90 * kDegree;
        const Vec3 n = normal_of_slope(right, 1), m = normal_of_slope(left, -1);
        Hollow hollow{hollow_of(right, left, random.integer(1, 8)), pose_somewhere(random)};
        hollow.margin = random.chance(0.5) ? 0 : random.uniform(0.003, 0.02);
        hollow.body_first = random.chance(0.5);
        const double depth = hollow.margin > 0 && random.chance(0.5) ? -0.002 : 0.002;
        for (BodyInHollow& body : curved_bodies(random)) {
            SCOPED_TRACE(body.name + " round " + std::to_string(round) + " right " +
                         std::to_string(right / kDegree) + " left " +
                         std::to_string(left / kDegree));
            body.place.y = random.uniform(-1, 1);
            place_in_hollow(body, n, m, depth, depth);
            if (!touches_both(body, n, m, depth)) {
                ++left_out;
                continue;
            }
            ++met;
            expect_walls(contacts_in(hollow, body), hollow, body, {n, m}, depth);
            if (HasFailure())
                return;
        }
    }
    std::cout << met << " met, " << left_out << " left out\n";
    EXPECT_GT(met, 200);
}

TEST(CurvedWalls, TheFoundCases) {
    // 2 mm deep in the floor and the wall of a room's corner.
    const double r = 0.3, e = 0.002;
    const Hollow room{hollow_of(0, 90 * kDegree, 1), {}, 0.02};
    const Vec3 up{0, 0, 1}, right{1, 0, 0};
    for (const auto& [name, shape, points] :
         {std::tuple{"lying cylinder", AnyShape(Cylinder{{{0, -0.5, 0}, {0, 0.5, 0}}, r}), 4U},
          std::tuple{"standing cylinder", AnyShape(Cylinder{{{0, 0, -r}, {0, 0, r}}, r}), 6U},
          std::tuple{"ellipsoid", AnyShape(Ellipsoid{{}, {r, 0.5, r}}), 2U}}) {
        SCOPED_TRACE(name);
        const BodyInHollow body{name, shape, {1, 0, 0, 0}, {r - e, 0.1, r - e}};
        const auto found = contacts_in(room, body);
        expect_walls(found, room, body, {up, right}, e);
        unsigned count = 0;
        for (const ContactManifold& m : found)
            count += m.count;
        EXPECT_EQ(count, points);
    }
}

/// A disc that slides down one slope meets the other one with its rim, right in the line where they meet.
TEST(CurvedWalls, ADiscThatSlidesDownOneWallIsStoppedByTheOther) {
    Random random(20261503);
    for (int round = 0; round < many(100); ++round) {
        const double left = random.uniform(20, 60) * kDegree,
                     right = random.uniform(20, 60) * kDegree;
        const Vec3 n = normal_of_slope(right, 1), m = normal_of_slope(left, -1);
        Hollow hollow{hollow_of(right, left, random.integer(1, 8)), pose_somewhere(random)};
        hollow.margin = 0.01, hollow.body_first = random.chance(0.5);
        BodyInHollow body{"", Cylinder{{{0, 0, 0}, {0, 0, 0.4}}, 0.2}};
        body.rotation = {std::cos(left / 2), 0, std::sin(left / 2), 0};
        const double e = 0.002, in_left = 1e-5;
        place_in_hollow(body, n, m, e, in_left);
        SCOPED_TRACE("round " + std::to_string(round));
        const auto found = contacts_in(hollow, body);
        ASSERT_EQ(found.size(), 2U);
        const Vec3 way = pull_back(Transform(hollow.pose),
                                   hollow.body_first ? -found[0].normal : found[0].normal);
        const bool right_first = length(way - n) < length(way - m);
        const ContactManifold &of_right = found[right_first ? 0 : 1],
                              &of_left = found[right_first ? 1 : 0];
        EXPECT_NEAR(of_left.points[0].depth, in_left, 1e-8);
        EXPECT_GE(of_left.count, 3U);
        // The rim reaches beyond the line by at most the depth in the left wall and its share of the other.
        EXPECT_LE(of_right.points[0].depth, e + 1e-9);
        EXPECT_GE(of_right.points[0].depth, e - 20 * in_left - e * std::abs(dot(n, m)));
        if (HasFailure())
            return;
    }
}

/// A block with a cut of the shape of a V along y, of this half width and depth.
Mesh cut_block(double width, double depth) {
    const std::vector<std::array<double, 2>> outline{{-2, -2},   {0, -2},     {2, -2},     {2, 0},
                                                     {width, 0}, {0, -depth}, {-width, 0}, {-2, 0}};
    Mesh m;
    for (const double y : {-2.0, 2.0})
        for (const auto& [x, z] : outline)
            m.positions.push_back({x, y, z});
    const auto count = static_cast<std::uint32_t>(outline.size());
    // The outline runs counter-clockwise, seen from -y.
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t k = (i + 1) % count;
        m.triangles.push_back({i, k + count, k});
        m.triangles.push_back({i, i + count, k + count});
    }
    for (std::uint32_t i = 2; i < count; ++i) {
        const std::uint32_t k = (i + 1) % count;
        m.triangles.push_back({1, i, k});
        m.triangles.push_back({1 + count, k + count, i + count});
    }
    return m;
}

TEST(CurvedWalls, ACutInABlockHoldsABodyOnBothSides) {
    Random random(20261502);
    int in_cut = 0, on_edges = 0;
    for (int round = 0; round < many(60); ++round) {
        const double depth_of_cut = random.uniform(0.7, 1.5), r = random.uniform(0.1, 0.25);
        Hollow hollow{cut_block(1, depth_of_cut), pose_somewhere(random)};
        hollow.margin = random.chance(0.5) ? 0 : 0.01;
        hollow.body_first = random.chance(0.5);
        const double angle = std::atan(depth_of_cut), e = 0.002;
        const Vec3 n = normal_of_slope(angle, 1), m = normal_of_slope(angle, -1);
        for (const bool is_cylinder : {true, false}) {
            SCOPED_TRACE("in the cut, round " + std::to_string(round));
            BodyInHollow body{"", Cylinder{{{0, -0.4, 0}, {0, 0.4, 0}}, r}};
            if (!is_cylinder)
                body.shape = Ellipsoid{{}, {r, 0.4, r}};
            place_in_hollow(body, n, m, e, e);
            body.place.z -= depth_of_cut;
            expect_walls(contacts_in(hollow, body), hollow, body, {n, m}, e);
            ++in_cut;
        }
        // A thicker body lies on both edges of the cut: across the edges, it is a circle.
        const double thick = random.uniform(1.3, 1.8);
        const Vec3 towards{-1, 0, std::sqrt((thick - e) * (thick - e) - 1)};
        BodyInHollow body{"", Cylinder{{{0, -0.4, 0}, {0, 0.4, 0}}, thick}};
        body.place = {0, 0, towards.z};
        if (std::abs(std::atan2(1.0, towards.z)) > angle - 0.05)
            continue; // it would touch the slopes
        const Vec3 from_right = normalized_or_zero(towards),
                   from_left{-from_right.x, 0, from_right.z};
        expect_walls(contacts_in(hollow, body), hollow, body, {from_right, from_left}, e);
        ++on_edges;
        if (HasFailure())
            return;
    }
    std::cout << in_cut << " in the cut, " << on_edges << " on its edges\n";
    EXPECT_GT(in_cut, 100);
    EXPECT_GT(on_edges, 15);
}

/// A table's edge, and the body beyond it: one manifold, which does not lead through the table.
TEST(CurvedWalls, AStandingBodyThatReachesOverAnEdgeIsCarriedByTheTop) {
    for (const double over : {0.1, 0.25, -0.1, 0.02})
        for (const double e : {0.002, 0.0, 1e-12, -0.002})
            for (const bool is_cone : {false, true}) {
                SCOPED_TRACE(std::to_string(over) + " deep " + std::to_string(e));
                World world;
                world.add(Model(box_mesh({-2, -2, -1}, {0, 2, 0})), {});
                AnyShape shape = Cylinder{{{0, 0, 0}, {0, 0, 0.5}}, 0.3};
                if (is_cone)
                    shape = Cone{{0, 0, 0.5}, {0, 0, 0}, 0.3};
                add(world, shape, {{over, 0.1, -e}});
                const auto found = world.contact_manifolds(0.01);
                ASSERT_EQ(found.size(), 1U);
                EXPECT_LE(length(found[0].normal - Vec3{0, 0, 1}), 1e-9);
                EXPECT_EQ(found[0].count, 4U);
                for (std::uint32_t i = 0; i < found[0].count; ++i) {
                    EXPECT_NEAR(found[0].points.at(i).depth, e, 1e-12);
                    EXPECT_LE(found[0].points.at(i).point_a.x, 1e-12);
                }
            }
}

TEST(CurvedWalls, ABodyThatIsSunkByMoreThanHalfLeavesAsPenetrationTells) {
    for (const double sunk : {0.55, 0.8}) {
        World world;
        world.add(Model(box_mesh({-2, -2, -3}, {2, 2, 0})), {});
        world.add(Cylinder{{{0, -0.5, 0}, {0, 0.5, 0}}, 0.3}, {{0.2, 0.1, 0.3 - 0.6 * sunk}});
        const auto gaps = world.penetration();
        const auto found = world.contact_manifolds(0.01);
        ASSERT_EQ(found.size(), 1U);
        ASSERT_EQ(gaps.size(), 1U);
        EXPECT_GT(-gaps[0].distance, 0.1);
        EXPECT_NEAR(found[0].points[0].depth, -gaps[0].distance, 1e-12);
        EXPECT_LE(length(found[0].normal - gaps[0].normal), 1e-12);
    }
}

} // namespace
} // namespace abut::test
