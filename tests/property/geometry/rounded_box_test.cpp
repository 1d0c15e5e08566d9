// Distances of rounded boxes, checked independently: by points sampled on both, by meshes of boxes,
// and by translations that must separate or join them.

#include "geometry/rounded_box_distance.h"
#include "geometry/triangle_triangle_distance.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace abut::test {
namespace {

RoundedBox random_box(Random& random, double reach) {
    RoundedBox box;
    const Transform t = random.pose(reach);
    box.centre = {t.m[9], t.m[10], t.m[11]};
    for (std::size_t k = 0; k < 3; ++k) {
        box.axis[k] = {t.m[3 * k], t.m[3 * k + 1], t.m[3 * k + 2]};
        box.half[k] = random.chance(0.4) ? 0 : random.uniform(0.1, 1);
    }
    box.radius = random.chance(0.4) ? 0 : random.uniform(0.05, 0.5);
    return box;
}

Vec3 point_inside(Random& random, const RoundedBox& box) {
    Vec3 p = box.centre + box.radius * random.uniform(0, 1) * random.direction();
    for (std::size_t k = 0; k < 3; ++k) {
        const double t = random.chance(0.3) ? double(random.integer(-1, 1)) : random.uniform(-1, 1);
        p = p + t * box.half[k] * box.axis[k];
    }
    return p;
}

RoundedBox moved(RoundedBox box, const Vec3& by) {
    box.centre = box.centre + by;
    return box;
}

TEST(RoundedBox, NoSampledPointsAreNearerThanTheDistance) {
    Random random(5101);
    int apart = 0, meeting = 0, near = 0;
    for (int round = 0; round < many(4000); ++round) {
        const RoundedBox a = random_box(random, 1.2), b = random_box(random, 1.2);
        const SolidGap gap = rounded_box_distance(a, b);
        SCOPED_TRACE(round);
        EXPECT_NEAR(length(gap.normal), 1, 1e-12);
        const Vec3 way = gap.point_b - gap.point_a;
        EXPECT_NEAR(length(way - gap.distance * gap.normal), 0, 1e-9);
        gap.distance > 0 ? ++apart : ++meeting;
        double sampled = HUGE_VAL;
        for (int i = 0; i < 30; ++i)
            sampled = std::min(sampled, length(point_inside(random, a) - point_inside(random, b)));
        EXPECT_GT(sampled, gap.distance - 1e-9);
        near += sampled < gap.distance + 0.3 ? 1 : 0;
    }
    EXPECT_GT(apart, many(4000) / 10);
    EXPECT_GT(meeting, many(4000) / 10);
    EXPECT_GT(near, many(4000) / 10);
}

TEST(RoundedBox, TheSeparatingMotionIsTheShortest) {
    Random random(5102);
    int deep = 0;
    for (int round = 0; round < many(2000); ++round) {
        const RoundedBox a = random_box(random, 0.6), b = random_box(random, 0.6);
        const SolidGap gap = rounded_box_distance(a, b);
        SCOPED_TRACE(round);
        const double touching =
            rounded_box_distance(a, moved(b, -gap.distance * gap.normal)).distance;
        EXPECT_NEAR(touching, 0, 1e-9);
        if (gap.distance > -1e-3)
            continue;
        ++deep;
        for (int i = 0; i < 40; ++i) {
            const Vec3 way = 0.999 * -gap.distance * random.direction();
            EXPECT_LE(rounded_box_distance(a, moved(b, way)).distance, 1e-9);
        }
    }
    EXPECT_GT(deep, many(2000) / 8);
}

TEST(RoundedBox, IsSymmetric) {
    Random random(5103);
    for (int round = 0; round < many(2000); ++round) {
        const RoundedBox a = random_box(random, 1), b = random_box(random, 1);
        EXPECT_NEAR(rounded_box_distance(a, b).distance, rounded_box_distance(b, a).distance, 1e-9);
    }
}

/// The corners of the box without its rounding; some coincide if the box is flat.
std::vector<Vec3> corners(const RoundedBox& box) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) {
        Vec3 p = box.centre;
        for (std::size_t k = 0; k < 3; ++k)
            p = p + ((i >> k & 1) != 0 ? box.half[k] : -box.half[k]) * box.axis[k];
        points.push_back(p);
    }
    return points;
}

