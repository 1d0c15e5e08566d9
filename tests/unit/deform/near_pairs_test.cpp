// Pairs of near features: what a constraint needs, worked by hand; and errors.

#include <abut/deformable.h>
#include <abut/error.h>

#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace abut::test {
namespace {

/// A large triangle in the plane z = 0, counter-clockwise as seen from above, and a small one whose
/// first vertex is at `tip` and whose others are far above.
Deformable triangle_and_tip(const Vec3& tip) {
    return Deformable(
        Mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, tip, {1, 2, 9}, {2, 1, 9}}, {{0, 1, 2}, {3, 4, 5}}});
}
/// Two triangles that reach each other only with an edge along x at z = 0 and an edge along y at
/// height z.
Deformable crossed_edges(double z) {
    return Deformable(
        Mesh{{{-1, 0, 0}, {1, 0, 0}, {0, 0, -5}, {0, -1, z}, {0, 1, z}, {0, 0, z + 5}},
             {{0, 1, 2}, {3, 4, 5}}});
}

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-15);
    EXPECT_NEAR(a.y, b.y, 1e-15);
    EXPECT_NEAR(a.z, b.z, 1e-15);
}

TEST(NearPairs, VertexAboveFace) {
    const auto pairs = self_within(triangle_and_tip({1, 1, 0.25}), 0.5);
    ASSERT_EQ(pairs.size(), 1U);
    const FeaturePair& pair = pairs[0];
    EXPECT_EQ(pair.kind, ElementaryKind::vertex_face);
    EXPECT_EQ(pair.a, 3U);
    EXPECT_EQ(pair.b, 0U);
    EXPECT_EQ(pair.vertices, (std::array<std::uint32_t, 4>{3, 0, 1, 2}));
    EXPECT_EQ(pair.distance, 0.25);
    EXPECT_EQ(pair.limit, 0.5);
    EXPECT_EQ(pair.side, 1);
    EXPECT_EQ(pair.point_a, (Vec3{1, 1, 0.25}));
    expect_near(pair.point_b, {1, 1, 0});
    expect_near(pair.normal, {0, 0, 1});
    EXPECT_EQ(pair.weights, (std::array<double, 4>{1, -0.5, -0.25, -0.25}));
}

TEST(NearPairs, VertexBelowFace) {
    // From below, the triangle's vertices run clockwise.
    const Deformable surface(
        Mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -0.25}, {1, 2, -9}, {2, 1, -9}},
             {{0, 1, 2}, {3, 4, 5}}});
    const auto pairs = self_within(surface, 0.5);
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].side, -1);
    expect_near(pairs[0].normal, {0, 0, -1});
}

TEST(NearPairs, TouchingVertexHasTheFacesNormal) {
    const auto pairs = self_within(triangle_and_tip({1, 1, 0}), 0);
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].distance, 0);
    EXPECT_EQ(pairs[0].side, 0);
    expect_near(pairs[0].normal, {0, 0, 1});
}

TEST(NearPairs, CrossedEdges) {
    for (const double z : {0.25, -0.25}) {
        const auto pairs = self_within(crossed_edges(z), 0.5);
        ASSERT_FALSE(pairs.empty());
        const FeaturePair* crossed = nullptr;
        for (const FeaturePair& pair : pairs)
            if (pair.vertices == std::array<std::uint32_t, 4>{0, 1, 3, 4})
                crossed = &pair;
        ASSERT_NE(crossed, nullptr);
        EXPECT_EQ(crossed->kind, ElementaryKind::edge_edge);
        // e_a x e_b is along +z, and a lies below b for a positive z.
        EXPECT_EQ(crossed->side, z > 0 ? -1 : 1);
        expect_near(crossed->normal, {0, 0, z > 0 ? -1.0 : 1.0});
        expect_near(crossed->point_a, {0, 0, 0});
        expect_near(crossed->point_b, {0, 0, z});
        EXPECT_EQ(crossed->weights, (std::array<double, 4>{0.5, 0.5, -0.5, -0.5}));
    }
    const auto touching = self_within(crossed_edges(0), 0);
    ASSERT_EQ(touching.size(), 1U);
    EXPECT_EQ(touching[0].side, 0);
    expect_near(touching[0].normal, {0, 0, 1});
}

