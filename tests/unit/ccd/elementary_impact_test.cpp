// Elementary tests with answers known by hand.

#include <abut/elementary_impact.h>
#include <abut/error.h>

#include "math/vector.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut {
namespace {

constexpr ElementaryKind kFace = ElementaryKind::vertex_face, kEdges = ElementaryKind::edge_edge;
using Points = std::array<Vec3, 4>;

/// A vertex and the unit right triangle in the plane z = 0.
Points face_and(const Vec3& vertex) {
    return {vertex, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
}
/// An edge along x through (0, 0, z), and one along y from -1 to 1 in the plane z = 0.
Points cross_at(double z, double half = 1) {
    return {Vec3{-half, 0, z}, Vec3{half, 0, z}, Vec3{0, -1, 0}, Vec3{0, 1, 0}};
}

ElementaryImpact impact(ElementaryKind kind, const Points& start, const Points& end) {
    return elementary_impact({kind, start, end});
}

void expect_hit(const ElementaryImpact& impact, double time) {
    ASSERT_TRUE(impact.meet);
    EXPECT_EQ(impact.status, Status::exact);
    EXPECT_LE(impact.time, time);
    EXPECT_NEAR(impact.time, time, 1e-9);
}
void expect_miss(const ElementaryImpact& impact) {
    EXPECT_FALSE(impact.meet);
    EXPECT_EQ(impact.time, 1);
    EXPECT_EQ(impact.status, Status::exact);
}
void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_LT(length(a - b), 1e-9) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(VertexFace, PassesThroughTheFace) {
    const auto hit = impact(kFace, face_and({0.25, 0.5, 3}), face_and({0.25, 0.5, -1}));
    expect_hit(hit, 0.75);
    EXPECT_EQ(hit.decided_by, ElementaryStage::interval);
    EXPECT_NEAR(hit.barycentric[0], 0.25, 1e-9);
    EXPECT_NEAR(hit.barycentric[1], 0.25, 1e-9);
    EXPECT_NEAR(hit.barycentric[2], 0.5, 1e-9);
    expect_near(hit.normal, {0, 0, 1});
    // From below, the normal has the other sign. The face may move instead of the vertex.
    expect_near(impact(kFace, face_and({0.25, 0.5, -1}), face_and({0.25, 0.5, 3})).normal,
                {0, 0, -1});
    Points up = face_and({0.25, 0.5, 3});
    for (std::size_t i = 1; i < 4; ++i)
        up[i].z = 4;
    const auto lifted = impact(kFace, face_and({0.25, 0.5, 3}), up);
    expect_hit(lifted, 0.75);
    expect_near(lifted.normal, {0, 0, 1});
}

TEST(VertexFace, MissesBesideIt) {
    expect_miss(impact(kFace, face_and({0.75, 0.75, 3}), face_and({0.75, 0.75, -1})));
    expect_miss(impact(kFace, face_and({0.25, 0.5, 3}), face_and({0.25, 0.5, 1e-300})));
    expect_miss(
        impact(kFace, face_and({0.5, 0.5 + 0x1p-53, 1}), face_and({0.5, 0.5 + 0x1p-53, -1})));
}

TEST(VertexFace, TouchesBordersAndEnds) {
    expect_hit(impact(kFace, face_and({0.5, 0.5, 1}), face_and({0.5, 0.5, -1})), 0.5);
    expect_hit(impact(kFace, face_and({1, 0, 1}), face_and({1, 0, -1})), 0.5);
    expect_hit(impact(kFace, face_and({0.25, 0.25, 1}), face_and({0.25, 0.25, 0})), 1);
    expect_hit(impact(kFace, face_and({0.25, 0.25, 0}), face_and({0.25, 0.25, 1})), 0);
    expect_hit(impact(kFace, face_and({0, 0, 0}), face_and({0, 0, 5})), 0);
}

TEST(VertexFace, TouchesAndTurnsBack) {
    // The vertex moves along x. The face's height at x is 1 + (1 - 2 x) h, where h goes from 1 to
    // -1. So the height below the vertex is 1 + (1 - 2 t)^2, which gives a double root at 1/2.
    const Points start{Vec3{0, 0.25, 1}, Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}};
    Points end = start;
    end[0] = {1, 0.25, 1};
    const auto tilt = [](Points& p, double h) { p[1].z = 1 + h, p[2].z = 1 - h, p[3].z = 1 + h; };
    Points tilted_start = start, tilted_end = end;
    tilt(tilted_start, 1);
    tilt(tilted_end, -1);
    expect_hit(impact(kFace, tilted_start, tilted_end), 0.5);
    // Slightly lower, the vertex comes near without touching. Slightly higher, it crosses twice.
    Points lower_start = tilted_start, lower_end = tilted_end;
    lower_start[0].z = lower_end[0].z = 1 - 0x1p-40;
    expect_miss(impact(kFace, lower_start, lower_end));
    lower_start[0].z = lower_end[0].z = 1 + 0x1p-40;
    expect_hit(impact(kFace, lower_start, lower_end), 0.5 - 0x1p-21);
}

TEST(VertexFace, WithinOnePlane) {
    expect_hit(impact(kFace, face_and({-1, 0.25, 0}), face_and({1, 0.25, 0})), 0.5);
    expect_hit(impact(kFace, face_and({-1, 0, 0}), face_and({1, 0, 0})), 0.5); // along the border
    expect_hit(impact(kFace, face_and({2, 1, 0}), face_and({0, -1, 0})), 0.5); // through its corner
                                                                               // (1, 0)
    expect_miss(impact(kFace, face_and({2, 1, 0}), face_and({0, -1.5, 0})));
}

TEST(VertexFace, WithinOnePlaneAskew) {
    const auto lift = [](Points p) {
        for (Vec3& v : p)
            v.z = v.x + 2 * v.y;
        return p;
    };
    expect_hit(impact(kFace, lift(face_and({-1, 0.25, 0})), lift(face_and({1, 0.25, 0}))), 0.5);
    expect_miss(impact(kFace, lift(face_and({-1, 2, 0})), lift(face_and({1, 2, 0}))));
}

TEST(VertexFace, FacesThatAreSegmentsOrPoints) {
    const Points line{Vec3{0.5, 0, 1}, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}};
    Points line_end = line;
    line_end[0].z = -1;
    const auto on_line = impact(kFace, line, line_end);
    expect_hit(on_line, 0.5);
    expect_near(on_line.normal, {0, 0, 1}); // without a plane, the normal is against the approach
    line_end[0].y = 1e-9;
    expect_miss(impact(kFace, line, line_end));

