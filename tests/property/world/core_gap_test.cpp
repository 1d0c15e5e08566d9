// Balls and capsules at models: where the centre or the axis lies on the surface, and how deep it
// lies inside, against points sampled along the axis.

#include <abut/shape_queries.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

std::vector<std::pair<Model, bool>> some_models() {
    std::vector<std::pair<Model, bool>> models;
    for (const KindOfBody& kind : kinds_of_bodies())
        if (const auto* model = std::get_if<Model>(&kind.shape))
            models.emplace_back(*model, kind.closed);
    models.emplace_back(Model(torus_mesh(1, .4, 24, 12)), true);
    return models;
}

/// Bound on the rounding of a distance between two bodies within `far` of the origin on each axis: 64
/// operations on numbers of at most 4 + 3 far, because each body reaches less than 4 from its place.
double rounding_at(double far) {
    return 64 * std::numeric_limits<double>::epsilon() * (4 + 3 * far);
}

/// A point of a triangle in the world, on a grid of its edges; rounding leaves it off the surface by
/// as much.
Vec3 point_on(Random& random, const Model& model, const Pose& pose, std::size_t triangle) {
    const auto& [i, j, k] = model.mesh().triangles[triangle];
    const auto& p = model.mesh().positions;
    const double u = .25 * random.integer(0, 4), v = (1 - u) * .25 * random.integer(0, 4);
    return apply(Transform(pose), p[i] + u * (p[j] - p[i]) + v * (p[k] - p[i]));
}

void expect_on_both(const BodyGap& gap, const AnyShape& core, const Model& model, const Pose& pose,
                    double tolerance) {
    EXPECT_NEAR(length(gap.normal), 1, 1e-12);
    EXPECT_NEAR(length(gap.point_b - gap.point_a - gap.distance * gap.normal), 0, tolerance);
    EXPECT_NEAR(distance_from_surface(model, pose, gap.point_a), 0, tolerance);
    EXPECT_NEAR(distance_from_surface(core, {}, gap.point_b), 0, tolerance);
}

TEST(CoreGap, ACoreOnTheSurfaceIsAsDeepAsItsRadius) {
    Random random(5405);
    int touching = 0, rounded = 0;
    const auto models = some_models();
    for (int round = 0; round < many(800); ++round) {
        SCOPED_TRACE(round);
        const auto& [model, closed] = models[static_cast<std::size_t>(round) % models.size()];
        const double far = round % 3 == 2 ? 1000 : round % 3;
        const Pose pose = random.pose(far);
        const auto triangle = static_cast<std::size_t>(
            random.integer(0, static_cast<int>(model.mesh().triangles.size()) - 1));
        const Segment axis{point_on(random, model, pose, triangle),
                           point_on(random, model, pose, triangle)};
        const double tolerance = rounding_at(far), radius = .25;
        // The queries of one model and a shape: 0 if they overlap, else rounding.
        const Gap gap = distance(model, pose, axis);
        const Nearest place = nearest(model, pose, axis.a, {.signed_distance = closed});
        EXPECT_EQ(gap.distance == 0, overlaps(model, pose, axis));
        EXPECT_EQ(place.distance == 0, overlaps(model, pose, Sphere{axis.a, 0}));
        EXPECT_LE(std::abs(place.distance), tolerance);
        EXPECT_LE(gap.distance, tolerance);
        gap.distance == 0 ? ++touching : ++rounded;
        for (const AnyShape& core :
             {AnyShape(Sphere{axis.a, radius}), AnyShape(Capsule{axis, radius})}) {
            if (axis.a == axis.b && std::holds_alternative<Capsule>(core))
                continue;
            World world;
            world.add(model, pose), add(world, core, {});
            for (const auto& gaps : {world.penetration(), world.within(0)}) {
                ASSERT_EQ(gaps.size(), 1U);
                EXPECT_NEAR(gaps[0].distance, -radius, tolerance);
                expect_on_both(gaps[0], core, model, pose, tolerance);
            }
        }
    }
    EXPECT_GT(touching, many(800) / 10);
    EXPECT_GT(rounded, many(800) / 10);
}

