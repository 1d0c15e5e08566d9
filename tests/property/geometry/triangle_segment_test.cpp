// The intersection of two triangles lies on both, is complete, and forms closed curves around two
// solids.

#include <abut/rigid.h>

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "geometry/triangle_triangle_segment.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <array>
#include <gtest/gtest.h>
#include <map>
#include <tuple>

namespace abut::test {
namespace {

double distance_to_edges(const Vec3& p, const Triangle& t) {
    double best = HUGE_VAL;
    for (std::size_t i = 0; i < 3; ++i)
        best = std::min(best, segment_segment_distance(p, p, t[i], t[(i + 1) % 3]).distance_sq);
    return std::sqrt(best);
}

struct SegmentTally {
    std::array<int, 7> of{}; ///< by number of corners
    double worst = 0;        ///< distance of a corner to a triangle, relative to the pair's size
};

void check(const Triangle& a, const Triangle& b, SegmentTally& tally) {
    const Intersection ab = triangle_triangle_segment(a, b), ba = triangle_triangle_segment(b, a);
    const bool meet = triangle_triangle_intersect(a, b) != TriangleContact::none;
    ASSERT_EQ(ab.count > 0, meet);
    ASSERT_EQ(ab.count, ba.count);
    ++tally.of.at(ab.count);
    const double size = size_of(a, b);
    for (std::uint32_t i = 0; i < ab.count; ++i) {
        const Vec3& p = ab.corners.at(i);
        const double to_a = std::sqrt(point_triangle_distance(p, a).distance_sq),
                     to_b = std::sqrt(point_triangle_distance(p, b).distance_sq);
        tally.worst = std::max(tally.worst, std::max(to_a, to_b) / size);
        // The intersection ends here: each corner is on the boundary of one of the triangles.
        ASSERT_LE(std::min(distance_to_edges(p, a), distance_to_edges(p, b)), 1e-10 * size);
        double nearest = HUGE_VAL;
        for (std::uint32_t j = 0; j < ba.count; ++j)
            nearest = std::min(nearest, length(p - ba.corners.at(j)));
        ASSERT_LE(nearest, 1e-10 * size);
    }
    if (ab.count == 2 && tally.worst < 1) { // checks the direction, unless the planes nearly
                                            // coincide
        const Vec3 n_a = cross(a[1] - a[0], a[2] - a[0]), n_b = cross(b[1] - b[0], b[2] - b[0]);
        const Vec3 along = cross(n_a, n_b), s = ab.corners[1] - ab.corners[0];
        if (length(along) > 1e-6 * length(n_a) * length(n_b) && length(s) > 1e-6 * size) {
            ASSERT_GT(dot(along, s), 0.99 * length(along) * length(s));
        }
    }
}

TEST(TriangleSegment, RandomPairs) {
    Random random(3101);
    SegmentTally tally;
    for (int i = 0; i < 60000 && !HasFatalFailure(); ++i) {
        const double scale = std::exp2(random.integer(-60, 60));
        Triangle a = random.triangle(), b = random.triangle();
        const Vec3 offset = random.in_cube(random.chance(0.2) ? 1000 : 1);
        for (std::size_t k = 0; k < 3; ++k)
            a[k] = scale * (a[k] + offset), b[k] = scale * (b[k] + offset);
        check(a, b, tally);
    }
    EXPECT_GT(tally.of[2], 5000);
    EXPECT_LT(tally.worst, 1e-11);
    std::cout << "worst corner: " << tally.worst << " of the size\n";
}

/// Nearly coincident planes, and needles.
TEST(TriangleSegment, NearlyCoplanarAndThin) {
    Random random(3102);
    SegmentTally tally;
    for (int i = 0; i < 40000 && !HasFatalFailure(); ++i) {
        const double tilt = std::exp2(random.integer(-60, -2));
        Triangle a = random.triangle(), b = random.triangle();
        for (std::size_t k = 0; k < 3; ++k) {
            a[k].z *= tilt, b[k].z *= tilt;
            if (i % 4 == 0)
                b[k].y *= 1e-6;
        }
        check(a, b, tally);
    }
    EXPECT_GT(tally.of[2], 4000);
    EXPECT_LT(tally.worst, 1e-11);
    std::cout << "worst corner: " << tally.worst << " of the size\n";
}

TEST(TriangleSegment, LatticePairsOfEveryKind) {
    Random random(3103);
    SegmentTally tally;
    for (int i = 0; i < 60000 && !HasFatalFailure(); ++i) {
        Triangle a = random.lattice_triangle(3), b = random.lattice_triangle(3);
        if (i % 2 == 0) // coplanar in an oblique plane
            for (std::size_t k = 0; k < 3; ++k)
                a[k].z = a[k].x + 2 * a[k].y, b[k].z = b[k].x + 2 * b[k].y;
        check(a, b, tally);
    }
    for (std::size_t corners = 0; corners <= 5; ++corners)
        EXPECT_GT(tally.of.at(corners), 20) << corners;
    EXPECT_LT(tally.worst, 1e-12);
}

/// The area of the polygon that coplanar triangles share, against points on a fine grid.
TEST(TriangleSegment, CoplanarAreaAgainstSampling) {
    Random random(3104);
    int large = 0;
    for (int i = 0; i < 500; ++i) {
        Triangle a = random.triangle(), b = random.triangle();
        for (std::size_t k = 0; k < 3; ++k)
            a[k].z = b[k].z = 0.5;
        const Intersection polygon = triangle_triangle_segment(a, b);
        Vec3 area;
        for (std::uint32_t k = 2; k < polygon.count; ++k)
            area = area + 0.5 * cross(polygon.corners.at(k - 1) - polygon.corners[0],
                                      polygon.corners.at(k) - polygon.corners[0]);
        constexpr int kGrid = 100;
        int inside = 0;
        const auto in = [](const Triangle& t, double x, double y) {
            int positive = 0, negative = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &p = t[k], &q = t[(k + 1) % 3];
                const double side = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
                positive += side > 0 ? 1 : 0, negative += side < 0 ? 1 : 0;
            }
            return positive == 0 || negative == 0;
        };
        for (int u = 0; u < kGrid; ++u)
            for (int v = 0; v < kGrid; ++v) {
                const double x = 2 * (u + 0.5) / kGrid - 1, y = 2 * (v + 0.5) / kGrid - 1;
                inside += in(a, x, y) && in(b, x, y) ? 1 : 0;
            }
        const double sampled = 4.0 * inside / (kGrid * kGrid);
        ASSERT_NEAR(length(area), sampled, 0.03);
        large += sampled > 0.1 ? 1 : 0;
        if (polygon.count > 2) {
            ASSERT_GT(area.z * cross(a[1] - a[0], a[2] - a[0]).z, 0);
        }
    }
    EXPECT_GT(large, 15);
}

/// If two closed surfaces cross, each segment begins where another ends, bit for bit.
TEST(Collide, SegmentsOfSolidsFormClosedCurves) {
    Random random(3105);
    int curves = 0;
    for (int i = 0; i < 60; ++i) {
        const Model a(torus_mesh(1, 0.4, 24, 14)),
            b(i % 2 == 0 ? sphere_mesh(0.9, 20, 11) : torus_mesh(0.8, 0.5, 19, 13));
        const Transform world_a = random.pose(0.5), world_b = random.pose(0.9);
        const Contacts c =
            collide(a, world_a, b, world_b, {.mode = ContactMode::all, .segments = true});
        if (!c.meet())
            continue;
        ++curves;
        std::map<std::tuple<double, double, double>, int> ends;
        for (const Intersection& s : c.segments) {
            ASSERT_EQ(s.count, 2U);
            const Vec3 &p = s.corners[0], &q = s.corners[1];
            ++ends[{p.x, p.y, p.z}];
            --ends[{q.x, q.y, q.z}];
        }
        for (const auto& [point, balance] : ends)
            ASSERT_EQ(balance, 0);
    }
    EXPECT_GT(curves, 30);
}

} // namespace
} // namespace abut::test
