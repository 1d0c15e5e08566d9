// Robots whose answers can be worked out by hand.

#include <abut/error.h>
#include <abut/robot.h>

#include "math/transform.h"
#include "tests/support/shapes.h"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace abut::test {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

RobotLink box_link(const std::string& name, const Vec3& lower, const Vec3& upper) {
    return {name, {{"box", box_mesh(lower, upper), {}, 0}}};
}

RobotJoint joint(const std::string& name, JointType type, std::uint32_t parent, std::uint32_t child,
                 const Vec3& at, const Vec3& axis) {
    RobotJoint result;
    result.name = name;
    result.type = type;
    result.parent = parent;
    result.child = child;
    result.parent_from_joint.m[9] = at.x;
    result.parent_from_joint.m[10] = at.y;
    result.parent_from_joint.m[11] = at.z;
    result.axis = axis;
    return result;
}

/// Three bars of length 1 in a plane, joined by hinges about z.
RobotDescription planar_arm() {
    RobotDescription robot;
    robot.name = "arm";
    for (const char* name : {"base", "upper", "lower"})
        robot.links.push_back(box_link(name, {0.1, -0.05, -0.05}, {0.9, 0.05, 0.05}));
    robot.joints.push_back(joint("shoulder", JointType::continuous, 0, 1, {1, 0, 0}, {0, 0, 1}));
    robot.joints.push_back(joint("elbow", JointType::continuous, 1, 2, {1, 0, 0}, {0, 0, 1}));
    return robot;
}

TEST(RobotTest, LinksArePlacedByTheirJoints) {
    const Robot robot(planar_arm());
    const std::vector<Transform> links = robot.link_transforms(std::array{kQuarter, kQuarter});
    const Vec3 tip = apply(links[2], {1, 0, 0});
    EXPECT_NEAR(tip.x, 0, 1e-15);
    EXPECT_NEAR(tip.y, 1, 1e-15);
}

TEST(RobotTest, PlanarAndFloatingJointsMoveTheirLinks) {
    RobotDescription description;
    description.links = {{"a", {}}, {"b", {}}, {"c", {}}};
    description.joints = {joint("p", JointType::planar, 0, 1, {}, {0, 0, 1}),
                          joint("f", JointType::floating, 1, 2, {}, {})};
    const Robot robot(description);
    ASSERT_EQ(robot.variables().size(), 9);
    EXPECT_EQ(robot.variables()[1].name, "p/y");
    EXPECT_EQ(robot.variables()[8].name, "f/rz");
    EXPECT_FALSE(robot.variables()[1].is_angle);
    EXPECT_TRUE(robot.variables()[2].is_angle);
    const auto links =
        robot.link_transforms(std::array{3.0, 4.0, 0.0, 1.0, 2.0, 3.0, 0.0, 0.0, kQuarter});
    // The plane's directions are an arrangement of x and y, and keep lengths.
    EXPECT_NEAR(std::hypot(links[1].m[9], links[1].m[10]), 5, 1e-14);
    EXPECT_NEAR(links[1].m[11], 0, 1e-15);
    const Vec3 turned = apply_linear(links[2], {1, 0, 0});
    EXPECT_NEAR(turned.y, 1, 1e-15);
    EXPECT_NEAR(links[2].m[11], 3, 1e-15);
}

TEST(RobotTest, DistanceOfBarsThatAreParallel) {
    const Robot robot(planar_arm());
    // Both hinges at a right angle: the third bar is parallel to the first, one apart.
    const RobotGap gap = distance(robot, std::array{kQuarter, kQuarter});
    EXPECT_NEAR(gap.distance, 0.9, 1e-14);
    EXPECT_EQ(gap.pair, (RobotPair{0, 2, false}));
    EXPECT_TRUE(collide(robot, std::array{kQuarter, kQuarter}).empty());
    // Folded back twice, the third bar lies in the first.
    EXPECT_EQ(collide(robot, std::array{std::numbers::pi, std::numbers::pi}),
              (std::vector<RobotPair>{{0, 2, false}}));
    EXPECT_EQ(collide(robot, std::array{0.0, std::numbers::pi}).size(), 0);
    const Robot all(planar_arm(), {.allow_adjacent = false});
    EXPECT_EQ(all.pairs().size(), 3);
    EXPECT_EQ(collide(all, std::array{0.0, std::numbers::pi}),
              (std::vector<RobotPair>{{1, 2, false}}));
}