TEST(NearPairs, ThicknessOfAFeatureIsItsLargest) {
    const Deformable surface = triangle_and_tip({1, 1, 0.25});
    std::vector<double> thickness(6, 0.0);
    thickness[2] = 0.125; // of the face
    EXPECT_TRUE(self_within(surface, 0.0625, {.vertices = {.thickness = thickness}}).empty());
    thickness[3] = 0.0625; // of the tip
    const auto pairs = self_within(surface, 0.0625, {.vertices = {.thickness = thickness}});
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].limit, 0.25);
}

TEST(NearPairs, GroupsAndMasksMustAgree) {
    const Deformable surface = triangle_and_tip({1, 1, 0.25});
    const std::vector<std::uint32_t> groups{1, 1, 1, 2, 2, 2};
    const auto count = [&](std::uint32_t of_face, std::uint32_t of_tip) {
        const std::vector<std::uint32_t> masks{of_face, of_face, of_face, of_tip, of_tip, of_tip};
        return self_within(surface, 0.5, {.vertices = {.groups = groups, .masks = masks}}).size();
    };
    EXPECT_EQ(count(2, 1), 1U);
    EXPECT_EQ(count(3, 3), 1U);
    EXPECT_EQ(count(1, 1), 0U);
    EXPECT_EQ(count(2, 2), 0U);
    EXPECT_EQ(count(0, ~0U), 0U);
}

TEST(NearPairs, OnlyPairsThatMoved) {
    const Deformable surface = triangle_and_tip({1, 1, 0.25});
    for (std::uint32_t v = 0; v < 6; ++v) {
        std::vector<std::uint8_t> moved(6, 0);
        moved[v] = 1;
        // The pair consists of vertices 0 to 3.
        EXPECT_EQ(self_within(surface, 0.5, {.vertices = {.moved = moved}}).size(),
                  v <= 3 ? 1U : 0U);
    }
}

TEST(NearPairs, AtTheEndOfTheStep) {
    Deformable surface = triangle_and_tip({1, 1, 3});
    EXPECT_TRUE(self_within(surface, 0.5, {.at_end = true}).empty());
    surface.advance(
        std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0.25}, {1, 2, 9}, {2, 1, 9}});
    EXPECT_TRUE(self_within(surface, 0.5).empty());
    EXPECT_EQ(self_within(surface, 0.5, {.at_end = true}).size(), 1U);
}

TEST(NearPairs, Errors) {
    const Deformable surface = triangle_and_tip({1, 1, 3}), other = triangle_and_tip({1, 1, 2});
    const std::vector<double> five(5, 0.0), six(6, 0.0), negative(6, -1.0),
        infinite(6, std::numeric_limits<double>::infinity());
    const std::vector<std::uint32_t> bits(7, 1U);
    const std::vector<std::uint8_t> moved(1, 1);
    const auto fails = [](const auto& query) {
        try {
            query();
        } catch (const Error& error) {
            return error.code() == ErrorCode::bad_argument;
        }
        return false;
    };
    for (const NearVertices& bad :
         {NearVertices{.thickness = five}, NearVertices{.thickness = negative},
          NearVertices{.thickness = infinite}, NearVertices{.groups = bits},
          NearVertices{.masks = bits}, NearVertices{.moved = moved}}) {
        EXPECT_TRUE(fails([&] { self_within(surface, 1, {.vertices = bad}); }));
        EXPECT_TRUE(fails([&] { within(surface, other, 1, {.vertices_b = bad}); }));
    }
    EXPECT_TRUE(fails([&] { self_within(surface, -1); }));
    EXPECT_TRUE(fails([&] { self_within(surface, 1, {.vertices_b = {.thickness = six}}); }));
    EXPECT_FALSE(fails([&] { within(surface, other, 1, {.vertices_b = {.thickness = six}}); }));
}

} // namespace
} // namespace abut::test
