// Impacts of convex bodies that turn as they fly: an impact that happens is proven, and bodies that
// pass each other do not meet. Fine steps of the same motion, and models of the same shapes, tell
// the truth.

#include <abut/convex.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

namespace abut::test {
namespace {

std::vector<BodyImpact> impacts_of(const AnyShape& moving, const Motion& motion,
                                   const AnyShape& still) {
    World world;
    const BodyId body = add(world, moving, motion.start);
    add(world, still, {});
    return world.time_of_impact({{body, motion}});
}

Motion flight(const Vec3& from, const Vec3& velocity, const Vec3& turn) {
    Motion motion;
    motion.start.translation = motion.centre = from;
    motion.velocity = velocity, motion.angular_velocity = turn;
    return motion;
}

TEST(ProvenImpacts, ATurningCubeThatHitsACubeIsProven) {
    const Box3 cube{{-1, -1, -1}, {1, 1, 1}};
    const Mesh mesh = box_mesh(cube.lower, cube.upper);
    const std::vector<AnyShape> shapes{cube, Convex(mesh.positions), Model(mesh)};
    for (const Vec3& turn : {Vec3{}, Vec3{0, 5, 0}, Vec3{3, 0, 0}, Vec3{0, 0, .1}})
        for (const AnyShape& shape : shapes) {
            SCOPED_TRACE(shape.index());
            const auto impacts = impacts_of(shape, flight({-5, 1.5, 0}, {10, 0, 0}, turn), shape);
            ASSERT_EQ(impacts.size(), 1U);
            const Impact& impact = impacts[0].impact;
            EXPECT_EQ(impact.status, Status::exact);
            EXPECT_GE(impact.contact_time, impact.time);
            EXPECT_LE(impact.contact_time, impact.time + 1e-5);
        }
}

/// The deepest that two bodies lie in each other at fine steps, and the first step at which they
/// share a point.
struct FineSteps {
    double deepest = 0, nearest = HUGE_VAL;
    std::optional<double> first;
};
FineSteps fine_steps(const AnyShape& moving, const Motion& motion, const AnyShape& still) {
    constexpr int kSteps = 400;
    World world;
    const BodyId body = add(world, moving, motion.start);
    add(world, still, {});
    FineSteps found;
    for (int step = 0; step <= kSteps; ++step) {
        const double time = double(step) / kSteps;
        const double angle = 0.5 * time * length(motion.angular_velocity);
        const Vec3 axis = normalized_or_zero(motion.angular_velocity);
        world.move(body, {motion.start.translation + time * motion.velocity,
                          {std::cos(angle), std::sin(angle) * axis.x, std::sin(angle) * axis.y,
                           std::sin(angle) * axis.z}});
        for (const BodyGap& gap : world.within(1)) {
            found.nearest = std::min(found.nearest, gap.distance);
            found.deepest = std::max(found.deepest, -gap.distance);
            if (gap.distance <= 0 && !found.first)
                found.first = time;
        }
    }
    return found;
}

TEST(ProvenImpacts, EveryImpactIsProvenAndNoNearMissIsOne) {
    Random random(5403);
    std::vector<KindOfBody> kinds = kinds_of_bodies();
    std::erase_if(kinds, [](const KindOfBody& kind) {
        return !kind.closed || std::holds_alternative<HalfSpace>(kind.shape);
    });
    int proven = 0, missed = 0, narrow = 0;
    for (int round = 0; round < many(80); ++round) {
        const int last = static_cast<int>(kinds.size()) - 1;
        const KindOfBody &moving = kinds[static_cast<std::size_t>(random.integer(0, last))],
                         &still = kinds[static_cast<std::size_t>(random.integer(0, last))];
        // Half of the flights are along an axis and turn about one, at places on a grid.
        const bool grid = round % 2 == 0;
        const double y = grid ? .25 * random.integer(-6, 6) : random.uniform(-1.8, 1.8),
                     z = grid ? .25 * random.integer(-6, 6) : random.uniform(-1.8, 1.8);
        const Vec3 turn = grid ? Vec3{0, 1.0 * random.integer(-5, 5), 0} : random.in_cube(5);
        const Motion motion = flight({-4, y, z}, {8, 0, 0}, turn);
        SCOPED_TRACE(moving.name + " at " + still.name + " y " + std::to_string(y) + " z " +
                     std::to_string(z) + " turn " + std::to_string(turn.y));
        const FineSteps truth = fine_steps(moving.shape, motion, still.shape);
        const auto impacts = impacts_of(moving.shape, motion, still.shape);
        if (truth.deepest > 1e-3) {
            ++proven;
            ASSERT_EQ(impacts.size(), 1U);
            EXPECT_EQ(impacts[0].impact.status, Status::exact);
            EXPECT_LE(impacts[0].impact.time, *truth.first);
            EXPECT_LE(impacts[0].impact.contact_time, *truth.first + 1.0 / 400);
        } else if (truth.nearest > 0.05) { // a step moves a body by 0.02, and turns it by less
            ++missed;
            EXPECT_TRUE(impacts.empty());
        } else {
            ++narrow;
        }
    }
    EXPECT_GT(proven, many(80) / 3);
    EXPECT_GT(missed, many(80) / 10);
    EXPECT_LT(narrow, many(80) / 4);
}

TEST(ProvenImpacts, BodiesThatPassWithinTheToleranceDoNotMeet) {
    const Box3 cube{{-1, -1, -1}, {1, 1, 1}};
    // The corner of a cube turned by 45 degrees passes at these distances.
    for (const double gap : {1e-3, 1e-6, 1e-9, 1e-11}) {
        const double corner = std::sqrt(2.0);
        Motion motion = flight({-5, 1 + corner + gap, 0}, {10, 0, 0}, {});
        motion.start.rotation = {std::cos(M_PI / 8), 0, 0, std::sin(M_PI / 8)};
        EXPECT_TRUE(impacts_of(cube, motion, cube).empty()) << gap;
        motion.start.translation.y = motion.centre.y = 1 + corner - gap;
        const auto impacts = impacts_of(cube, motion, cube);
        ASSERT_EQ(impacts.size(), 1U) << gap;
        EXPECT_EQ(impacts[0].impact.status, Status::exact) << gap;
    }
}

} // namespace
} // namespace abut::test
