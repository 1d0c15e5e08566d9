// Cylinders, cones, ellipsoids and half-spaces of a world: against polytopes inside and around them,
// and against closed forms.

#include <abut/error.h>
#include <abut/world.h>

#include "scenes/bodies.h"
#include "tests/support/curved_shapes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/world_script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <variant>

namespace abut::test {
namespace {

using Other = std::variant<Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid>;

Convex random_convex(Random& random) {
    std::vector<Vec3> points(static_cast<std::size_t>(random.integer(4, 24)));
    for (Vec3& p : points)
        p = random.in_cube(0.6);
    return Convex(points);
}

Other other_shape(Random& random) {
    switch (random.integer(0, 5)) {
    case 0:
        return Model(tetrahedron(random.uniform(0.3, 1.5)));
    case 1:
        return random_convex(random);
    case 2:
        return Sphere{random.in_cube(0.2), random.uniform(0.05, 0.6)};
    case 3:
        return Capsule{{random.in_cube(0.5), random.in_cube(0.5)}, random.uniform(0.05, 0.4)};
    case 4: {
        const Vec3 half = 0.35 * (random.in_cube(1) + Vec3{1.2, 1.2, 1.2});
        return Box3{-half, half};
    }
    default:
        return std::visit([](const auto& shape) { return Other(shape); },
                          curved_shape(random, random.integer(0, 2)));
    }
}

/// The shape, or a polytope inside or around it if it is curved.
enum class Stand : std::uint8_t { inner, itself, outer };
Other replaced(const Other& other, Stand side) {
    const auto replace = [&](const auto& shape) {
        return side == Stand::inner   ? Other(inside_of(shape))
               : side == Stand::outer ? Other(around(shape))
                                      : Other(shape);
    };
    if (const auto* cylinder = std::get_if<Cylinder>(&other))
        return replace(*cylinder);
    if (const auto* cone = std::get_if<Cone>(&other))
        return replace(*cone);
    if (const auto* ellipsoid = std::get_if<Ellipsoid>(&other))
        return replace(*ellipsoid);
    return other;
}

/// The gap between two bodies, as `within` sees it, or the depth as `penetration` does.
double gap_of(const Other& a, const Pose& pose_a, const Other& b, const Pose& pose_b) {
    World world;
    std::visit([&](const auto& shape) { world.add(shape, pose_a); }, a);
    std::visit([&](const auto& shape) { world.add(shape, pose_b); }, b);
    const auto depths = world.penetration();
    if (!depths.empty())
        return depths[0].distance;
    const auto gaps = world.within(20);
    return gaps.empty() ? HUGE_VAL : gaps[0].distance;
}

TEST(CurvedBodies, LieBetweenPolytopesInsideAndAround) {
    Random random(7101);
    int apart = 0, deep = 0;
    for (int round = 0; round < many(60); ++round) {
        const Other a = replaced(std::visit([](const auto&s) { return Other(s); },
                                            curved_shape(random, round % 3)),
                                 Stand::itself),
                    b = other_shape(random);
        const Pose pose_a = random.pose(0.8), pose_b = random.pose(0.8);
        const double gap = gap_of(a, pose_a, b, pose_b);
        const double most =
            gap_of(replaced(a, Stand::inner), pose_a, replaced(b, Stand::inner), pose_b);
        const double least =
            gap_of(replaced(a, Stand::outer), pose_a, replaced(b, Stand::outer), pose_b);
        // The depth of a model is a bound of its own, which only its sign relates to others.
        if (std::holds_alternative<Model>(b) && (least < 0 || gap <= 0)) {
            EXPECT_TRUE(gap <= 0 || most > 0);
            EXPECT_TRUE(gap > 0 || least <= 0);
            continue;
        }
        EXPECT_LE(gap, most + 1e-9) << round;
        EXPECT_GE(gap, least - 1e-9) << round;
        EXPECT_LT(most - least, 0.05);
        (gap > 0 ? apart : deep) += 1;
    }
    EXPECT_GT(apart, many(60) / 5);
    EXPECT_GT(deep, many(60) / 8);
}

TEST(CurvedBodies, WitnessPointsAreOnTheBodiesAndAsFarApartAsTheySay) {
    Random random(7102);
    int checked = 0;
    for (int round = 0; round < many(300); ++round) {
        World world;
        const Pose pose_a = random.pose(1), pose_b = random.pose(1);
        const Curved a = curved_shape(random, round % 3),
                     b = curved_shape(random, random.integer(0, 2));
        add(world, a, pose_a), add(world, b, pose_b);
        const auto touching = world.collide();
        for (const BodyGap& gap : world.within(10)) {
            EXPECT_NEAR(length(gap.normal), 1, 1e-12);
            EXPECT_LT(length(gap.point_b - gap.point_a - gap.distance * gap.normal), 1e-7);
            EXPECT_EQ(touching.empty(), gap.distance > 0);
            // A point has the bodies' signed distance 0, to the accuracy of the points.
            World points;
            const BodyId on_a = points.add(Sphere{gap.point_a, 0}, {}),
                         on_b = points.add(Sphere{gap.point_b, 0}, {});
            add(points, a, pose_a), add(points, b, pose_b);
            for (const BodyGap& of_point : points.within(10))
                if ((of_point.a == on_a && of_point.b.index == 2) ||
                    (of_point.a == on_b && of_point.b.index == 3)) {
                    EXPECT_NEAR(of_point.distance, 0, 1e-6);
                    ++checked;
                }
        }
    }
    EXPECT_EQ(checked, 2 * many(300));
}

/// Signed distance of a point from a cylinder along z, from -h to h, in closed form.
double distance_from_cylinder(const Vec3& p, double r, double h) {
    const double across = std::hypot(p.x, p.y) - r, along = std::abs(p.z) - h;
    if (across <= 0 || along <= 0)
        return std::max(across, along);
    return std::hypot(across, along);
}

/// Signed distance of a point from a cone whose base of radius r is at z = 0, with apex at z = h.
double distance_from_cone(const Vec3& p, double r, double h) {
    const double across = std::hypot(p.x, p.y), slant = std::hypot(r, h);
    const double beyond_side = (across * h + p.z * r - r * h) / slant; // of the side's plane
    if (beyond_side <= 0 && p.z >= 0)
        return std::max(beyond_side, -p.z);
    const auto from_segment = [&](double x0, double z0, double x1, double z1) {
        const double x = x1 - x0, z = z1 - z0;
        const double s = std::clamp(((across - x0) * x + (p.z - z0) * z) / (x * x + z * z), 0., 1.);
        return std::hypot(across - x0 - s * x, p.z - z0 - s * z);
    };
    return std::min(from_segment(0, 0, r, 0), from_segment(r, 0, 0, h));
}

TEST(CurvedBodies, BallsAgreeWithClosedForms) {
    Random random(7103);
    int deep = 0;
    for (int round = 0; round < many(400); ++round) {
        const double r = random.uniform(0.2, 1), h = random.uniform(0.2, 1),
                     ball = random.chance(0.3) ? 0 : random.uniform(0, 0.5);
        const Pose pose = random.pose(random.chance(0.1) ? 1e3 : 1);
        const Vec3 centre = random.in_cube(1.5);
        World world;
        world.add(Cylinder{{{0, 0, -h}, {0, 0, h}}, r}, pose);
        world.add(Cone{{0, 0, h}, {}, r}, pose);
        const BodyId sphere = world.add(Sphere{centre, ball}, pose);
        const std::array expected{distance_from_cylinder(centre, r, h) - ball,
                                  distance_from_cone(centre, r, h) - ball};
        int found = 0;
        for (const BodyGap& gap : world.within(10))
            if (gap.b == sphere) {
                EXPECT_NEAR(gap.distance, expected[gap.a.index], 1e-11 * 1e3) << round;
                if (max_abs(pose.translation) < 2) {
                    EXPECT_NEAR(gap.distance, expected[gap.a.index], 1e-11) << round;
                }
                deep += gap.distance < -ball ? 1 : 0;
                ++found;
            }
        EXPECT_EQ(found, 2);
    }
    EXPECT_GT(deep, many(20));
}

TEST(CurvedBodies, AnEllipsoidWithEqualAxesIsABall) {
    Random random(7104);
    int met = 0;
    for (int round = 0; round < many(200); ++round) {
        const Vec3 centre = random.in_cube(0.5);
        const double r = random.uniform(0.1, 1);
        const Pose pose = random.pose(1), other_pose = random.pose(1);
        const Curved other = curved_shape(random, round % 3);
        World balls, ellipsoids;
        balls.add(Sphere{centre, r}, pose), add(balls, other, other_pose);
        ellipsoids.add(Ellipsoid{centre, {r, r, r}}, pose), add(ellipsoids, other, other_pose);
        const auto expected = balls.within(10), found = ellipsoids.within(10);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_NEAR(found[0].distance, expected[0].distance, 1e-11);
        met += found[0].distance < 0 ? 1 : 0;
    }
    EXPECT_GT(met, many(200) / 10);
}

TEST(CurvedBodies, HalfSpacesMeetTheLowestPoints) {
    Random random(7105);
    int met = 0;
    for (int round = 0; round < many(200); ++round) {
        const Vec3 normal = random.direction();
        const double stretch = random.uniform(0.1, 10), offset = random.uniform(-1, 1);
        const Pose pose = random.pose(1), floor_pose = random.pose(1);
        const Other other = other_shape(random);
        World world;
        const BodyId floor = world.add(HalfSpace{stretch * normal, stretch * offset}, floor_pose);
        std::visit([&](const auto& shape) { world.add(shape, pose); }, other);
        // A large box stands for the half-space.
        const Vec3 n = apply_linear(Transform(floor_pose), normal),
                   on_plane = apply(Transform(floor_pose), offset * normal);
        const Vec3 u = perpendicular(n), v = cross(n, u);
        std::vector<Vec3> corners;
        for (const double x : {-90.0, 90.0})
            for (const double y : {-90.0, 90.0})
                for (const double z : {-90.0, 0.0})
                    corners.push_back(on_plane + x * u + y * v + z * n);
        const double expected = gap_of(Convex(corners), {}, other, pose);
        const auto gaps = world.within(20);
        ASSERT_EQ(gaps.size(), 1U);
        EXPECT_EQ(gaps[0].a, floor);
        const bool is_model = std::holds_alternative<Model>(other);
        if (!is_model || expected > 0) {
            EXPECT_NEAR(gaps[0].distance, expected, 1e-9) << round << ' ' << other.index();
        }
        EXPECT_EQ(gaps[0].distance <= 0, expected <= 0);
        EXPECT_LT(length(gaps[0].normal - n), 1e-12);
        EXPECT_NEAR(dot(gaps[0].point_a - on_plane, n), 0, 1e-12);
        EXPECT_LT(length(gaps[0].point_b - gaps[0].point_a - gaps[0].distance * n), 1e-12);
        EXPECT_EQ(world.penetration().size(), gaps[0].distance <= 0 ? 1U : 0U);
        EXPECT_EQ(world.collide().size(), gaps[0].distance <= 0 ? 1U : 0U);
        met += gaps[0].distance <= 0 ? 1 : 0;
    }
    EXPECT_GT(met, many(200) / 5);
    EXPECT_LT(met, many(200) * 4 / 5);
}

TEST(CurvedBodies, HalfSpacesMeetEachOtherUnlessTheirNormalsAreOpposite) {
    World world;
    world.add(HalfSpace{{0, 0, 1}, 0}, {});
    world.add(HalfSpace{{0, 0, -2}, -6}, {}); // z >= 3
    EXPECT_TRUE(world.collide().empty());
    ASSERT_EQ(world.within(4).size(), 1U);
    EXPECT_EQ(world.within(4)[0].distance, 3);
    world.add(HalfSpace{{1, 0, 0}, 0}, {});
    EXPECT_EQ(world.collide().size(), 2U);
    EXPECT_EQ(world.penetration()[0].distance, -std::numeric_limits<double>::infinity());
}

TEST(CurvedBodies, AFloorUnderManyBodies) {
    Random random(7106);
    for (const BroadPhaseMethod method :
         {BroadPhaseMethod::automatic, BroadPhaseMethod::tree, BroadPhaseMethod::sweep,
          BroadPhaseMethod::sweep_and_prune}) {
        for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{0.1, 0, 1}}) {
            World world({method, {}});
            const BodyId floor = world.add(HalfSpace{normal, 0}, {}, {.is_static = true});
            std::vector<BodyPair> expected;
            for (int i = 0; i < 200; ++i) {
                const Vec3 at = random.in_cube(20);
                const BodyId id = world.add(Sphere{at, 0.1}, {});
                if (dot(normal, at) <= 0.1 * length(normal))
                    expected.push_back({floor, id});
            }
            for (int step = 0; step < 40; ++step) {
                BodyPairs found;
                for (const BodyPair& pair : world.collide())
                    if (pair.a == floor)
                        found.push_back(pair);
                ASSERT_EQ(found, expected);
                world.update();
            }
        }
    }
}

