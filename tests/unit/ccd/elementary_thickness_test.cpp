/// Elementary tests with a thickness, and features at rest. The cases are worked by hand.
#include <abut/elementary_impact.h>
#include <abut/error.h>

#include "ccd/feature_distance.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace abut {
namespace {

using Points = std::array<Vec3, 4>;
constexpr auto kFace = ElementaryKind::vertex_face, kEdges = ElementaryKind::edge_edge;

ElementaryImpact impact(ElementaryKind kind, const Points& start, const Points& end,
                        double thickness, double delta = 0) {
    return elementary_impact({kind, start, end}, {.absolute_error = delta, .thickness = thickness});
}

/// A vertex and the right triangle in the plane z = 0.
Points face_and(const Vec3& vertex) {
    return {vertex, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
}
/// An edge along x at height z, and one along y.
Points cross_at(double z) {
    return {Vec3{-1, 0, z}, Vec3{1, 0, z}, Vec3{0, -1, 0}, Vec3{0, 1, 0}};
}

/// Expects a hit at `time`, or at most `early` before it: the time that a distance of 1e-6 of the
/// thickness takes.
void expect_hit(const ElementaryImpact& i, double time, double early) {
    ASSERT_TRUE(i.meet);
    EXPECT_EQ(i.status, Status::converged);
    EXPECT_EQ(i.decided_by, ElementaryStage::interval);
    EXPECT_LE(i.time, time);
    EXPECT_GE(i.time, time - early);
}

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-6);
    EXPECT_NEAR(a.y, b.y, 1e-6);
    EXPECT_NEAR(a.z, b.z, 1e-6);
}

TEST(Thickness, VertexFallsOnAFace) {
    const auto i = impact(kFace, face_and({0.25, 0.25, 1}), face_and({0.25, 0.25, -1}), 0.5);
    expect_hit(i, 0.25, 1e-6);
    expect_near(i.normal, {0, 0, 1});
    EXPECT_NEAR(i.barycentric[0], 0.5, 1e-9);
    EXPECT_NEAR(i.barycentric[1], 0.25, 1e-9);
    expect_near(impact(kFace, face_and({0.25, 0.25, -1}), face_and({0.25, 0.25, 1}), 0.5).normal,
                {0, 0, -1});
}

TEST(Thickness, VertexPassesBesideACornerAndAnEdge) {
    // The vertex is 3 beside the corner (1, 0, 0), and at first 4 above it. Its distance is 5 at
    // the start and 3 at t = 1/2.
    const Points start = face_and({4, 0, 4}), end = face_and({4, 0, -4});
    expect_hit(impact(kFace, start, end, 5), 0, 0);
    expect_hit(impact(kFace, start, end, 3), 0.5, 1e-2);
    const auto i = impact(kFace, start, end, std::sqrt(10));
    expect_hit(i, 0.375, 1e-5);
    expect_near(i.normal, {3 / std::sqrt(10), 0, 1 / std::sqrt(10)});
    EXPECT_NEAR(i.barycentric[1], 1, 1e-12);
    EXPECT_FALSE(impact(kFace, start, end, 3 * (1 - 2e-6)).meet);
    // The vertex passes beside the edge along x.
    const Points beside = face_and({0.5, -2, 3}), gone = face_and({0.5, -2, -3});
    expect_hit(impact(kFace, beside, gone, 2), 0.5, 1e-2);
    EXPECT_FALSE(impact(kFace, beside, gone, 1.99).meet);
}

TEST(Thickness, EdgesApproachAndSlide) {
    const auto i = impact(kEdges, cross_at(3), cross_at(-1), 1);
    expect_hit(i, 0.5, 1e-6);
    expect_near(i.normal, {0, 0, 1});
    EXPECT_NEAR(i.barycentric[0], 0.5, 1e-9);
    EXPECT_EQ(i.barycentric[2], 0);
    // Always exactly at the thickness, and then slightly beyond it.
    Points start = cross_at(1), end = cross_at(1);
    start[0].x = -0.5, end[0].x = -1;
    expect_hit(impact(kEdges, start, end, 1), 0, 0);
    EXPECT_FALSE(impact(kEdges, start, end, 1 - 0x1p-19).meet);
}

TEST(Thickness, ParallelAndZeroLengthEdges) {
    const Points start{Vec3{0, 0, 2}, Vec3{1, 0, 2}, Vec3{0.5, 0, 0}, Vec3{2, 0, 0}};
    Points end = start;
    end[0].z = end[1].z = 0;
    const auto i = impact(kEdges, start, end, 0.5);
    expect_hit(i, 0.75, 1e-6);
    expect_near(i.normal, {0, 0, 1});
    const Points points{Vec3{0, 0, 4}, Vec3{0, 0, 4}, Vec3{0, 3, 0}, Vec3{0, 3, 0}};
    Points met = points;
    met[0] = met[1] = {0, 3, 0};
    const auto p = impact(kEdges, points, met, 2.5);
    expect_hit(p, 0.5, 1e-6);
    expect_near(p.normal, {0, -0.6, 0.8});
}

