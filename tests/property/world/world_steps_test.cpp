// The lists of pairs after every kind of query, against all pairs, and the room that bodies take
// that come and go.

#include <abut/error.h>
#include <abut/progress.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/world_script.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace abut::test {
namespace {

/// A query of a world, whose answer does not matter here.
struct NamedQuery {
    const char* name;
    std::function<void(World&)> ask;
};

/// Every query. Those of a body name the one with the given id.
std::vector<NamedQuery> every_query(BodyId body, BodyId other) {
    return {
        {"collide", [](World& world) { world.collide(); }},
        {"penetration", [](World& world) { world.penetration(); }},
        {"within 0", [](World& world) { world.within(0); }},
        {"within", [](World& world) { world.within(0.1); }},
        {"contacts", [](World& world) { world.contact_manifolds(); }},
        {"contacts with a margin", [](World& world) { world.contact_manifolds(0.1); }},
        {"time_of_impact",
         [body](World& world) {
             world.time_of_impact({{body, {Pose{}, {}, {1, 0, 0}, {}}}});
         }},
        {"time_of_impact of none", [](World& world) { world.time_of_impact({}); }},
        {"advance", [](World& world) { world.advance(0.01); }},
        {"advance by nothing", [](World& world) { world.advance(0); }},
        {"next_event", [](World& world) { static_cast<void>(world.next_event()); }},
        {"time_to_collision", [](World& world) { static_cast<void>(world.time_to_collision(1)); }},
        {"time_to_collision of two",
         [body, other](World& world) { static_cast<void>(world.time_to_collision(body, other)); }}};
}

TEST(WorldSteps, EveryQueryUpdatesTheListsOfPairsFirst) {
    Random random(5301);
    std::size_t begun = 0, ended = 0, stayed = 0;
    for (int round = 0; round < many(3); ++round) {
        const std::size_t queries = every_query({}, {}).size();
        for (std::size_t number = 0; number < queries; ++number) {
            World world({static_cast<BroadPhaseMethod>(random.integer(0, 3)), {}});
            WorldScript<Random> script(random, world, {0, true});
            // Two bodies that every query may name. They lie far from all others.
            const BodyId first = world.add(Sphere{{5000, 0, 0}, 1}, {}),
                         second = world.add(Sphere{{7000, 0, 0}, 1}, {});
            const NamedQuery query = every_query(first, second)[number];
            SCOPED_TRACE(query.name);
            BodyPairs last;
            for (int step = 0; step < 12; ++step) {
                script.step();
                script.add(); // a step of a script may change nothing
                query.ask(world);
                const BodyPairs now = pairs_of_boxes(script, world);
                ASSERT_EQ(world.pairs(), now);
                ASSERT_EQ(world.begun(), without(now, last));
                ASSERT_EQ(world.ended(), without(last, now));
                begun += world.begun().size(), ended += world.ended().size();
                stayed += now.size() - world.begun().size();
                // Further queries of bodies that stay belong to the same update.
                const BodyPairs of_begun = world.begun(), of_ended = world.ended();
                for (const NamedQuery& further : every_query(first, second))
                    if (random.chance(0.2)) {
                        further.ask(world);
                        ASSERT_EQ(world.pairs(), now) << further.name;
                        ASSERT_EQ(world.begun(), of_begun) << further.name;
                        ASSERT_EQ(world.ended(), of_ended) << further.name;
                    }
                last = now;
            }
        }
    }
    EXPECT_GT(begun, 300U);
    EXPECT_GT(ended, 300U);
    EXPECT_GT(stayed, 300U);
}

TEST(WorldSteps, AnUpdateAndAMoveToTheSamePlaceBeginANewStep) {
    for (std::size_t number = 0; number < every_query({}, {}).size(); ++number) {
        World world;
        const BodyId a = world.add(Sphere{{}, 1}, {}), b = world.add(Sphere{{1, 0, 0}, 1}, {});
        const NamedQuery query = every_query(a, b)[number];
        SCOPED_TRACE(query.name);
        query.ask(world);
        EXPECT_EQ(world.begun().size(), 1U);
        query.ask(world);
        EXPECT_EQ(world.begun().size(), 1U);
        world.update();
        EXPECT_EQ(world.begun().size(), 0U);
        world.remove(b);
        EXPECT_EQ(world.pairs().size(), 1U); // as of the last update
        EXPECT_EQ(world.ended().size(), 0U);
        const BodyId c = world.add(Sphere{{1, 0, 0}, 1}, {});
        every_query(a, c)[number].ask(world);
        EXPECT_EQ(world.ended(), (BodyPairs{{a, b}}));
        EXPECT_EQ(world.begun(), (BodyPairs{{a, c}}));
        EXPECT_EQ(world.pairs(), (BodyPairs{{a, c}}));
        world.move(a, {});
        every_query(a, c)[number].ask(world);
        EXPECT_EQ(world.ended().size() + world.begun().size(), 0U);
        EXPECT_EQ(world.pairs(), (BodyPairs{{a, c}}));
    }
}

TEST(WorldSteps, RefusedArgumentsBeginNoStep) {
    World world;
    const BodyId a = world.add(Sphere{{}, 1}, {});
    world.update();
    const BodyId b = world.add(Sphere{{1, 0, 0}, 1}, {});
    const std::array<std::function<void()>, 7> refused{
        [&] { world.within(-1); },
        [&] { world.contact_manifolds(-1); },
        [&] {
            world.time_of_impact({{{99, 0}, {}}});
        },
        [&] {
            world.time_of_impact({{a, {}}, {a, {}}});
        },
        [&] { world.advance(-1); },
        [&] { static_cast<void>(world.time_to_collision(-1)); },
        [&] { static_cast<void>(world.time_to_collision(b, b)); }};
    for (const auto& call : refused)
        EXPECT_THROW(call(), Error);
    EXPECT_TRUE(world.pairs().empty());
    EXPECT_EQ(world.collide().size(), 1U);
}

/// Lets one body after the other come, be asked about and go. Returns the largest index of a body.
std::uint32_t largest_index(World& world, BodyId stays, const NamedQuery* query, int bodies,
                            Random& random) {
    std::uint32_t largest = 0;
    for (int i = 0; i < bodies; ++i) {
        const BodyId body = world.add(Sphere{random.in_cube(1), 0.5}, {});
        largest = std::max(largest, body.index);
        if (query != nullptr)
            for (const NamedQuery& each : every_query(body, stays))
                if (std::string(each.name) == query->name)
                    each.ask(world);
        world.remove(body);
    }
    return largest;
}

TEST(WorldSteps, BodiesThatComeAndGoTakeNoMoreRoomWhateverIsAsked) {
    Random random(5302);
    constexpr int kBodies = 300;
    std::vector<NamedQuery> queries = every_query({}, {});
    for (const NamedQuery& query : queries) {
        SCOPED_TRACE(query.name);
        World world;
        const BodyId stays = world.add(Sphere{{50, 0, 0}, 0.5}, {});
        // A removed body's place is free two updates later.
        EXPECT_LE(largest_index(world, stays, &query, kBodies, random), 4U);
        EXPECT_EQ(world.size(), 1U);
        EXPECT_TRUE(world.pairs().empty());
    }
    World world;
    const BodyId stays = world.add(Sphere{{50, 0, 0}, 0.5}, {});
    EXPECT_LE(largest_index(world, stays, nullptr, kBodies, random), 1U); // nothing is asked
}

/// Asks in several ways, and returns the answers in numbers.
std::vector<double> all_answers_of(World& world) {
    std::vector<double> numbers;
    for (const BodyPair& pair : world.collide())
        numbers.push_back(pair.a.index), numbers.push_back(pair.b.index);
    for (const BodyGap& gap : world.penetration())
        numbers.insert(numbers.end(), {gap.distance, gap.normal.x, gap.normal.y, gap.normal.z});
    for (const double margin : {0.0, 0.05})
        for (const ContactManifold& each : world.contact_manifolds(margin))
            for (std::uint32_t i = 0; i < each.count; ++i)
                numbers.insert(numbers.end(), {each.points[i].depth, each.points[i].point_a.x,
                                               each.points[i].point_b.z});
    return numbers;
}

/// A body takes the place of one that was removed, and the two overlap the same bodies. Nothing that
/// was remembered of the first may count for the second.
TEST(WorldSteps, ABodyInAFormerPlaceIsAskedAboutAnew) {
    Random random(5303);
    std::size_t replaced = 0;
    for (int round = 0; round < many(60); ++round) {
        World world, fresh;
        const Pose pose = random.pose(0.2);
        const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
        const Convex block(corners);
        const Model model(tetrahedron(1));
        const auto add = [&](World& to, int kind, const Pose& at) {
            switch (kind) {
            case 0:
                return to.add(block, at);
            case 1:
                return to.add(model, at);
            case 2:
                return to.add(Box3{{-0.3, -0.2, -0.4}, {0.3, 0.2, 0.4}}, at);
            default:
                return to.add(Cylinder{{{0, 0, -0.5}, {0, 0, 0.5}}, 0.3}, at);
            }
        };
        const int kind = random.integer(0, 3), other = random.integer(0, 3);
        const Pose at = random.pose(0.5);
        add(world, kind, pose), add(fresh, kind, pose);
        const BodyId gone = add(world, random.integer(0, 3), random.pose(0.3));
        all_answers_of(world);
        world.remove(gone);
        // The place becomes free without a query that asks about the pair, or with one.
        for (int i = 0; i < 2; ++i) {
            world.update();
            if (random.chance(0.3))
                static_cast<void>(world.collide());
        }
        const BodyId next = add(world, other, at);
        add(fresh, other, at);
        replaced += next.index == gone.index ? 1 : 0;
        EXPECT_EQ(all_answers_of(world), all_answers_of(fresh));
    }
    EXPECT_EQ(replaced, std::size_t(many(60)));
}

} // namespace
} // namespace abut::test
