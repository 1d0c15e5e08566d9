// Surfaces at rest that pass through themselves or each other: cases worked by hand.

#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/rigid.h>

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// The triangle 0, 1, 2 in the plane z = 0, and the triangle 3, 4, 5 that hangs from the edge 3 4.
Mesh face_and_edge(const Vec3& p, const Vec3& q, const Vec3& away = {9, 9, 1}) {
    return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, p, q, away}, {{0, 1, 2}, {3, 4, 5}}};
}

std::vector<EdgeFaceIntersection> found_in(const Mesh& mesh) {
    return self_intersections(Deformable(mesh));
}

TEST(Intersections, AnEdgeThroughAFaceIsFoundAtRest) {
    const Deformable surface(face_and_edge({1, 1, -1}, {1, 1, 3}));
    // The triangles share a segment: one end is on the edge 3 4, the other on the edge 1 2.
    const auto found = self_intersections(surface);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(surface.edges().at(found[0].edge), (std::array<std::uint32_t, 2>{1, 2}));
    EXPECT_EQ(found[0].face, 1U);
    EXPECT_EQ(found[0].point, (Vec3{2, 2, 0}));
    const EdgeFaceIntersection& only = found[1];
    EXPECT_EQ(surface.edges().at(only.edge), (std::array<std::uint32_t, 2>{3, 4}));
    EXPECT_EQ(only.face, 0U);
    EXPECT_FALSE(only.face_first);
    EXPECT_EQ(only.contact, EdgeFaceContact::crossing);
    EXPECT_EQ(only.point, (Vec3{1, 1, 0}));
    EXPECT_DOUBLE_EQ(only.along, 0.25);
    EXPECT_DOUBLE_EQ(only.barycentric[0], 0.5);
    EXPECT_DOUBLE_EQ(only.barycentric[1], 0.25);
    EXPECT_DOUBLE_EQ(only.barycentric[2], 0.25);
}

TEST(Intersections, TouchingIsToldFromCrossing) {
    // The edge ends on the face. Then both edges at its end touch, and no edge of the face does.
    auto found = found_in(face_and_edge({1, 1, 0}, {1, 1, 3}, {1, 2, 3}));
    ASSERT_EQ(found.size(), 2U);
    for (const EdgeFaceIntersection& each : found) {
        EXPECT_EQ(each.contact, EdgeFaceContact::touching);
        EXPECT_EQ(each.point, (Vec3{1, 1, 0}));
    }
    // It passes through the face's border: then that edge touches the other face, too.
    found = found_in(face_and_edge({2, 2, -1}, {2, 2, 1}));
    ASSERT_EQ(found.size(), 2U);
    for (const EdgeFaceIntersection& each : found)
        EXPECT_EQ(each.contact, EdgeFaceContact::touching);
    // It passes the border at the distance of one rounding, inside and outside.
    const double inside = std::nextafter(2.0, 0.0), outside = std::nextafter(2.0, 3.0);
    found = found_in(face_and_edge({2, inside, -1}, {2, inside, 1}));
    ASSERT_EQ(found.size(), 2U);
    for (const EdgeFaceIntersection& each : found)
        EXPECT_EQ(each.contact, EdgeFaceContact::crossing);
    EXPECT_TRUE(found_in(face_and_edge({2, outside, -1}, {2, outside, 1})).empty());
}

TEST(Intersections, AnEdgeInThePlaneOfAFaceIsCoplanar) {
    const Deformable surface(face_and_edge({1, 1, 0}, {9, 1, 0}, {9, 1, 5}));
    const auto found = self_intersections(surface);
    // The other pairs touch at one point each.
    std::size_t coplanar = 0;
    for (const EdgeFaceIntersection& each : found)
        if (each.contact == EdgeFaceContact::coplanar) {
            ++coplanar;
            EXPECT_EQ(each.point, (Vec3{2, 1, 0})); // the middle of (1, 1, 0) to (3, 1, 0)
            EXPECT_DOUBLE_EQ(each.along, 0.125);
        }
    EXPECT_EQ(coplanar, 1U);
}

