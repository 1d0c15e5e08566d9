// Walks worked by hand.
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/shape_queries.h>
#include <abut/walk.h>

#include "store/database/sqlite.h"
#include "tests/support/folder.h"
#include "tests/support/shapes.h"

#include <atomic>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class WalkByHand : public testing::Test {
protected:
    /// Two cubes of side 2 about (0, 0, 0) and (10, 0, 0) that share a mesh.
    Store two_cubes() {
        Scene scene;
        scene.meshes = {box_mesh({-1, -1, -1}, {1, 1, 1})};
        scene.parts = {{"left", "Left one", "Cube", 0, {}},
                       {"right", "Right one", "Cube", 0, translation(10, 0, 0)}};
        return import(scene);
    }
    Store import(const Scene& scene) {
        write_glb(scene, folder_ / "a.glb");
        (void)import_models({folder_ / "a.glb"}, store_);
        return open_store(store_);
    }
    static ErrorCode code_of(const std::function<void()>& work) {
        try {
            work();
        } catch (const Error& error) {
            return error.code();
        }
        ADD_FAILURE() << "no error";
        return ErrorCode::interrupted;
    }

    Folder folder_;
    std::string store_ = folder_ / "s.abut";
    const Probe ball_{Sphere{{}, 0.5}};
};

TEST_F(WalkByHand, FindsTheNearerOfTwoCubes) {
    Walk walk(two_cubes());
    walk.move_to({2, 0, 0});
    walk.wait();
    const NearestPart nearest = walk.distance(ball_, Pose{{4, 0, 0}});
    ASSERT_TRUE(nearest.found);
    EXPECT_TRUE(nearest.complete);
    EXPECT_EQ(nearest.misses, 0U);
    EXPECT_EQ(nearest.gap.distance, 2.5); // from x = 1 to x = 3.5
    EXPECT_EQ(nearest.at_least, 2.5);
    EXPECT_EQ(nearest.gap.point_part, (Vec3{1, 0, 0}));
    EXPECT_EQ(nearest.gap.point_probe, (Vec3{3.5, 0, 0}));
    EXPECT_EQ(nearest.gap.normal, (Vec3{1, 0, 0}));
    const WalkPartName name = walk.name(nearest.gap.part);
    EXPECT_EQ(name.file, folder_ / "a.glb");
    EXPECT_EQ(name.id, "left");
    EXPECT_EQ(name.name, "Left one");
    EXPECT_EQ(name.type, "Cube");
    EXPECT_EQ(walk.model(nearest.gap.part).mesh().triangles.size(), 12U);

    EXPECT_FALSE(walk.distance(ball_, Pose{{4, 0, 0}}, {.upper_bound = 2.5}).found);
    EXPECT_TRUE(walk.distance(ball_, Pose{{4, 0, 0}}, {.upper_bound = 2.6}).found);
    // Both are equally far: the part with the lower number is returned.
    EXPECT_EQ(walk.distance(ball_, Pose{{5, 0, 0}}).gap.part, nearest.gap.part);
}

TEST_F(WalkByHand, FindsAllCubesWithinAndTouched) {
    Walk walk(two_cubes(), {.prefetch = false});
    EXPECT_EQ(walk.within(ball_, Pose{{4, 0, 0}}, 2.5).parts.size(), 1U);
    EXPECT_EQ(walk.within(ball_, Pose{{4, 0, 0}}, 4.5).parts.size(), 2U);
    EXPECT_TRUE(walk.within(ball_, Pose{{4, 0, 0}}, 2.4).parts.empty());
    EXPECT_EQ(walk.collide(ball_, Pose{{1.5, 0, 0}}).parts.size(), 1U);
    EXPECT_TRUE(walk.collide(ball_, Pose{{1.6, 0, 0}}).parts.empty());
    // Inside and away from the surface: parts are surfaces, so there is no contact.
    EXPECT_TRUE(walk.collide(ball_, Pose{}).parts.empty());
    // The ball's centre is 0.25 inside the closed cube, so 0.75 ends the overlap.
    const NearParts contacts = walk.penetration(ball_, Pose{{0.75, 0, 0}});
    ASSERT_EQ(contacts.parts.size(), 1U);
    EXPECT_EQ(contacts.parts[0].distance, -0.75);
    EXPECT_EQ(contacts.parts[0].normal, (Vec3{1, 0, 0}));
    const WalkStatistics found = walk.statistics();
    EXPECT_EQ(found.read_in_query, 2U); // both parts, once each
    EXPECT_EQ(found.misses, 2U);
    EXPECT_EQ(found.read_ahead, 0U);
    EXPECT_EQ(found.parts_in_memory, 2U);
}

