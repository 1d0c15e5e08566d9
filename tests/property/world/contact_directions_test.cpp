// Directions, points and statuses of contacts where placements are special: cores on a face, an edge
// or a corner, bodies inside closed models, surfaces that cross or coincide, thin discs, bodies far
// from the origin, and bodies that meet at the start of a motion.

#include <abut/error.h>
#include <abut/penetration.h>
#include <abut/rigid.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/support_oracle.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace abut::test {
namespace {

Pose turned(const Vec3& axis, double angle, const Vec3& place) {
    const Vec3 q = std::sin(0.5 * angle) * normalized_or_zero(axis);
    return {place, {std::cos(0.5 * angle), q.x, q.y, q.z}};
}

/// A place of the cube of half-width 1: on a face, an edge or a corner, on a grid of quarters.
Vec3 on_cube(Random& random) {
    std::array<double, 3> p{};
    for (double& each : p)
        each = 0.25 * random.integer(-3, 3);
    const int first = random.integer(0, 2), count = random.integer(1, 3);
    for (int k = 0; k < count; ++k)
        p[static_cast<std::size_t>((first + k) % 3)] = random.chance(0.5) ? 1 : -1;
    return {p[0], p[1], p[2]};
}

/// Nothing, some roundings, or a little more.
Vec3 slight_shift(Random& random) {
    constexpr std::array<double, 5> kSizes{0x1p-52, 0x1p-50, 1e-14, 1e-12, 1e-10};
    if (random.chance(0.3))
        return {};
    const double size = kSizes[static_cast<std::size_t>(random.integer(0, 4))];
    const int x = random.integer(-2, 2), y = random.integer(-2, 2), z = random.integer(-2, 2);
    return {size * x, size * y, size * z};
}

TEST(ContactDirections, OfACoreOnASurfaceComeFromFacesAndEdges) {
    Random random(701);
    const Box3 box{{-1, -1, -1}, {1, 1, 1}};
    const Convex convex(box_mesh({-1, -1, -1}, {1, 1, 1}));
    const Model model(box_mesh({-1, -1, -1}, {1, 1, 1}));
    int on_surface = 0, near_surface = 0;
    const int count = many(1500);
    for (int i = 0; i < count; ++i) {
        const Vec3 axis = random.chance(0.5) ? Vec3{0, 0, 1} : random.direction();
        Pose pose = turned(axis, random.integer(0, 89) * std::numbers::pi / 180, {});
        const Vec3 shift = slight_shift(random);
        const Vec3 centre = apply(Transform(pose), on_cube(random)) + shift;
        const double radius = random.chance(0.5) ? 0.1 : 1;
        const int kind = random.integer(0, 2);
        World world;
        SolidPair pair;
        if (kind < 2 && random.chance(0.5)) {
            const Capsule capsule{{{}, random.direction()}, radius};
            world.add(capsule, Pose{centre, {1, 0, 0, 0}});
            pair.a = parts_of(capsule);
        } else {
            world.add(Sphere{{}, radius}, Pose{centre, {1, 0, 0, 0}});
            pair.a = parts_of(Sphere{{}, radius});
        }
        pair.a.place(Transform(Pose{centre, {1, 0, 0, 0}}));
        if (kind == 0)
            world.add(box, pose);
        else if (kind == 1)
            world.add(convex, pose);
        else
            world.add(model, pose);
        pair.b = parts_of(box);
        pair.b.place(Transform(pose));

        const std::vector<BodyGap> gaps = world.penetration();
        const std::vector<ContactManifold> contacts = world.contact_manifolds();
        ASSERT_EQ(gaps.size(), 1U);
        ASSERT_EQ(contacts.size(), 1U);
        const double distance = gaps[0].distance, error = 4e-13 * (4 + radius);
        ASSERT_NEAR(contacts[0].points[0].depth, -distance, error);
        for (const Vec3& normal : {gaps[0].normal, contacts[0].normal}) {
            ASSERT_NEAR(length(normal), 1, 1e-14);
            ASSERT_GE(double(pair.separation(to_long(normal))), distance - error)
                << kind << " round " << i << " shift " << max_abs(shift);
        }
        ++(shift == Vec3{} ? on_surface : near_surface);
    }
    EXPECT_GT(on_surface, count / 5);
    EXPECT_GT(near_surface, count / 2);
}

struct Answers {
    std::size_t collide, penetration, within, contacts;
};
Answers answers_of(World& world) {
    return {world.collide().size(), world.penetration().size(), world.within(0).size(),
            world.contact_manifolds().size()};
}

/// A model is its surface: what lies inside it, clear of its triangles, shares no point with it.
TEST(ContactDirections, ABodyInsideAClosedModelIsInNoContact) {
    const Model outer(box_mesh({-1, -1, -1}, {1, 1, 1}));
    const Mesh small = box_mesh({-.125, -.125, -.125}, {.125, .125, .125});
    const std::vector<AnyShape> inner{Sphere{{}, .125},
                                      Capsule{{{-.0625, 0, 0}, {.0625, 0, 0}}, .0625},
                                      Box3{{-.125, -.125, -.125}, {.125, .125, .125}},
                                      Cylinder{{{0, 0, -.125}, {0, 0, .125}}, .125},
                                      Convex(small),
                                      Model(small)};
    for (std::size_t i = 0; i < inner.size(); ++i)
        for (const bool is_first : {false, true})
            for (const Vec3& place : {Vec3{}, Vec3{.5, .25, 0}, Vec3{.875 - 0x1p-30, 0, 0}}) {
                World world;
                if (is_first)
                    add(world, inner[i], Pose{place, {1, 0, 0, 0}});
                world.add(outer, {});
                if (!is_first)
                    add(world, inner[i], Pose{place, {1, 0, 0, 0}});
                const Answers answers = answers_of(world);
                EXPECT_EQ(answers.collide + answers.penetration + answers.within + answers.contacts,
                          0U)
                    << i << " at " << place.x;
                const std::vector<BodyGap> near = world.within(1);
                const std::vector<ContactManifold> contacts = world.contact_manifolds(1);
                ASSERT_EQ(near.size(), 1U);
                ASSERT_GE(contacts.size(), 1U) << i << " at " << place.x;
                EXPECT_NEAR(near[0].distance, .875 - place.x, 1e-12);
                double deepest = -HUGE_VAL;
                for (const ContactManifold& each : contacts)
                    deepest = std::max(deepest, each.points[0].depth);
                EXPECT_NEAR(deepest, -near[0].distance, 1e-12) << i;
            }
    // A solid holds what lies inside it.
    for (const AnyShape& solid :
         {AnyShape(Box3{{-1, -1, -1}, {1, 1, 1}}), AnyShape(Convex(outer.mesh()))})
        for (const Vec3& place : {Vec3{}, Vec3{.5, .25, 0}}) {
            World world;
            world.add(Model(small), Pose{place, {1, 0, 0, 0}});
            add(world, solid, {});
            const Answers answers = answers_of(world);
            EXPECT_EQ(answers.collide, 1U);
            EXPECT_EQ(answers.penetration, 1U);
            EXPECT_EQ(answers.within, 1U);
            EXPECT_EQ(answers.contacts, 1U);
            const std::vector<ContactManifold> contacts = world.contact_manifolds(1);
            ASSERT_EQ(contacts.size(), 1U);
            EXPECT_NEAR(contacts[0].points[0].depth, -world.penetration()[0].distance, 1e-12);
            EXPECT_GT(contacts[0].points[0].depth, 0.1);
        }
}

/// An open surface inside, also as one of several pieces, and one that comes through.
TEST(ContactDirections, ASheetInsideAClosedModelIsInNoContact) {
    Random random(20261129);
    int inside = 0, through = 0;
    for (int round = 0; round < many(150); ++round) {
        std::vector<Vec3> corners;
        for (int i = random.integer(8, 30); i > 0; --i)
            corners.push_back(10 * random.direction());
        const Model hull(Convex(corners).mesh());
        const double size = random.uniform(1, 7), bend = random.chance(0.5) ? 0.3 : 0;
        Mesh sheets = grid_mesh(4, 4, false, false, [&](double u, double v) {
            return Vec3{size * (2 * u - 1), size * (2 * v - 1), bend * std::sin(9 * u)};
        });
        if (random.chance(0.4)) { // and one far away
            const auto first = static_cast<std::uint32_t>(sheets.positions.size());
            sheets.positions.insert(sheets.positions.end(), {{40, 0, 0}, {41, 0, 0}, {40, 1, 0}});
            sheets.triangles.push_back({first, first + 1, first + 2});
        }
        Pose pose = random.pose(0);
        pose.translation = random.in_cube(3);
        World world;
        const bool hull_first = random.chance(0.5);
        if (hull_first)
            world.add(hull, {});
        world.add(Model(sheets), pose);
        if (!hull_first)
            world.add(hull, {});
        SCOPED_TRACE(round);
        const Answers answers = answers_of(world);
        EXPECT_EQ(answers.contacts > 0, answers.collide > 0);
        EXPECT_EQ(answers.penetration, answers.collide);
        (answers.collide > 0 ? through : inside) += 1;
        const std::vector<BodyGap> near = world.within(2);
        const std::vector<ContactManifold> contacts = world.contact_manifolds(2);
        EXPECT_EQ(contacts.empty(), near.empty());
        if (answers.collide > 0 || near.empty())
            continue;
        double deepest = -HUGE_VAL;
        for (const ContactManifold& each : contacts)
            deepest = std::max(deepest, each.points[0].depth);
        EXPECT_NEAR(deepest, -near[0].distance, 1e-12);
    }
    EXPECT_GT(inside, many(150) / 4);
    EXPECT_GT(through, many(150) / 20);
}

Model plate(int n) {
    return Model(grid_mesh(n, n, false, false, [](double u, double v) {
        return Vec3{2 * u - 1, 2 * v - 1, 0};
    }));
}

/// The depth of crossing plates depends on their triangles, and so is no exact depth of the plates.
TEST(ContactDirections, DepthsOfSurfacesAreBounds) {
    const Pose across = turned({1, 0, 0}, std::numbers::pi / 2, {0, 0, .2});
    for (const int n : {2, 5}) {
        const Model sheet = plate(n);
        const Depth depth = penetration(sheet, Pose{}, sheet, across);
        ASSERT_TRUE(depth.interpenetrate);
        EXPECT_EQ(depth.status, Status::bound_only);
        EXPECT_EQ(distance(sheet, Pose{}, sheet, across, {.signed_distance = true}).status,
                  Status::bound_only);
        World world;
        world.add(sheet, {});
        world.add(sheet, across);
        EXPECT_EQ(world.penetration().at(0).status, Status::bound_only);
    }
    const Model cube(box_mesh({-1, -1, -1}, {1, 1, 1})),
        open(open_box_mesh({-1, -1, -1}, {1, 1, 1}));
    EXPECT_EQ(penetration(cube, Pose{}, cube, Pose{}).status, Status::bound_only);
    EXPECT_EQ(distance(cube, Pose{}, cube, Pose{}, {.signed_distance = true}).status,
              Status::bound_only);
    for (const Model* other : {&cube, &open})
        for (const Vec3& place : {Vec3{}, Vec3{1.5, 0, 0}, Vec3{.25, .5, 0}}) {
            World world;
            world.add(cube, {});
            world.add(*other, Pose{place, {1, 0, 0, 0}});
            const BodyGap gap = world.penetration().at(0);
            EXPECT_LT(gap.distance, 0);
            EXPECT_EQ(gap.status, Status::bound_only) << place.x;
        }
    // The depth of the deepest point in a solid stays exact.
    EXPECT_EQ(penetration(cube, Pose{}, cube, Pose{{2, .5, 0}, {1, 0, 0, 0}}).status,
              Status::exact);
}

/// Far from the origin, positions are rounded, but the search for a distance is not less exact.
TEST(ContactDirections, ConvexDistancesFarFromTheOriginAreThoseNearIt) {
    Random random(702);
    const Convex slab(box_mesh({-1, -1, -1e-4}, {1, 1, 1e-4})),
        needle(box_mesh({-1e-4, -1e-4, -1}, {1e-4, 1e-4, 1})),
        corner(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::array bodies{&slab, &needle, &corner};
    constexpr double kNearlyZero = 0x1.8p-52;
    const std::array<std::array<double, 9>, 3> turns{
        {{1, 0, 0, 0, 1, 0, 0, 0, 1},
         {kNearlyZero, 1 + 0x1p-52, 0, 0, kNearlyZero, 1 + 0x1p-52, 1 + 0x1p-52, 0, kNearlyZero},
         {0, 1 - 0x1p-53, kNearlyZero, -1 + 0x1p-53, 0, 0, 0, kNearlyZero, 1}}};
    int apart = 0;
    const int count = many(3000);
    for (int i = 0; i < count; ++i) {
        const auto any = [&](const auto& list) {
            return list[static_cast<std::size_t>(random.integer(0, int(list.size()) - 1))];
        };
        const Convex &a = *any(bodies), &b = *any(bodies);
        Transform at_a, at_b;
        const auto turn_a = any(turns), turn_b = any(turns);
        std::copy(turn_a.begin(), turn_a.end(), at_a.m.begin());
        std::copy(turn_b.begin(), turn_b.end(), at_b.m.begin());
        for (std::size_t k = 9; k < 12; ++k)
            at_b.m[k] = 0.5 * random.integer(-6, 6);
        Transform far_a = at_a, far_b = at_b;
        for (std::size_t k = 9; k < 12; ++k)
            far_a.m[k] += 0x1p20, far_b.m[k] += 0x1p20;
        const double near = distance(a, at_a, b, at_b).distance,
                     far = distance(a, far_a, b, far_b).distance;
        // A position at 2^20 is rounded by 2^-33; some of them decide a distance.
        ASSERT_NEAR(far, near, 6 * 0x1p-33) << "round " << i;
        const double depth_near = penetration(a, at_a, b, at_b).depth,
                     depth_far = penetration(a, far_a, b, far_b).depth;
        ASSERT_NEAR(depth_far, depth_near, 6 * 0x1p-33) << "round " << i;
        apart += near > 0.1 ? 1 : 0;
    }
    EXPECT_GT(apart, count / 2);
}

/// How far a point is outside of a body; of a model, from its surface.
double outside_of(const AnyShape& shape, const Pose& pose, const Vec3& p) {
    const double distance = distance_from_surface(shape, pose, p);
    return std::holds_alternative<Model>(shape) ? std::abs(distance) : distance;
}

TEST(ContactDirections, BodiesThatMeetAtTheStartHaveOneCommonPoint) {
    Random random(703);
    int pairs = 0, parting = 0;
    const std::vector<KindOfBody> kinds = kinds_of_bodies();
    const int count = many(1500);
    for (int i = 0; i < count; ++i) {
        const auto any = [&]() -> const KindOfBody& {
            return kinds[static_cast<std::size_t>(random.integer(0, int(kinds.size()) - 1))];
        };
        const KindOfBody &a = any(), &b = any();
        const Pose pose_a =
            turned(random.direction(), random.integer(0, 3) * std::numbers::pi / 2, {});
        const Pose pose_b{
            {.25 * random.integer(-3, 3), .25 * random.integer(-3, 3), .25 * random.integer(-3, 3)},
            {1, 0, 0, 0}};
        World world;
        add(world, a.shape, pose_a);
        const BodyId moving = add(world, b.shape, pose_b);
        if (world.collide().empty())
            continue;
        Motion motion = Motion::fixed(pose_b);
        EXPECT_TRUE(world.time_of_impact({{moving, motion}}).empty());
        motion.velocity = random.direction();
        const std::vector<BodyImpact> impacts = world.time_of_impact({{moving, motion}});
        if (impacts.empty()) { // they only touch, and part
            const BodyGap gap = world.penetration().at(0);
            ASSERT_LE(-gap.distance, 1e-9) << a.name << ' ' << b.name;
            ASSERT_GE(dot(motion.velocity, gap.normal), -1e-9) << a.name << ' ' << b.name;
            ++parting;
            continue;
        }
        ASSERT_EQ(impacts.size(), 1U);
        const Impact& impact = impacts[0].impact;
        ASSERT_EQ(impact.time, 0) << a.name << ' ' << b.name;
        ASSERT_EQ(impact.normal, (Vec3{})) << a.name << ' ' << b.name;
        ASSERT_LE(length(impact.point_b - impact.point_a), 1e-12) << a.name << ' ' << b.name;
        for (const auto& [kind, pose] : {std::pair(&a, pose_a), std::pair(&b, pose_b)})
            // A component of a model inside a solid has a vertex for the point.
            ASSERT_LE(outside_of(kind->shape, pose, impact.point_a), 1e-11)
                << a.name << ' ' << b.name << ' ' << kind->name;
        ++pairs;
    }
    EXPECT_GT(pairs, count / 3);
    EXPECT_GT(parting, count / 300);
}

TEST(ContactDirections, BodiesAtRestByTheirMotionsAreNoPair) {
    World world;
    const Pose place{{1, 0, 0}, {1, 0, 0, 0}};
    const BodyId a = world.add(Sphere{{}, 1}, {}), b = world.add(Sphere{{}, 1}, place);
    EXPECT_TRUE(world.time_of_impact({{a, Motion::fixed({})}, {b, Motion::fixed(place)}}).empty());
    EXPECT_THROW((void)world.time_of_impact({{a, Motion::fixed({})}, {a, Motion::fixed({})}}),
                 Error);
    Motion moving = Motion::fixed(place);
    moving.velocity = {1, 0, 0};
    EXPECT_EQ(world.time_of_impact({{a, Motion::fixed({})}, {b, moving}}).size(), 1U);
}

/// Thin discs and rods in blocks: many motions are nearly as short as the shortest one.
TEST(ContactDirections, WitnessPointsOfThinCurvedBodiesLieOnThem) {
    Random random(704);
    const std::vector<AnyShape> blocks{Convex(box_mesh({-1, -1, -1}, {1, 1, 1})),
                                       Box3{{-1, -1, -1}, {1, 1, 1}},
                                       Cylinder{{{0, 0, -1}, {0, 0, 1}}, 1}};
    int met = 0;
    const int count = many(600);
    for (int i = 0; i < count; ++i) {
        const double thin = std::pow(10.0, -random.integer(1, 4));
        const std::vector<AnyShape> discs{Ellipsoid{{}, {1, 1, thin}},
                                          Cylinder{{{0, 0, -thin}, {0, 0, thin}}, 1},
                                          Cone{{0, 0, thin}, {0, 0, 0}, 1}};
        const AnyShape &block = blocks[std::size_t(random.integer(0, 2))],
                       &disc = discs[std::size_t(random.integer(0, 2))];
        const Pose pose_a = turned(std::array{Vec3{1, 0, 0}, Vec3{0, 1, 0},
                                              Vec3{0, 0, 1}}[std::size_t(random.integer(0, 2))],
                                   random.integer(0, 3) * std::numbers::pi / 2, {});
        const double away = random.chance(0.5) ? thin : 0;
        const Pose pose_b =
            turned({0, 0, 1}, random.integer(0, 2) * std::numbers::pi / 4,
                   {1 - away, .25 * random.integer(-3, 3), random.chance(0.5) ? thin : 0});
        World world;
        add(world, block, pose_a);
        add(world, disc, pose_b);
        const std::vector<BodyGap> gaps = world.penetration();
        if (gaps.empty())
            continue;
        const BodyGap& gap = gaps[0];
        ASSERT_LE(length(gap.point_b - gap.point_a - gap.distance * gap.normal), 1e-10)
            << "round " << i << " thin " << thin;
        ASSERT_LE(distance_from_surface(block, pose_a, gap.point_a), 1e-10) << "round " << i;
        ASSERT_LE(distance_from_surface(disc, pose_b, gap.point_b), 1e-10) << "round " << i;
        ++met;
    }
    EXPECT_GT(met, count / 2);
    // The found cases.
    World world;
    world.add(Convex(box_mesh({-1, -1, -1}, {1, 1, 1})),
              turned({0, 1, 0}, std::numbers::pi / 2, {}));
    world.add(Ellipsoid{{}, {1, 1, 1e-4}},
              turned({0, 0, 1}, std::numbers::pi / 4, {.9999, -.5, 0}));
    const BodyGap disc = world.penetration().at(0);
    EXPECT_NEAR(disc.distance, -1.0001, 1e-12);
    EXPECT_LE(length(disc.point_b - disc.point_a - disc.distance * disc.normal), 1e-11);
    World block_in_drum;
    block_in_drum.add(Box3{{-1e-4, -1e-4, -1e-4}, {1e-4, 1e-4, 1e-4}}, {});
    block_in_drum.add(Cylinder{{{0, 0, -1e4}, {0, 0, 1e4}}, 5000},
                      Pose{{0, 1e-12, 0}, {1, 0, 0, 0}});
    EXPECT_NEAR(block_in_drum.penetration().at(0).distance, -5000.0001, 2e-8);
}

/// A lower bound of a depth has points that are as far apart.
TEST(ContactDirections, WitnessPointsOfModelsAndCurvedBodiesAreTheDepthApart) {
    Random random(705);
    const Model cube(box_mesh({-1, -1, -1}, {1, 1, 1}));
    const std::vector<AnyShape> curved{Cylinder{{{0, 0, -1}, {0, 0, 1}}, 1},
                                       Cone{{0, 0, 1}, {0, 0, -1}, 1}, Ellipsoid{{}, {2, 1, .5}},
                                       Ellipsoid{{}, {1, 1, 1e-4}}};
    int bounds = 0, met = 0;
    const int count = many(300);
    for (int i = 0; i < count; ++i) {
        const AnyShape& shape = curved[std::size_t(random.integer(0, 3))];
        const Pose pose = turned({1, 0, 0}, random.integer(0, 1) * std::numbers::pi / 2,
                                 {.5 * random.integer(-3, 3) - 1e-4, .5 * random.integer(-3, 3),
                                  random.chance(0.5) ? 0.2 : 0.});
        World world;
        world.add(cube, {});
        add(world, shape, pose);
        const std::vector<BodyGap> gaps = world.penetration();
        if (gaps.empty())
            continue;
        const BodyGap& gap = gaps[0];
        ++met;
        bounds += gap.status == Status::bound_only ? 1 : 0;
        ASSERT_LE(length(gap.point_b - gap.point_a - gap.distance * gap.normal), 1e-10)
            << "round " << i;
        ASSERT_LE(outside_of(cube, {}, gap.point_a), 1e-10) << "round " << i;
        ASSERT_LE(distance_from_surface(shape, pose, gap.point_b), 1e-10) << "round " << i;
    }
    EXPECT_GT(met, count / 3);
    EXPECT_GT(bounds, count / 10);
}

} // namespace
} // namespace abut::test