    const Points point{Vec3{1, 1, 1}, Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 0}};
    Points point_end = point;
    point_end[0] = {-1, -1, -1};
    expect_hit(impact(kFace, point, point_end), 0.5);
    point_end[0] = {-1, -1, -1.5};
    expect_miss(impact(kFace, point, point_end));

    // A face that is flat only at t = 1/2, when the vertex crosses its line.
    const Points turning{Vec3{0.5, 0, 1}, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
    Points turned{Vec3{0.5, 0, -1}, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, -1, 0}};
    expect_hit(impact(kFace, turning, turned), 0.5);
}

TEST(VertexFace, WithoutMotion) {
    expect_hit(impact(kFace, face_and({0.25, 0.25, 0}), face_and({0.25, 0.25, 0})), 0);
    expect_miss(impact(kFace, face_and({0.25, 0.25, 1}), face_and({0.25, 0.25, 1})));
}

TEST(EdgeEdge, PassThroughEachOther) {
    const auto hit = impact(kEdges, cross_at(3), cross_at(-1));
    expect_hit(hit, 0.75);
    EXPECT_NEAR(hit.barycentric[0], 0.5, 1e-9);
    EXPECT_NEAR(hit.barycentric[1], 0.5, 1e-9);
    EXPECT_EQ(hit.barycentric[2], 0);
    expect_near(hit.normal, {0, 0, 1});
    expect_near(impact(kEdges, cross_at(-1), cross_at(3)).normal, {0, 0, -1});
    expect_miss(impact(kEdges, cross_at(3), cross_at(1)));
}

TEST(EdgeEdge, TouchAtEndsOfEdgesAndOfTime) {
    expect_hit(impact(kEdges, cross_at(1), cross_at(0)), 1);
    expect_hit(impact(kEdges, cross_at(0), cross_at(1)), 0);
    // A T: the end of one edge on the other.
    Points t_start = cross_at(1), t_end = cross_at(-1);
    for (Points* p : {&t_start, &t_end})
        (*p)[0].x = 0;
    expect_hit(impact(kEdges, t_start, t_end), 0.5);
    for (Points* p : {&t_start, &t_end})
        (*p)[0].x = 0x1p-1000;
    expect_miss(impact(kEdges, t_start, t_end));
}

TEST(EdgeEdge, ParallelEdges) {
    const Points start{Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0.5, 0, 0}, Vec3{2, 0, 0}};
    Points end = start;
    end[0].z = end[1].z = -1;
    const auto hit = impact(kEdges, start, end);
    expect_hit(hit, 0.5);
    expect_near(hit.normal, {0, 0, 1});
    for (Vec3& p : end)
        p.y = 0.25;
    expect_hit(impact(kEdges, start, end), 0.5);
    end[0].x = -2, end[1].x = -1; // moves away along their line before they meet
    Points away = start;
    away[0].x = -2, away[1].x = -1;
    expect_miss(impact(kEdges, away, end));
    // On one line: one edge runs into the other's end.
    const Points line{Vec3{-3, 0, 0}, Vec3{-2, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 0, 0}};
    Points line_end = line;
    line_end[0].x = 1, line_end[1].x = 2;
    expect_hit(impact(kEdges, line, line_end), 0.5);
}