double distance_to(const RoundedBox& box, const Vec3& p) {
    const Vec3 d = p - box.centre;
    double sq = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sq += std::pow(std::max(0.0, std::abs(dot(d, box.axis[k])) - box.half[k]), 2);
    return std::sqrt(sq);
}

/// Distance of two separate boxes, by all pairs of features.
double by_all_features(const RoundedBox& a, const RoundedBox& b) {
    const std::vector<Vec3> p = corners(a), q = corners(b);
    double sq = HUGE_VAL;
    for (const Vec3& v : p)
        sq = std::min(sq, std::pow(distance_to(b, v), 2));
    for (const Vec3& v : q)
        sq = std::min(sq, std::pow(distance_to(a, v), 2));
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 0; k < 8; ++k)
            for (const std::size_t u : {1, 2, 4})
                for (const std::size_t v : {1, 2, 4})
                    if ((i & u) == 0 && (k & v) == 0)
                        sq = std::min(
                            sq,
                            segment_segment_distance(p[i], p[i + u], q[k], q[k + v]).distance_sq);
    return std::sqrt(sq);
}

TEST(RoundedBox, EqualsTheMinimumOverAllFeatures) {
    Random random(5104);
    int apart = 0, edges = 0;
    for (int round = 0; round < many(6000); ++round) {
        RoundedBox a = random_box(random, 1.5), b = random_box(random, 1.5);
        a.radius = b.radius = 0;
        if (random.chance(0.3))
            b.axis = a.axis;
        if (random.chance(0.2))
            a.half[0] = 100; // a needle or a plate
        const double far = random.chance(0.2) ? 1e7 : 0;
        a = moved(a, {far, -far, far}), b = moved(b, {far, -far, far});
        const SolidGap first = rounded_box_distance(a, b);
        // The gap becomes anything from 1e-9 to 1; the nearest features stay or change.
        if (random.chance(0.5))
            b = moved(b, (std::pow(10, random.uniform(-9, 0)) - first.distance) * first.normal);
        const SolidGap gap = rounded_box_distance(a, b);
        if (gap.distance <= 1e-12 * (1 + far))
            continue;
        SCOPED_TRACE(round);
        ++apart;
        const double rounding = 1e-13 + 1e-14 * far;
        EXPECT_NEAR(gap.distance, by_all_features(a, b), rounding);
        EXPECT_LT(distance_to(a, gap.point_a), rounding);
        EXPECT_LT(distance_to(b, gap.point_b), rounding);
        const auto on_vertex = [](const RoundedBox& box, const Vec3& p) {
            return std::ranges::any_of(corners(box),
                                       [&](const Vec3& v) { return length(v - p) < 1e-6; });
        };
        edges += !on_vertex(a, gap.point_a) && !on_vertex(b, gap.point_b) ? 1 : 0;
    }
    EXPECT_GT(apart, many(6000) / 3);
    EXPECT_GT(edges, many(6000) / 40);
}

TEST(RoundedBox, SpheresAndCoincidentBoxes) {
    RoundedBox a, b;
    a.radius = 1, b.radius = 2, b.centre = {5, 0, 0};
    EXPECT_DOUBLE_EQ(rounded_box_distance(a, b).distance, 2);
    EXPECT_EQ(rounded_box_distance(a, b).point_a, (Vec3{1, 0, 0}));
    b.centre = {};
    EXPECT_DOUBLE_EQ(rounded_box_distance(a, b).distance, -3);
    a.half = b.half = {1, 2, 3};
    a.radius = b.radius = 0;
    EXPECT_DOUBLE_EQ(rounded_box_distance(a, b).distance, -2); // along x
    RoundedBox point, other;
    EXPECT_EQ(rounded_box_distance(point, other).distance, 0);
}

} // namespace
} // namespace abut::test