TEST_F(WalkByHand, PartsThatComeMoveAndGo) {
    Walk walk(two_cubes());
    const WalkPart left = walk.collide(ball_, Pose{{1.4, 0, 0}}).parts.at(0);
    const WalkPart added =
        walk.add(Model(box_mesh({-1, -1, -1}, {1, 1, 1})), translation(0, 10, 0));
    EXPECT_LT(added.number, 0);
    EXPECT_TRUE(walk.name(added).id.empty());
    EXPECT_EQ(walk.distance(ball_, Pose{{0, 8, 0}}).gap.part, added);
    walk.move(left, translation(0, 20, 0));
    EXPECT_TRUE(walk.collide(ball_, Pose{{1.4, 0, 0}}).parts.empty());
    EXPECT_EQ(walk.collide(ball_, Pose{{1.4, 20, 0}}).parts, std::vector{left});
    EXPECT_EQ(walk.world_from_part(left), translation(0, 20, 0));
    // A part's own model as the probe: what does the part touch at its place?
    const Probe copy(walk.model(left));
    EXPECT_EQ(walk.collide(copy, walk.world_from_part(left)).parts, std::vector{left});
    EXPECT_TRUE(walk.collide(copy, walk.world_from_part(left), {.except = left}).parts.empty());
    walk.move(added, translation(0, 18.5, 0));
    EXPECT_EQ(walk.collide(copy, walk.world_from_part(left), {.except = left}).parts,
              std::vector{added});
    walk.move(added, translation(0, 30, 0));
    EXPECT_EQ(walk.distance(ball_, Pose{{0, 27, 0}}).gap.distance, 1.5);
    walk.remove(added);
    walk.remove(left);
    EXPECT_EQ(walk.distance(ball_, Pose{{0, 27, 0}}).gap.part.number, 2);
    for (const WalkPart part : {added, left, WalkPart{77}, WalkPart{-77}, WalkPart{0}}) {
        EXPECT_EQ(code_of([&] { walk.move(part, {}); }), ErrorCode::bad_argument);
        EXPECT_EQ(code_of([&] { walk.remove(part); }), ErrorCode::bad_argument);
        EXPECT_EQ(code_of([&] { (void)walk.name(part); }), ErrorCode::bad_argument);
    }
}

TEST_F(WalkByHand, ARayMeetsTheFirstPart) {
    Walk walk(two_cubes(), {.prefetch = false});
    const HitPart hit = walk.first_hit({{5, 0.25, 0.5}, {2, 0, 0}});
    ASSERT_TRUE(hit.meet);
    EXPECT_EQ(walk.name(hit.part).id, "right");
    EXPECT_EQ(hit.t, 2);
    EXPECT_EQ(hit.at_least, 2);
    EXPECT_EQ(hit.point, (Vec3{9, 0.25, 0.5}));
    EXPECT_EQ(hit.side, HitSide::front);
    EXPECT_EQ(walk.statistics().lookups, 1U);
    EXPECT_FALSE(walk.first_hit({{5, 2, 0}, {1, 0, 0}}).meet);
    EXPECT_FALSE(walk.first_hit({{5, 0, 0}, {1, 0, 0}, 0, 3.5}).meet);
    EXPECT_EQ(walk.first_hit({{5, 0, 0}, {1, 0, 0}}, {.except = hit.part}).meet, false);
    const HitPart back = walk.first_hit({{5, 0, 0}, {1, 0, 0}, -kInfinity, 0});
    EXPECT_EQ(walk.name(back.part).id, "left");
    EXPECT_EQ(back.t, -6);
}

