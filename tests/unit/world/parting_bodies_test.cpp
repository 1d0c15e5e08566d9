// Bodies that are near or touch at the start of a step and part or slide are not stopped.

#include <abut/world.h>

#include "math/transform.h"
#include "tests/support/shapes.h"

#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace abut::test {
namespace {

struct Kind {
    std::string name;
    std::function<BodyId(World&, const Pose&)> add;
};

/// Walls whose upper side is the plane z = 0 of their frame.
std::vector<Kind> walls() {
    const Box3 box{{-50, -50, -1}, {50, 50, 0}};
    return {{"box", [=](World& w, const Pose& p) { return w.add(box, p); }},
            {"convex",
             [=](World& w, const Pose& p) {
                 return w.add(Convex(box_mesh(box.lower, box.upper).positions), p);
             }},
            {"half-space", [](World& w, const Pose& p) {
                 return w.add(HalfSpace{{0, 0, 1}, 0}, p);
             }}};
}
/// The same wall, of many triangles.
Kind wall_of_triangles() {
    const Mesh mesh = grid_mesh(40, 40, false, false, [](double u, double v) {
        return Vec3{100 * u - 50, 100 * v - 50, 0};
    });
    return {"model", [=](World& w, const Pose& p) { return w.add(Model(mesh), p); }};
}
/// Bodies whose lowest point is 0.1 below the origin of their frame.
std::vector<Kind> bodies() {
    const Vec3 half{0.1, 0.1, 0.1};
    return {{"ball",
             [](World& w, const Pose& p) {
                 return w.add(Sphere{{}, 0.1}, p);
             }},
            {"capsule",
             [](World& w, const Pose& p) {
                 return w.add(Capsule{{{-0.1, 0, 0}, {0.1, 0, 0}}, 0.1}, p);
             }},
            {"box",
             [=](World& w, const Pose& p) {
                 return w.add(Box3{-half, half}, p);
             }},
            {"convex", [=](World& w, const Pose& p) {
                 return w.add(Convex(box_mesh(-half, half).positions), p);
             }}};
}

/// A wall and a body above it, both turned.
struct Scene {
    World world;
    BodyId body;
    Motion motion;
    Vec3 up, along; ///< of the wall

    Scene(const Kind& wall, const Kind& kind, double gap, double angle) {
        const Pose frame{
            {3, -2, 1},
            {std::cos(angle / 2), 0.6 * std::sin(angle / 2), 0.8 * std::sin(angle / 2), 0}};
        const Transform at_wall = frame;
        up = {at_wall.m[6], at_wall.m[7], at_wall.m[8]},
        along = {at_wall.m[0], at_wall.m[1], at_wall.m[2]};
        wall.add(world, frame);
        const Pose pose{apply(at_wall, {0.3, 0.2, 0.1 + gap}), frame.rotation};
        body = kind.add(world, pose);
        motion = Motion::fixed(pose);
        motion.centre = pose.translation;
    }
    std::vector<BodyImpact> impacts() { return world.time_of_impact({{body, motion}}); }
};

constexpr double kQuarter = std::numbers::pi / 2;

TEST(PartingBodies, AreFreeWhileTheyPartOrSlide) {
    for (const Kind& wall : walls())
        for (const Kind& kind : bodies())
            for (const double gap : {0.0, 1e-9, 9.7e-6})
                for (const double angle : {0.0, kQuarter, 0.3}) {
                    SCOPED_TRACE(wall.name + ' ' + kind.name + " gap " + std::to_string(gap) +
                                 " angle " + std::to_string(angle));
                    Scene scene(wall, kind, gap, angle);
                    // A step of 1/60 s at 90 m/s, with a spin of 1 rad/s.
                    scene.motion.velocity = 1.5 * scene.up;
                    scene.motion.angular_velocity = (1.0 / 60) * scene.along;
                    EXPECT_TRUE(scene.impacts().empty());
                    scene.motion.angular_velocity = {};
                    EXPECT_TRUE(scene.impacts().empty());
                    scene.motion.velocity = 1.5 * scene.along;
                    EXPECT_TRUE(scene.impacts().empty());
                    scene.motion.velocity = -1.5 * scene.up;
                    const std::vector<BodyImpact> impacts = scene.impacts();
                    ASSERT_EQ(impacts.size(), 1U);
                    EXPECT_LE(impacts[0].impact.time, gap / 1.5);
                    EXPECT_EQ(impacts[0].impact.status, Status::exact);
                }
}

TEST(PartingBodies, SlideAboveTheTrianglesOfAModel) {
    for (const Kind& kind : bodies())
        for (const double gap : {1e-9, 9.7e-6})
            for (const double angle : {0.0, kQuarter, 0.3}) {
                SCOPED_TRACE(kind.name + " gap " + std::to_string(gap) + " angle " +
                             std::to_string(angle));
                Scene scene(wall_of_triangles(), kind, gap, angle);
                scene.motion.velocity = 1.5 * scene.along;
                EXPECT_TRUE(scene.impacts().empty());
                scene.motion.velocity = 1.5 * scene.up;
                EXPECT_TRUE(scene.impacts().empty());
                scene.motion.angular_velocity = (1.0 / 60) * scene.along;
                EXPECT_TRUE(scene.impacts().empty());
                scene.motion.angular_velocity = {};
                scene.motion.velocity = -1.5 * scene.up;
                const std::vector<BodyImpact> impacts = scene.impacts();
                ASSERT_EQ(impacts.size(), 1U);
                EXPECT_LE(impacts[0].impact.time, gap / 1.5);
                EXPECT_EQ(impacts[0].impact.status, Status::exact);
                EXPECT_NEAR(dot(impacts[0].impact.normal, scene.up), 1, 1e-6);
            }
}

TEST(PartingBodies, ASpinningBallSlides) {
    std::vector<Kind> all = walls();
    all.push_back(wall_of_triangles());
    for (const Kind& wall : all)
        for (const double gap : {1e-9, 9.7e-6}) {
            Scene scene(wall, bodies()[0], gap, 0.3);
            scene.motion.velocity = 1.5 * scene.along;
            scene.motion.angular_velocity = {0.5, 1, 0.25};
            EXPECT_TRUE(scene.impacts().empty()) << wall.name << ' ' << gap;
        }
}

TEST(PartingBodies, ThatComeBackMeet) {
    // The box parts and turns its corner into the wall.
    for (const Kind& wall : walls()) {
        Scene scene(wall, bodies()[2], 0, 0.3);
        scene.motion.velocity = 0.01 * scene.up;
        scene.motion.angular_velocity = 0.7 * scene.along;
        EXPECT_EQ(scene.impacts().size(), 1U) << wall.name;
    }
}

TEST(PartingBodies, TheToleranceFollowsTheSmallerBody) {
    World world;
    world.add(Box3{{-5e6, -5e6, -10}, {5e6, 5e6, 0}}, {});
    const Pose start{{0, 0, 10}}, end{{0, 0, -10}};
    const BodyId ball = world.add(Sphere{{}, 0.1}, start);
    const std::vector<BodyImpact> impacts =
        world.time_of_impact({{ball, Motion::between(start, end)}});
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_NEAR(impacts[0].impact.time, 9.9 / 20, 1e-6);
    EXPECT_LT(impacts[0].impact.gap, 1e-5);
}

} // namespace
} // namespace abut::test
