// A part in the hand: never through another, with true contacts and clearances.

#include <abut/carry.h>
#include <abut/error.h>

#include "tests/support/rounds.h"
#include "tests/support/walk_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace abut::test {
namespace {

/// Random ways of random parts in all modes.
TEST(Carry, IsStoppedByAllPartsAndSeesThoseNear) {
    Random random(6531);
    int moves = 0, blocked = 0, arrived = 0, slid = 0, touching = 0;
    for (int round = 0; round < many(6); ++round) {
        const Folder folder;
        const std::string path = some_store(random, folder, false);
        Walk walk(open_store(path), {.prefetch = false});
        const auto known = parts_of(path);
        for (int i = 0; i < 6; ++i) {
            const WalkPart part = std::next(known.begin(), random.integer(0, 40))->first;
            Carry carry(walk, part);
            std::set<WalkPart> held;
            for (const WalkPart other : walk.collide(part).parts)
                held.insert(other);
            CarryOptions options;
            options.mode = random.chance(0.5) ? CarryMode::stop : CarryMode::slide;
            for (int k = 0; k < 6; ++k, ++moves) {
                Pose goal = random.pose(0);
                if (random.chance(0.5))
                    goal.rotation = carry.state().pose.rotation;
                goal.translation = carry.state().pose.translation + random.in_cube(1);
                const Vec3 before = carry.state().pose.translation;
                const CarryStep& step = carry.move_to(goal, options);
                ASSERT_TRUE(step.complete);
                ASSERT_EQ(walk.world_from_part(part), carry.carried().world_from_part(step.pose));
                ASSERT_EQ(step.blocked, !step.contacts.empty());
                // It touches nothing but what held it from the start.
                const TouchedParts now = walk.collide(carry.probe(), step.pose, {.except = part});
                for (const WalkPart other : now.parts)
                    ASSERT_TRUE(held.contains(other));
                std::set<WalkPart> still;
                for (const WalkPart other : now.parts)
                    still.insert(other);
                ASSERT_EQ(step.touched.size(), still.size());
                held = still;
                touching += still.empty() ? 0 : 1;
                for (const WalkGap& gap : step.near) {
                    ASSERT_GT(gap.distance, 0);
                    ASSERT_LE(gap.distance, options.clearance);
                }
                blocked += step.blocked ? 1 : 0;
                arrived += step.pose.translation == goal.translation ? 1 : 0;
                slid += step.blocked && length(step.pose.translation - before) > 0.01 ? 1 : 0;
            }
        }
    }
    std::cout << moves << " moves, " << arrived << " arrived, " << blocked << " blocked, " << slid
              << " of these moved, " << touching << " touch\n";
    EXPECT_GT(blocked, moves / 10);
    EXPECT_GT(arrived, moves / 10);
    EXPECT_GT(slid, blocked / 10);
}

/// Depths in few steps are at most those without a limit, and say so.
TEST(Carry, BoundsTheStepsOfDepths) {
    Random random(6533);
    int complete = 0, limited = 0;
    for (int round = 0; round < many(4); ++round) {
        const Folder folder;
        const std::string path = some_store(random, folder, false);
        Walk walk(open_store(path), {.prefetch = false});
        const auto known = parts_of(path);
        for (int i = 0; i < 25; ++i) {
            const WalkPart part = std::next(known.begin(), random.integer(0, 40))->first;
            const Transform place(random.pose(2));
            WalkQuery query;
            query.except = part;
            const Probe probe(walk.model(part));
            const NearParts all = walk.penetration(probe, place, query);
            query.max_steps = static_cast<std::uint64_t>(std::pow(10, random.uniform(0, 4)));
            const NearParts few = walk.penetration(probe, place, query);
            ASSERT_EQ(few.parts.size(), all.parts.size());
            for (std::size_t k = 0; k < all.parts.size(); ++k) {
                const WalkGap &exact = all.parts[k], &found = few.parts[k];
                ASSERT_EQ(found.part, exact.part);
                ASSERT_LE(found.distance, 0);
                if (found.distance == exact.distance) {
                    ++complete;
                    continue;
                }
                ASSERT_EQ(found.status, Status::bound_only);
                // A depth is within a hundredth, so a search with less work may find a little more.
                ASSERT_GE(found.distance, 1.02 * exact.distance);
                ++limited;
            }
        }
    }
    std::cout << complete << " depths complete, " << limited << " limited\n";
    EXPECT_GT(complete, 10);
    EXPECT_GT(limited, 10);
}

class CarryByHand : public testing::Test {
protected:
    Store import_room() {
        Scene scene;
        scene.meshes = {box_mesh({-1, -1, -1}, {1, 1, 1}), box_mesh({5, -9, -9}, {6, 9, 9})};
        scene.parts = {{"box", "Box", "", 0, translation(0, 0, 0)}, {"wall", "Wall", "", 1, {}}};
        write_glb(scene, folder_ / "room.glb");
        (void)import_models({folder_ / "room.glb"}, folder_ / "room.abut");
        return open_store(folder_ / "room.abut");
    }
    Folder folder_;
    Walk walk_{import_room(), {.prefetch = false}};
    const WalkPart box_{1}, wall_{2};
};

TEST_F(CarryByHand, StopsSlidesAndGoesThrough) {
    Carry carry(walk_, box_);
    CarryStep step = carry.move_to(Pose{{8, 4, 0}});
    EXPECT_TRUE(step.blocked);
    EXPECT_NEAR(step.pose.translation.x, 4, 3e-3);
    EXPECT_LT(step.pose.translation.x, 4);
    EXPECT_NEAR(step.pose.translation.y, 2, 3e-3);
    ASSERT_EQ(step.contacts.size(), 1U);
    EXPECT_EQ(step.contacts[0].part, wall_);
    EXPECT_NEAR(step.contacts[0].normal.x, -1, 1e-9);
    ASSERT_EQ(step.near.size(), 1U);
    EXPECT_EQ(step.near[0].part, wall_);

    step = carry.move_to(Pose{{8, 4, 0}}, {.mode = CarryMode::slide});
    EXPECT_NEAR(step.pose.translation.y, 4, 1e-9);
    EXPECT_LT(step.pose.translation.x, 4);

    step = carry.move_to(Pose{{4.25, 4, 0}}, {.mode = CarryMode::through});
    EXPECT_FALSE(step.blocked);
    ASSERT_EQ(step.touched.size(), 1U);
    EXPECT_EQ(step.touched[0].part, wall_);
    EXPECT_NEAR(step.touched[0].distance, -0.25, 1e-9);
    EXPECT_NEAR(step.touched[0].normal.x, -1, 1e-9); // the way out
    EXPECT_EQ(walk_.collide(box_).parts, std::vector{wall_});

    // Out again on the way out; from then on the wall stops it.
    step = carry.move_to(Pose{{3, 4, 0}});
    EXPECT_FALSE(step.blocked);
    EXPECT_EQ(step.pose.translation.x, 3);
    EXPECT_TRUE(carry.move_to(Pose{{9, 4, 0}}).blocked);

    EXPECT_THROW(carry.move_to(Pose{{std::nan(""), 0, 0}}), Error);
    walk_.remove(box_);
    EXPECT_THROW(carry.move_to(Pose{}), Error);
}

TEST_F(CarryByHand, TurnsUntilItMeetsSomething) {
    Carry carry(walk_, box_);
    const Pose near_wall{{3.9, 0, 0}}; // its corner reaches 1.414 when it turns
    EXPECT_FALSE(carry.move_to(near_wall).blocked);
    const double half = 0.3926990816987241;
    const CarryStep step = carry.move_to({{3.9, 0, 0}, {std::cos(half), 0, 0, std::sin(half)}});
    EXPECT_TRUE(step.blocked);
    const double angle = 2 * std::atan2(step.pose.rotation[3], step.pose.rotation[0]);
    // Touches where sqrt(2) cos(45 degrees - angle) = 1.1.
    EXPECT_NEAR(angle, 0.7853981633974483 - std::acos(1.1 / std::sqrt(2.0)), 5e-3);
}

} // namespace
} // namespace abut::test