TEST_F(WalkByHand, AMovingProbeMeetsTheFirstPartInItsWay) {
    Walk walk(two_cubes(), {.prefetch = false});
    // From x = 5 by 8: the ball touches the right cube at x = 8.5.
    const WalkQuery query{.absolute_error = 1e-9};
    const FirstContact right = walk.sweep(ball_, Pose{{5, 0, 0}}, {8, 0, 0}, query);
    ASSERT_TRUE(right.meet);
    EXPECT_EQ(walk.name(right.impact.part).id, "right");
    EXPECT_LE(right.impact.time, 3.5 / 8);
    EXPECT_NEAR(right.impact.time, 3.5 / 8, 1e-9);
    EXPECT_EQ(right.time_free, right.impact.time);
    EXPECT_NEAR(right.impact.point_part.x, 9, 1e-9);
    EXPECT_NEAR(right.impact.point_probe.x, 9, 1e-8);
    EXPECT_NEAR(right.impact.normal.x, -1, 1e-9);
    EXPECT_FALSE(walk.sweep(ball_, Pose{{5, 0, 0}}, {3.4, 0, 0}).meet);
    EXPECT_EQ(walk.sweep(ball_, Pose{{5, 0, 0}}, {3.4, 0, 0}).time_free, 1);
    EXPECT_FALSE(walk.sweep(ball_, Pose{{5, 1.6, 0}}, {8, 0, 0}).meet); // passes by
    EXPECT_FALSE(walk.sweep(ball_, Pose{{5, 0, 0}}, {8, 0, 0}, {.except = right.impact.part}).meet);
    EXPECT_EQ(walk.sweep(ball_, Pose{{1.2, 0, 0}}, {8, 0, 0}).time_free, 0);
    // Inside the cube nothing is touched; then the ball's side is.
    EXPECT_NEAR(walk.sweep(ball_, Pose{}, {0, 1, 0}).impact.time, 0.5, 1e-6);
    // A small cube deep in a solid box.
    const Probe hollow(Box3{{-3, -3, -3}, {3, 3, 3}});
    EXPECT_EQ(walk.sweep(hollow, Pose{}, {1, 0, 0}).time_free, 0);

    const Motion both{Pose{{5, 0, 0}}, {5, 0, 0}, {-8, 0, 0}, {0, 0, 3}};
    const FirstContact left = walk.time_of_impact(ball_, both, query);
    ASSERT_TRUE(left.meet);
    EXPECT_EQ(walk.name(left.impact.part).id, "left");
    EXPECT_NEAR(left.impact.time, 3.5 / 8, 1e-9);
    const Motion far{Pose{{5, 0, 0}}, {0, 0, 0}, {}, {0, 0, 6}}; // a circle about the left cube
    EXPECT_FALSE(walk.time_of_impact(ball_, far).meet);
    const PartsInWay all =
        walk.parts_in_way(ball_, {Pose{{-5, 0, 0}}, {-5, 0, 0}, {20, 0, 0}, {}}, query);
    ASSERT_EQ(all.parts.size(), 2U);
    EXPECT_EQ(walk.name(all.parts[0].part).id, "left");
    EXPECT_NEAR(all.parts[0].time, 3.5 / 20, 1e-9);
    EXPECT_NEAR(all.parts[1].time, 13.5 / 20, 1e-9);
}

