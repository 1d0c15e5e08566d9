// Times of impact of a world's bodies against fine steps of the same motions.

#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/progress.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/world_motions.h"
#include "tests/support/world_script.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>

namespace abut::test {
namespace {

using Script = WorldScript<Random>;

/// The first of `steps` small steps at which two bodies share a point; nothing if none does.
std::optional<double> first_contact(World& world, const std::vector<BodyMotion>& motions,
                                    const std::vector<Surface>& surfaces, BodyPair pair,
                                    int steps) {
    for (int step = 0; step <= steps; ++step) {
        const double t = double(step) / steps;
        move_to(world, motions, surfaces, t);
        if (holds(world.collide(), pair))
            return t;
    }
    return std::nullopt;
}

/// Compares the impacts of pairs of bodies with fine steps, one pair a round.
class ImpactTally {
public:
    /// Checks a world of only these two bodies.
    void check(World& world, const std::vector<BodyMotion>& motions,
               const std::vector<Surface>& surfaces, BodyPair pair) {
        constexpr int kSteps = 60;
        const auto impacts = world.time_of_impact(motions);
        const auto contact = first_contact(world, motions, surfaces, pair, kSteps);
        if (!contact) {
            misses_ += impacts.empty() ? 1 : 0;
            return;
        }
        if (impacts.empty() && *contact == 0) { // they only touch, and part or slide
            ++misses_;
            for (int step = 0; step <= kSteps; ++step) {
                move_to(world, motions, surfaces, double(step) / kSteps);
                for (const BodyGap& gap : world.penetration())
                    ASSERT_LE(-gap.distance, 1e-9);
            }
            return;
        }
        ++hits_;
        ASSERT_EQ(impacts.size(), 1U);
        const Impact& impact = impacts[0].impact;
        EXPECT_EQ(impacts[0].a, pair.a);
        EXPECT_EQ(impacts[0].b, pair.b);
        EXPECT_LE(impact.time, *contact + 1e-9);
        if (impact.time > 0) { // at the start, bodies may lie deep in each other
            EXPECT_NEAR(length(impact.point_b - impact.point_a), impact.gap, 1e-9);
        }
        tight_ += impact.time > *contact - 1.5 / kSteps ? 1 : 0;
        if (impact.status != Status::exact)
            return;
        ++proven_;
        EXPECT_GE(impact.contact_time, impact.time);
        const bool near_end = impact.contact_time > 1 - 1e-6;
        move_to(world, motions, surfaces, impact.contact_time);
        const auto gaps = world.within(1e-8);
        EXPECT_TRUE(near_end || gaps.size() == 1);
        // Shortly before the contact, b must lie on the side to which the normal points.
        if (impact.time > 0.01 && impact.normal != Vec3{}) {
            move_to(world, motions, surfaces, impact.time - 1e-3);
            for (const BodyGap& gap : world.within(0.1))
                turned_ += gap.distance > 1e-6 && dot(gap.normal, impact.normal) < -0.5 ? 1 : 0;
        }
    }
    void expect_both(int least) const {
        EXPECT_GT(hits_, least);
        EXPECT_GT(misses_, least);
        EXPECT_GT(tight_, hits_ * 8 / 10);
        EXPECT_GT(proven_, hits_ * 8 / 10);
        EXPECT_LE(turned_, hits_ / 50);
    }

private:
    int hits_ = 0, misses_ = 0;
    int tight_ = 0;  ///< hits that are no earlier than 1.5 steps before the contact
    int proven_ = 0; ///< with status exact
    int turned_ = 0; ///< normals that point the wrong way
};

TEST(WorldImpacts, NoLaterThanFineSteps) {
    Random random(5204);
    ImpactTally tally;
    for (int round = 0; round < many(900); ++round) {
        SCOPED_TRACE(round);
        World world;
        Script script(random, world);
        script.add(), script.add();
        for (const auto& [id, body] : script.bodies())
            world.set_options(id, {});
        const auto motions = script.motions(0.8);
        if (!motions.empty())
            tally.check(world, motions, {},
                        {script.bodies().begin()->first, script.bodies().rbegin()->first});
    }
    tally.expect_both(60);
}

/// A surface that moves and deforms: a tetrahedron or a sheet, sometimes with segments and points
/// among its triangles.
MovingSurface random_surface(Random& random, const DeformableOptions& options = {}) {
    Mesh mesh = tetrahedron(0.5);
    if (random.chance(0.5))
        mesh = grid_mesh(3, 3, false, false, [](double u, double v) {
            return Vec3{0.7 * u, 0.7 * v, 0};
        });
    if (random.chance(0.2))
        mesh = with_degenerates(random, mesh, 4);
    mesh = transformed(mesh, random.pose(0.7));
    MovingSurface moving(mesh);
    moving.surface = Deformable(mesh, options);
    std::vector<Vec3> end = mesh.positions;
    const Vec3 way = random.in_cube(2);
    for (Vec3& p : end)
        p = p + way + random.in_cube(0.2);
    moving.set_step(mesh.positions, end);
    return moving;
}

TEST(WorldImpacts, NoLaterThanFineStepsForDeformablesAndRigidBodies) {
    Random random(5205);
    ImpactTally tally;
    for (int round = 0; round < many(900); ++round) {
        SCOPED_TRACE(round);
        World world;
        MovingSurface moving = random_surface(random);
        Script script(random, world);
        // The bodies may be added in either order.
        if (random.chance(0.5))
            script.add();
        const BodyId sheet = world.add(moving.surface);
        if (script.bodies().empty())
            script.add();
        const BodyId body = script.bodies().begin()->first;
        world.set_options(body, {});
        tally.check(world, script.motions(0.8), {{sheet, moving}},
                    {std::min(sheet, body), std::max(sheet, body)});
    }
    tally.expect_both(40);
}

TEST(WorldImpacts, NoLaterThanFineStepsForTwoDeformables) {
    Random random(5206);
    ImpactTally tally;
    for (int round = 0; round < many(600); ++round) {
        SCOPED_TRACE(round);
        const auto options = [&] {
            DeformableOptions result;
            result.scheme = static_cast<Scheme>(random.integer(0, 4));
            result.culling = random.chance(0.5) ? Culling::tree : Culling::sweep;
            if (result.scheme == Scheme::features)
                result.culling = Culling::tree;
            return result;
        };
        MovingSurface a = random_surface(random, options()), b = random_surface(random, options());
        World world;
        const BodyId id_a = world.add(a.surface), id_b = world.add(b.surface);
        tally.check(world, {}, {{id_a, a}, {id_b, b}}, {id_a, id_b});
    }
    tally.expect_both(40);
}

TEST(WorldImpacts, NoLaterThanFineStepsFarFromTheOrigin) {
    Random random(5207);
    int hits = 0;
    for (int round = 0; round < many(400); ++round) {
        World world;
        const Vec3 far{1e7, -1e7, 1e7};
        MovingSurface moving = random_surface(random);
        std::vector<Vec3> start = moving.mesh.positions, end = moving.end;
        for (auto* positions : {&start, &end})
            for (Vec3& p : *positions)
                p = p + far;
        moving.set_step(start, end);
        const BodyId sheet = world.add(moving.surface);
        Pose pose = random.pose(1);
        pose.translation = pose.translation + far;
        const BodyId body = world.add(Model(tetrahedron(0.4)), pose);
        const std::vector<BodyMotion> motions{
            {body, {pose, pose.translation, random.in_cube(1), random.in_cube(3)}}};
        const auto impacts = world.time_of_impact(motions);
        const auto contact = first_contact(world, motions, {{sheet, moving}}, {sheet, body}, 40);
        if (!contact)
            continue;
        ++hits;
        ASSERT_EQ(impacts.size(), 1U) << round;
        EXPECT_LE(impacts[0].impact.time, *contact + 1e-6) << round;
    }
    EXPECT_GT(hits, 15);
}

TEST(WorldImpacts, AFastBallDoesNotPassAThinWall) {
    World world;
    const BodyId wall = world.add(Box3{{-0.001, -5, -5}, {0.001, 5, 5}}, {});
    const BodyId ball = world.add(Sphere{{}, 0.1}, Pose{{-50, 0, 0}, {1, 0, 0, 0}});
    const BodyMotion motion{ball, {{{-50, 0, 0}, {1, 0, 0, 0}}, {-50, 0, 0}, {100, 0, 0}, {}}};
    const auto impacts = world.time_of_impact({motion});
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_EQ(impacts[0].a, wall);
    EXPECT_NEAR(impacts[0].impact.time, (50 - 0.101) / 100, 1e-5);
    EXPECT_THROW(world.time_of_impact({motion, motion}), Error);
}

/// A flat sheet across the x axis.
Mesh sheet_at(double x) {
    Mesh mesh = grid_mesh(8, 8, false, false, [](double u, double v) {
        return Vec3{0, 2 * u - 1, 2 * v - 1};
    });
    return transformed(mesh, translation(x, 0, 0));
}

TEST(WorldImpacts, AFastSheetPassesNothing) {
    MovingSurface sheet(sheet_at(-50)), still(sheet_at(20));
    sheet.set_step(sheet_at(-50).positions, sheet_at(50).positions);
    World world;
    const BodyId moving = world.add(sheet.surface);
    const BodyId wall = world.add(Box3{{-0.001, -5, -5}, {0.001, 5, 5}}, {});
    const BodyId ball = world.add(Sphere{{}, 0.01}, Pose{{10, 0.3, 0.3}, {1, 0, 0, 0}});
    const BodyId cloth = world.add(still.surface);
    const BodyId plate = world.add(Model(sheet_at(30)), {});
    const BodyId needle =
        world.add(Convex(std::vector<Vec3>{{40, 0.1, 0.1}, {40.5, 0.1, 0.1}}), {});
    world.add(Sphere{{0, 1.2, 0}, 0.1}, {}); // beside the sheet's path
    const auto impacts = world.time_of_impact({});
    ASSERT_EQ(impacts.size(), 5U);
    const std::array expected{std::pair{wall, 49.999}, std::pair{ball, 59.99},
                              std::pair{cloth, 70.0}, std::pair{plate, 80.0},
                              std::pair{needle, 90.0}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(impacts[i].a, moving);
        EXPECT_EQ(impacts[i].b, expected[i].first);
        EXPECT_NEAR(impacts[i].impact.time, expected[i].second / 100, 2e-6) << i;
        EXPECT_LE(impacts[i].impact.time, expected[i].second / 100) << i;
        EXPECT_NEAR(impacts[i].impact.normal.x, 1, 1e-9) << i;
    }
}

TEST(WorldImpacts, AFallingSheetMeetsATurningBlade) {
    // The blade begins along the x axis, makes most of a turn, and passes the sheet's place before
    // the end.
    MovingSurface sheet(sheet_at(0));
    sheet.set_step(transformed(sheet_at(0), translation(-3, 0, 0)).positions,
                   transformed(sheet_at(0), translation(-3, 0.5, 0)).positions);
    World world;
    const BodyId cloth = world.add(sheet.surface);
    const BodyId blade = world.add(Box3{{0, -0.01, -0.1}, {4, 0.01, 0.1}}, {});
    const auto turn = [&](double angle) {
        return world.time_of_impact({{blade, {{}, {}, {}, {0, 0, angle}}}});
    };
    // The middle plane of the blade meets the sheet's upper edge, at y = 1 + t / 2, when t is 0.580
    // and the angle 2.7346. Half of the blade's thickness subtracts 0.003.
    const auto impacts = turn(1.5 * std::numbers::pi);
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_EQ(impacts[0].a, cloth);
    EXPECT_NEAR(impacts[0].impact.time * 1.5 * std::numbers::pi, 2.732, 1e-3);
    EXPECT_TRUE(turn(0.5 * std::numbers::pi).empty());
}

TEST(WorldImpacts, ASheetThatSlidesJustAboveOthersHasNoImpact) {
    // The gap is a thousandth of the motion.
    Mesh flat = grid_mesh(20, 20, false, false, [](double u, double v) {
        return Vec3{2 * u - 1, 2 * v - 1, 1e-3};
    });
    MovingSurface sheet(flat);
    sheet.set_step(flat.positions, transformed(flat, translation(1, 0.3, 0)).positions);
    World world;
    world.add(sheet.surface);
    const Mesh floor = grid_mesh(20, 20, false, false, [](double u, double v) {
        return Vec3{4 * u - 2, 4 * v - 2, 0};
    });
    world.add(Model(floor), {});
    world.add(Box3{{-2, -2, -1}, {2, 2, 0}}, {});
    MovingSurface below(floor);
    world.add(below.surface);
    EXPECT_TRUE(world.time_of_impact({}).empty());
}

TEST(WorldImpacts, ADeformableInASolidMeetsItAtTheStartIfItMoves) {
    MovingSurface inner(tetrahedron(0.1));
    World world;
    world.add(Box3{{-1, -1, -1}, {1, 1, 1}}, {});
    const BodyId body = world.add(inner.surface);
    EXPECT_TRUE(world.time_of_impact({}).empty()); // neither moves
    inner.set_step(inner.mesh.positions, transformed(inner.mesh, translation(0, 0, 0.1)).positions);
    world.refresh(body);
    const auto impacts = world.time_of_impact({});
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_EQ(impacts[0].impact.time, 0);
    EXPECT_EQ(impacts[0].impact.contact_time, 0);
}

/// For bodies that share a point at the start, the answer does not depend on their motion.
TEST(WorldImpacts, ADeformableThatOverlapsABodyAtRestMeetsItAtTheStartIfItMoves) {
    const Mesh mesh = tetrahedron(1);
    const Model crossed(box_mesh({0.1, 0.1, -0.5}, {0.2, 0.2, 0.5})); // through a face
    for (const bool as_model : {false, true})
        for (const Vec3& step : {Vec3{0, 0, 0.1}, Vec3{0, 0, 9}, Vec3{-9, 0, 0}, Vec3{}}) {
            MovingSurface sheet(mesh);
            World world;
            const BodyId rest = as_model ? world.add(crossed, {})
                                         : world.add(Box3{{0.1, 0.1, -0.5}, {0.2, 0.2, 0.5}}, {});
            const BodyId moving = world.add(sheet.surface);
            sheet.set_step(mesh.positions,
                           transformed(mesh, translation(step.x, step.y, step.z)).positions);
            world.refresh(moving);
            EXPECT_EQ(world.collide().size(), 1U);
            const auto impacts = world.time_of_impact({});
            if (step == Vec3{}) {
                EXPECT_TRUE(impacts.empty()); // neither moves: `collide` reports the pair
                const auto pushed = world.time_of_impact(
                    {{rest, Motion::between({{}, {1, 0, 0, 0}}, {{5, 0, 0}, {1, 0, 0, 0}})}});
                ASSERT_EQ(pushed.size(), 1U);
                EXPECT_EQ(pushed[0].impact.time, 0);
                continue;
            }
            ASSERT_EQ(impacts.size(), 1U);
            const Impact& impact = impacts[0].impact;
            EXPECT_EQ(impact.time, 0);
            EXPECT_EQ(impact.contact_time, 0);
            EXPECT_EQ(impact.gap, 0);
            EXPECT_EQ(impact.normal, Vec3{});
            // A point of both bodies at the start.
            EXPECT_NEAR(length(impact.point_a - impact.point_b), 0, 1e-15);
            EXPECT_GE(impact.point_a.x, 0.1 - 1e-15);
            EXPECT_LE(impact.point_a.x, 0.2 + 1e-15);
        }
}

TEST(WorldImpacts, ALimitOnStepsLeavesAProvenTimeAndAFlagStops) {
    Random random(5208);
    int limited = 0;
    for (int round = 0; round < many(60); ++round) {
        SCOPED_TRACE(round);
        // A body of each kind moves through a model.
        World world;
        world.add(Model(sphere_mesh(0.5, 12, 7)), {});
        const Pose start{{-2, 0.1, 0.1}, {1, 0, 0, 0}};
        MovingSurface sheet(transformed(tetrahedron(0.3), translation(-2, 0.1, 0.1)));
        sheet.set_step(sheet.mesh.positions,
                       transformed(sheet.mesh, translation(4, 0, 0)).positions);
        const int kind = round % 4;
        const BodyId body = kind == 0 ? world.add(Sphere{{}, 0.1}, start)
                            : kind == 1
                                ? world.add(Box3{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}, start)
                            : kind == 2 ? world.add(Model(tetrahedron(0.3)), start)
                                        : world.add(sheet.surface);
        std::vector<BodyMotion> motions;
        if (kind != 3)
            motions.push_back({body, {start, start.translation, {4, 0, 0}, random.in_cube(2)}});
        const auto whole = world.time_of_impact(motions);
        ASSERT_EQ(whole.size(), 1U);
        EXPECT_GT(whole[0].impact.steps, 0U);
        EXPECT_FALSE(whole[0].impact.out_of_steps);
        double before = 0;
        for (std::uint64_t most = 0; most < whole[0].impact.steps; most += 1 + most / 4) {
            const auto impacts = world.time_of_impact(motions, {.max_steps = most});
            ASSERT_EQ(impacts.size(), 1U);
            const Impact& impact = impacts[0].impact;
            if (!impact.out_of_steps)
                continue;
            ++limited;
            EXPECT_EQ(impact.steps, most);
            EXPECT_EQ(impact.status, Status::bound_only);
            EXPECT_LE(before, impact.time);
            EXPECT_LE(impact.time, whole[0].impact.time);
            before = impact.time;
        }
        std::vector<double> reports;
        const auto report = [&](std::string_view, double fraction) { reports.push_back(fraction); };
        ASSERT_EQ(world.time_of_impact(motions, {.progress = {report, nullptr}}).size(), 1U);
        EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
        EXPECT_EQ(reports.back(), 1);
        const std::atomic<bool> stop = true;
        try {
            world.time_of_impact(motions, {.progress = {{}, &stop}});
            FAIL() << "not stopped";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::interrupted);
        }
    }
    EXPECT_GT(limited, many(60));
}

TEST(WorldImpacts, RefusesMotionsOfDeformablesAndBadTolerances) {
    MovingSurface surface(tetrahedron(1));
    World world;
    const BodyId body = world.add(surface.surface);
    EXPECT_THROW(world.time_of_impact({{body, Motion::fixed({})}}), Error);
    EXPECT_THROW(world.move(body, {}), Error);
    ImpactOptions options;
    options.absolute_error = -1;
    EXPECT_THROW(world.time_of_impact({}, options), Error);
    options.absolute_error = NAN;
    EXPECT_THROW(world.time_of_impact({}, options), Error);
}

} // namespace
} // namespace abut::test
