// Rays and moving probes in a walk, against all parts in memory: rays exactly, motions by dense
// sampling.

#include <abut/error.h>
#include <abut/shape_queries.h>
#include <abut/walk.h>

#include "rigid/motion/trajectory.h"
#include "tests/support/rounds.h"
#include "tests/support/walk_scenes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

using KnownParts = std::map<WalkPart, KnownPart>;

/// Moves, adds and removes some parts.
void change_some(Random& random, Walk& walk, KnownParts& known) {
    for (int i = 0; i < 10; ++i) {
        const auto part = std::next(known.begin(), random.integer(0, int(known.size()) - 1));
        if (random.chance(0.3)) {
            const Model model(some_body(random));
            const Transform world = some_place(random);
            known.emplace(walk.add(model, world), KnownPart{model, world});
        } else if (random.chance(0.8)) {
            part->second.world = some_place(random);
            walk.move(part->first, part->second.world);
        } else {
            walk.remove(part->first);
            known.erase(part);
        }
    }
}

Ray some_ray(Random& random) {
    Ray ray{random.in_cube(kSceneReach), random.uniform(0.01, 10) * random.direction()};
    ray.origin.y *= 0.3;
    if (random.chance(0.2))
        ray.direction = {random.chance(0.5) ? 1.0 : -1.0, 0, 0};
    if (random.chance(0.2))
        ray.t_min = random.chance(0.5) ? -HUGE_VAL : random.uniform(-2, 2);
    if (random.chance(0.2))
        ray.t_max = random.uniform(-1, 5);
    return ray;
}

TEST(WalkMotion, FirstHitsEqualThoseOfAllParts) {
    Random random(6501);
    int hits = 0, rays = 0, incomplete = 0;
    for (int round = 0; round < many(4); ++round) {
        const Folder folder;
        const std::string path = some_store(random, folder, round % 2 == 0);
        Walk walk(open_store(path), {.memory = std::uint64_t{64} << 20, .prefetch = false});
        KnownParts known = parts_of(path);
        change_some(random, walk, known);
        for (int i = 0; i < 200; ++i, ++rays) {
            const Ray ray = some_ray(random);
            RayHit truth;
            WalkPart part;
            for (const auto& [number, one] : known) {
                const RayHit hit = first_hit(std::get<Model>(one.shape), one.world, ray);
                if (hit.meet && (!truth.meet || hit.t < truth.t))
                    truth = hit, part = number;
            }
            const bool skips = random.chance(0.2);
            const HitPart answer =
                walk.first_hit(ray, {.missing = skips ? MissingParts::skip : MissingParts::wait});
            if (!answer.complete) {
                ++incomplete;
                ASSERT_TRUE(skips);
                ASSERT_LE(answer.at_least, truth.t);
                continue;
            }
            ASSERT_EQ(answer.meet, truth.meet);
            ASSERT_EQ(answer.at_least, answer.t);
            if (!truth.meet)
                continue;
            ++hits;
            ASSERT_EQ(answer.part.number, part.number);
            ASSERT_EQ(answer.t, truth.t);
            ASSERT_EQ(answer.triangle, truth.triangle);
            ASSERT_EQ(answer.side, truth.side);
            ASSERT_EQ(answer.point, truth.point);
        }
    }
    std::cout << hits << " of " << rays << " rays hit, " << incomplete << " incomplete\n";
    EXPECT_GT(hits, rays / 5);
    EXPECT_LT(hits, rays);
    EXPECT_GT(incomplete, 0);
}

/// The random way of a probe, and its place at any time.
struct SomeWay {
    SomeProbe probe;
    Motion motion;
    bool is_straight = false;
    Trajectory trajectory;

    [[nodiscard]] Transform at(double t) const { return trajectory.at(t); }
};

SomeWay some_way(Random& random) {
    const Vec3 start{random.uniform(-kSceneReach, kSceneReach), random.uniform(-4, 4),
                     random.uniform(-kSceneReach, kSceneReach)};
    Pose pose = random.pose(0);
    pose.translation = start;
    const SomeProbe probe = some_probe(random, {});
    Motion motion = Motion::fixed(pose);
    motion.velocity = random.uniform(0.1, random.chance(0.2) ? 10 : 3) * random.direction();
    if (random.chance(0.7) && motion.velocity.y * start.y > 0) // towards the parts
        motion.velocity.y = -motion.velocity.y;
    const bool is_straight = random.chance(0.5);
    if (!is_straight) {
        motion.angular_velocity = random.uniform(0.1, 4) * random.direction();
        motion.centre = start + random.in_cube(random.chance(0.5) ? 0.2 : 2);
    }
    return {{probe.probe, pose}, motion, is_straight, Trajectory(motion)};
}

FirstContact ask(Walk& walk, const SomeWay& way, const WalkQuery& query) {
    return way.is_straight ? walk.sweep(way.probe.probe, way.at(0), way.motion.velocity, query)
                           : walk.time_of_impact(way.probe.probe, way.motion, query);
}

constexpr double kAllowed = 1e-5;

/// The first sample in which each part touches the probe.
std::map<WalkPart, double> sampled(const KnownParts& known, const SomeWay& way, double until) {
    constexpr int kSamples = 30;
    std::map<WalkPart, double> found;
    for (int i = 0; i <= kSamples; ++i) {
        const double t = until * i / kSamples;
        const Transform world = way.at(t);
        const Box3 box = grown(
            bounds_of(way.probe.probe.data().shape(), way.probe.probe.data().own_bounds(), world),
            1e-9);
        for (const auto& [number, part] : known)
            if (!found.contains(number) &&
                overlap(box, placed_bounds(bounds_of(part.shape), part.world)) &&
                touches(part, way.probe.probe, world))
                found.emplace(number, t);
    }
    return found;
}

