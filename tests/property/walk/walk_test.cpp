// A walk through a store answers what all parts in memory would: on any path, in little memory,
// while parts come, move and go.

#include <abut/error.h>
#include <abut/scene.h>
#include <abut/walk.h>

#include "rigid/model/solid.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/walk_scenes.h"
#include "walk/loose_boxes.h"
#include "walker.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace abut::test {
namespace {

class WalkScript {
public:
    WalkScript(Random& random, const std::string& path, Walk& walk)
        : random_(random), walk_(walk), known_(parts_of(path)) {}

    void run(int steps) {
        for (int step = 0; step < steps; ++step) {
            advance();
            if (random_.chance(0.3))
                change();
            for (int query = random_.integer(0, 3); query > 0; --query)
                ask();
        }
    }

    std::size_t asked = 0, touched = 0, incomplete = 0, changes = 0;

private:
    void advance() {
        if (random_.chance(0.1)) {
            position_ = {random_.uniform(-kSceneReach, kSceneReach), random_.uniform(-1, 1),
                         random_.uniform(-kSceneReach, kSceneReach)};
            velocity_ = {};
        } else {
            velocity_ = 0.9 * velocity_ + random_.in_cube(0.02);
            position_ = position_ + velocity_;
        }
        if (random_.chance(0.5))
            walk_.move_to(position_);
        else
            walk_.move_to(position_, 60 * velocity_);
        if (random_.chance(0.1))
            walk_.wait();
    }

    std::map<WalkPart, KnownPart>::iterator any() {
        return std::next(known_.begin(), random_.integer(0, int(known_.size()) - 1));
    }
    void change() {
        ++changes;
        const double choice = random_.uniform(0, 1);
        if (choice < 0.3 || known_.size() < 5) {
            const Model model(some_body(random_));
            const Transform world = some_place(random_);
            const WalkPart part = walk_.add(model, world);
            EXPECT_LT(part.number, 0);
            EXPECT_TRUE(known_.emplace(part, KnownPart{model, world}).second);
        } else if (choice < 0.8) {
            const auto part = any();
            Transform world = part->second.world;
            if (random_.chance(0.5))
                world = some_place(random_);
            else // a small step
                world.m[9] += random_.uniform(-0.1, 0.1);
            walk_.move(part->first, world);
            part->second.world = world;
            EXPECT_EQ(walk_.world_from_part(part->first), world);
        } else {
            const auto part = any();
            walk_.remove(part->first);
            EXPECT_THROW(walk_.move(part->first, Transform()), Error);
            EXPECT_THROW(walk_.remove(part->first), Error);
            known_.erase(part);
        }
    }

    void ask() {
        const SomeProbe probe =
            some_probe(random_, random_.chance(0.9) ? position_ : random_.in_cube(kSceneReach));
        WalkQuery query;
        if (random_.chance(0.2))
            query.missing = MissingParts::skip;
        ++asked;
        switch (random_.integer(0, 3)) {
        case 0:
            return ask_distance(probe, query);
        case 1:
            return ask_within(probe, query);
        case 2:
            return ask_collide(probe, query);
        default:
            return ask_contacts(probe, query);
        }
    }

    void ask_distance(const SomeProbe& probe, WalkQuery query) {
        if (random_.chance(0.3))
            query.upper_bound = random_.uniform(0, 1);
        WalkPart nearest;
        double distance = query.upper_bound;
        bool found = false;
        for (const auto& [part, known] : known_)
            if (const BodyGap gap = gap_of(known, probe, Depths::no); gap.distance < distance) {
                nearest = part, distance = gap.distance;
                found = true;
            }
        const NearestPart answer = walk_.distance(probe.probe, probe.world, query);
        touched += distance <= 0 ? 1 : 0;
        if (!answer.complete) {
            ++incomplete;
            EXPECT_LE(answer.at_least, distance);
            EXPECT_TRUE(!answer.found || answer.gap.distance >= distance);
            return;
        }
        ASSERT_EQ(answer.found, found);
        EXPECT_EQ(answer.at_least, found ? answer.gap.distance : query.upper_bound);
        if (!found)
            return;
        ASSERT_EQ(answer.gap.part.number, nearest.number);
        expect_gap(answer.gap, gap_of(known_.at(nearest), probe, Depths::no), known_.at(nearest));
    }

    void ask_within(const SomeProbe& probe, const WalkQuery& query) {
        const double tolerance = random_.chance(0.2) ? 0 : random_.uniform(0, 1);
        std::map<WalkPart, BodyGap> truth;
        for (const auto& [part, known] : known_)
            if (const BodyGap gap = gap_of(known, probe, Depths::no); gap.distance <= tolerance)
                truth.emplace(part, gap);
        const NearParts answer = walk_.within(probe.probe, probe.world, tolerance, query);
        expect_parts(answer, truth);
    }