TEST(RobotTest, ALinkInsideAnotherMeetsIt) {
    RobotDescription description;
    description.links = {box_link("hull", {-1, -1, -1}, {1, 1, 1}),
                         {"rail", {}},
                         box_link("core", {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})};
    description.joints = {joint("s", JointType::prismatic, 0, 1, {}, {1, 0, 0}),
                          joint("t", JointType::fixed, 1, 2, {}, {1, 0, 0})};
    const Robot robot(description, {.allow_adjacent = false});
    EXPECT_EQ(collide(robot, std::array{0.0}).size(), 1);
    EXPECT_EQ(distance(robot, std::array{0.0}).distance, 0);
    EXPECT_EQ(collide(robot, std::array{3.0}).size(), 0);
    EXPECT_NEAR(distance(robot, std::array{3.0}).distance, 1.9, 1e-15);
    EXPECT_EQ(collide(robot, Configurations{std::array{0.0, 3.0, 1.0}}),
              (std::vector<bool>{true, false, true}));
    const RobotImpact impact = time_of_impact(robot, std::array{3.0}, std::array{0.0});
    ASSERT_TRUE(impact.meet);
    EXPECT_LE(impact.time, 1.9 / 3);
    EXPECT_NEAR(impact.time, 1.9 / 3, 1e-4);
    EXPECT_EQ(time_of_impact(robot, std::array{0.0}, std::array{3.0}).time, 0);
}