TEST(CurvedBodies, DegenerateShapesAreSegmentsDiscsAndPoints) {
    const auto gap = [](const auto& a, const auto& b) {
        World world;
        world.add(a, {}), world.add(b, {});
        return world.within(1e18).at(0).distance;
    };
    const Sphere ball{{0, 0, 3}, 1};
    EXPECT_NEAR(gap(Cylinder{{{0, 0, 0}, {1, 0, 0}}, 0}, ball), 2, 1e-12); // a segment
    EXPECT_NEAR(gap(Cylinder{{{1, 0, 3}, {1, 0, 3}}, 0}, ball), 0, 1e-12); // a point
    EXPECT_NEAR(gap(Cone{{0, 0, 1}, {0, 0, 0}, 0}, ball), 1, 1e-12);
    EXPECT_NEAR(gap(Ellipsoid{{}, {2, 1, 0}}, ball), 2, 1e-12); // an ellipse
    EXPECT_NEAR(gap(Ellipsoid{{}, {0, 0, 2}}, ball), 0, 1e-12);
    EXPECT_NEAR(gap(Ellipsoid{{}, {0, 0, 0}}, ball), 2, 1e-12);
    EXPECT_NEAR(gap(Ellipsoid{{}, {2, 1, 0}}, Ellipsoid{{0, 0, 1}, {2, 1, 0}}), 1, 1e-12);
    EXPECT_NEAR(gap(Ellipsoid{{}, {2, 1, 0}}, Ellipsoid{{0, 0, 0}, {2, 1, 0}}), 0, 1e-12);
    EXPECT_NEAR(gap(Ellipsoid{{}, {0, 0, 0}}, Ellipsoid{{}, {0, 0, 0}}), 0, 1e-12);
    // A needle, a coin, and what is tiny or huge.
    EXPECT_NEAR(gap(Cylinder{{{-1e6, 0, 0}, {1e6, 0, 0}}, 1e-6}, ball), 2 - 1e-6, 1e-8);
    EXPECT_NEAR(gap(Cylinder{{{0, 0, 0}, {0, 0, 1e-9}}, 10}, ball), 2 - 1e-9, 1e-12);
    EXPECT_NEAR(gap(Ellipsoid{{}, {1e-200, 1e-200, 1e-200}}, Sphere{{0, 0, 3e-200}, 1e-200}),
                1e-200, 1e-210);
    EXPECT_NEAR(gap(Cone{{0, 0, 1e17}, {}, 1e17}, Sphere{{0, 0, -2e17}, 1e17}) / 1e17, 1, 1e-12);
}