    void ask_contacts(const SomeProbe& probe, const WalkQuery& query) {
        std::map<WalkPart, BodyGap> truth;
        for (const auto& [part, known] : known_)
            if (touches(known, probe)) {
                BodyGap gap = gap_of(known, probe, known.is_cut ? Depths::no : Depths::yes);
                if (known.is_cut)
                    gap.status = Status::bound_only;
                truth.emplace(part, gap);
            }
        expect_parts(walk_.penetration(probe.probe, probe.world, query), truth);
        touched += truth.empty() ? 0 : 1;
    }

    void ask_collide(const SomeProbe& probe, WalkQuery query) {
        std::vector<WalkPart> truth;
        for (const auto& [part, known] : known_)
            if (touches(known, probe))
                truth.push_back(part);
        if (random_.chance(0.3))
            query.mode = ContactMode::first;
        const TouchedParts answer = walk_.collide(probe.probe, probe.world, query);
        touched += truth.empty() ? 0 : 1;
        if (query.mode == ContactMode::all && answer.complete) {
            EXPECT_EQ(answer.parts, truth);
            return;
        }
        EXPECT_TRUE(
            std::includes(truth.begin(), truth.end(), answer.parts.begin(), answer.parts.end()));
        EXPECT_TRUE(!answer.complete || answer.parts.empty() == truth.empty());
        incomplete += answer.complete ? 0 : 1;
    }

    void expect_parts(const NearParts& answer, const std::map<WalkPart, BodyGap>& truth) {
        EXPECT_TRUE(
            std::is_sorted(answer.parts.begin(), answer.parts.end(),
                           [](const WalkGap& a, const WalkGap& b) { return a.part < b.part; }));
        EXPECT_TRUE(!answer.complete || answer.parts.size() == truth.size());
        incomplete += answer.complete ? 0 : 1;
        for (const WalkGap& gap : answer.parts) {
            const auto found = truth.find(gap.part);
            ASSERT_NE(found, truth.end());
            // A block of a cut part may have been skipped.
            if (answer.complete)
                expect_gap(gap, found->second, known_.at(gap.part));
        }
    }

    static void expect_gap(const WalkGap& gap, const BodyGap& truth, const KnownPart& part) {
        EXPECT_EQ(gap.status, truth.status);
        if (part.is_cut) { // of several equally near triangles, another may be found
            EXPECT_NEAR(gap.distance, truth.distance, 1e-12);
            return;
        }
        EXPECT_EQ(gap.distance, truth.distance);
        if (truth.distance > 0) {
            EXPECT_NEAR(length(gap.point_part - gap.point_probe), gap.distance, 1e-9);
        }
    }

    static BodyGap gap_of(const KnownPart& part, const SomeProbe& probe, Depths depths) {
        return test::gap_of(part, probe.probe, probe.world, depths);
    }
    static bool touches(const KnownPart& part, const SomeProbe& probe) {
        return test::touches(part, probe.probe, probe.world);
    }

    Random& random_;
    Walk& walk_;
    std::map<WalkPart, KnownPart> known_;
    Vec3 position_, velocity_;
};

/// One to eight times the least power of two of memory that a walk accepts, plus room for changes.
std::uint64_t some_memory(Random& random, const Store& store) {
    std::uint64_t memory = 1 << 15;
    for (;; memory *= 2) {
        try {
            const Walk walk(store, {.memory = memory, .prefetch = false});
            break;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument) << error.what();
        }
    }
    constexpr std::uint64_t kForChanges = 1 << 16; // parts that are added or moved
    return (memory << random.integer(0, 3)) + kForChanges;
}

TEST(Walk, EqualsQueriesWithAllPartsInMemory) {
    Random random(6301);
    std::size_t asked = 0, touched = 0, incomplete = 0, changes = 0;
    std::uint64_t lookups = 0, misses = 0, evicted = 0, read_ahead = 0;
    for (int round = 0; round < many(9); ++round) {
        const Folder folder;
        const std::string path = some_store(random, folder, round % 3 == 0);
        const Store store = open_store(path);
        WalkOptions options;
        options.memory = some_memory(random, store);
        options.prefetch = random.chance(0.8);
        Walk walk(store, options);
        WalkScript script(random, path, walk);
        script.run(120);
        const WalkStatistics found = walk.statistics();
        EXPECT_LE(found.peak_bytes, options.memory);
        EXPECT_LE(found.misses, found.lookups);
        asked += script.asked, touched += script.touched, incomplete += script.incomplete;
        changes += script.changes;
        lookups += found.lookups, misses += found.misses, evicted += found.evicted;
        read_ahead += found.read_ahead;
    }
    std::cout << asked << " questions, " << touched << " touch, " << incomplete << " incomplete, "
              << changes << " changes; " << lookups << " lookups, " << misses << " misses, "
              << evicted << " evicted, " << read_ahead << " read ahead\n";
    EXPECT_GT(touched, asked / 8);
    EXPECT_LT(touched, asked * 7 / 8);
    EXPECT_GT(misses, 10U);
    EXPECT_LT(misses, lookups * 3 / 4);
    EXPECT_GT(evicted, 10U);
    EXPECT_GT(read_ahead, 20U);
}

