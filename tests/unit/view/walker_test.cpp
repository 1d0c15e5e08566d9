// A person on floors, stairs, ramps and under pipes, worked by hand.
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/walker.h>

#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

/// A floor of 60 x 60, whose top is z = 0, and what a test adds to it.
class WalkerSite : public testing::Test {
protected:
    WalkPart add(const Mesh& mesh) { return walk_.add(Model(mesh), {}); }
    WalkPart add_box(const Vec3& lower, const Vec3& upper) { return add(box_mesh(lower, upper)); }
    /// A wedge from (0, -5, 0) up along x to `height`.
    void add_ramp(double length, double height) {
        Mesh mesh = box_mesh({0, -5, 0}, {length, 5, height});
        for (Vec3& p : mesh.positions)
            if (p.x == 0)
                p.z = 0;
        add(mesh);
    }
    void add_stairs(int steps, double rise, double tread) {
        for (int i = 0; i < steps; ++i)
            add_box({i * tread, -2, -0.1}, {steps * tread + 3, 2, (i + 1) * rise});
    }
    static WalkerOptions options() { return {.missing = MissingParts::wait}; }
    Walker at(const Vec3& feet) {
        Walker walker(walk_, feet, options());
        walker.step({}, 0.5); // lands
        return walker;
    }
    /// Walks for some seconds.
    static void go(Walker& walker, const Vec3& wish, double seconds, double frame = 1.0 / 60,
                   bool duck = false) {
        const int frames = static_cast<int>(std::lround(seconds / frame));
        for (int i = 0; i < frames; ++i)
            walker.step(wish, frame, duck);
    }

    Store import_floor() {
        Scene scene;
        scene.meshes = {box_mesh({-30, -30, -0.5}, {30, 30, 0})};
        scene.parts = {{"floor", "Floor", "Slab", 0, {}}};
        write_glb(scene, folder_ / "floor.glb");
        (void)import_models({folder_ / "floor.glb"}, folder_ / "floor.abut");
        return open_store(folder_ / "floor.abut");
    }

    Folder folder_;
    Store store_ = import_floor();
    Walk walk_{store_, {.prefetch = false}};
    const double skin_ = WalkerOptions().skin;
};

TEST_F(WalkerSite, FallsAndLands) {
    Walker walker(walk_, {1, 2, 3}, options());
    const double seconds = std::sqrt(2 * 3 / 9.81);
    go(walker, {}, 0.9 * seconds);
    EXPECT_FALSE(walker.state().on_ground);
    EXPECT_NEAR(walker.state().feet.z, 3 - 0.5 * 9.81 * std::pow(0.9 * seconds, 2), 0.1);
    go(walker, {}, 0.5);
    EXPECT_TRUE(walker.state().on_ground);
    EXPECT_NEAR(walker.state().feet.z, skin_, 1e-3);
    EXPECT_EQ(walker.state().feet.x, 1);
    EXPECT_NEAR(walker.state().eye.z, walker.state().feet.z + 1.7, 1e-12);
    // Beside the floor there is nothing to fall on.
    walker.move_to({100, 0, 5});
    go(walker, {}, 1);
    EXPECT_EQ(walker.state().feet.z, 5);
}

TEST_F(WalkerSite, Jumps) {
    Walker walker = at({0, 0, 0});
    walker.step({}, 0.01, false, true);
    double highest = 0;
    for (int i = 0; i < 200; ++i)
        highest = std::max(highest, walker.step({}, 0.01).feet.z);
    EXPECT_NEAR(highest, 3.5 * 3.5 / 2 / 9.81 + skin_, 0.01);
    EXPECT_TRUE(walker.state().on_ground);
    add_box({-1, -1, 2}, {1, 1, 2.5}); // a ceiling
    walker.step({}, 0.01, false, true);
    for (int i = 0; i < 200; ++i)
        EXPECT_LT(walker.step({}, 0.01).feet.z, 0.2);
    EXPECT_NEAR(walker.state().feet.z, skin_, 1e-3);
}

TEST_F(WalkerSite, ClimbsStairsAndGoesDownAgain) {
    add_stairs(12, 0.17, 0.29);
    Walker walker = at({-1, 0, 0});
    go(walker, {1.4, 0, 0}, 4);
    EXPECT_NEAR(walker.state().feet.x, -1 + 4 * 1.4, 0.1);
    EXPECT_NEAR(walker.state().feet.z, 12 * 0.17 + skin_, 2e-3);
    for (int i = 0; i < 4 * 60; ++i) {
        walker.step({-1.4, 0, 0}, 1.0 / 60);
        EXPECT_TRUE(walker.state().on_ground);
    }
    EXPECT_NEAR(walker.state().feet.x, -1, 0.1);
    EXPECT_NEAR(walker.state().feet.z, skin_, 2e-3);
}

