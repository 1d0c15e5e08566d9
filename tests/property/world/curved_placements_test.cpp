// Curved solids in the placements that people use: parallel, at right angles, concentric, coaxial, on
// a grid, resting, coincident, far from the origin. Against closed forms and brute force.

#include <abut/world.h>

#include "math/transform.h"
#include "tests/support/curved_shapes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/support_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <variant>
#include <vector>

namespace abut::test {
namespace {

using AnySolid = std::variant<Cylinder, Cone, Ellipsoid, Sphere, Capsule, Box3, Convex>;
constexpr int kCurvedKinds = kUprightCurvedKinds, kKinds = kUprightKinds + 1;

struct PlacedAnySolid {
    AnySolid shape;
    Pose pose;
};

BodyId add_solid(World& world, const PlacedAnySolid& solid) {
    return std::visit([&](const auto& shape) { return world.add(shape, solid.pose); }, solid.shape);
}

SolidParts parts_in_world(const PlacedAnySolid& solid) {
    SolidParts parts = std::visit([](const auto& shape) { return parts_of(shape); }, solid.shape);
    parts.place(Transform(solid.pose));
    return parts;
}

/// The answers of all queries about one pair, in the order of adding.
struct PlacedAnswers {
    BodyGap gap; ///< of `penetration` if the bodies meet, else of `within`
    bool collide = false, has_depth = false, has_contact = false;
    double within = 0; ///< the distance that `within` gives
    std::optional<ContactManifold> contact;
    bool operator==(const PlacedAnswers& other) const {
        return collide == other.collide && has_depth == other.has_depth &&
               has_contact == other.has_contact && within == other.within &&
               gap.distance == other.gap.distance && gap.normal == other.gap.normal &&
               gap.point_a == other.gap.point_a && gap.point_b == other.gap.point_b &&
               gap.status == other.gap.status;
    }
};

PlacedAnswers answers_of(World& world, double reach) {
    PlacedAnswers answers;
    answers.collide = !world.collide().empty();
    const std::vector<BodyGap> depths = world.penetration(), gaps = world.within(reach);
    const std::vector<ContactManifold> contacts = world.contact_manifolds();
    answers.has_depth = !depths.empty(), answers.has_contact = !contacts.empty();
    if (!gaps.empty())
        answers.gap = gaps[0], answers.within = gaps[0].distance;
    if (!depths.empty())
        answers.gap = depths[0];
    if (!contacts.empty())
        answers.contact = contacts[0];
    return answers;
}

PlacedAnswers answers_of(const PlacedAnySolid& a, const PlacedAnySolid& b, double reach = 1e3) {
    World world;
    add_solid(world, a), add_solid(world, b);
    return answers_of(world, reach);
}

/// Expects the same answer of all queries about a pair whose signed distance is known.
void expect_signed_distance(const PlacedAnySolid& a, const PlacedAnySolid& b, double expected,
                            double error) {
    for (const bool swapped : {false, true}) {
        const PlacedAnswers found = swapped ? answers_of(b, a) : answers_of(a, b);
        EXPECT_NEAR(found.gap.distance, expected, error);
        EXPECT_EQ(found.gap.distance, found.within);
        EXPECT_EQ(found.gap.status, Status::exact);
        EXPECT_NEAR(length(found.gap.normal), 1, 1e-12);
        EXPECT_LT(
            length(found.gap.point_b - found.gap.point_a - found.gap.distance * found.gap.normal),
            error);
        if (std::abs(expected) <= error)
            continue;
        EXPECT_EQ(found.collide, expected < 0);
        EXPECT_EQ(found.has_depth, expected < 0);
        EXPECT_EQ(found.has_contact, expected < 0);
        if (found.contact) {
            EXPECT_NEAR(found.contact->points[0].depth, -expected, error);
        }
    }
}

Pose moved_by(const Vec3& offset) {
    Pose pose;
    pose.translation = offset;
    return pose;
}

Cylinder upright(double radius, double half) {
    return {{{0, 0, -half}, {0, 0, half}}, radius};
}
Cone upright_cone(double radius, double height) {
    return {{0, 0, height}, {}, radius};
}

TEST(CurvedPlacements, OverlapsThatWereFoundFree) {
    expect_signed_distance(
        {Cylinder{{{0, 0, 0}, {0, 0, 15.5}}, 0.3125}, {}},
        {Cylinder{{{0, 0, -13}, {0, 0, 13}}, 0.25}, moved_by({-.078125, .078125, 7.75})},
        std::sqrt(2.0) * 0.078125 - 0.5625, 1e-11);
    // The sum of both ellipses in the plane of x is a point's distance from it: by brute force.
    const PlacedAnySolid a{Ellipsoid{{}, {0.25, 0.5, 10}}, {}},
        b{Ellipsoid{{}, {0.25, 0.5, 0.5}}, moved_by({0, 0.25, 3.5})};
    Random random(7201);
    const PlacedAnswers found = answers_of(a, b);
    const SolidPair pair{parts_in_world(a), parts_in_world(b)};
    EXPECT_TRUE(found.collide && found.has_depth && found.has_contact);
    EXPECT_NEAR(found.gap.distance, double(pair.largest_separation(random, found.gap.normal)),
                1e-9);
    EXPECT_LT(found.gap.distance, -0.4);
    // A ball that is deep in a thin ellipsoid: 0.664 at this place, 0.75 at the centre.
    expect_signed_distance({Ellipsoid{{}, {0.75, 0.5, 20}}, {}}, {Sphere{{}, 0.25}, {}}, -0.75,
                           1e-11);
}

TEST(CurvedPlacements, DepthsOnOneAxisAndOneCentre) {
    const Ellipsoid ball{{}, {1, 1, 1}};
    const double cone = 4 / std::sqrt(5.0);
    Random random(7202);
    // The bodies are also turned and far from the origin, where their axes are rounded.
    for (int round = 0; round < many(40); ++round) {
        const Pose pose = round == 0 ? Pose{} : random.pose(round % 2 == 0 ? 1 : 1e4);
        const double error = round % 2 == 0 ? 1e-12 : 1e-10;
        const auto moved = [&](const Vec3& by) {
            Pose result = pose;
            result.translation = apply(Transform(pose), by);
            return result;
        };
        const auto check = [&](const AnySolid& a, const AnySolid& b, double depth) {
            expect_signed_distance({a, pose}, {b, pose}, -depth, 4 * error);
        };
        check(upright(0.5, 1), upright(0.2, 0.5), 0.7);
        check(upright(0.5, 1), upright(0.5, 1), 1);
        check(upright(0.5, 1), Sphere{{}, 0.2}, 0.7);
        check(ball, ball, 2);
        check(ball, Sphere{{}, 0.5}, 1.5);
        check(upright_cone(1, 2), upright_cone(1, 2), cone);
        check(Ellipsoid{{}, {1, 1, 3}}, Ellipsoid{{}, {1, 1, 3}}, 2);
        check(Ellipsoid{{}, {1, 2, 3}}, Ellipsoid{{}, {1, 2, 3}}, 2);
        check(Ellipsoid{{}, {1, 2, 3}}, Sphere{{}, 0.25}, 1.25);
        check(Ellipsoid{{}, {1, 1.0001, 0.9999}}, Sphere{{}, 0.5}, 1.4999);
        check(Ellipsoid{{}, {0.25, 0.25, 0.5}}, upright(0.5, 2), 0.75);
        check(Capsule{{{0, 0, -1}, {0, 0, 1}}, 0.25}, upright(0.5, 2), 0.75);
        check(Capsule{{{0, 0, -1}, {0, 0, 1}}, 0.25}, Ellipsoid{{}, {0.5, 0.5, 3}}, 0.75);
        check(Box3{{-1, -1, -1}, {1, 1, 1}}, upright(0.5, 2), 1.5);
        check(Box3{{-1, -1, -1}, {1, 1, 1}}, ball, 2);
        expect_signed_distance({ball, pose}, {ball, moved({1e-3, 0, 0})}, 1e-3 - 2, 4 * error);
    }
}

/// A length, a size or an offset as people choose them.
double grid_length(Random& random) {
    static constexpr std::array kLengths{0.25, 0.3125, 0.5,  0.75, 1.0,  1.5,
                                         2.0,  3.0,    10.0, 13.0, 20.0, 40.0};
    return kLengths[static_cast<std::size_t>(random.integer(0, kLengths.size() - 1))];
}
Vec3 grid_offset(Random& random) {
    switch (random.integer(0, 3)) {
    case 0:
        return {};
    case 1:
        return {0, 0, random.integer(-64, 64) / 16.0};
    case 2:
        return {random.integer(-8, 8) / 64.0, random.integer(-8, 8) / 64.0,
                random.integer(-32, 32) / 4.0};
    default:
        return {random.integer(-32, 32) / 16.0, random.integer(-32, 32) / 16.0,
                random.integer(-32, 32) / 4.0};
    }
}

/// The signed distance of two cylinders along z, in closed form.
double parallel_cylinders(const Cylinder& a, const Cylinder& b, const Vec3& offset) {
    const double across = std::hypot(offset.x, offset.y) - a.radius - b.radius;
    const double along = std::abs(offset.z) - a.axis.b.z - b.axis.b.z;
    return across > 0 && along > 0 ? std::hypot(across, along) : std::max(across, along);
}

TEST(CurvedPlacements, ParallelCylindersOnAGrid) {
    Random random(7203);
    int deep = 0, apart = 0;
    for (int round = 0; round < many(2000); ++round) {
        const Cylinder a = upright(grid_length(random), grid_length(random)),
                       b = upright(grid_length(random), grid_length(random));
        const Vec3 offset = grid_offset(random);
        const double expected = parallel_cylinders(a, b, offset);
        expect_signed_distance({a, {}}, {b, moved_by(offset)}, expected, 1e-12 * 60);
        (expected < 0 ? deep : apart) += 1;
    }
    EXPECT_GT(deep, many(2000) / 3);
    EXPECT_GT(apart, many(2000) / 50);
}

TEST(CurvedPlacements, ParallelEllipsoidsOfOneShape) {
    // Scaled copies: the sum of both is an ellipsoid of the same shape again.
    Random random(7204);
    int met = 0, apart = 0;
    for (int round = 0; round < many(2000); ++round) {
        const Vec3 half{grid_length(random), grid_length(random),
                        random.chance(0.5) ? 40 : grid_length(random)};
        const double scale = random.integer(1, 8) / 4.0;
        const Vec3 offset{half.x * random.integer(-6, 6) / 4.0,
                          half.y * random.integer(-6, 6) / 4.0,
                          half.z * random.integer(-6, 6) / 4.0};
        const double ratio =
            length({offset.x / half.x, offset.y / half.y, offset.z / half.z}) / (1 + scale);
        if (std::abs(ratio - 1) < 1e-9)
            continue;
        const PlacedAnswers found =
            answers_of({Ellipsoid{{}, half}, {}}, {Ellipsoid{{}, scale * half}, moved_by(offset)});
        EXPECT_EQ(found.collide, ratio < 1) << round;
        EXPECT_EQ(found.has_depth, ratio < 1);
        EXPECT_EQ(found.has_contact, ratio < 1);
        EXPECT_EQ(found.within <= 0, ratio < 1);
        // Each bound of a distance from an ellipsoid: it lies between those of two balls.
        const double inner = std::min({half.x, half.y, half.z}) * (1 + scale);
        if (ratio < 1) {
            EXPECT_LE(found.gap.distance, -(1 - ratio) * inner * (1 - 1e-9));
        }
        (ratio < 1 ? met : apart) += 1;
    }
    EXPECT_GT(met, many(2000) / 4);
    EXPECT_GT(apart, many(2000) / 8);
}

/// The distance of the origin from a triangle, by the regions of its corners, edges and inside.
Long distance_from_origin(const std::array<LongVec3, 3>& corner) {
    Long least = HUGE_VALL;
    for (std::size_t i = 0; i < 3; ++i) {
        const LongVec3 &p = corner[i], way = corner[(i + 1) % 3] - p;
        const Long all = dot(way, way);
        const Long t = all > 0 ? std::clamp(-dot(p, way) / all, 0.0L, 1.0L) : 0;
        const LongVec3 at = p + t * way;
        least = std::min(least, std::sqrt(dot(at, at)));
    }
    const LongVec3 u = corner[1] - corner[0], v = corner[2] - corner[0];
    const Long uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), pu = -dot(corner[0], u),
               pv = -dot(corner[0], v), area = uu * vv - uv * uv;
    const Long s = vv * pu - uv * pv, t = uu * pv - uv * pu;
    if (area > 0 && s > 0 && t > 0 && s + t < area) {
        const LongVec3 at = corner[0] + (s / area) * u + (t / area) * v;
        least = std::min(least, std::sqrt(dot(at, at)));
    }
    return least;
}

TEST(CurvedPlacements, TrianglesOfAMeshThroughAnEllipsoid) {
    // In units of the semi-axes the ellipsoid is a ball.
    Random random(7205);
    int met = 0, apart = 0;
    for (int round = 0; round < many(2000); ++round) {
        const Vec3 half{grid_length(random), grid_length(random), grid_length(random)};
        const auto corner = [&] {
            return Vec3{half.x * random.integer(-8, 8) / 4.0, half.y * random.integer(-8, 8) / 4.0,
                        half.z * random.integer(-8, 8) / 4.0};
        };
        const Triangle triangle{corner(), corner(), corner()};
        std::array<LongVec3, 3> scaled;
        for (std::size_t i = 0; i < 3; ++i)
            scaled[i] = {Long(triangle[i].x) / half.x, Long(triangle[i].y) / half.y,
                         Long(triangle[i].z) / half.z};
        const Long ratio = distance_from_origin(scaled);
        if (std::abs(ratio - 1) < 1e-9L)
            continue;
        World world;
        const Ellipsoid ellipsoid{{}, half};
        const Model model(Mesh{{triangle[0], triangle[1], triangle[2]}, {{0, 1, 2}}});
        if (round % 2 == 0)
            world.add(ellipsoid, {}), world.add(model, {});
        else
            world.add(model, {}), world.add(ellipsoid, {});
        const PlacedAnswers found = answers_of(world, 1e3);
        EXPECT_EQ(found.collide, ratio < 1) << round;
        EXPECT_EQ(found.has_depth, ratio < 1);
        EXPECT_EQ(found.has_contact, ratio < 1);
        EXPECT_EQ(found.within <= 0, ratio < 1);
        (ratio < 1 ? met : apart) += 1;
    }
    EXPECT_GT(met, many(2000) / 4);
    EXPECT_GT(apart, many(2000) / 8);
}

AnySolid grid_solid(Random& random, int kind, double scale) {
    const auto some = [&] { return scale * random.integer(1, 8) / 4.0; };
    const double a = some(), b = some(), c = some();
    if (kind < kUprightKinds)
        return upright_solid<AnySolid>(random, kind, a, b, c);
    std::vector<Vec3> points(12);
    for (Vec3& point : points)
        point = scale * (random.on_lattice(8) - Vec3{4, 4, 4});
    return Convex(points);
}

Pose grid_pose(Random& random) {
    const double h = std::sqrt(0.5);
    static const std::array<std::array<double, 4>, 5> kTurns{
        {{1, 0, 0, 0}, {h, h, 0, 0}, {h, 0, h, 0}, {0, 1, 0, 0}, {0.5, 0.5, 0.5, 0.5}}};
    if (random.chance(0.15))
        return random.pose(0);
    const auto& q = kTurns[static_cast<std::size_t>(random.integer(0, 4))];
    return {{}, {q[0], q[1], q[2], q[3]}};
}

/// The signed distance of a point from a solid, by a world of its own.
double distance_of_point(const Vec3& point, const PlacedAnySolid& solid) {
    return answers_of({Sphere{point, 0}, {}}, solid).gap.distance;
}

/// Expects the gap to be the separation along its own normal, and no other direction to have a larger one.
void expect_best(Random& random, const PlacedAnySolid& a, const PlacedAnySolid& b,
                 const BodyGap& gap, double error) {
    const SolidPair pair{parts_in_world(a), parts_in_world(b)};
    ASSERT_NEAR(length(gap.normal), 1, 1e-12);
    EXPECT_NEAR(double(pair.separation(unit(to_long(gap.normal)))), gap.distance, error);
    if (gap.status == Status::exact) {
        EXPECT_LE(double(pair.largest_separation(random, gap.normal)), gap.distance + error);
    }
}

/// By how much the witness points are off: each lies on its body, on the plane that touches it there.
double error_of_points(const PlacedAnySolid& a, const PlacedAnySolid& b, const BodyGap& gap) {
    const SolidPair pair{parts_in_world(a), parts_in_world(b)};
    const LongVec3 n = to_long(gap.normal), from_a = to_long(gap.point_a) - pair.a.centre,
                   from_b = to_long(gap.point_b) - pair.a.centre;
    return std::max(
        {std::abs(double(dot(from_a, n) - pair.a.farthest(n, pair.a.centre))),
         std::abs(double(dot(from_b, n) + pair.b.farthest(LongVec3{} - n, pair.a.centre))),
         length(gap.point_b - gap.point_a - gap.distance * gap.normal),
         std::abs(distance_of_point(gap.point_a, a)), std::abs(distance_of_point(gap.point_b, b))});
}

TEST(CurvedPlacements, AnyKindsOnAGridAgreeWithBruteForce) {
    Random random(7206);
    int deep = 0, shallow = 0, apart = 0, unproven = 0, rough = 0;
    for (int round = 0; round < many(500); ++round) {
        const double scale = random.chance(0.2) ? std::pow(10, -random.uniform(0, 3)) : 1;
        PlacedAnySolid a{grid_solid(random, round % kCurvedKinds, 1), grid_pose(random)},
            b{grid_solid(random, random.integer(0, kKinds - 1), scale), grid_pose(random)};
        b.pose.translation = grid_offset(random);
        if (random.chance(0.3)) { // on a's upper or lower side, a little too deep or too high
            const SolidPair pair{parts_in_world(a), parts_in_world(b)};
            const double up = random.chance(0.5) ? 1 : -1;
            b.pose.translation.z -=
                up * (double(pair.separation({0, 0, up})) + random.integer(-1, 2) / 64.0);
        }
        const bool far = random.chance(0.15);
        if (far)
            a.pose.translation = {1e6, -1e6, 1e6},
            b.pose.translation = b.pose.translation + a.pose.translation;
        const PlacedAnswers found = answers_of(a, b);
        ASSERT_EQ(found.collide, found.gap.distance <= 0);
        EXPECT_EQ(found.has_depth, found.collide);
        EXPECT_EQ(found.has_contact, found.collide);
        EXPECT_EQ(found.within, found.gap.distance);
        SCOPED_TRACE(testing::Message() << "round " << round << " kinds " << a.shape.index() << ' '
                                        << b.shape.index());
        const double error = far ? 1e-9 : 2e-11;
        expect_best(random, a, b, found.gap, error);
        const double error_of_both = error_of_points(a, b, found.gap);
        if (found.gap.status == Status::exact) {
            EXPECT_LT(error_of_both, 1e-7); // beside the border of a face or side; else less
        }
        rough += error_of_both > error ? 1 : 0;
        // In the other order.
        const PlacedAnswers turned = answers_of(b, a);
        EXPECT_EQ(turned.collide, found.collide);
        EXPECT_EQ(turned.gap.distance, found.gap.distance);
        EXPECT_EQ(turned.gap.normal, -found.gap.normal);
        EXPECT_EQ(turned.gap.point_a, found.gap.point_b);
        unproven += found.gap.status == Status::exact ? 0 : 1;
        (found.gap.distance > 0 ? apart : found.gap.distance > -0.0625 ? shallow : deep) += 1;
    }
    EXPECT_GT(deep, many(500) / 4);
    EXPECT_GT(apart, many(500) / 8);
    EXPECT_GT(shallow, many(500) / 100);
    EXPECT_LT(unproven, many(500) / 20);
    EXPECT_LT(rough, many(500) / 50 + unproven);
}

TEST(CurvedPlacements, RestingSolidsTouchForAllQueries) {
    Random random(7207);
    int touching = 0, near = 0;
    for (int round = 0; round < many(400); ++round) {
        // A floor of each kind with a flat top at z = 0, and a body that stands on it.
        const double half = random.integer(1, 8) / 4.0, radius = random.integer(1, 8) / 4.0;
        const std::array<AnySolid, 4> floors{
            Cylinder{{{0, 0, -1}, {0, 0, 0}}, 4}, Cone{{0, 0, -2}, {}, 4},
            Box3{{-4, -4, -1}, {4, 4, 0}},
            Convex(std::vector<Vec3>{{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}, {0, 0, -2}})};
        const std::array<AnySolid, 5> bodies{upright(radius, half),
                                             Cone{{0, 0, half}, {0, 0, -half}, radius},
                                             Ellipsoid{{}, {radius, 0.5, half}}, Sphere{{}, half},
                                             Ellipsoid{{}, {half, half, half}}};
        const auto i = static_cast<std::size_t>(random.integer(0, 3)),
                   k = static_cast<std::size_t>(i < 2 ? random.integer(0, 4)
                                                      : random.integer(0, 2));
        const double gaps[] = {0, 0, 1e-9, -1e-9, 0.125, -0.125};
        const double gap = gaps[random.integer(0, 5)];
        const PlacedAnySolid a{floors[i], {}},
            b{bodies[k],
              moved_by({random.integer(-4, 4) / 8.0, random.integer(-4, 4) / 8.0, half + gap})};
        World world;
        add_solid(world, a), add_solid(world, b);
        const PlacedAnswers first = answers_of(world, 1), again = answers_of(world, 1);
        EXPECT_TRUE(first == again);
        EXPECT_EQ(first.collide, gap <= 0);
        EXPECT_EQ(first.has_depth, gap <= 0);
        EXPECT_EQ(first.has_contact, gap <= 0);
        EXPECT_NEAR(first.gap.distance, gap, 1e-14 + 1e-9 * std::abs(gap));
        EXPECT_LT(length(first.gap.normal - Vec3{0, 0, 1}), 1e-9) << round;
        EXPECT_NEAR(first.gap.point_a.z, 0, 1e-12);
        (gap == 0 ? touching : near) += 1;
    }
    EXPECT_GT(touching, many(400) / 5);
    EXPECT_GT(near, many(400) / 5);
}

TEST(CurvedPlacements, AnswersDoNotDependOnEarlierQueries) {
    Random random(7208);
    int met = 0, apart = 0;
    for (int round = 0; round < many(150); ++round) {
        PlacedAnySolid a{grid_solid(random, round % kCurvedKinds, 1), grid_pose(random)},
            b{grid_solid(random, random.integer(0, kKinds - 1), 1), grid_pose(random)};
        World used;
        add_solid(used, a);
        const BodyId moving = add_solid(used, b);
        for (int step = 0; step < 4; ++step) {
            b.pose.translation = grid_offset(random);
            used.move(moving, b.pose);
            const PlacedAnswers found = answers_of(used, 1e3);
            EXPECT_TRUE(found == answers_of(a, b));
            EXPECT_TRUE(found == answers_of(used, 1e3));
            (found.collide ? met : apart) += 1;
        }
    }
    EXPECT_GT(met, many(150));
    EXPECT_GT(apart, many(150) / 4);
}

/// The outward normal of an ellipsoid at a point of its surface.
Vec3 normal_at(const PlacedAnySolid& solid, const Vec3& point) {
    const Transform world(solid.pose);
    const auto& [a, b, c] = std::get<Ellipsoid>(solid.shape).semi_axes;
    const auto& m = world.m;
    const Vec3 from = point - solid.pose.translation, x{m[0], m[1], m[2]}, y{m[3], m[4], m[5]},
               z{m[6], m[7], m[8]};
    return normalized_or_zero(dot(from, x) / (a * a) * x + dot(from, y) / (b * b) * y +
                              dot(from, z) / (c * c) * z);
}

TEST(CurvedPlacements, NormalsAreThoseOfTheSurfaces) {
    Random random(7209);
    int deep = 0, apart = 0;
    for (int round = 0; round < many(300); ++round) {
        const auto ellipsoid = [&] {
            return Ellipsoid{
                {}, {random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)}};
        };
        const PlacedAnySolid a{ellipsoid(), random.pose(1)}, b{ellipsoid(), random.pose(1)};
        const PlacedAnswers found = answers_of(a, b);
        ASSERT_EQ(found.gap.status, Status::exact);
        EXPECT_LT(length(normal_at(a, found.gap.point_a) - found.gap.normal), 1e-10);
        EXPECT_LT(length(normal_at(b, found.gap.point_b) + found.gap.normal), 1e-10);
        (found.collide ? deep : apart) += 1;
    }
    EXPECT_GT(deep, many(300) / 5);
    EXPECT_GT(apart, many(300) / 5);
}

} // namespace
} // namespace abut::test
