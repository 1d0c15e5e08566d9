// What a gap of a cylinder, cone or ellipsoid promises: the normal is a unit vector, point_b is point_a
// plus the distance along it, both points lie on the surfaces, and the bodies are as far apart along the
// normal as the distance says, or nearly as deep. The truth comes from the shapes' definitions.

#include <abut/world.h>

#include "tests/support/curved_shapes.h"
#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/support_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace abut::test {
namespace {

struct PlacedShape {
    AnyShape shape;
    Pose pose;
};

/// A bound of the distance of the shape's points from its frame's origin.
double size_of_shape(const AnyShape& shape) {
    struct Size {
        double operator()(const Sphere& s) const { return s.radius; }
        double operator()(const Capsule& c) const { return c.radius + length(c.axis.a); }
        double operator()(const Box3& box) const { return length(box.upper); }
        double operator()(const Cylinder& c) const { return c.radius + length(c.axis.a); }
        double operator()(const Cone& c) const { return c.radius + length(c.apex); }
        double operator()(const Ellipsoid& e) const { return max_abs(e.semi_axes); }
        double operator()(const HalfSpace&) const { return 0; }
        double operator()(const Convex& c) const { return farthest_of(c.vertices()); }
        double operator()(const Model& m) const { return farthest_of(m.mesh().positions); }
        static double farthest_of(const std::vector<Vec3>& points) {
            double farthest = 0;
            for (const Vec3& p : points)
                farthest = std::max(farthest, length(p));
            return farthest;
        }
    };
    return std::visit(Size{}, shape);
}

/// The parts of a solid in the world; none of a model or a half-space.
std::optional<SolidParts> parts_in_world(const PlacedShape& placed) {
    return std::visit(
        [&](const auto& shape) -> std::optional<SolidParts> {
            if constexpr (requires { parts_of(shape); }) {
                SolidParts parts = parts_of(shape);
                parts.place(Transform(placed.pose));
                return parts;
            }
            return std::nullopt;
        },
        placed.shape);
}

/// Errors of a gap, relative to the sizes and the distance.
struct WitnessErrors {
    double points = 0;     ///< of point_b = point_a + distance * normal
    double unit = 0;       ///< of the normal's length
    double surface = 0;    ///< of the points' distances from the surfaces
    double along = 0;      ///< of the distance along the normal
    double improvable = 0; ///< by how much another direction is better, if the status is exact
    bool meet = false, exact = false, found = false;
};

WitnessErrors errors_of(Random& random, const PlacedShape& a, const PlacedShape& b) {
    World world;
    add(world, a.shape, a.pose), add(world, b.shape, b.pose);
    WitnessErrors errors;
    const double size = size_of_shape(a.shape) + size_of_shape(b.shape);
    const auto gaps = world.within(10 * size);
    if (gaps.empty())
        return errors;
    const BodyGap& gap = gaps[0];
    errors.found = true, errors.meet = gap.distance <= 0;
    errors.exact = gap.status == Status::exact;
    const double coordinates = max_abs(a.pose.translation) + max_abs(b.pose.translation),
                 rounding = 0x1p-48 * coordinates, scale = 1 / (size + std::abs(gap.distance));
    const auto relative = [&](double error) { return scale * std::max(error - rounding, 0.0); };
    const auto off = [&](const Vec3& from, const Vec3& to, double distance, const Vec3& normal) {
        const LongVec3 rest = to_long(to) - to_long(from) - Long(distance) * to_long(normal);
        return relative(double(std::sqrt(dot(rest, rest))));
    };
    errors.points = off(gap.point_a, gap.point_b, gap.distance, gap.normal);
    for (const ContactManifold& contact : world.contact_manifolds(1e-3 * size))
        for (std::uint32_t i = 0; i < contact.count; ++i)
            errors.points =
                std::max(errors.points, off(contact.points[i].point_a, contact.points[i].point_b,
                                            -contact.points[i].depth, contact.normal));
    errors.unit = std::abs(length(gap.normal) - 1);
    // The point on a curved shape below a triangle of a model may lie inside it.
    if (errors.exact || !std::holds_alternative<Model>(b.shape))
        errors.surface = relative(std::abs(distance_from_surface(a.shape, a.pose, gap.point_a)));
    errors.surface = std::max(
        errors.surface, relative(std::abs(distance_from_surface(b.shape, b.pose, gap.point_b))));
    const auto parts_a = parts_in_world(a), parts_b = parts_in_world(b);
    if (!parts_a || !parts_b || !errors.exact)
        return errors;
    const SolidPair pair{*parts_a, *parts_b};
    errors.along =
        relative(std::abs(double(pair.separation(unit(to_long(gap.normal)))) - gap.distance));
    errors.improvable =
        relative(double(pair.largest_separation(random, gap.normal)) - gap.distance);
    return errors;
}

double length_for(Random& random) {
    switch (random.integer(0, 3)) {
    case 0:
        return random.integer(1, 8) / 4.0;
    case 1:
        return random.uniform(0.1, 1);
    case 2:
        return 1;
    default:
        return std::pow(10, random.uniform(-3, 0));
    }
}

AnyShape shape_for(Random& random, int kind, double scale) {
    const double a = scale * length_for(random), b = scale * length_for(random),
                 c = scale * length_for(random);
    if (kind < kUprightKinds)
        return upright_solid<AnyShape>(random, kind, a, b, c);
    if (kind == 6)
        return Convex(box_mesh({-a, -b, -c}, {a, b, c}).positions);
    if (kind == 7)
        return HalfSpace{{0, 0, 1}, 0};
    return Model(box_mesh({-a, -b, -c}, {a, b, c}));
}
constexpr int kCurved = kUprightCurvedKinds, kShapes = kUprightKinds + 3;

std::array<double, 4> quarter_turn(Random& random) {
    const double h = std::sqrt(0.5);
    static const std::array<std::array<double, 4>, 6> kTurns{{{1, 0, 0, 0},
                                                              {h, h, 0, 0},
                                                              {h, 0, h, 0},
                                                              {0, 1, 0, 0},
                                                              {0.5, 0.5, 0.5, 0.5},
                                                              {h, 0, 0, h}}};
    return kTurns[static_cast<std::size_t>(random.integer(0, 5))];
}

/// A length from 1e-15 to 1e-3 of either sign, or 0.
double slight(Random& random) {
    return random.chance(0.3)
               ? 0
               : std::pow(10, -random.uniform(3, 15)) * (random.chance(0.5) ? 1 : -1);
}

enum class Placement { anywhere, concentric, coaxial, parallel, touching, tilted, on_grid };

/// Places b beside a, which is in its own frame.
Pose place(Random& random, const AnyShape& a, const AnyShape& b, Placement placement) {
    const double size = size_of_shape(a) + size_of_shape(b);
    Pose pose;
    switch (placement) {
    case Placement::anywhere:
        pose = random.pose(0), pose.translation = size * random.in_cube(0.6);
        break;
    case Placement::concentric:
        pose = random.pose(0);
        break;
    case Placement::coaxial:
        pose.translation = {0, 0, size * random.uniform(-1, 1)};
        pose.rotation = {0, random.chance(0.5) ? 1.0 : 0.0, 0, 1};
        break;
    case Placement::parallel:
        pose.translation = size * random.in_cube(0.7);
        break;
    case Placement::touching: {
        pose.rotation = random.chance(0.6) ? quarter_turn(random) : random.pose(0).rotation;
        const std::optional<SolidParts> of_a = parts_in_world({a, {}}),
                                        of_b = parts_in_world({b, pose});
        const double half = size_of_shape(a);
        pose.translation = half * Vec3{random.integer(-4, 4) / 4.0, random.integer(-4, 4) / 4.0, 0};
        if (of_a && of_b)
            pose.translation.z = size * slight(random) -
                                 double(SolidPair{*of_a, *of_b}.separation(LongVec3{0, 0, 1}));
        break;
    }
    case Placement::tilted: {
        const Vec3 tilt = std::pow(10, -random.uniform(3, 15)) * random.direction();
        pose.rotation = {1, tilt.x, tilt.y, tilt.z};
        pose.translation = random.chance(0.4) ? Vec3{} : size * random.in_cube(0.5);
        if (random.chance(0.3))
            pose.translation.x = pose.translation.y = 0;
        break;
    }
    case Placement::on_grid:
        pose.rotation = quarter_turn(random);
        pose.translation = size * (0.125 * (random.on_lattice(8) - Vec3{4, 4, 4}));
        break;
    }
    return pose;
}

/// Turns and moves both bodies.
void carry(Random& random, PlacedShape& a, PlacedShape& b) {
    const double reach = random.chance(0.5) ? 1e6 : std::pow(10, random.uniform(0, 4));
    const Vec3 by = reach * random.direction();
    for (PlacedShape* each : {&a, &b})
        each->pose.translation = each->pose.translation + by;
}

class CurvedWitnesses : public testing::TestWithParam<int> {};

TEST_P(CurvedWitnesses, PointsNormalsAndDepthsAgree) {
    const int kind = GetParam();
    Random random(7300 + static_cast<std::uint64_t>(kind));
    int met = 0, apart = 0, unproven = 0;
    for (int round = 0; round < many(500); ++round) {
        const double scale = random.chance(0.7) ? 1 : std::pow(10, random.integer(-3, 3));
        const int other = random.integer(0, kShapes - 1);
        PlacedShape a{shape_for(random, kind, scale), {}},
            b{shape_for(random, other,
                        scale * (random.chance(0.7) ? 1 : std::pow(10, random.uniform(-3, 0)))),
              {}};
        const int placement = random.integer(0, 6);
        b.pose = place(random, a.shape, b.shape, static_cast<Placement>(placement));
        if (random.chance(0.3))
            carry(random, a, b);
        SCOPED_TRACE("round " + std::to_string(round) + " with " + std::to_string(other) +
                     " placed " + std::to_string(placement));
        const WitnessErrors errors = errors_of(random, a, b);
        if (!errors.found)
            continue;
        EXPECT_LE(errors.points, 1e-13);
        EXPECT_LE(errors.unit, 1e-15);
        EXPECT_LE(errors.surface, 1e-13);
        EXPECT_LE(errors.along, 1e-12);
        EXPECT_LE(errors.improvable, 1e-12);
        (errors.meet ? met : apart) += 1;
        const bool with_model = std::holds_alternative<Model>(b.shape);
        unproven += !errors.exact && !with_model ? 1 : 0;
    }
    EXPECT_GT(met, many(500) / 3);
    EXPECT_GT(apart, many(500) / 5);
    EXPECT_LT(unproven, many(500) / 20);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, CurvedWitnesses, testing::Range(0, kCurved));

TEST(CurvedWitness, PegsThatAreTiltedInTheirBush) {
    // Motions along a curve of directions are nearly as short as each other.
    Random random(7310);
    int unproven = 0;
    for (int round = 0; round < many(200); ++round) {
        const Vec3 tilt = std::pow(10, random.uniform(-7, -5)) * random.direction();
        const PlacedShape bush{shape_for(random, random.integer(0, 1), 1), {}},
            peg{shape_for(random, random.integer(0, 1), 1), {{}, {1, tilt.x, tilt.y, tilt.z}}};
        SCOPED_TRACE(round);
        const WitnessErrors errors = errors_of(random, bush, peg);
        ASSERT_TRUE(errors.meet);
        EXPECT_LE(errors.points, 1e-13);
        EXPECT_LE(errors.surface, 1e-13);
        unproven += errors.exact ? 0 : 1;
    }
    EXPECT_GT(unproven, many(200) / 20);
}

TEST(CurvedWitness, ConesTipToTipLeaveAcrossASide) {
    // A flat cone upside down on a steep one's tip. Along the axes it would have farther to go, by 1e-9.
    Random random(7311);
    const double steep = 0.17985413274180259, flat = 0.0010756291663403701;
    const PlacedShape a{Cone{{0, 0, steep}, {0, 0, -steep}, 0.75}, {}},
        b{Cone{{0, 0, flat}, {0, 0, -flat}, 0.21639083106286211},
          {{0, 0, 0.18090998540713657}, {0, 1, 0, 0}}};
    const WitnessErrors errors = errors_of(random, a, b);
    EXPECT_TRUE(errors.meet && errors.exact);
    EXPECT_LE(errors.improvable, 1e-14);
    EXPECT_LE(errors.along, 1e-14);
}

TEST(CurvedWitness, TheNormalOfARimOverACapIsTheCaps) {
    // Two cylinders whose axes are tilted by 8e-11, and 0.5 apart.
    Random random(7312);
    const PlacedShape a{Cylinder{{{0, 0, -0.26717454387406625}, {0, 0, 0.26717454387406625}}, 1},
                        {}},
        b{Cylinder{{{0, 0, -0.50409210961588313}, {0, 0, 0.50409210961588313}}, 1},
          {{0, 0, 1.307440414130026},
           {1, -4.241630737911983e-11, 6.3757139763426395e-11, -9.8944983469877941e-11}}};
    const WitnessErrors errors = errors_of(random, a, b);
    EXPECT_TRUE(errors.found && errors.exact);
    EXPECT_LE(errors.along, 1e-14);
    EXPECT_LE(errors.points, 1e-14);
}

} // namespace
} // namespace abut::test
