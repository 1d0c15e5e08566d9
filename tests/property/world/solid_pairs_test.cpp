// What the contacts of two boxes and of two capsules are made of: the height of a capsule, the region of two
// boxes, the axis of least overlap up to a distance, what separated a pair before, and warm starts that stay with their pairs.

#include <abut/vector.h>
#include <abut/world.h>

#include "geometry/least_box_overlap.h"
#include "tests/support/random.h"
#include "world/contacts/contact_candidates.h"
#include "world/contacts/contact_face.h"
#include "world/contacts/near_pairs.h"
#include "world/solids/box_region.h"
#include "world/solids/capsule_height.h"
#include "world/solids/known_separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

/// The top of the balls around many points of a capsule's axis, over a place.
std::optional<double> sampled_height(const Vec3& p, const Vec3& q, double radius, double x,
                                     double y) {
    constexpr int kSamples = 4000;
    std::optional<double> height;
    for (int i = 0; i <= kSamples; ++i) {
        const Vec3 c = p + (static_cast<double>(i) / kSamples) * (q - p);
        const double room = radius * radius - (x - c.x) * (x - c.x) - (y - c.y) * (y - c.y);
        if (room >= 0)
            height = std::max(height.value_or(-HUGE_VAL), c.z + std::sqrt(room));
    }
    return height;
}

TEST(SolidPairs, TheHeightOfACapsuleIsThatOfItsBalls) {
    Random random(417);
    int met = 0, missed = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3 p = random.in_cube(1);
        // Some axes stand upright.
        const Vec3 q = i % 10 == 0 ? Vec3{p.x, p.y, random.uniform(-1, 1)} : random.in_cube(1);
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        const auto expected = sampled_height(p, q, 0.5, x, y);
        const auto top = capsule_height(p, q, 0.5, x, y, 1);
        // The bottom is the top of the mirror image.
        const auto mirrored = capsule_height({p.x, p.y, -p.z}, {q.x, q.y, -q.z}, 0.5, x, y, -1);
        ASSERT_EQ(top, mirrored);
        if (!expected || !top) {
            // Samples may miss what a line just touches.
            ASSERT_FALSE(expected && !top);
            ++missed;
            continue;
        }
        ++met;
        ASSERT_GE(*top, *expected - 1e-12);
        ASSERT_LE(*top, *expected + 1e-3);
    }
    EXPECT_GE(met, 60);
    EXPECT_GE(missed, 60);
}

/// A box of random sizes near the origin; some are turned by little, and most are no larger than 1.
RoundedBox random_box(Random& random, double spread, bool turned) {
    RoundedBox box;
    box.centre = random.in_cube(spread);
    const double angle = random.uniform(-0.02, 0.02);
    const Vec3 z = turned ? random.direction() : Vec3{0, 0, 1},
               x = turned ? perpendicular(z) : Vec3{std::cos(angle), std::sin(angle), 0};
    box.axis = {x, cross(z, x), z};
    box.half = {random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)};
    return box;
}

TEST(SolidPairs, TheRegionOfTwoBoxesIsThatOfTheirFacesAsPolygons) {
    Random random(418);
    int met = 0, dropped = 0, renamed = 0;
    std::map<LeastOverlap::Kind, int> kinds;
    for (int i = 0; i < 4000; ++i) {
        RoundedBox a = random_box(random, 0.6, i % 4 != 0), b = random_box(random, 0.6, i % 4 != 0);
        if (i % 8 == 0) // one on the other, with sides of the same size
            b.half = a.half, b.centre = a.centre + Vec3{0.01, 0.02, 2 * a.half[2] - 1e-3};
        const BoxAxes axes(a, b);
        const LeastOverlap least = least_overlap(a, b, axes);
        const double least_depth = i % 2 == 0 ? -HUGE_VAL : 0.1;
        const BoxRegion region(a, b, axes, least, least_depth);
        const ContactFrame frame(a.centre, least.normal);
        ContactCandidates all;
        add_overlap_corners(contact_face(a, least.normal, a.centre),
                            contact_face(b, -least.normal, a.centre), frame, all);
        std::map<std::uint64_t, const ContactCandidate*> expected;
        double deepest = -HUGE_VAL;
        for (const ContactCandidate& each : all) {
            deepest = std::max(deepest, each.depth());
            if (each.depth() >= least_depth)
                expected[each.feature] = &each;
        }
        if (!expected.empty()) {
            ASSERT_NEAR(region.deepest, deepest, 1e-12);
        } else {
            ASSERT_EQ(region.count, 0U);
        }
        for (std::size_t k = 0; k < region.count; ++k) {
            const auto same = expected.find(region.corners[k].feature);
            if (same == expected.end()) {
                ++renamed; // rounding decides where a vertex is just in reach of a corner
                continue;
            }
            const ContactCandidate& other = *same->second;
            ASSERT_NEAR(region.corners[k].depth, other.depth(), 1e-12);
            const Vec3 on_a = frame.world(other.x, other.y, other.height_a),
                       on_b = frame.world(other.x, other.y, other.height_b);
            ASSERT_LE(length(region.on_reference(k) - (region.reference_is_a ? on_a : on_b)),
                      1e-12);
            expected.erase(same);
        }
        renamed += static_cast<int>(expected.size());
        ++kinds[least.kind];
        met += region.count > 0 ? 1 : 0;
        dropped += region.count < all.size() ? 1 : 0;
    }
    EXPECT_GE(met, 2000);
    EXPECT_GE(dropped, 300);
    EXPECT_LE(renamed, 4);
    for (const auto kind :
         {LeastOverlap::Kind::face_a, LeastOverlap::Kind::face_b, LeastOverlap::Kind::edges})
        EXPECT_GE(kinds[kind], 300);
}

