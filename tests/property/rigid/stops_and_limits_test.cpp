// Long queries: the stop flag ends each, and a limit on steps leaves a proven bound.

#include <abut/abut.h>

#include "core/stop.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/pair/placed_pair.h"
#include "tests/support/infinity.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

bool is_interrupted(const std::function<void()>& query) {
    try {
        query();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "interrupted");
        return error.code() == ErrorCode::interrupted;
    }
    return false;
}

/// Long triangles through the origin; each meets most of the others.
Mesh needles_mesh(Random& random, int count) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3 along = random.direction(), across = 0.01 * random.direction();
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {along, -along + across, -along - across});
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

TEST(SearchSteps, AreCountedUpToTheLimit) {
    for (const std::uint64_t most : {0, 1, 2, 255, 256, 257, 512, 1000}) {
        SearchSteps steps(most);
        for (std::uint64_t i = 0; i < most; ++i) {
            EXPECT_EQ(steps.count(), i);
            EXPECT_TRUE(steps.take());
        }
        EXPECT_FALSE(steps.ran_out());
        for (int i = 0; i < 3; ++i)
            EXPECT_FALSE(steps.take());
        EXPECT_TRUE(steps.ran_out());
        EXPECT_EQ(steps.count(), most);
    }
}

TEST(Stops, AFlagThatIsSetEndsEveryQuery) {
    Random random(1);
    const Model a(sphere_mesh(1, 12, 8)), b(sphere_mesh(1, 9, 7));
    const ConvexPieces solid_a(a), solid_b(b);
    const Transform here, there = translation(0.5, 0.25, 0.125);
    const std::vector<Placement> placements(3, {here, there});
    const std::vector<MotionPair> motions(3);
    const Vec3 p{3, 0, 0};
    const Segment segment{p, {}};
    const OrientedBox oriented{{{0, 0, 0}, {1, 1, 1}}, there};
    const std::vector<Vec3> points(3, p);
    const std::vector<Ray> rays(3, {p, {-1, 0, 0}});
    Deformable cloth(needles_mesh(random, 20)), other(needles_mesh(random, 20));
    World world;
    world.add(a, {});
    const BodyId moving = world.add(b, {{0.5, 0, 0}, {1, 0, 0, 0}});
    world.add(cloth);
    const std::vector<BodyMotion> moves{{moving, Motion::fixed({{0.5, 0, 0}, {1, 0, 0, 0}})}};
    const std::vector<ElementaryPair> pairs(3);

    std::atomic<bool> stop = false;
    const Progress progress{{}, &stop};
    const std::vector<std::pair<std::string, std::function<void()>>> queries{
        {"model", [&] { const Model built(a.mesh(), {.progress = progress}); }},
        {"collide", [&] { collide(a, here, b, there, {.progress = progress}); }},
        {"distance", [&] { distance(a, here, b, there, {.progress = progress}); }},
        {"signed distance",
         [&] { distance(a, here, b, there, {.signed_distance = true, .progress = progress}); }},
        {"within", [&] { within(a, here, b, there, 1, {.progress = progress}); }},
        {"penetration", [&] { penetration(a, here, b, there, {.progress = progress}); }},
        {"time of impact", [&] { time_of_impact(a, {}, b, {}, {.progress = progress}); }},
        {"collide, batch", [&] { collide(a, b, placements, {.progress = progress}); }},
        {"distance, batch", [&] { distance(a, b, placements, {.progress = progress}); }},
        {"within, batch", [&] { within(a, b, placements, 1, {.progress = progress}); }},
        {"time of impact, batch", [&] { time_of_impact(a, b, motions, {.progress = progress}); }},
        {"collide, pieces",
         [&] { collide(solid_a, here, solid_b, there, {.progress = progress}); }},
        {"distance, pieces",
         [&] { distance(solid_a, here, solid_b, there, {.progress = progress}); }},
        {"within, pieces",
         [&] { within(solid_a, here, solid_b, there, 1, {.progress = progress}); }},
        {"penetration, pieces",
         [&] { penetration(solid_a, here, solid_b, there, {.progress = progress}); }},
        {"collide, pieces, batch",
         [&] { collide(solid_a, solid_b, placements, {.progress = progress}); }},
        {"distance, pieces, batch",
         [&] { distance(solid_a, solid_b, placements, {.progress = progress}); }},
        {"within, pieces, batch",
         [&] { within(solid_a, solid_b, placements, 1, {.progress = progress}); }},
        {"penetration, pieces, batch",
         [&] { penetration(solid_a, solid_b, placements, {.progress = progress}); }},
        {"nearest", [&] { nearest(a, here, p, {.progress = progress}); }},
        {"nearest, batch", [&] { nearest(a, here, points, {.progress = progress}); }},
        {"first hit", [&] { first_hit(a, here, rays[0], progress); }},
        {"first hit, batch", [&] { first_hit(a, here, rays, progress); }},
        {"all hits", [&] { all_hits(a, here, rays[0], progress); }},
        {"distance, segment", [&] { distance(a, here, segment, {.progress = progress}); }},
        {"overlaps, sphere",
         [&] {
             overlaps(a, here, Sphere{p, 1}, progress);
         }},
        {"overlaps, box", [&] { overlaps(a, here, oriented.box, progress); }},
        {"overlaps, oriented box", [&] { overlaps(a, here, oriented, progress); }},
        {"overlaps, segment", [&] { overlaps(a, here, segment, progress); }},
        {"triangles, sphere",
         [&] {
             overlapping_triangles(a, here, Sphere{p, 1}, progress);
         }},
        {"triangles, box", [&] { overlapping_triangles(a, here, oriented.box, progress); }},
        {"triangles, oriented box", [&] { overlapping_triangles(a, here, oriented, progress); }},
        {"triangles, segment", [&] { overlapping_triangles(a, here, segment, progress); }},
        {"contains", [&] { contains(a, here, p, progress); }},
        {"contains, batch", [&] { contains(a, here, points, progress); }},
        {"self impacts", [&] { self_impacts(cloth, {}, progress); }},
        {"impacts", [&] { impacts(cloth, other, {}, progress); }},
        {"first self impact", [&] { self_time_of_impact(cloth, {}, progress); }},
        {"first impact", [&] { time_of_impact(cloth, other, {}, progress); }},
        {"free of self impacts", [&] { is_free_of_self_impacts(cloth, {}, progress); }},
        {"free of impacts", [&] { is_free_of_impacts(cloth, other, {}, progress); }},
        {"self pairs", [&] { self_within(cloth, 1, {.progress = progress}); }},
        {"pairs", [&] { within(cloth, other, 1, {.progress = progress}); }},
        {"contacts with a ball",
         [&] {
             within(cloth, Sphere{p, 1}, {}, 1, {.progress = progress});
         }},
        {"contacts with a model", [&] { within(cloth, a, {}, 1, {.progress = progress}); }},
        {"elementary impacts", [&] { elementary_impacts(pairs, {}, progress); }},
        {"bodies that meet", [&] { world.collide(progress); }},
        {"penetration of bodies", [&] { world.penetration(progress); }},
        {"bodies within", [&] { world.within(1, progress); }},
        {"impacts of bodies", [&] { world.time_of_impact(moves, {.progress = progress}); }},
        {"advance", [&] { world.advance(0, progress); }},
    };
    for (const auto& [name, query] : queries) {
        SCOPED_TRACE(name);
        stop = false;
        EXPECT_NO_THROW(query());
        stop = true;
        EXPECT_TRUE(is_interrupted(query));
    }
    // The stopped query leaves no state behind on this thread.
    EXPECT_NO_THROW(collide(a, here, b, there));
}