void expect_tight(const PartImpact& impact, const KnownParts& known, const SomeWay& way) {
    const KnownPart& part = known.at(impact.part);
    const BodyGap gap = gap_of(part, way.probe.probe, way.at(impact.time), Depths::no);
    EXPECT_LE(gap.distance, kAllowed + 1e-9);
    EXPECT_NE(impact.status, Status::bound_only);
    if (impact.status == Status::bound_only)
        return;
    ASSERT_LE(impact.contact_time, 1);
    EXPECT_GE(impact.contact_time, impact.time);
    EXPECT_LE(gap_of(part, way.probe.probe, way.at(impact.contact_time), Depths::no).distance,
              1e-12);
}

TEST(WalkMotion, SweepsAreNeverLaterThanASampledContact) {
    Random random(6502);
    int ways = 0, met = 0, at_start = 0, in_way = 0, incomplete = 0;
    for (int round = 0; round < many(4); ++round) {
        const Folder folder;
        const std::string path = some_store(random, folder, round == 0);
        Walk walk(open_store(path), {.memory = std::uint64_t{64} << 20, .prefetch = false});
        KnownParts known = parts_of(path);
        change_some(random, walk, known);
        for (int i = 0; i < 40; ++i, ++ways) {
            const SomeWay way = some_way(random);
            WalkQuery query{.absolute_error = kAllowed};
            if (random.chance(0.3))
                query.except = std::next(known.begin(), random.integer(0, 20))->first;
            KnownParts others = known;
            others.erase(query.except);
            if (random.chance(0.2)) {
                query.missing = MissingParts::skip;
                const FirstContact partial = ask(walk, way, query);
                query.missing = MissingParts::wait;
                const FirstContact whole = ask(walk, way, query);
                incomplete += partial.complete ? 0 : 1;
                ASSERT_LE(partial.time_free, whole.time_free);
                ASSERT_TRUE(!partial.complete || partial.time_free == whole.time_free);
            }
            const FirstContact answer = ask(walk, way, query);
            ASSERT_TRUE(answer.complete);
            ASSERT_EQ(answer.time_free, answer.meet ? answer.impact.time : 1);
            const double until = answer.time_free;
            for (const auto& [part, time] : sampled(others, way, until)) {
                ASSERT_TRUE(answer.meet);
                ASSERT_GE(time, answer.time_free) << "part " << part.number;
            }
            if (answer.meet) {
                ++met;
                at_start += answer.time_free == 0 ? 1 : 0;
                expect_tight(answer.impact, others, way);
            }
            const PartsInWay all = walk.parts_in_way(way.probe.probe, way.motion, query);
            in_way += static_cast<int>(all.parts.size());
            ASSERT_EQ(all.parts.empty(), !answer.meet);
            if (answer.meet && !way.is_straight) {
                EXPECT_EQ(all.parts.front().part.number, answer.impact.part.number);
                EXPECT_EQ(all.parts.front().time, answer.impact.time);
            }
            std::map<WalkPart, double> times;
            for (const PartImpact& impact : all.parts)
                times.emplace(impact.part, impact.time);
            for (const auto& [part, time] : sampled(others, way, 1)) {
                ASSERT_TRUE(times.contains(part));
                ASSERT_LE(times.at(part), time);
            }
        }
    }
    std::cout << met << " of " << ways << " ways met something, " << at_start << " at the start, "
              << in_way << " parts in the way, " << incomplete << " incomplete\n";
    EXPECT_GT(met, ways / 5);
    EXPECT_LT(met, ways);
    EXPECT_LT(at_start, met * 3 / 4);
    EXPECT_GT(incomplete, 0);
}

/// A part as its own probe meets all other parts, wherever it was moved.
TEST(WalkMotion, MovedPartsMeetEachOther) {
    Random random(6503);
    int touched = 0, asked = 0;
    for (int round = 0; round < many(3); ++round) {
        const Folder folder;
        const std::string path = some_store(random, folder, false);
        Walk walk(open_store(path), {.prefetch = false});
        KnownParts known = parts_of(path);
        change_some(random, walk, known);
        for (int i = 0; i < 40; ++i, ++asked) {
            const auto one = std::next(known.begin(), random.integer(0, int(known.size()) - 1));
            const Probe probe(std::get<Model>(one->second.shape));
            std::vector<WalkPart> truth;
            double nearest = HUGE_VAL;
            for (const auto& [number, part] : known) {
                if (number == one->first)
                    continue;
                if (touches(part, probe, one->second.world))
                    truth.push_back(number);
                nearest =
                    std::min(nearest, gap_of(part, probe, one->second.world, Depths::no).distance);
            }
            ASSERT_EQ(walk.collide(one->first).parts, truth);
            ASSERT_EQ(walk.distance(one->first).gap.distance, nearest);
            ASSERT_EQ(walk.penetration(one->first).parts.size(), truth.size());
            ASSERT_EQ(walk.within(one->first, 0).parts.size(), truth.size());
            touched += truth.empty() ? 0 : 1;
        }
    }
    std::cout << touched << " of " << asked << " parts touch another\n";
    EXPECT_GT(touched, asked / 10);
    EXPECT_LT(touched, asked);
}

} // namespace
} // namespace abut::test