TEST(SolidPairs, WhatSeparatedBoxesProvesThemApart) {
    Random random(421);
    int proven = 0, not_proven = 0, mirrored = 0;
    std::map<bool, int> by_edges;
    for (int i = 0; i < 3000; ++i) {
        const RoundedBox a = random_box(random, 1.2, true);
        RoundedBox b = random_box(random, 1.2, true);
        const double distance = random.uniform(0, 0.2);
        const LeastOverlap before = least_overlap(a, b);
        KnownSeparation known;
        known.axis = before.axis;
        b.centre = b.centre + random.in_cube(0.4); // it moves
        const LeastOverlap now = least_overlap(a, b);
        const bool is_proven = is_apart(known, a, b, distance);
        if (is_proven) {
            ASSERT_LT(now.overlap, -distance);
        }
        // The axis that separates most proves all but what rounding decides, unless edges are parallel.
        KnownSeparation best;
        best.axis = now.axis;
        const std::size_t edges = now.axis < 6 ? 0 : now.axis - 6U;
        if (now.axis < 6 || length(cross(a.axis[edges / 3], b.axis[edges % 3])) > 0x1p-5) {
            ASSERT_EQ(is_apart(best, a, b, distance), now.overlap < -distance);
        }
        by_edges[now.axis >= 6] += now.overlap < -distance ? 1 : 0;
        known.exchange();
        ASSERT_EQ(is_apart(known, b, a, distance), is_proven);
        mirrored += is_proven ? 1 : 0;
        (is_proven ? proven : not_proven) += now.overlap < -distance ? 1 : 0;
    }
    EXPECT_GE(proven, 500);
    EXPECT_GE(not_proven, 10);
    EXPECT_GE(mirrored, 500);
    EXPECT_GE(by_edges[true], 50);
    EXPECT_GE(by_edges[false], 500);
}

TEST(SolidPairs, WhatSeparatedCapsulesProvesThemApart) {
    Random random(422);
    int proven = 0, not_proven = 0, near = 0;
    for (int i = 0; i < 3000; ++i) {
        RoundedBox capsules[2];
        for (RoundedBox& each : capsules) {
            each = random_box(random, 1, true);
            const double half = random.uniform(0.1, 1);
            each.half = {}, each.half[static_cast<std::size_t>(random.integer(0, 2))] = half;
            each.radius = random.uniform(0, 0.3);
        }
        auto& [a, b] = capsules;
        const double distance = random.uniform(0, 0.2);
        const SolidGap before = rounded_box_distance(a, b);
        KnownSeparation known;
        ASSERT_FALSE(is_apart(known, a, b, distance));
        if (before.distance > 0)
            known.direction = before.normal;
        b.centre = b.centre + random.in_cube(0.05); // it moves
        const double now = rounded_box_distance(a, b).distance;
        if (is_apart(known, a, b, distance)) {
            ASSERT_GT(now, distance);
            KnownSeparation mirrored = known;
            mirrored.exchange();
            ASSERT_TRUE(is_apart(mirrored, b, a, distance));
            ++proven;
        }
        near += now <= distance ? 1 : 0;
        not_proven += now > distance && !is_apart(known, a, b, distance) ? 1 : 0;
    }
    EXPECT_GE(proven, 800);
    EXPECT_GE(not_proven, 2);
    EXPECT_GE(near, 300);
}

/// A world of boxes and capsules at given places.
struct Crowd {
    World world;
    std::vector<BodyId> ids;