TEST(CoreGap, ACoreOnAFaceOfAConvexBodyLeavesAlongTheNormal) {
    Random random(5407);
    std::vector<KindOfBody> kinds = kinds_of_bodies();
    std::erase_if(kinds, [](const KindOfBody& kind) {
        return !std::holds_alternative<Convex>(kind.shape) &&
               !std::holds_alternative<Box3>(kind.shape);
    });
    int checked = 0;
    for (int round = 0; round < many(2000); ++round) {
        SCOPED_TRACE(round);
        const KindOfBody& kind = kinds[static_cast<std::size_t>(round) % kinds.size()];
        const auto* hull = std::get_if<Convex>(&kind.shape);
        const Box3 box = hull != nullptr ? Box3{} : std::get<Box3>(kind.shape);
        const Model surface(hull != nullptr ? hull->mesh() : box_mesh(box.lower, box.upper));
        const double far = round % 3 == 2 ? 1000 : round % 3, radius = .25;
        const Pose pose = random.pose(far);
        const auto triangle = static_cast<std::size_t>(
            random.integer(0, static_cast<int>(surface.mesh().triangles.size()) - 1));
        const Segment axis{point_on(random, surface, pose, triangle),
                           point_on(random, surface, pose, triangle)};
        if (axis.a == axis.b)
            continue;
        const double tolerance = rounding_at(far);
        for (const AnyShape& core :
             {AnyShape(Sphere{axis.a, radius}), AnyShape(Capsule{axis, radius})}) {
            World world;
            add(world, kind.shape, pose);
            const BodyId body = add(world, core, {});
            const auto gaps = world.penetration();
            ASSERT_EQ(gaps.size(), 1U);
            EXPECT_NEAR(gaps[0].distance, -radius, tolerance);
            expect_on_both(gaps[0], core, surface, pose, tolerance);
            world.move(body, {-gaps[0].distance * gaps[0].normal, {1, 0, 0, 0}});
            const auto after = world.within(1);
            ASSERT_EQ(after.size(), 1U);
            EXPECT_NEAR(after[0].distance, 0, tolerance);
            ++checked;
        }
    }
    EXPECT_GT(checked, many(2000));
}

/// The signed distance of a point from a closed model: by all triangles, and by the parity of a ray.
double from_solid(const Model& model, const Pose& pose, const Vec3& p) {
    const double distance = distance_from_surface(model, pose, p);
    return contains(model, pose, p).side == Side::inside ? -distance : distance;
}

TEST(CoreGap, TheDepthIsThatOfTheDeepestPointOfTheCore) {
    Random random(5406);
    int balls = 0, capsules = 0, beyond = 0;
    auto models = some_models();
    std::erase_if(models, [](const auto& each) { return !each.second; });
    for (int round = 0; round < many(400); ++round) {
        SCOPED_TRACE(round);
        const Model& model = models[static_cast<std::size_t>(round) % models.size()].first;
        const Pose pose = round % 2 == 0 ? Pose{} : random.pose(1);
        const double radius = random.uniform(.05, .5);
        const bool grid = round % 4 < 2;
        const auto point = [&] {
            return grid ? .25 * random.on_lattice(8) - Vec3{1, 1, 1} : random.in_cube(1);
        };
        const Segment axis{point(), point()};
        const bool is_ball = round % 3 == 0 || axis.a == axis.b;
        const AnyShape core =
            is_ball ? AnyShape(Sphere{axis.a, radius}) : AnyShape(Capsule{axis, radius});
        World world;
        world.add(model, pose), add(world, core, {});
        const auto gaps = world.penetration();
        if (gaps.empty())
            continue;
        // The deepest of many points of the core; between two of them it is less than `step` deeper.
        constexpr int kPoints = 200;
        double deepest = -HUGE_VAL;
        for (int i = 0; i <= (is_ball ? 0 : kPoints); ++i)
            deepest =
                std::max(deepest, -from_solid(model, pose,
                                              axis.a + (1.0 * i / kPoints) * (axis.b - axis.a)));
        const double step = is_ball ? 1e-12 : .5 * length(axis.b - axis.a) / kPoints + 1e-12;
        const double depth = -gaps[0].distance;
        expect_on_both(gaps[0], core, model, pose, 1e-13);
        if (is_ball || gaps[0].status == Status::exact) {
            EXPECT_GE(depth, deepest + radius - 1e-12);
            EXPECT_LE(depth, deepest + radius + step);
            ++(is_ball ? balls : capsules);
        } else {
            EXPECT_GE(depth, 0);
            ++beyond;
        }
    }
    EXPECT_GT(balls, 40);
    EXPECT_GT(capsules, 40);
    EXPECT_LT(beyond, capsules * 3);
}

} // namespace
} // namespace abut::test