TEST(Stops, AFlagSetByAnotherThreadEndsLongQueries) {
    Random random(2);
    const Model a(needles_mesh(random, 4000)), b(needles_mesh(random, 4000));
    Deformable cloth(needles_mesh(random, 2000)), other(needles_mesh(random, 2000));
    const auto turned = [](const Deformable& surface) {
        std::vector<Vec3> end;
        for (std::size_t v = 0; v < surface.vertex_count(); ++v)
            end.push_back(
                {std::sin(double(v)), std::cos(3.0 * double(v)), std::sin(7.0 * double(v))});
        return end;
    };
    cloth.advance(turned(cloth));
    other.advance(turned(other));
    World world;
    world.add(a, {});
    world.add(b, {});

    std::atomic<bool> stop = false;
    const Progress progress{{}, &stop};
    const Mesh many = needles_mesh(random, 1'000'000);
    const std::vector<std::pair<std::string, std::function<void()>>> queries{
        {"model", [&] { const Model built(many, {.progress = progress}); }},
        {"collide",
         [&] { collide(a, {}, b, {}, {.mode = ContactMode::all, .progress = progress}); }},
        {"signed distance",
         [&] { distance(a, {}, b, {}, {.signed_distance = true, .progress = progress}); }},
        {"penetration", [&] { penetration(a, {}, b, {}, {.progress = progress}); }},
        {"self impacts", [&] { self_impacts(cloth, {}, progress); }},
        {"impacts", [&] { impacts(cloth, other, {}, progress); }},
        {"self pairs", [&] { self_within(cloth, 1, {.progress = progress}); }},
        {"pairs", [&] { within(cloth, other, 1, {.progress = progress}); }},
        {"penetration of bodies", [&] { world.penetration(progress); }},
    };
    for (const auto& [name, query] : queries) {
        SCOPED_TRACE(name);
        stop = false;
        std::thread other_thread([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            stop = true;
        });
        EXPECT_TRUE(is_interrupted(query));
        other_thread.join();
    }
}

