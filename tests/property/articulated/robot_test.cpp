// Random robots: every query agrees with measuring all pairs of shapes one by one.

#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/robot.h>
#include <abut/shape_queries.h>

#include "math/transform.h"
#include "scenes/bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Mesh any_shape(Random& random) {
    const double size = random.uniform(0.1, 0.5);
    switch (random.integer(0, 4)) {
    case 0:
        return box_mesh({-size, -0.2, -0.1}, {size, 0.2, 0.1});
    case 1:
        return sphere_mesh(size, 9, 7);
    case 2:
        return torus_mesh(size, 0.3 * size, 12, 7);
    case 3: // a sheet without thickness
        return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}};
    default: // a needle
        return {{{0, 0, 0}, {3 * size, 0, 0}, {3 * size, 1e-9, 0}}, {{0, 1, 2}}};
    }
}

/// A tree of 3 to 9 links with joints of all types. Some links have no shape, some two.
RobotDescription random_robot(Random& random) {
    RobotDescription robot;
    const int links = random.integer(3, 9);
    for (int i = 0; i < links; ++i) {
        RobotLink link{"link" + std::to_string(i), {}};
        for (int k = random.integer(0, 5); k > 3 || (k > 0 && link.shapes.empty()); --k)
            link.shapes.push_back({"shape", any_shape(random), random.pose(0.3), 0});
        robot.links.push_back(std::move(link));
        if (i == 0)
            continue;
        RobotJoint joint;
        joint.name = "joint" + std::to_string(i);
        joint.type = kJointTypes.at(static_cast<std::size_t>(random.integer(0, 5)));
        joint.parent = static_cast<std::uint32_t>(random.integer(0, i - 1));
        joint.child = static_cast<std::uint32_t>(i);
        joint.parent_from_joint = random.pose(0.8);
        joint.axis = random.direction();
        if (joint.type == JointType::revolute || joint.type == JointType::prismatic)
            joint.limits = {-1, 1};
        robot.joints.push_back(joint);
    }
    std::vector<std::uint32_t> sources;
    for (std::uint32_t i = 0; i < robot.joints.size(); ++i) {
        if (variables_of(robot.joints[i].type) != 1)
            continue;
        if (!sources.empty() && random.chance(0.3))
            robot.joints[i].mimic = JointMimic{sources[0], random.uniform(-2, 2), 0.1};
        else
            sources.push_back(i);
    }
    return robot;
}

std::vector<double> random_values(const Robot& robot, Random& random) {
    std::vector<double> values;
    for (const RobotVariable& variable : robot.variables())
        values.push_back(variable.is_angle ? random.uniform(-3, 3) : random.uniform(-1, 1));
    return values;
}

/// The truth, by the queries of two models.
struct AllPairs {
    double distance = std::numeric_limits<double>::infinity();
    std::vector<RobotPair> meeting;
};

bool is_in(const Model& a, const Transform& place_a, const Model& b, const Transform& place_b) {
    return inspect(b.mesh()).closed &&
           contains(b, place_b, apply(place_a, a.mesh().positions[a.mesh().triangles[0][0]]))
                   .side == Side::inside;
}

AllPairs measure_all(const Robot& robot, std::span<const double> q,
                     const std::vector<RobotObstacle>& obstacles) {
    AllPairs result;
    const auto links = robot.link_transforms(q);
    const auto add = [&](const RobotPair& pair, const Model& a, const Transform& place_a,
                         const Model& b, const Transform& place_b) {
        double gap = distance(a, place_a, b, place_b).distance;
        if (gap > 0 && (is_in(a, place_a, b, place_b) || is_in(b, place_b, a, place_a)))
            gap = 0;
        result.distance = std::min(result.distance, gap);
        if (gap == 0 && (result.meeting.empty() || result.meeting.back() != pair))
            result.meeting.push_back(pair);
    };
    const auto& description = robot.description();
    for (const auto& [a, b] : robot.pairs())
        for (const RobotShape& of_a : description.links[a].shapes)
            for (const RobotShape& of_b : description.links[b].shapes)
                add({a, b, false}, Model(of_a.mesh), compose(links[a], of_a.link_from_shape),
                    Model(of_b.mesh), compose(links[b], of_b.link_from_shape));
    for (std::uint32_t a = 0; a < description.links.size(); ++a)
        for (std::uint32_t b = 0; b < obstacles.size() && a != description.root; ++b)
            for (const RobotShape& of_a : description.links[a].shapes)
                add({a, b, true}, Model(of_a.mesh), compose(links[a], of_a.link_from_shape),
                    obstacles[b].model, obstacles[b].world_from_model);
    return result;
}