TEST(CurvedBodies, AreRefusedByTheirIndex) {
    const auto message = [](const auto& shape) -> std::string {
        World world;
        world.add(Sphere{}, {});
        try {
            world.add(shape, {});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
            EXPECT_EQ(world.size(), 1U);
            return error.what();
        }
        return "no error";
    };
    const Segment axis{{}, {0, 0, 1}}, no_axis{{0, 0, 1}, {0, 0, 1}};
    EXPECT_EQ(message(Cylinder{axis, -1}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(Cylinder{axis, NAN}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(Cylinder{{{NAN, 0, 0}, {}}, 1}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(Cylinder{no_axis, 1}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(Cone{{0, 0, 1}, {0, 0, 1}, 1}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(Cone{{0, 0, 1e19}, {0, 0, 1}, 1}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(Ellipsoid{{}, {1, -1, 1}}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(Ellipsoid{{}, {1, NAN, 1}}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(HalfSpace{{0, 0, 0}, 1}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(HalfSpace{{0, INFINITY, 0}, 1}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(HalfSpace{{0, 0, 1}, NAN}).substr(0, 8), "body 1: ");
    EXPECT_EQ(message(HalfSpace{{0, 0, 1}, 1e19}).substr(0, 8), "body 1: ");
}

TEST(CurvedBodies, AModelMeetsASolidWhereATriangleDoes) {
    Random random(7107);
    const Model ball(scenes::sphere(128));
    int met = 0, apart = 0;
    for (int round = 0; round < many(60); ++round) {
        const Curved curved = curved_shape(random, round % 3);
        const Pose pose = random.pose(1.2), ball_pose = random.pose(0.5);
        World world;
        world.add(ball, ball_pose), add(world, curved, pose);
        // Each triangle is a convex body.
        World triangles;
        const BodyId solid = add(triangles, curved, pose);
        for (const auto& t : ball.mesh().triangles)
            triangles.add(
                Convex(std::vector<Vec3>{ball.mesh().positions[t[0]], ball.mesh().positions[t[1]],
                                         ball.mesh().positions[t[2]]}),
                ball_pose, {.is_static = true});
        double least = HUGE_VAL;
        for (const BodyGap& gap : triangles.within(10))
            if (gap.a == solid)
                least = std::min(least, gap.distance);
        const auto gaps = world.within(10);
        ASSERT_EQ(gaps.size(), 1U);
        EXPECT_EQ(world.collide().size(), least <= 0 ? 1U : 0U);
        const auto depths = world.penetration();
        ASSERT_EQ(depths.size(), least <= 0 ? 1U : 0U);
        EXPECT_NEAR(gaps[0].distance, least <= 0 ? depths[0].distance : least, 1e-11);
        if (least <= 0) {
            EXPECT_EQ(depths[0].status, Status::bound_only);
            EXPECT_LE(depths[0].distance, 0.5 * least);
            if (depths[0].distance < least - 1e-11) { // it must part the solid from all triangles
                std::vector<BodyId> met_triangles;
                for (const BodyPair& pair : triangles.collide())
                    met_triangles.push_back(pair.b);
                Pose moved = pose;
                moved.translation =
                    pose.translation + (1e-9 - depths[0].distance) * depths[0].normal;
                triangles.move(solid, moved);
                for (const BodyPair& pair : triangles.collide())
                    EXPECT_EQ(std::ranges::count(met_triangles, pair.b), 0);
            }
        }
        (least <= 0 ? met : apart) += 1;
    }
    EXPECT_GT(met, many(60) / 6);
    EXPECT_GT(apart, many(60) / 6);
}

TEST(CurvedBodies, DistancesAreTheSameFarFromTheOrigin) {
    Random random(7108);
    for (int round = 0; round < many(100); ++round) {
        const Curved a = curved_shape(random, round % 3),
                     b = curved_shape(random, random.integer(0, 2));
        const Pose pose_a{random.on_lattice(2), {1, 0, 0, 0}},
            pose_b{random.on_lattice(2), {1, 0, 0, 0}};
        const auto measured = [&](const Vec3& shift) {
            World world;
            add(world, a, {pose_a.translation + shift, pose_a.rotation});
            add(world, b, {pose_b.translation + shift, pose_b.rotation});
            return world.within(10).at(0).distance;
        };
        EXPECT_NEAR(measured({1e6, -1e6, 1e6}), measured({}), 1e-9);
    }
}

} // namespace
} // namespace abut::test