TEST(Walk, ASolidTakesNoMoreMemoryThanCounted) {
    Random random(6302);
    for (int round = 0; round < many(200); ++round) {
        const Mesh mesh = random.chance(0.1) ? soup_mesh(random, 500, 1, 0.2) : some_body(random);
        const Solid solid = examine_solid(mesh);
        const std::size_t bytes =
            solid.topology.vertex_of.capacity() * sizeof(solid.topology.vertex_of[0]) +
            solid.topology.half_edges.capacity() * sizeof(solid.topology.half_edges[0]) +
            solid.components.capacity() * sizeof(solid.components[0]);
        ASSERT_LE(bytes, most_solid_bytes(mesh.triangles.size(), mesh.positions.size()));
    }
}

/// A tree of boxes that come and go finds the boxes in reach, nearest first, and leaves none out.
TEST(LooseBoxes, AreFoundNearestFirst) {
    Random random(6303);
    std::size_t found = 0, asked = 0;
    for (int round = 0; round < many(30); ++round) {
        LooseBoxes loose;
        std::map<std::uint32_t, Aabb> truth;
        const auto some_box = [&] {
            const Vec3 at = random.in_cube(5), half = random.in_cube(0.5);
            if (random.chance(0.05))
                return Aabb();
            return Aabb({min(at - half, at + half), max(at - half, at + half)});
        };
        for (int step = 0; step < 100; ++step) {
            for (int change = random.integer(0, 20); change > 0; --change) {
                const auto entry = static_cast<std::uint32_t>(random.integer(0, 300));
                if (random.chance(0.2)) {
                    loose.erase(entry);
                    truth.erase(entry);
                } else {
                    truth[entry] = some_box();
                    loose.put(entry, truth[entry]);
                }
            }
            ASSERT_EQ(loose.size(), truth.size());
            const Aabb query = some_box();
            const float limit = static_cast<float>(random.uniform(0, 9));
            std::set<std::uint32_t> wanted;
            for (const auto& [entry, box] : truth) {
                double sq = 0;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    sq += std::pow(std::max({0.0, double{box.lower[axis]} - query.upper[axis],
                                             double{query.lower[axis]} - box.upper[axis]}),
                                   2);
                if (sq <= limit)
                    wanted.insert(entry);
            }
            NearestLanes lanes(loose.tree(), GapToBox{query});
            lanes.set_limit(limit);
            float last = 0;
            while (const auto lane = lanes.next()) {
                ASSERT_GE(lane->key, last);
                last = lane->key;
                wanted.erase(loose.entry(lane->lane));
                ++found;
            }
            ASSERT_TRUE(wanted.empty());
            asked += truth.size();
        }
    }
    std::cout << found << " of " << asked << " boxes in reach\n";
    EXPECT_GT(found, asked / 100);
    EXPECT_LT(found, asked / 2);
}

/// The walker of the examples goes around obstacles, never through them.
TEST(Walker, DoesNotGoThroughWalls) {
    Random random(6304);
    int arrived = 0, slid = 0;
    for (int round = 0; round < many(10); ++round) {
        const Folder folder;
        Scene scene;
        scene.meshes = {sphere_mesh(0.5, 24, 12)};
        for (int i = 0; i < 8; ++i)
            scene.parts.push_back({"ball" + std::to_string(i), "", "", 0,
                                   translation(random.uniform(1, 9), random.uniform(-0.5, 0.5),
                                               random.uniform(-4, 4))});
        write_glb(scene, folder / "balls.glb");
        (void)import_models({folder / "balls.glb"}, folder / "balls.abut");
        Walk walk(open_store(folder / "balls.abut"), {.memory = std::uint64_t{1} << 20});
        const walker::Settings settings;
        walker::Walker walker(walk, {-1, 0, 0}, settings);
        const Vec3 goal{11, 0, 0.01};
        bool slides = false;
        for (int frame = 0; frame < 1200 && length(goal - walker.position()) > 0.01; ++frame) {
            const Vec3 before = walker.position();
            const walker::Frame after = walker.step_towards(goal);
            ASSERT_TRUE(after.nearest.found);
            EXPECT_GT(after.nearest.gap.distance, 0);
            EXPECT_LE(length(after.position - before), settings.speed * settings.frame * 1.001);
            slides = slides || after.nearest.gap.distance < settings.skin;
        }
        arrived += length(goal - walker.position()) <= 0.01 ? 1 : 0;
        slid += slides ? 1 : 0;
    }
    std::cout << arrived << " arrived, " << slid << " slid along something\n";
    EXPECT_GT(slid, 0);
    EXPECT_GT(arrived, 0);
}

} // namespace
} // namespace abut::test