    Crowd(const std::vector<Vec3>& sizes, const std::vector<Pose>& poses) {
        for (std::size_t i = 0; i < sizes.size(); ++i)
            ids.push_back(i % 2 == 0
                              ? world.add(Box3{-sizes[i], sizes[i]}, poses[i])
                              : world.add(Capsule{{{0, 0, -0.4}, {0, 0, 0.4}}, 0.1}, poses[i]));
    }
};

TEST(SolidPairs, ContactsDoNotDependOnWhatSeparatedBodiesBefore) {
    Random random(423);
    std::vector<Vec3> sizes;
    std::vector<Pose> poses;
    for (int i = 0; i < 120; ++i) {
        sizes.push_back({random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), 0.4});
        poses.push_back(random.pose(2));
    }
    Crowd crowd(sizes, poses);
    int begun = 0, kept = 0;
    std::set<std::pair<std::uint32_t, std::uint32_t>> before;
    for (int step = 0; step < 60; ++step) {
        const double margin = step % 3 == 0 ? 0 : 0.05;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            poses[i].translation = poses[i].translation + random.in_cube(0.03);
            poses[i].rotation[1] += random.uniform(-0.03, 0.03);
            crowd.world.move(crowd.ids[i], poses[i]);
        }
        Crowd fresh(sizes, poses); // the same bodies, without a past
        const auto found = crowd.world.contact_manifolds(margin),
                   expected = fresh.world.contact_manifolds(margin);
        ASSERT_EQ(found.size(), expected.size());
        std::set<std::pair<std::uint32_t, std::uint32_t>> now;
        for (std::size_t k = 0; k < found.size(); ++k) {
            ASSERT_EQ(found[k].a.index, expected[k].a.index);
            ASSERT_EQ(found[k].b.index, expected[k].b.index);
            ASSERT_EQ(found[k].normal, expected[k].normal);
            now.emplace(found[k].a.index, found[k].b.index);
            begun += before.contains({found[k].a.index, found[k].b.index}) ? 0 : 1;
            kept += before.contains({found[k].a.index, found[k].b.index}) ? 1 : 0;
        }
        before = now;
    }
    EXPECT_GE(begun, 500);
    EXPECT_GE(kept, 1000);
}

TEST(SolidPairs, AnAxisOfAFaceThatIsFarEnoughEndsTheSearch) {
    Random random(419);
    int apart = 0, same = 0;
    for (int i = 0; i < 2000; ++i) {
        const RoundedBox a = random_box(random, 1.5, true), b = random_box(random, 1.5, true);
        const LeastOverlap all = least_overlap(a, b), some = least_overlap(a, b, 0.1);
        if (some.overlap == all.overlap) {
            ASSERT_EQ(some.normal, all.normal);
            ++same;
            continue;
        }
        ASSERT_LT(some.overlap, -0.1);
        ASSERT_LT(all.overlap, some.overlap + 1e-12);
        ++apart;
    }
    EXPECT_GE(apart, 50);
    EXPECT_GE(same, 1000);
}

TEST(NearPairs, WarmStartsStayWithTheirPairs) {
    Random random(420);
    WorldData bodies{WorldOptions()};
    std::vector<BodyId> ids;
    const auto somewhere = [&] { return Pose{random.in_cube(3), {1, 0, 0, 0}}; };
    ids.reserve(60);
    for (int i = 0; i < 60; ++i)
        ids.push_back(bodies.add(shape_of(Sphere{{}, 0.5}), somewhere(), {}));
    NearPairs near(bodies);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> marks; // of the last step's pairs
    double next = 0;
    int stayed = 0, begun = 0;
    for (int step = 0; step < 200; ++step) {
        for (int i = 0; i < 3; ++i) {
            BodyId& moved = ids[static_cast<std::size_t>(random.integer(0, 59))];
            if (random.integer(0, 3) == 0) { // another body with an index that was used before
                bodies.remove(moved);
                moved = bodies.add(shape_of(Sphere{{}, 0.5}), somewhere(), {});
            } else {
                bodies.move(moved, somewhere());
            }
        }
        bodies.update();
        near.update(0.2);
        std::map<std::pair<std::uint32_t, std::uint32_t>, double> now;
        for (std::size_t k = 0; k < near.pairs().size(); ++k) {
            const std::pair pair(near.pairs()[k].a(), near.pairs()[k].b());
            double& mark = near.warm_start(k).direction.x;
            if (mark == 0) {
                mark = ++next, ++begun;
            } else {
                ASSERT_TRUE(marks.contains(pair));
                ASSERT_EQ(mark, marks[pair]);
                ++stayed;
            }
            now[pair] = mark;
        }
        marks = now;
    }
    EXPECT_GE(stayed, 5000);
    EXPECT_GE(begun, 500);
}

} // namespace
} // namespace abut::test