TEST(Stops, AReportEndsABatch) {
    const Model a(sphere_mesh(1, 12, 8)), b(sphere_mesh(1, 9, 7));
    const ConvexPieces solid_a(a), solid_b(b);
    const std::vector<Placement> placements(200, {{}, translation(0.5, 0, 0)});
    World world;
    for (int i = 0; i < 40; ++i)
        world.add(a, {{0.01 * i, 0, 0}, {1, 0, 0, 0}});
    std::atomic<bool> stop = false;
    std::atomic<int> reports = 0;
    const Progress progress{[&](std::string_view, double done) {
                                ++reports;
                                if (done > 0.2)
                                    stop = true;
                            },
                            &stop};
    const std::vector<std::function<void()>> queries{
        [&] { collide(a, b, placements, {.progress = progress}); },
        [&] { distance(a, b, placements, {.progress = progress}); },
        [&] { within(a, b, placements, 1, {.progress = progress}); },
        [&] { distance(solid_a, solid_b, placements, {.progress = progress}); },
        [&] { penetration(solid_a, solid_b, placements, {.progress = progress}); },
        [&] { world.collide(progress); },
        [&] { world.within(1, progress); },
    };
    for (std::size_t i = 0; i < queries.size(); ++i) {
        SCOPED_TRACE(i);
        stop = false, reports = 0;
        EXPECT_TRUE(is_interrupted(queries[i]));
        EXPECT_GT(reports, 1);
    }
}

// The next call asks again for the pairs that were due.
TEST(Stops, AStoppedScheduleForgetsNoPair) {
    Random random(3);
    const auto fill = [&random](World& world, World& twin) {
        std::vector<BodyId> bodies;
        for (int i = 0; i < 60; ++i) {
            const Pose pose{random.in_cube(3), {1, 0, 0, 0}};
            bodies.push_back(world.add(Sphere{{}, 0.3}, pose));
            const BodyId same = twin.add(Sphere{{}, 0.3}, pose);
            EXPECT_EQ(same, bodies.back());
            const SpeedBounds bounds{random.in_cube(1), {}, 0, 0};
            world.set_speed(bodies.back(), bounds);
            twin.set_speed(same, bounds);
        }
        return bodies;
    };
    World stopped, twin;
    fill(stopped, twin);
    std::size_t touching = 0, interrupted = 0;
    for (int step = 0; step < 20; ++step) {
        std::atomic<bool> stop = false;
        const Progress progress{[&](std::string_view, double) { stop = true; }, &stop};
        const bool hit = is_interrupted([&] { stopped.advance(0, progress); });
        interrupted += hit ? 1 : 0;
        const std::vector<BodyPair> pairs = stopped.advance(0);
        EXPECT_EQ(pairs, twin.advance(0));
        touching += pairs.size();
    }
    EXPECT_GT(interrupted, 10U);
    EXPECT_GT(touching, 20U);
}