TEST_F(WalkByHand, MotionsIntoWhatIsNotInMemoryAreFreeUpToItsBox) {
    Walk walk(two_cubes(), {.prefetch = false});
    const WalkQuery skip{.missing = MissingParts::skip};
    const FirstContact answer = walk.sweep(ball_, Pose{{5, 0, 0}}, {8, 0, 0}, skip);
    EXPECT_FALSE(answer.meet);
    EXPECT_FALSE(answer.complete);
    EXPECT_LE(answer.time_free, 3.5 / 8);
    EXPECT_GT(answer.time_free, 3.49 / 8);
    const HitPart hit = walk.first_hit({{5, 0, 0}, {2, 0, 0}}, skip);
    EXPECT_FALSE(hit.meet);
    EXPECT_FALSE(hit.complete);
    EXPECT_LE(hit.at_least, 2);
    EXPECT_GT(hit.at_least, 1.99);
}

TEST_F(WalkByHand, QueriesStopAndRefuseBadArguments) {
    Walk walk(two_cubes(), {.prefetch = false});
    const std::atomic<bool> stop{true};
    WalkQuery stopped;
    stopped.progress.stop = &stop;
    const Motion motion = Motion::fixed(Pose{});
    const auto expect_all = [&](ErrorCode code, const WalkQuery& query, const Pose& pose,
                                const Motion& way) {
        EXPECT_EQ(code_of([&] { walk.distance(ball_, pose, query); }), code);
        EXPECT_EQ(code_of([&] { walk.within(ball_, pose, 1, query); }), code);
        EXPECT_EQ(code_of([&] { walk.collide(ball_, pose, query); }), code);
        EXPECT_EQ(code_of([&] { walk.penetration(ball_, pose, query); }), code);
        EXPECT_EQ(code_of([&] { walk.first_hit({pose.translation, {1, 0, 0}}, query); }), code);
        EXPECT_EQ(code_of([&] { walk.sweep(ball_, pose, {1, 0, 0}, query); }), code);
        EXPECT_EQ(code_of([&] { walk.time_of_impact(ball_, way, query); }), code);
        EXPECT_EQ(code_of([&] { walk.parts_in_way(ball_, way, query); }), code);
    };
    expect_all(ErrorCode::interrupted, stopped, {}, motion);
    for (const double bad : {std::nan(""), kInfinity}) {
        expect_all(ErrorCode::bad_argument, {}, Pose{{bad, 0, 0}}, {Pose{}, {}, {0, bad, 0}, {}});
        for (const Motion& way :
             {Motion{Pose{}, {bad, 0, 0}, {}, {}}, Motion{Pose{}, {}, {}, {bad, 0, 0}},
              Motion{Pose{{0, 0, bad}}, {}, {}, {}}})
            EXPECT_EQ(code_of([&] { walk.time_of_impact(ball_, way); }), ErrorCode::bad_argument);
        EXPECT_EQ(code_of([&] {
                      walk.sweep(ball_, Pose{}, {0, 0, bad});
                  }),
                  ErrorCode::bad_argument);
        EXPECT_EQ(code_of([&] { walk.first_hit({{}, {bad, 0, 0}}); }), ErrorCode::bad_argument);
    }
    EXPECT_EQ(code_of([&] { walk.first_hit({{}, {}}); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { walk.sweep(ball_, Pose{}, {}, {.absolute_error = -1}); }),
              ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { walk.collide(WalkPart{77}); }), ErrorCode::bad_argument);
}

TEST_F(WalkByHand, PartsNotInMemoryMayBeSkipped) {
    Walk walk(two_cubes());
    const WalkQuery skip{.missing = MissingParts::skip};
    // No region of interest was given, so nothing is in memory.
    const NearestPart before = walk.distance(ball_, Pose{{4, 0, 0}}, skip);
    EXPECT_FALSE(before.found);
    EXPECT_FALSE(before.complete);
    EXPECT_GT(before.misses, 0U);
    EXPECT_LE(before.at_least, 2.5);
    EXPECT_GT(before.at_least, 2.4);
    walk.wait(); // reads what was skipped
    const NearestPart after = walk.distance(ball_, Pose{{4, 0, 0}}, skip);
    EXPECT_TRUE(after.complete);
    EXPECT_EQ(after.gap.distance, 2.5);
}