TEST(RobotTest, AComponentInsideALinkMeetsIt) {
    const Mesh two =
        joined(box_mesh({5, 5, 5}, {6, 6, 6}), box_mesh({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    RobotDescription description;
    description.links = {box_link("hull", {-1, -1, -1}, {1, 1, 1}), {"two", {{"two", two, {}, 0}}}};
    description.joints = {joint("s", JointType::prismatic, 0, 1, {}, {1, 0, 0})};
    const Robot robot(description, {.allow_adjacent = false});
    EXPECT_EQ(collide(robot, std::array{0.0}).size(), 1);
    EXPECT_EQ(distance(robot, std::array{0.0}).distance, 0);
    EXPECT_EQ(collide(robot, std::array{3.0}).size(), 0);
}

TEST(RobotTest, NoPairNearerThanTheBoundIsInfinitelyFar) {
    const Robot robot(planar_arm());
    RobotDistanceOptions options;
    for (const double bound : {0.0, 0.5}) {
        options.upper_bound = bound;
        const RobotGap gap = distance(robot, std::array{kQuarter, kQuarter}, options);
        EXPECT_TRUE(std::isinf(gap.distance));
        EXPECT_EQ(gap.status, Status::bound_only);
    }
}

TEST(RobotTest, ObstaclesAreTestedWithEveryLinkThatMoves) {
    const Robot robot(planar_arm());
    const RobotObstacles obstacles(std::vector<RobotObstacle>{
        {"wall", Model(box_mesh({2.5, -1, -1}, {3.5, 1, 1})), {}},
        {"floor", Model(box_mesh({0, -0.2, -0.2}, {0.5, 0.2, 0.2})), {}}});
    const RobotQuery query{.obstacles = obstacles};
    EXPECT_EQ(collide(robot, std::array{0.0, 0.0}, query), (std::vector<RobotPair>{{2, 0, true}}));
    EXPECT_EQ(collide(robot, std::array{0.0, 0.0}, {.obstacles = obstacles, .root = true}).size(),
              2);
    const RobotImpact impact = time_of_impact(robot, std::array{kQuarter, 0.0},
                                              std::array{0.0, 0.0}, {{.obstacles = obstacles}});
    ASSERT_TRUE(impact.meet);
    EXPECT_EQ(impact.pair, (RobotPair{2, 0, true}));
    EXPECT_EQ(impact.status, Status::exact);
    EXPECT_LE(impact.time, impact.contact_time);
    EXPECT_LT(impact.gap, 2e-4);
}

TEST(RobotTest, AllowedPairsAreProposedWithTheirReasons) {
    RobotDescription description = planar_arm();
    // A flag on the third bar that is always in the way of a ring around the elbow.
    description.links.push_back(box_link("flag", {0.2, -0.01, -0.01}, {0.3, 0.01, 0.01}));
    description.joints.push_back(joint("f", JointType::fixed, 2, 3, {}, {1, 0, 0}));
    const Robot robot(description);
    const std::vector<AllowedPair> pairs = propose_allowed_pairs(robot, {.samples = 500});
    const std::vector<AllowedPair> expected{{0, 1, AllowReason::adjacent},
                                            {1, 2, AllowReason::adjacent},
                                            {2, 3, AllowReason::adjacent}};
    for (const AllowedPair& pair : expected)
        EXPECT_NE(std::ranges::find(pairs, pair), pairs.end()) << pair.a << ' ' << pair.b;
    EXPECT_EQ(pairs, propose_allowed_pairs(robot, {.samples = 500}));
}

TEST(RobotTest, BadInputIsAnError) {
    const Robot robot(planar_arm());
    EXPECT_THROW(collide(robot, std::array{0.0}), Error);
    EXPECT_THROW(collide(robot, std::array{0.0, std::nan("")}), Error);
    EXPECT_THROW(distance(robot, std::array{0.0, 1e10}), Error);
    EXPECT_THROW(distance(robot, Configurations{std::array{0.0, 0.0, 0.0}}), Error);
    EXPECT_THROW(time_of_impact(robot, std::array{0.0, 0.0}, std::array{0.0, 0.0},
                                {{}, /*absolute_error=*/0}),
                 Error);
    EXPECT_THROW(propose_allowed_pairs(robot, {.samples = 0}), Error);
    RobotDescription scaled = planar_arm();
    scaled.joints[0].parent_from_joint.m[0] = 2;
    EXPECT_THROW(Robot{scaled}, Error);
    RobotDescription nowhere = planar_arm();
    nowhere.links[1].shapes[0].link_from_shape.m[9] = std::nan("");
    EXPECT_THROW(Robot{nowhere}, Error);
    RobotDescription narrow = planar_arm();
    narrow.joints[0].limits = {1, -1};
    EXPECT_THROW(Robot{narrow}, Error);
    RobotDescription fast = planar_arm();
    fast.joints[1].mimic = JointMimic{0, 1e308, 0};
    EXPECT_NO_THROW(collide(Robot(fast), std::array{0.0}));
    EXPECT_THROW(collide(Robot(fast), std::array{100.0}), Error);
    RobotDescription cyclic = planar_arm();
    cyclic.joints[1].child = 1;
    EXPECT_THROW(Robot{cyclic}, Error);
    EXPECT_THROW(Robot(planar_arm(), {.allowed = {{0, 9}}}), Error);
}

TEST(RobotTest, QueriesStopOnRequest) {
    const Robot robot(planar_arm());
    const std::atomic<bool> stop{true};
    RobotQuery query;
    query.progress.stop = &stop;
    const std::vector<double> many(2000, 0.5);
    EXPECT_THROW(collide(robot, Configurations{many}, query), Error);
    AllowedPairsOptions options;
    options.progress.stop = &stop;
    EXPECT_THROW(propose_allowed_pairs(robot, options), Error);
}

} // namespace
} // namespace abut::test