TEST(RobotProperties, DistancesAndContactsAreThoseOfAllPairs) {
    Random random(8101);
    int meeting = 0, apart = 0, robots = many(60);
    for (int i = 0; i < robots; ++i) {
        const Robot robot(random_robot(random), {.allow_adjacent = random.chance(0.5)});
        const RobotObstacles obstacles(
            std::vector<RobotObstacle>{{"a", Model(any_shape(random)), random.pose(1)},
                                       {"b", Model(sphere_mesh(0.4, 8, 6)), random.pose(3)}});
        const RobotQuery query{.obstacles = obstacles};
        std::vector<double> batch;
        std::vector<double> distances;
        std::vector<bool> meet;
        for (int k = 0; k < 5; ++k) {
            const std::vector<double> q = random_values(robot, random);
            const AllPairs truth = measure_all(robot, q, obstacles.list());
            EXPECT_EQ(collide(robot, q, query), truth.meeting);
            const RobotGap gap = distance(robot, q, {query});
            if (truth.distance == std::numeric_limits<double>::infinity())
                EXPECT_EQ(gap.distance, truth.distance);
            else
                EXPECT_NEAR(gap.distance, truth.distance, 1e-12);
            EXPECT_EQ(gap.distance == 0, !truth.meeting.empty());
            if (truth.distance > 0 && truth.distance < 10) {
                EXPECT_EQ(distance(robot, q, {query, 0.5 * truth.distance}).status,
                          Status::bound_only);
                EXPECT_NEAR(length(gap.point_a - gap.point_b), truth.distance, 1e-9);
            }
            (truth.meeting.empty() ? apart : meeting) += 1;
            batch.insert(batch.end(), q.begin(), q.end());
            distances.push_back(gap.distance);
            meet.push_back(!truth.meeting.empty());
        }
        if (robot.variables().empty())
            continue;
        EXPECT_EQ(collide(robot, Configurations{batch}, query), meet);
        const auto gaps = distance(robot, Configurations{batch}, {query});
        for (std::size_t k = 0; k < gaps.size(); ++k)
            EXPECT_EQ(gaps[k].distance, distances[k]);
    }
    EXPECT_GT(meeting, robots);
    EXPECT_GT(apart, robots);
}

std::vector<double> between(std::span<const double> from, std::span<const double> to, double t) {
    std::vector<double> q(from.size());
    for (std::size_t i = 0; i < q.size(); ++i)
        q[i] = from[i] + t * (to[i] - from[i]);
    return q;
}

TEST(RobotProperties, TimesOfImpactAreNeverLate) {
    Random random(8102);
    int hits = 0, misses = 0, undecided = 0;
    const int motions = many(150);
    for (int i = 0; i < motions; ++i) {
        const Robot robot(random_robot(random));
        const RobotObstacles obstacles(
            std::vector<RobotObstacle>{{"a", Model(any_shape(random)), random.pose(2.5)}});
        const RobotQuery query{.self = true, .obstacles = obstacles};
        std::vector<double> from, to;
        int tries = 0;
        do {
            from = random_values(robot, random);
            to = random_values(robot, random);
        } while (!collide(robot, from, query).empty() && ++tries < 20);
        const RobotImpact impact = time_of_impact(robot, from, to, {query, 1e-3});
        constexpr int kSamples = 200;
        for (int k = 0; k <= kSamples; ++k) {
            const double t = double(k) / kSamples;
            if (t < impact.time || !impact.meet) {
                ASSERT_TRUE(collide(robot, between(from, to, t), query).empty())
                    << "motion " << i << " at " << t << ", impact at " << impact.time;
            }
        }
        if (impact.meet) {
            if (impact.status == Status::exact) {
                ++hits;
                EXPECT_FALSE(collide(robot, between(from, to, impact.contact_time), query).empty());
                EXPECT_LE(impact.time, impact.contact_time);
            } else {
                ++undecided;
                EXPECT_LE(distance(robot, between(from, to, impact.time), {query}).distance,
                          1e-3 * 1.3);
            }
        } else {
            ++misses;
        }
    }
    EXPECT_GT(hits, motions / 8);
    EXPECT_GT(misses, motions / 8);
    EXPECT_LT(undecided, motions / 8);
}

TEST(RobotProperties, AnswersDoNotDependOnThreads) {
    Random random(8103);
    const Robot robot(random_robot(random), {.allow_adjacent = false});
    std::vector<double> batch;
    for (int i = 0; i < 200; ++i)
        for (const double value : random_values(robot, random))
            batch.push_back(value);
    const auto run = [&] {
        std::vector<double> answers;
        for (const RobotGap& gap : distance(robot, Configurations{batch})) {
            answers.push_back(gap.distance);
            answers.push_back(gap.point_a.x);
        }
        return answers;
    };
    set_threads(1);
    const auto one = run();
    const auto pairs = propose_allowed_pairs(robot, {.samples = 200});
    set_threads(0);
    EXPECT_EQ(run(), one);
    EXPECT_EQ(propose_allowed_pairs(robot, {.samples = 200}), pairs);
    EXPECT_FALSE(one.empty());
}

} // namespace
} // namespace abut::test