TEST_F(WalkerSite, ClimbsStepsUpToTheStepHeight) {
    for (const double height : {0.05, 0.2, 0.35, 0.36, 0.4, 1.0}) {
        const WalkPart step = add_box({0, -2, 0}, {5, 2, height});
        Walker walker = at({-1, 0, 0});
        go(walker, {1.4, 0, 0}, 3);
        const bool climbs = height <= 0.35;
        EXPECT_NEAR(walker.state().feet.z, (climbs ? height : 0) + skin_, 2e-3) << height;
        EXPECT_NEAR(walker.state().feet.x, climbs ? -1 + 3 * 1.4 : -0.3 - skin_, 0.05) << height;
        EXPECT_EQ(walker.state().blocked, !climbs);
        walk_.remove(step);
    }
}

TEST_F(WalkerSite, WalksUpRampsThatAreNotTooSteep) {
    add_ramp(10, 10 * std::tan(0.7)); // 40 degrees
    Walker walker = at({-2, 0, 0});
    go(walker, {1.4, 0, 0}, 4);
    const double run = -2 + 4 * 1.4;
    EXPECT_NEAR(walker.state().feet.x, run, 0.05);
    EXPECT_GT(walker.state().feet.z, (run - 0.3) * std::tan(0.7));
    const Vec3 before = walker.state().feet;
    go(walker, {}, 2); // stands still
    EXPECT_NEAR(length(walker.state().feet - before), 0, 1e-3);
}

TEST_F(WalkerSite, DoesNotCreepUpSteepSlopes) {
    add_ramp(10, 10 * std::tan(0.88)); // 50 degrees
    Walker walker = at({-2, 0, 0});
    go(walker, {1.4, 0.3, 0}, 5);
    EXPECT_LT(walker.state().feet.z, 0.05);
    EXPECT_GT(walker.state().feet.y, 1.3); // slides along
    walker.move_to({5, 0, 7});
    go(walker, {1.4, 0, 0}, 5); // slides down
    EXPECT_LT(walker.state().feet.z, 0.05);
}

TEST_F(WalkerSite, SlidesAlongWallsAtTheTangentialSpeed) {
    add_box({-20, 1, 0}, {20, 1.5, 3});
    Walker walker = at({-5, 0, 0});
    go(walker, {1, 1, 0}, 2); // reaches the wall
    const Vec3 before = walker.state().feet;
    go(walker, {1, 1, 0}, 4);
    EXPECT_NEAR(walker.state().feet.x - before.x, 4, 1e-3);
    EXPECT_NEAR(walker.state().feet.y, 1 - 0.3 - skin_, 2e-3);
    EXPECT_TRUE(walker.state().blocked);
    add_box({6, -5, 0}, {6.5, 5, 3}); // a corner
    go(walker, {1, 1, 0}, 8);
    EXPECT_NEAR(walker.state().feet.x, 6 - 0.3 - skin_, 2e-3);
    EXPECT_NEAR(walker.state().feet.y, 1 - 0.3 - skin_, 2e-3);
}

TEST_F(WalkerSite, DucksUnderAPipe) {
    Mesh pipe = prism_mesh(-4, 4, 0.1, 12);
    for (Vec3& p : pipe.positions)
        p = {p.y, p.x, p.z + 1.4}; // along y; its lower side at 1.3
    add(pipe);
    Walker walker = at({-2, 0, 0});
    go(walker, {1.4, 0, 0}, 3);
    EXPECT_LT(walker.state().feet.x, -0.2);
    go(walker, {1.4, 0, 0}, 0.3, 1.0 / 60, true);
    EXPECT_NEAR(walker.state().feet.x, 0, 0.3);
    EXPECT_TRUE(walker.state().ducked);
    walker.step({}, 0.1);
    EXPECT_TRUE(walker.state().ducked); // no room to stand up
    EXPECT_NEAR(walker.state().eye.z, walker.state().feet.z + 0.9, 1e-12);
    go(walker, {1.4, 0, 0}, 1);
    EXPECT_FALSE(walker.state().ducked);
    EXPECT_GT(walker.state().feet.x, 0.9);
}