// A stopped search leaves nothing in a warm start that could mislead a later one.
TEST(Stops, AWarmStartSurvivesAStop) {
    Random random(4);
    const Model a(torus_mesh(1, 0.4, 24, 12)), b(torus_mesh(1, 0.3, 20, 10));
    const ConvexPieces solid_a(a), solid_b(b);
    PiecesWarmStart warm_start;
    WarmStart of_models;
    std::atomic<bool> stop = false, done = false;
    std::thread other([&] {
        while (!done) {
            std::this_thread::sleep_for(std::chrono::microseconds(100));
            stop = true;
        }
    });
    int interrupted = 0;
    Pose pose{{1.5, 0, 0}, {1, 0, 0, 0}};
    // Runs longer where the other thread is seldom scheduled.
    for (int i = 0; i < 2000 || (interrupted < 100 && i < 200'000); ++i) {
        pose.translation = pose.translation + random.in_cube(0.02);
        if (random.chance(0.05))
            pose = random.pose(2.5);
        stop = false;
        interrupted += is_interrupted([&] {
            distance(solid_a, {}, solid_b, pose,
                     {.warm_start = &warm_start, .progress = {{}, &stop}});
        });
        const PiecesGap gap = distance(solid_a, {}, solid_b, pose, {.warm_start = &warm_start}),
                        alone = distance(solid_a, {}, solid_b, pose);
        EXPECT_NEAR(gap.distance, alone.distance, 1e-12 + 1e-9 * alone.distance);
        interrupted += is_interrupted([&] {
            distance(a, {}, b, pose, {.warm_start = &of_models, .progress = {{}, &stop}});
        });
        EXPECT_NEAR(distance(a, {}, b, pose, {.warm_start = &of_models}).distance,
                    distance(a, {}, b, pose).distance, 1e-12);
    }
    done = true;
    other.join();
    EXPECT_GE(interrupted, 100);
}

class Limits : public ::testing::Test {
protected:
    Random random{5};

    Model model() {
        constexpr std::array kEachVolume{Volume::automatic, Volume::aabb, Volume::sphere,
                                         Volume::kdop18,    Volume::obb,  Volume::rss};
        const ModelOptions options{
            .volume = kEachVolume.at(static_cast<std::size_t>(random.integer(0, 5)))};
        switch (random.integer(0, 2)) {
        case 0:
            return Model(sphere_mesh(1, 20, 14), options);
        case 1:
            return Model(torus_mesh(1, 0.3, 24, 12), options);
        default:
            return Model(soup_mesh(random, 300, 1, 0.3), options);
        }
    }
    std::uint64_t limit() {
        return static_cast<std::uint64_t>(std::pow(2, random.uniform(0, 8)) - 1);
    }
};

TEST_F(Limits, BoundsOfADistanceHoldTheTruth) {
    int limited = 0, proven = 0, complete = 0;
    for (int i = 0; i < 1500; ++i) {
        const Model a = model(), b = model();
        const Transform wa = random.pose(1), wb = random.pose(random.uniform(1, 5));
        DistanceOptions options;
        if (random.chance(0.3))
            options.relative_error = 0.1;
        if (random.chance(0.3))
            options.upper_bound = random.uniform(0, 3);
        const Gap whole = distance(a, wa, b, wb, options), truth = distance(a, wa, b, wb);
        options.max_steps = limit();
        const Gap gap = distance(a, wa, b, wb, options);
        EXPECT_LE(gap.steps, *options.max_steps);
        EXPECT_LE(gap.at_least, truth.distance);
        EXPECT_LE(gap.at_least, gap.distance);
        EXPECT_GE(gap.distance, std::min(truth.at_least, options.upper_bound));
        if (!gap.out_of_steps) {
            ++complete;
            EXPECT_EQ(gap.distance, whole.distance);
            EXPECT_EQ(gap.at_least, whole.at_least);
            EXPECT_EQ(gap.status, whole.status);
            continue;
        }
        ++limited;
        proven += gap.at_least > 0 ? 1 : 0;
        EXPECT_EQ(gap.status, Status::bound_only);
        if (gap.distance < options.upper_bound) {
            EXPECT_NEAR(length(gap.point_a - gap.point_b), gap.distance, 1e-12);
        }
    }
    EXPECT_GT(limited, 300);
    EXPECT_GT(proven, 100);
    EXPECT_GT(complete, 100);
}

/// Keeps the least distance of the visited pairs.
class NearestVisited : public LeafPairVisitor {
public:
    explicit NearestVisited(const PlacedPair& pair) : pair_(pair) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs&) override {
        for (std::uint32_t i = 0; i < leaf_a.count(); ++i)
            for (std::uint32_t j = 0; j < leaf_b.count(); ++j)
                best_sq = std::min(
                    best_sq, triangle_triangle_distance(
                                 pair_.a().world_slot(leaf_a.first() + i, pair_.world_from_a()),
                                 pair_.b().world_slot(leaf_b.first() + j, pair_.world_from_b()))
                                 .distance_sq);
        return best_sq;
    }
    double best_sq = kInfinity;

private:
    const PlacedPair& pair_;
};

