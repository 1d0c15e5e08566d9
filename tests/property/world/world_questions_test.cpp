// Rays, overlaps and sweeps of a world: rays against signed distances of the shapes' definitions, the other
// two against the world's own queries of a body in place of the question.

#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/rigid_shape.h>
#include <abut/vector.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace abut::test {
namespace {

/// Bodies of all kinds.
struct MixedWorld {
    World world;
    std::vector<KindOfBody> kinds;
    std::vector<Pose> poses;
    std::vector<BodyId> ids;

    void put(const KindOfBody& kind, const Pose& pose) {
        kinds.push_back(kind), poses.push_back(pose);
        ids.push_back(test::add(world, kind.shape, pose));
    }
};

Pose random_place(Random& random, double spread) {
    Pose pose = random.pose(spread);
    if (random.chance(0.4)) { // on a grid, along the axes
        pose.rotation = {1, 0, 0, 0};
        pose.translation = {0.25 * random.integer(-12, 12), 0.25 * random.integer(-12, 12),
                            0.25 * random.integer(-12, 12)};
    }
    return pose;
}

Ray random_ray(Random& random, const Vec3& target = {}) {
    Ray ray;
    if (random.chance(0.4)) {
        ray.origin = {0.25 * random.integer(-16, 16), 0.25 * random.integer(-16, 16),
                      0.25 * random.integer(-16, 16)};
        const Vec3 axes[]{{1, 0, 0}, {0, -1, 0}, {0, 0, 2}, {1, 1, 0}, {-1, 0, 1}};
        ray.direction = axes[random.integer(0, 4)];
    } else {
        ray.origin = 4 * random.direction();
        ray.direction = random.uniform(0.2, 3) * random.direction();
        if (random.chance(0.8))
            ray.direction = 0.1 * ray.direction + target - ray.origin;
    }
    if (random.chance(0.3))
        ray.t_max = random.uniform(0, 3);
    return ray;
}

/// Where a ray comes to a surface for the first time up to a parameter, by steps as long as the distance
/// from it; none if it does not, or if that is in doubt.
struct Traced {
    std::optional<double> t;
    bool is_in_doubt = false;
};
Traced traced(const KindOfBody& kind, const Pose& pose, const Ray& ray, double last) {
    const double speed = length(ray.direction);
    double t = ray.t_min;
    for (int step = 0; step < 2000; ++step) {
        const double d = distance_from_surface(kind.shape, pose, ray.origin + t * ray.direction);
        const bool is_surface = std::holds_alternative<Model>(kind.shape);
        if ((is_surface ? std::abs(d) : d) <= 1e-10)
            return {t, false};
        t += std::abs(d) / speed;
        if (t > last)
            return {std::nullopt, std::abs(d) < 1e-6};
    }
    return {std::nullopt, true};
}

TEST(WorldQuestions, RaysMeetEachKindWhereItsDistanceIsZero) {
    Random random(20261129);
    const std::vector<KindOfBody> kinds = kinds_of_bodies();
    int hits = 0, inside = 0, doubtful = 0;
    const int rounds = many(6000);
    for (int round = 0; round < rounds; ++round) {
        MixedWorld scene;
        const KindOfBody& kind = kinds[static_cast<std::size_t>(round) % kinds.size()];
        scene.put(kind, random_place(random, 1));
        const Ray ray = random_ray(random, scene.poses[0].translation);
        SCOPED_TRACE(kind.name + ", round " + std::to_string(round));
        const BodyRayHit hit = scene.world.first_hit(ray);
        const double last = std::min(ray.t_max, 50.0);
        const Traced expected = traced(kind, scene.poses[0], ray, last);
        if (expected.is_in_doubt || (hit.meet && hit.t > 50)) {
            ++doubtful;
            continue;
        }
        // Rays that graze are decided by rounding: then the point is on the surface.
        if (!expected.t) {
            EXPECT_TRUE(!hit.meet || std::abs(distance_from_surface(kind.shape, scene.poses[0],
                                                                    hit.point)) < 1e-9);
            continue;
        }
        if (!hit.meet) {
            ++doubtful;
            continue;
        }
        ++hits;
        ASSERT_EQ(hit.body, scene.ids[0]);
        EXPECT_NEAR(hit.t, *expected.t, 1e-7);
        EXPECT_LE(length(hit.point - ray.origin - hit.t * ray.direction), 1e-12);
        if (hit.normal == Vec3{}) {
            ++inside;
            continue;
        }
        EXPECT_NEAR(length(hit.normal), 1, 1e-12);
        EXPECT_LE(dot(hit.normal, ray.direction), 1e-9);
        // A step along the normal leads away from the surface by as much.
        const double away =
            distance_from_surface(kind.shape, scene.poses[0], hit.point + 1e-5 * hit.normal);
        EXPECT_NEAR(std::abs(away), 1e-5, 1e-8);
    }
    std::cout << hits << " hits, " << inside << " from inside, " << doubtful << " in doubt\n";
    EXPECT_GT(hits, rounds / 4);
    EXPECT_GT(inside, rounds / 100);
    EXPECT_LT(doubtful, rounds / 20);
}

/// A world of many bodies, some of which have moved since the first question.
MixedWorld crowd(Random& random, int count) {
    MixedWorld scene;
    const std::vector<KindOfBody> kinds = kinds_of_bodies();
    for (int i = 0; i < count; ++i) {
        const KindOfBody* kind = nullptr;
        do
            kind = &kinds[static_cast<std::size_t>(random.integer(0, int(kinds.size()) - 1))];
        while (std::holds_alternative<HalfSpace>(kind->shape) && !random.chance(0.1));
        scene.put(*kind, random_place(random, 5));
    }
    static_cast<void>(scene.world.first_hit({{0, 0, 9}, {0, 0, -1}}));
    for (int i = 0; i < count; i += 3) {
        scene.poses[std::size_t(i)] = random_place(random, 5);
        scene.world.move(scene.ids[std::size_t(i)], scene.poses[std::size_t(i)]);
    }
    return scene;
}

TEST(WorldQuestions, RaysOfACrowdAreThoseOfItsBodies) {
    Random random(20261130);
    int hits = 0;
    for (int round = 0; round < many(40); ++round) {
        MixedWorld scene = crowd(random, 40);
        for (int k = 0; k < 20; ++k) {
            const Ray ray = random_ray(random);
            std::vector<BodyRayHit> expected;
            for (std::size_t i = 0; i < scene.kinds.size(); ++i) {
                World alone;
                test::add(alone, scene.kinds[i].shape, scene.poses[i]);
                BodyRayHit hit = alone.first_hit(ray);
                hit.body = scene.ids[i];
                if (hit.meet)
                    expected.push_back(hit);
            }
            std::sort(expected.begin(), expected.end(), [](const auto& p, const auto& q) {
                return p.t != q.t ? p.t < q.t : p.body < q.body;
            });
            const std::vector<BodyRayHit> all = scene.world.all_hits(ray);
            ASSERT_EQ(all.size(), expected.size());
            for (std::size_t i = 0; i < all.size(); ++i) {
                EXPECT_EQ(all[i].body, expected[i].body);
                EXPECT_EQ(all[i].t, expected[i].t);
                EXPECT_EQ(all[i].normal, expected[i].normal);
            }
            const BodyRayHit first = scene.world.first_hit(ray);
            ASSERT_EQ(first.meet, !all.empty());
            if (!first.meet)
                continue;
            ++hits;
            EXPECT_EQ(first.body, all[0].body);
            EXPECT_EQ(first.t, all[0].t);
            // Without the first body, the next one.
            const BodyRayHit next = scene.world.first_hit(
                ray, {.filter = [&](BodyId body) { return !(body == first.body); }});
            EXPECT_EQ(next.meet, all.size() > 1);
            if (next.meet) {
                EXPECT_EQ(next.t, all[1].t);
            }
        }
    }
    EXPECT_GT(hits, many(40) * 5);
}

TEST(WorldQuestions, OverlapsAndSweepsAreThoseOfABodyInThatPlace) {
    Random random(20261201);
    const std::vector<KindOfBody> kinds = kinds_of_bodies();
    int touched = 0, met = 0;
    for (int round = 0; round < many(60); ++round) {
        MixedWorld scene = crowd(random, 25);
        const KindOfBody& kind = kinds[static_cast<std::size_t>(round) % kinds.size()];
        const Pose pose = random_place(random, 3);
        const RigidShape shape =
            std::visit([](const auto& each) { return RigidShape(each); }, kind.shape);
        const std::vector<BodyId> found = scene.world.overlaps(shape, pose);
        const Motion motion = [&] {
            Motion m = Motion::fixed(pose);
            m.velocity = random.in_cube(4);
            return m;
        }();
        const ImpactOptions coarse{.absolute_error = 1e-4};
        const BodySweepHit swept = scene.world.sweep(shape, motion, {}, coarse);
        const BodyId body = test::add(scene.world, kind.shape, pose);
        std::vector<BodyId> expected;
        for (const BodyPair& pair : scene.world.collide())
            if (pair.a == body || pair.b == body)
                expected.push_back(pair.a == body ? pair.b : pair.a);
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(found, expected) << kind.name << " round " << round;
        touched += static_cast<int>(found.size());
        std::optional<BodyImpact> first;
        for (const BodyImpact& each : scene.world.time_of_impact({{body, motion}}, coarse))
            if (!first || each.impact.time < first->impact.time)
                first = each;
        ASSERT_EQ(swept.meet, first.has_value());
        if (!first)
            continue;
        ++met;
        EXPECT_EQ(swept.impact.time, first->impact.time);
        EXPECT_EQ(swept.body, first->a == body ? first->b : first->a);
    }
    EXPECT_GT(touched, many(60));
    EXPECT_GT(met, many(60) / 3);
}

TEST(WorldQuestions, ShapesThatTouchByRoundingOverlapAsBodiesDo) {
    Random random(20261203);
    int touching = 0;
    for (int round = 0; round < many(400); ++round) {
        const bool is_ball = random.chance(0.5);
        const double size = random.uniform(0.1, 3), gap = 0x1p-52 * random.integer(-8, 40);
        const AnyShape shape =
            is_ball ? AnyShape(Sphere{{}, size}) : AnyShape(Capsule{{{-1, 0, 0}, {1, 0, 0}}, size});
        World world;
        world.add(Box3{{-1, -1, -1}, {1, 1, 0}}, {});
        const Pose pose{{0.3, 0.2, size + gap * size}, {1, 0, 0, 0}};
        const RigidShape asked =
            std::visit([](const auto& each) { return RigidShape(each); }, shape);
        const std::size_t found = world.overlaps(asked, pose).size();
        test::add(world, shape, pose);
        EXPECT_EQ(found, world.collide().size()) << "size " << size << " gap " << gap;
        touching += static_cast<int>(found);
    }
    EXPECT_GT(touching, many(400) / 2);
}

TEST(WorldQuestions, ADeformableStaysAsItIsAtTheStartOfItsStep) {
    Mesh sheet{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    Deformable surface(sheet);
    std::vector<Vec3> end = sheet.positions;
    for (Vec3& p : end)
        p.z += 5;
    surface.set_motion(sheet.positions, end);
    World world;
    world.add(surface);
    EXPECT_EQ(world.first_hit({{0.2, 0.1, 4}, {0, 0, -1}}).t, 4);
    EXPECT_EQ(world.overlaps(Sphere{{}, 0.5}, {{0, 0, 0.2}, {1, 0, 0, 0}}).size(), 1U);
    EXPECT_TRUE(world.overlaps(Sphere{{}, 0.5}, {{0, 0, 4}, {1, 0, 0, 0}}).empty());
    Motion down = Motion::fixed({{0, 0, 4}, {1, 0, 0, 0}});
    down.velocity = {0, 0, -4};
    const BodySweepHit hit = world.sweep(Sphere{{}, 0.5}, down, {}, {.absolute_error = 1e-6});
    ASSERT_TRUE(hit.meet);
    EXPECT_NEAR(hit.impact.time, 3.5 / 4, 1e-5);
}

TEST(WorldQuestions, AskOnlyTheirGroupsAndTheBodiesThatAreThere) {
    World world;
    const BodyId near = world.add(Sphere{{}, 1}, {{0, 0, 5}, {1, 0, 0, 0}}, {.groups = 2}),
                 far = world.add(Box3{{-1, -1, -1}, {1, 1, 1}}, {{0, 0, 9}, {1, 0, 0, 0}});
    const Ray ray{{0, 0, 0}, {0, 0, 2}};
    EXPECT_EQ(world.first_hit(ray).body, near);
    EXPECT_EQ(world.first_hit(ray).t, 2);
    EXPECT_EQ(world.first_hit(ray, {.groups = 1}).body, far);
    EXPECT_FALSE(world.first_hit(ray, {.groups = 4}).meet);
    world.remove(near);
    EXPECT_EQ(world.first_hit(ray).body, far);
    EXPECT_EQ(world.overlaps(Sphere{{}, 3}, {{0, 0, 5.5}, {1, 0, 0, 0}}),
              (std::vector<BodyId>{far}));
    EXPECT_TRUE(world.overlaps(Sphere{{}, 2}, {{0, 0, 5.5}, {1, 0, 0, 0}}).empty());
    EXPECT_THROW(world.first_hit({{0, 0, 0}, {0, 0, 0}}), Error);
    EXPECT_FALSE(World().first_hit(ray).meet);
}

} // namespace
} // namespace abut::test