TEST(Thickness, FacesThatAreSegmentsOrPoints) {
    const Points line{Vec3{0.5, 0, 2}, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}};
    Points line_end = line;
    line_end[0].z = 0;
    expect_hit(impact(kFace, line, line_end, 1), 0.5, 1e-6);
    const Points point{Vec3{0, 0, 2}, Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 0}};
    Points point_end = point;
    point_end[0].z = 0;
    expect_hit(impact(kFace, point, point_end, 1), 0.5, 1e-6);
}

TEST(Thickness, WithoutMotionAndAtTheSamePoint) {
    const Points above = face_and({0.25, 0.25, 0.5});
    expect_hit(impact(kFace, above, above, 0.5), 0, 0);
    EXPECT_FALSE(impact(kFace, above, above, 0.499).meet);
    const Points one{Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{1, 2, 3}};
    expect_hit(impact(kFace, one, one, 1e-300), 0, 0);
    // They cross at the start, so the normal is the one without a thickness.
    const Points crossing = cross_at(0);
    expect_near(impact(kEdges, crossing, cross_at(1), 0.5).normal,
                impact(kEdges, crossing, cross_at(1), 0).normal);
}

TEST(Thickness, DeltaAllowsMore) {
    // 3 from the corner at the origin, in a direction that no filter tests.
    const Points p{Vec3{1, 2, 2}, Vec3{0, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}};
    const auto i = impact(kFace, p, p, 2.9, 0.2);
    ASSERT_TRUE(i.meet);
    EXPECT_EQ(i.status, Status::bound_only);
    EXPECT_FALSE(impact(kFace, p, p, 2.9, 0.05).meet);
    EXPECT_EQ(impact(kFace, p, p, 3, 0.2).status, Status::converged);
}

TEST(Thickness, TinyThicknessesAreNotMissed) {
    // Smaller than the rounding of coordinates near 1. The status reports that.
    const auto i = impact(kFace, face_and({0.3, 0.3, 0.7}), face_and({0.3, 0.3, -0.1}), 1e-17);
    ASSERT_TRUE(i.meet);
    EXPECT_EQ(i.status, Status::bound_only);
    EXPECT_LE(i.time, 0.875);
    EXPECT_GE(i.time, 0.875 - 1e-11);
}

TEST(Thickness, BadThicknessesAreRefused) {
    const Points p = face_and({0, 0, 1});
    EXPECT_THROW(impact(kFace, p, p, -1), Error);
    EXPECT_THROW(impact(kFace, p, p, std::numeric_limits<double>::infinity()), Error);
    EXPECT_THROW(impact(kFace, p, p, std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST(FeatureDistance, ByHand) {
    const auto face = feature_distance(kFace, face_and({0.25, 0.5, -2}));
    EXPECT_NEAR(face.distance_sq, 4, 1e-14);
    EXPECT_NEAR(face.barycentric[0], 0.25, 1e-15);
    EXPECT_NEAR(face.barycentric[1], 0.25, 1e-15);
    EXPECT_NEAR(face.barycentric[2], 0.5, 1e-15);
    EXPECT_LE(face.lower, 2);
    EXPECT_GE(face.upper, 2);
    const auto edges =
        feature_distance(kEdges, {Vec3{4, 3, 0}, Vec3{6, 3, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}});
    EXPECT_NEAR(edges.distance_sq, 20, 1e-13);
    EXPECT_EQ(edges.barycentric[0], 0);
    EXPECT_EQ(edges.barycentric[1], 0);
    EXPECT_EQ(feature_distance(kEdges, cross_at(0)).lower, 0);
}

TEST(FeatureDistance, AnySizeOfCoordinates) {
    for (const double s : {0x1p-1000, 0x1p-300, 0x1p500, 0x1p1020}) {
        Points p = face_and({0.25, 0.5, -2});
        for (Vec3& v : p)
            v = {s * v.x, s * v.y, s * v.z};
        const auto d = feature_distance(kFace, p);
        EXPECT_LE(d.lower, 2 * s);
        EXPECT_GE(d.upper, 2 * s);
        EXPECT_GE(d.lower, (2 - 1e-13) * s);
        EXPECT_LE(d.upper, (2 + 1e-13) * s);
    }
}

} // namespace
} // namespace abut