TEST_F(Limits, BoundsHoldIfTheQueueIsFull) {
    int limited = 0, decisive = 0;
    for (int i = 0; i < 1000; ++i) {
        const Model a = model(), b = model();
        const Transform wa = random.pose(1), wb = random.pose(random.uniform(1, 5));
        const PlacedPair pair(a, wa, b, wb);
        PairTraversal traversal = pair.traversal(kInfinity);
        traversal.queue_limit = static_cast<std::size_t>(random.integer(1, 40));
        traversal.steps = SearchSteps(limit());
        NearestVisited visitor(pair);
        const Verdict verdict = traverse_nearest(traversal, visitor);
        EXPECT_EQ(verdict == Verdict::out_of_steps, traversal.steps.ran_out());
        const double truth = distance(a, wa, b, wb).distance;
        EXPECT_LE(std::sqrt(std::min(traversal.left_sq, visitor.best_sq)), truth * (1 + 1e-12));
        limited += traversal.steps.ran_out() ? 1 : 0;
        decisive += traversal.left_sq < visitor.best_sq ? 1 : 0;
    }
    EXPECT_GT(limited, 200);
    EXPECT_GT(decisive, 100);
}

TEST_F(Limits, BoundsOfADepthHoldTheTruth) {
    int limited = 0, without_regions = 0, reached = 0, complete = 0;
    for (int i = 0; i < 150; ++i) {
        const Model a = model(), b = model();
        const Transform wa = random.pose(1), wb = random.pose(random.uniform(0.5, 3));
        PenetrationOptions options{.separation = random.chance(0.7)};
        const Depth truth = penetration(a, wa, b, wb, options);
        options.max_steps =
            random.chance(0.5) ? limit() : static_cast<std::uint64_t>(random.integer(100, 5000));
        const Depth depth = penetration(a, wa, b, wb, options);
        EXPECT_LE(depth.steps, *options.max_steps);
        if (!depth.out_of_steps) {
            ++complete;
            EXPECT_EQ(depth.depth, truth.depth);
            EXPECT_EQ(depth.separation, truth.separation);
            continue;
        }
        ++limited;
        without_regions += depth.regions.empty() ? 1 : 0;
        reached += depth.depth > 0 ? 1 : 0;
        EXPECT_TRUE(depth.interpenetrate || !truth.interpenetrate);
        EXPECT_LE(depth.depth, truth.depth_at_most * (1 + 1e-9));
        EXPECT_GE(depth.depth_at_most, truth.depth * (1 - 1e-9));
        EXPECT_LT(depth.depth_at_most, 20);
        EXPECT_TRUE(options.separation || depth.separation == Vec3{});
        if (options.separation && truth.interpenetrate) {
            Transform moved = wb;
            moved.m[9] += depth.separation.x, moved.m[10] += depth.separation.y,
                moved.m[11] += depth.separation.z;
            EXPECT_FALSE(collide(a, wa, b, moved).meet());
        }
    }
    EXPECT_GT(limited, 50);
    EXPECT_GT(without_regions, 15);
    EXPECT_GT(reached, 5);
    EXPECT_GT(complete, 10);
}

TEST_F(Limits, BoundsOfASignedDistanceHoldTheTruth) {
    int limited = 0, inside = 0, apart = 0;
    for (int i = 0; i < 600; ++i) {
        const Model a = model(), b = model();
        const Transform wa = random.pose(1), wb = random.pose(random.uniform(0.5, 5));
        DistanceOptions options{.signed_distance = true};
        const Gap truth = distance(a, wa, b, wb, options);
        options.max_steps =
            random.chance(0.5) ? limit() : static_cast<std::uint64_t>(random.integer(100, 2000));
        const Gap gap = distance(a, wa, b, wb, options);
        EXPECT_LE(gap.steps, *options.max_steps);
        EXPECT_LE(gap.at_least, truth.distance + 1e-12);
        EXPECT_GE(gap.distance, truth.at_least - 1e-12);
        if (!gap.out_of_steps) {
            EXPECT_EQ(gap.distance, truth.distance);
            continue;
        }
        ++limited;
        (truth.distance < 0 ? inside : apart) += 1;
        EXPECT_EQ(gap.status, Status::bound_only);
        EXPECT_GT(gap.at_least, -20);
    }
    EXPECT_GT(limited, 100);
    EXPECT_GT(inside, 30);
    EXPECT_GT(apart, 30);
}

} // namespace
} // namespace abut::test