TEST(Intersections, DegenerateFacesAndEdgesTouch) {
    Mesh mesh = face_and_edge({1, 1, -1}, {1, 1, 1});
    mesh.positions[1] = {2, 2, 0}; // the face becomes the segment from the origin to (4, 4, 0)
    mesh.positions[2] = {4, 4, 0};
    auto found = found_in(mesh);
    EXPECT_FALSE(found.empty());
    for (const EdgeFaceIntersection& each : found)
        if (each.face == 0) {
            EXPECT_EQ(each.contact, EdgeFaceContact::touching);
        }
    // All of the second triangle lies at one point of the first.
    found = found_in(face_and_edge({1, 1, 0}, {1, 1, 0}, {1, 1, 0}));
    EXPECT_EQ(found.size(), 3U);
    for (const EdgeFaceIntersection& each : found) {
        EXPECT_EQ(each.contact, EdgeFaceContact::touching);
        EXPECT_EQ(each.point, (Vec3{1, 1, 0}));
        EXPECT_EQ(each.along, 0);
    }
}

TEST(Intersections, NeighboursAreNoPair) {
    // Two triangles with a common edge, folded flat onto each other.
    EXPECT_TRUE(
        found_in({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}}).empty());
    // With one common vertex: the edge opposite to it passes through the other triangle.
    const auto found = found_in(
        {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}}, {{0, 1, 2}, {0, 3, 4}}});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].contact, EdgeFaceContact::crossing);
}

TEST(Intersections, StartAndEndOfAStep) {
    const Mesh apart = face_and_edge({1, 1, 1}, {1, 1, 3}),
               through = face_and_edge({1, 1, -1}, {1, 1, 3});
    Deformable surface(apart);
    surface.advance(through.positions);
    EXPECT_TRUE(self_intersections(surface).empty());
    EXPECT_EQ(self_intersections(surface, {.at_end = true}), found_in(through));
    surface.advance(apart.positions);
    EXPECT_EQ(self_intersections(surface), found_in(through));
    EXPECT_TRUE(self_intersections(surface, {.at_end = true}).empty());
}

TEST(Intersections, TwoSurfaces) {
    const Mesh both = face_and_edge({1, 1, -1}, {1, 1, 3});
    const Deformable face({both.positions, {both.triangles[0]}}),
        edge({both.positions, {both.triangles[1]}}, {.scheme = Scheme::features});
    const auto one = intersections(face, edge), other = intersections(edge, face);
    ASSERT_EQ(one.size(), 2U);
    EXPECT_FALSE(one[0].face_first); // the edge 1 2 through the hanging triangle
    EXPECT_TRUE(one[1].face_first);
    EXPECT_EQ(one[1].point, (Vec3{1, 1, 0}));
    ASSERT_EQ(other.size(), 2U);
    EXPECT_FALSE(other[0].face_first);
    EXPECT_EQ(one[1].point, other[0].point);
    EXPECT_EQ(intersections(face, edge).size(), self_intersections(Deformable(both)).size());
    EXPECT_TRUE(intersections(face, face).empty());
    EXPECT_TRUE(intersections(face, Deformable(Mesh{})).empty());
    EXPECT_TRUE(self_intersections(Deformable(Mesh{})).empty());
}

TEST(Intersections, TheStopFlagEndsThem) {
    const Deformable surface(face_and_edge({1, 1, -1}, {1, 1, 3}));
    const std::atomic<bool> stop = true;
    IntersectionOptions stopped;
    stopped.progress.stop = &stop;
    for (const auto& query : {0, 1})
        try {
            if (query == 0)
                self_intersections(surface, stopped);
            else
                intersections(surface, Deformable(Mesh{}), stopped);
            ADD_FAILURE() << query;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::interrupted);
        }
}

/// The model of a surface follows its steps, and models of earlier steps stay as they were.
TEST(DeformableModel, IsTheSurfaceAtTheStartOfItsStep) {
    const Mesh first = face_and_edge({1, 1, 1}, {1, 1, 3}),
               second = face_and_edge({1, 1, 2}, {1, 1, 3});
    Deformable surface(first);
    const Model before = surface.model();
    surface.advance(second.positions);
    EXPECT_EQ(surface.model().mesh().positions, first.positions);
    surface.advance(second.positions);
    EXPECT_EQ(surface.model().mesh().positions, second.positions);
    EXPECT_EQ(&surface.model().data(), &surface.model().data());
    EXPECT_EQ(before.mesh().positions, first.positions);
    surface.set_mesh(Mesh{});
    EXPECT_TRUE(surface.model().mesh().triangles.empty());
}

} // namespace
} // namespace abut::test
