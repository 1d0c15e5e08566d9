// What the contacts of two boxes and of two capsules are made of: the height of a capsule, the region of two
// faces, the axis of least overlap up to a distance, and warm starts that stay with their pairs.

#include <abut/vector.h>

#include "geometry/least_box_overlap.h"
#include "tests/support/random.h"
#include "world/contacts/near_pairs.h"
#include "world/solids/capsule_height.h"
#include "world/solids/polygon_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <optional>
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

/// A parallelogram in a contact frame, which runs counter-clockwise or clockwise.
std::array<FlatCorner, 4> parallelogram(Random& random, bool counter_clockwise, double height) {
    const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.5, 0.5),
                 turn = random.uniform(0, 6.3), shear = random.uniform(-0.3, 0.3);
    const Vec3 u{std::cos(turn), std::sin(turn), 0}, v{-u.y + shear * u.x, u.x + shear * u.y, 0};
    std::array<FlatCorner, 4> corners;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t at = counter_clockwise ? i : 3 - i;
        const double s = at == 0 || at == 3 ? 0.5 : -0.5, t = at < 2 ? 0.5 : -0.5;
        corners[i] = {x + s * u.x + t * v.x, y + s * u.y + t * v.y, height, i, i};
    }
    return corners;
}

TEST(SolidPairs, TheRegionOfTwoQuadrilateralsIsThatOfPolygons) {
    Random random(418);
    const ContactFrame frame({}, {0, 0, 1});
    int met = 0, dropped = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto a = parallelogram(random, true, 0), b = parallelogram(random, false, -0.1);
        const Vec3 tilted{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 1};
        const FacePlane plane(a[0], (1 / length(tilted)) * tilted, frame);
        ContactCandidates all, deep;
        add_polygon_overlap(a, b, plane, all);
        add_quad_overlap(a, b, plane, 0.1, deep);
        std::map<std::uint64_t, double> expected, found;
        for (const ContactCandidate& each : all)
            if (each.depth() >= 0.1)
                expected[each.feature] = each.depth();
        for (const ContactCandidate& each : deep)
            found[each.feature] = each.depth();
        ASSERT_EQ(found, expected);
        // All corners lie in both.
        for (const ContactCandidate& each : all)
            for (std::size_t k = 0; k < 4; ++k) {
                ASSERT_GE(left_of(a[k], a[(k + 1) % 4], each.x, each.y), -1e-12);
                ASSERT_LE(left_of(b[k], b[(k + 1) % 4], each.x, each.y), 1e-12);
            }
        met += all.empty() ? 0 : 1;
        dropped += deep.size() < all.size() ? 1 : 0;
    }
    EXPECT_GE(met, 500);
    EXPECT_GE(dropped, 300);
}

TEST(SolidPairs, AnAxisOfAFaceThatIsFarEnoughEndsTheSearch) {
    Random random(419);
    int apart = 0, same = 0;
    for (int i = 0; i < 2000; ++i) {
        RoundedBox a, b;
        for (RoundedBox* box : {&a, &b}) {
            box->centre = random.in_cube(1.5);
            const Vec3 z = random.direction(), x = perpendicular(z);
            box->axis = {x, cross(z, x), z};
            box->half = {random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
        }
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
