// A person thrown at the parts of a plant passes through none of them.

#include <abut/scene.h>
#include <abut/shape_queries.h>
#include <abut/walker.h>

#include "scenes/plant/plant.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

class WalkerInPlant : public testing::Test {
protected:
    WalkerInPlant() {
        write_glb(make_plant({.triangles = 60'000}).scene, folder_ / "plant.glb");
        (void)import_models({folder_ / "plant.glb"}, folder_ / "plant.abut");
        walk_.emplace(open_store(folder_ / "plant.abut"), WalkOptions{.prefetch = false});
    }

    /// Whether the straight pieces of the way of the body's middle meet a triangle.
    bool passes(const WalkerState& state) {
        const Vec3 middle{0, 0.5, 0}; // within both bodies of a person, y up
        for (std::size_t i = 1; i < state.way.size(); ++i) {
            const Vec3 from = state.way[i - 1] + middle, way = state.way[i] - state.way[i - 1];
            if (way != Vec3{} && walk_->first_hit({from, way, 0, 1}).meet)
                return true;
        }
        return false;
    }
    bool overlaps(const Walker& walker) {
        return !walk_->collide(walker.capsule(), Transform(), {.mode = ContactMode::first})
                    .parts.empty();
    }
    Vec3 some_point(Random& random) {
        return {random.uniform(-30, 30), random.uniform(0, 25), random.uniform(-30, 30)};
    }

    Folder folder_;
    std::optional<Walk> walk_;
};

WalkerOptions in_plant(WalkerMode mode) {
    return {.up = UpAxis::y, .mode = mode, .missing = MissingParts::wait};
}

TEST_F(WalkerInPlant, NothingIsPassedAtAnySpeed) {
    Random random(6511);
    int thrown = 0, blocked = 0, steps = 0;
    for (int round = 0; thrown < many(1000) && round < many(20000); ++round) {
        const HitPart target = walk_->first_hit({some_point(random), random.direction()});
        if (!target.meet)
            continue;
        const Vec3 start = target.point + random.uniform(0.3, 6) * random.direction();
        Walker walker(*walk_, start,
                      in_plant(random.chance(0.7) ? WalkerMode::fly : WalkerMode::walk));
        if (overlaps(walker))
            continue;
        ++thrown;
        const Vec3 to_target = normalized_or_zero(target.point - walker.capsule().axis.a);
        const Vec3 velocity = random.uniform(1, 200) * to_target;
        bool was_blocked = false;
        for (int i = 0; i < 4; ++i, ++steps) {
            const WalkerState& state =
                walker.step(velocity, random.uniform(0.001, 0.15), random.chance(0.2));
            ASSERT_TRUE(is_finite(state.feet));
            ASSERT_FALSE(state.squeezed);
            ASSERT_FALSE(passes(state)) << "throw " << thrown << ", step " << i;
            ASSERT_FALSE(overlaps(walker)) << "throw " << thrown << ", step " << i;
            was_blocked = was_blocked || state.blocked;
        }
        blocked += was_blocked ? 1 : 0;
    }
    std::cout << thrown << " thrown, " << blocked << " blocked, " << steps << " steps\n";
    EXPECT_GE(thrown, many(1000));
    EXPECT_GT(blocked, thrown / 4);
}

/// A person who walks about for long gets around, and never ends up in a part.
TEST_F(WalkerInPlant, WalksAboutForLong) {
    Random random(6513);
    int walkers = 0, grounded = 0, blocked = 0, frames = 0;
    double gone = 0;
    for (int round = 0; walkers < many(20) && round < many(1000); ++round) {
        const HitPart floor = walk_->first_hit({some_point(random), {0, -1, 0}});
        if (!floor.meet)
            continue;
        Walker walker(*walk_, floor.point + Vec3{0, 0.05, 0}, in_plant(WalkerMode::walk));
        if (walker.step({}, 0.1).squeezed || overlaps(walker))
            continue;
        ++walkers;
        Vec3 wish;
        for (int i = 0; i < 300; ++i, ++frames) {
            if (i % 40 == 0)
                wish = random.uniform(0.5, 4) * random.direction();
            const Vec3 before = walker.state().feet;
            const WalkerState& state = walker.step(wish, random.uniform(0.001, 0.05),
                                                   random.chance(0.1), random.chance(0.02));
            ASSERT_FALSE(state.squeezed) << walkers << ", " << i;
            ASSERT_FALSE(passes(state)) << walkers << ", " << i;
            ASSERT_FALSE(overlaps(walker)) << walkers << ", " << i;
            gone += length(state.feet - before);
            grounded += state.on_ground ? 1 : 0;
            blocked += state.blocked ? 1 : 0;
        }
    }
    std::cout << walkers << " walkers, " << gone << " m, " << grounded << " frames of " << frames
              << " on the ground, " << blocked << " blocked\n";
    EXPECT_EQ(walkers, many(20));
    EXPECT_GT(grounded, frames / 2);
    EXPECT_GT(blocked, 20);
    EXPECT_GT(gone, 5 * walkers);
}

/// Wherever a person is put, the answer is a place; and where it has no room, it does not pass.
TEST_F(WalkerInPlant, StartsAnywhere) {
    Random random(6512);
    int overlapping = 0, squeezed = 0, free = 0;
    for (int round = 0; round < many(300); ++round) {
        // At a random part's surface, where most starts overlap something.
        const HitPart hit = walk_->first_hit({some_point(random), random.direction()});
        if (!hit.meet)
            continue;
        Walker walker(*walk_, hit.point - Vec3{0, random.uniform(0, 1.8), 0},
                      in_plant(WalkerMode::walk));
        overlapping += overlaps(walker) ? 1 : 0;
        const Vec3 velocity = random.uniform(0, 3) * random.direction();
        for (int i = 0; i < 5; ++i) {
            const WalkerState& state = walker.step(velocity, 0.1);
            ASSERT_TRUE(is_finite(state.feet));
            ASSERT_TRUE(state.squeezed || !overlaps(walker));
        }
        squeezed += walker.state().squeezed ? 1 : 0;
        free += walker.state().squeezed ? 0 : 1;
    }
    std::cout << overlapping << " overlap, " << free << " free, " << squeezed << " squeezed\n";
    EXPECT_GT(overlapping, free / 4);
    EXPECT_GT(free, squeezed / 2);
    EXPECT_GT(squeezed, 0);
}

} // namespace
} // namespace abut::test