TEST_F(WalkByHand, TrianglesOfACutMeshHaveTheirNumbersInTheWholeMesh) {
    Scene scene;
    scene.meshes = {torus_mesh(3, 1, 300, 150)}; // 90,000 triangles: three blocks
    scene.parts = {{"torus", "", "", 0, {}}};
    Walk walk(import(scene), {.memory = std::uint64_t{32} << 20, .prefetch = false});
    const Model whole = walk.model({1});
    for (const double angle : {0.1, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        const Vec3 at{5 * std::cos(angle), 5 * std::sin(angle), 0.3};
        const NearestPart nearest = walk.distance(ball_, Pose{at});
        const auto& corners = whole.mesh().triangles.at(nearest.gap.triangle_part);
        const Model triangle(
            Mesh{{whole.mesh().positions[corners[0]], whole.mesh().positions[corners[1]],
                  whole.mesh().positions[corners[2]]},
                 {{0, 1, 2}}});
        EXPECT_NEAR(nearest.gap.distance, abut::nearest(triangle, Pose{}, at).distance - 0.5,
                    1e-12);
        EXPECT_NEAR(nearest.gap.distance, abut::nearest(whole, Pose{}, at).distance - 0.5, 1e-12);
    }
    EXPECT_LE(walk.statistics().peak_bytes, std::uint64_t{32} << 20);
}

TEST_F(WalkByHand, BadArgumentsAreRefused) {
    const Store store = two_cubes();
    EXPECT_EQ(code_of([&] { Walk(store, {.memory = 1000}); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { Walk(store, {.look_ahead = -1}); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { Walk(store, {.look_ahead = kInfinity}); }), ErrorCode::bad_argument);
    Walk walk(store);
    EXPECT_EQ(code_of([&] { walk.move_to({NAN, 0, 0}); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { walk.move_to({}, {kInfinity, 0, 0}); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { (void)walk.distance(ball_, scaling(2, 2, 2)); }),
              ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { (void)walk.distance(ball_, translation(NAN, 0, 0)); }),
              ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { (void)walk.distance(ball_, Pose{}, {.upper_bound = NAN}); }),
              ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { (void)walk.within(ball_, Pose{}, -1); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { (void)Probe(Sphere{{}, -1}); }), ErrorCode::bad_argument);
    // A probe that is a model takes any transform. One without triangles is nowhere.
    const Probe cube(Model(box_mesh({-1, -1, -1}, {1, 1, 1})));
    EXPECT_EQ(walk.collide(cube, scaling(10, 10, 10)).parts.size(), 1U);
    EXPECT_FALSE(walk.distance(Model(Mesh{}), Pose{}).found);
}

TEST_F(WalkByHand, TooManyPartsAreRefused) {
    Walk walk(two_cubes(), {.memory = 1 << 17});
    const Model cube(box_mesh({-1, -1, -1}, {1, 1, 1}));
    std::vector<WalkPart> added;
    EXPECT_EQ(code_of([&] {
                  for (int i = 0; i < 10'000; ++i)
                      added.push_back(walk.add(cube, translation(0, 10.0 * i, 0)));
              }),
              ErrorCode::bad_argument);
    EXPECT_GT(added.size(), 100U);
    EXPECT_EQ(walk.distance(ball_, Pose{{10, 0, 2}}).gap.part.number, 2);
    EXPECT_EQ(walk.distance(ball_, Pose{{0, 100, 2}}).gap.part, added.at(10));
    EXPECT_LE(walk.statistics().peak_bytes, 1U << 17);
    for (const WalkPart part : added)
        walk.remove(part);
    walk.remove(walk.add(cube, Pose{}));
}

TEST_F(WalkByHand, DamageIsReportedWhereItMatters) {
    (void)two_cubes();
    Database(store_, OpenMode::read_write).run("UPDATE block SET data = zeroblob(length(data))");
    Walk walk(open_store(store_));
    walk.move_to({4, 0, 0}); // reads ahead, in vain
    walk.wait();
    EXPECT_FALSE(walk.distance(ball_, Pose{{4, 0, 0}}, {.upper_bound = 1}).found);
    EXPECT_EQ(code_of([&] { (void)walk.distance(ball_, Pose{{4, 0, 0}}); }), ErrorCode::malformed);
    EXPECT_EQ(code_of([&] { (void)walk.distance(ball_, Pose{{4, 0, 0}}); }), ErrorCode::malformed);
}

TEST_F(WalkByHand, APartThatCouldNotBeMovedCanBeMovedLater) {
    Walk walk(two_cubes());
    Database database(store_, OpenMode::read_write);
    database.run("UPDATE mesh SET mesh = mesh + 100");
    EXPECT_THROW(walk.move({1}, Pose{{0, 50, 0}}), Error);
    database.run("UPDATE mesh SET mesh = mesh - 100");
    walk.move({1}, Pose{{0, 50, 0}});
    EXPECT_EQ(walk.distance(ball_, Pose{{0, 50, 3}}).gap.distance, 1.5);
}

TEST_F(WalkByHand, InvalidPartNumbersAreRefused) {
    Walk walk(two_cubes());
    const Model cube(box_mesh({-1, -1, -1}, {1, 1, 1}));
    EXPECT_EQ(walk.add(cube, Pose{}).number, -1);
    for (const std::int64_t number :
         {std::numeric_limits<std::int64_t>::min(), std::int64_t{-2},
          std::int64_t{-2} - (std::int64_t{1} << 32), std::int64_t{-1} - (std::int64_t{1} << 32),
          std::int64_t{0}, std::int64_t{3}, std::numeric_limits<std::int64_t>::max()})
        EXPECT_EQ(code_of([&] { walk.move({number}, Pose{}); }), ErrorCode::bad_argument) << number;
}

TEST_F(WalkByHand, MovingBackAndForthComesToRest) {
    Walk walk(two_cubes());
    for (int i = 0; i < 300; ++i) {
        walk.move_to({0, 0, 0}, {});
        walk.move_to({100, 0, 0}, {});
        walk.move_to({0, 0, 0}, {});
        walk.wait();
    }
    EXPECT_EQ(walk.statistics().parts_in_memory, 2U);
}

TEST_F(WalkByHand, WithoutPartsNothingIsNear) {
    Walk walk(two_cubes());
    walk.remove({1});
    walk.remove({2});
    walk.move_to({});
    walk.wait();
    const NearestPart nearest = walk.distance(ball_, Pose{});
    EXPECT_FALSE(nearest.found);
    EXPECT_TRUE(nearest.complete);
    EXPECT_EQ(nearest.at_least, kInfinity);
}

// In a region that is not in memory a query would otherwise visit every part, and ask for each.
TEST_F(WalkByHand, AQueryThatSkipsEndsAfterSomeMissingParts) {
    Scene scene;
    scene.meshes = {box_mesh({-1, -1, -1}, {1, 1, 1})};
    for (int i = 0; i < 3000; ++i)
        scene.parts.push_back({std::to_string(i), "", "Cube", 0, translation(4 * i, 0, 0)});
    Walk walk(import(scene), {.prefetch = false});
    const WalkQuery skip{.missing = MissingParts::skip};
    const NearestPart nearest = walk.distance(ball_, Pose{{-10, 0, 0}}, skip);
    EXPECT_FALSE(nearest.complete);
    EXPECT_FALSE(nearest.found);
    EXPECT_EQ(nearest.misses, 1024U);
    EXPECT_LE(nearest.at_least, 8.5); // from x = -9.5 to x = -1
    EXPECT_GE(nearest.at_least, 8.4);
    EXPECT_EQ(walk.within(ball_, Pose{{-10, 0, 0}}, 1e6, skip).misses, 1024U);
    EXPECT_EQ(walk.distance(ball_, Pose{{-10, 0, 0}}).gap.distance, 8.5);
}

} // namespace
} // namespace abut::test