TEST_F(WalkerSite, FramesOfAnyLengthLeadToTheSamePlace) {
    add_stairs(8, 0.17, 0.29);
    add_box({1, -3, 0}, {4, -0.3, 5}); // a wall beside the stairs
    add_box({5, 0.5, 0}, {5.3, 5, 8});
    const auto end_of = [&](double frame) {
        Walker walker = at({-2, 0.5, 0});
        go(walker, {1.4, -0.5, 0}, 3, frame);
        go(walker, {0.5, 1.2, 0}, 2, frame);
        EXPECT_GT(walker.state().feet.z, 1);
        go(walker, {1.2, 0.7, 0}, 3, frame);
        return walker.state().feet;
    };
    const Vec3 slow = end_of(0.1), fast = end_of(0.01), usual = end_of(1.0 / 60);
    EXPECT_LT(length(slow - fast), 0.02);
    EXPECT_LT(length(usual - fast), 0.02);
    EXPECT_EQ(end_of(0.01), fast); // and each time
}

TEST_F(WalkerSite, PartsThatMoveAreInTheWay) {
    const WalkPart box = add_box({-1, -1, 0}, {1, 1, 2});
    Walker walker = at({-5, 0, 0});
    walk_.move(box, translation(-3, 0, 0));
    go(walker, {2, 0, 0}, 2);
    EXPECT_NEAR(walker.state().feet.x, -4 - 0.3 - skin_, 1e-2);
    walk_.move(box, translation(-4.5, 0, 0)); // onto the person, who is pushed out
    walker.step({}, 0.1);
    EXPECT_FALSE(walker.state().squeezed);
    EXPECT_TRUE(walk_.collide(walker.capsule(), Transform()).parts.empty());
    walk_.remove(box);
    go(walker, {2, 0, 0}, 1);
    EXPECT_GT(walker.state().feet.x, -5);
}

TEST_F(WalkerSite, WhereTheBodyHasNoRoomItMovesOutThinner) {
    add_box({-1, -0.25, 0}, {1, -0.2, 3});
    add_box({-1, 0.2, 0}, {1, 0.25, 3});
    Walker walker = at({0, 0, 0.5});
    EXPECT_TRUE(walker.state().squeezed);
    go(walker, {0, 1.4, 0}, 1);
    EXPECT_LT(std::abs(walker.state().feet.y), 0.2); // not through the wall
    go(walker, {1.4, 0, 0}, 2);
    EXPECT_FALSE(walker.state().squeezed);
    EXPECT_GT(walker.state().feet.x, 1.2);
    EXPECT_TRUE(walker.state().on_ground);
}

TEST_F(WalkerSite, WaitsForPartsThatAreNotInMemory) {
    Walk empty(store_, {.prefetch = false}); // reads nothing
    Walker waiting(empty, {0, 0, 1});
    for (int i = 0; i < 10; ++i)
        waiting.step({0, 0, 0}, 0.1);
    EXPECT_TRUE(waiting.state().waits);
    EXPECT_GT(waiting.state().feet.z, 0); // the border of what is not known: the floor's box
    EXPECT_LT(waiting.state().feet.z, 2 * skin_);
    waiting.move_to({0, 0, -0.2});
    EXPECT_TRUE(waiting.step({1, 0, 0}, 0.5).waits);
    EXPECT_EQ(waiting.state().feet, (Vec3{0, 0, -0.2}));

    Walk walk(store_);
    Walker walker(walk, {0, 0, 1});
    walk.move_to({0, 0, 1});
    walk.wait();
    for (int i = 0; i < 10; ++i)
        walker.step({1, 0, 0}, 0.1);
    EXPECT_FALSE(walker.state().waits);
    EXPECT_TRUE(walker.state().on_ground);
    EXPECT_GT(walker.state().feet.x, 0.8);
}

TEST_F(WalkerSite, RefusesArgumentsThatAreNotNumbers) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const auto expect_bad = [](const std::function<void()>& work) {
        try {
            work();
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        }
    };
    Walker walker = at({0, 0, 0});
    expect_bad([&] { walker.step({kNaN, 0, 0}, 0.1); });
    expect_bad([&] { walker.step({HUGE_VAL, 0, 0}, 0.1); });
    expect_bad([&] { walker.step({}, kNaN); });
    expect_bad([&] { walker.step({}, -1); });
    expect_bad([&] { walker.move_to({0, kNaN, 0}); });
    for (double WalkerOptions::*member :
         {&WalkerOptions::height, &WalkerOptions::radius, &WalkerOptions::skin,
          &WalkerOptions::steepest, &WalkerOptions::gravity, &WalkerOptions::step_height,
          &WalkerOptions::ducked_height, &WalkerOptions::jump_speed, &WalkerOptions::eye_height}) {
        WalkerOptions bad = options();
        bad.*member = kNaN;
        expect_bad([&] { const Walker other(walk_, {}, bad); });
        bad.*member = -1;
        expect_bad([&] { const Walker other(walk_, {}, bad); });
    }
    EXPECT_NEAR(walker.state().feet.z, skin_, 1e-3);
}

} // namespace
} // namespace abut::test