// Found by the soak test: in a plane, ends meet edges at times 1.6e-14 apart.
TEST(EdgeEdge, IsNotLateAmongAdjacentTimes) {
    const Points start{Vec3{-0x1.e3423e3c65332p-2, -0x1.b273132125cfap-1, 0},
                       Vec3{0x1.25a2975b6621p+0, -0x1.0f0d13dbb7bdp-2, 0},
                       Vec3{-0x1.e3423e3c65332p-2, -0x1.b273132125cf9p-1, 0},
                       Vec3{0x1.8bfa100c66adap-1, 0x1.cf7ab0692cebp-2, 0}};
    const Points end{Vec3{-0x1.e3ffe871f53d4p-2, -0x1.b0c7132532c2ap-1, 0},
                     Vec3{0x1.26677722b850cp+0, -0x1.102e8aafbee0ep-2, 0},
                     Vec3{-0x1.e321eb4397028p-2, -0x1.b16d7db1a458dp-1, 0},
                     Vec3{0x1.8c9a1a53ce73ap-1, 0x1.cf7cd11de9c9fp-2, 0}};
    // Rational arithmetic shows that they are apart at 7e-14 and in contact right after.
    expect_hit(impact(kEdges, start, end), 7.1054e-14);
}

TEST(EdgeEdge, EdgesWithoutLength) {
    const Points start{Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, -1, 0}, Vec3{0, 1, 0}};
    Points end = start;
    end[0].z = end[1].z = -3;
    expect_hit(impact(kEdges, start, end), 0.25);
    const Points two{Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 0, -1}};
    Points met = two;
    for (Vec3& p : met)
        p.z = 0;
    expect_hit(impact(kEdges, two, met), 1);
    // An edge without length at t = 1/2 only.
    const Points shrinking{Vec3{-1, 0, 1}, Vec3{1, 0, 1}, Vec3{0, -1, 0}, Vec3{0, 1, 0}};
    const Points grown{Vec3{1, 0, -1}, Vec3{-1, 0, -1}, Vec3{0, -1, 0}, Vec3{0, 1, 0}};
    expect_hit(impact(kEdges, shrinking, grown), 0.5);
}

TEST(ElementaryImpact, AnySizeOfCoordinates) {
    const auto scaled = [](const Points& p, double s) {
        Points r = p;
        for (Vec3& v : r)
            v = s * v;
        return r;
    };
    for (const double s : {1e-160, 1e-300, 0x1p-1070, 1e150, 1e300}) {
        SCOPED_TRACE(s);
        expect_hit(impact(kEdges, scaled(cross_at(3), s), scaled(cross_at(-1), s)), 0.75);
        expect_miss(impact(kEdges, scaled(cross_at(3), s), scaled(cross_at(1), s)));
    }
    // Huge and tiny sizes together: an edge of half length 1e-300 moves from z = 1e150 to -1e150.
    expect_hit(impact(kEdges, cross_at(1e150, 1e-300), cross_at(-1e150, 1e-300)), 0.5);
    Points aside_start = cross_at(1e150, 1e-300), aside_end = cross_at(-1e150, 1e-300);
    for (Points* p : {&aside_start, &aside_end})
        (*p)[0].x += 3e-300, (*p)[1].x += 3e-300;
    expect_miss(impact(kEdges, aside_start, aside_end));
}

TEST(ElementaryImpact, ConservativeReportsNearPairs) {
    // The double root of VertexFace.TouchesAndTurnsBack.
    ElementaryPair pair{kFace,
                        {Vec3{0, 0.25, 1}, Vec3{0, 0, 2}, Vec3{1, 0, 0}, Vec3{0, 1, 2}},
                        {Vec3{1, 0.25, 1}, Vec3{0, 0, 0}, Vec3{1, 0, 2}, Vec3{0, 1, 0}}};
    const auto near = elementary_impact(pair, {.absolute_error = 1e-3});
    ASSERT_TRUE(near.meet);
    EXPECT_EQ(near.status, Status::bound_only);
    EXPECT_EQ(near.decided_by, ElementaryStage::interval);
    EXPECT_LE(near.time, 0.5);
    EXPECT_EQ(elementary_impact(pair).decided_by, ElementaryStage::exact);
}

TEST(ElementaryImpact, BadInputIsRefused) {
    ElementaryPair pair{kFace, face_and({0, 0, 1}), face_and({0, 0, -1})};
    EXPECT_THROW(elementary_impact(pair, {.absolute_error = -1}), Error);
    EXPECT_THROW(
        elementary_impact(pair, {.absolute_error = std::numeric_limits<double>::infinity()}),
        Error);
    EXPECT_THROW(
        elementary_impact(pair, {.absolute_error = std::numeric_limits<double>::quiet_NaN()}),
        Error);
    std::vector<ElementaryPair> pairs(3, pair);
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
        pairs[2].end[3].y = bad;
        EXPECT_THROW(elementary_impact(pairs[2]), Error);
        try {
            elementary_impacts(pairs);
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
            EXPECT_EQ(std::string(error.what()).rfind("pair 2: ", 0), 0U) << error.what();
        }
    }
    EXPECT_TRUE(elementary_impacts({}).empty());
}

} // namespace
} // namespace abut
