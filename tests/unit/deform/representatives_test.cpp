#include <abut/error.h>
#include <abut/representatives.h>

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Two triangles with a common edge, and a third one apart from them.
const Triangles kThree{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}};

TEST(Representatives, FirstTriangleRepresents) {
    const Representatives surface(7, kThree);
    EXPECT_EQ(surface.vertex_count(), 7U);
    EXPECT_EQ(surface.triangles(), kThree);
    ASSERT_EQ(surface.edges().size(), 8U);
    EXPECT_EQ(surface.represented()[0], 0b111111);
    EXPECT_EQ(surface.represented()[1], 0b110100); // vertex 3, and the edges to it
    EXPECT_EQ(surface.represented()[2], 0b111111);
}

TEST(Representatives, NeighboursLeadToTheTestsOfFeaturesApart) {
    const Representatives surface(7, kThree);
    const std::vector<FeatureTest> tests =
        self_feature_tests(surface, std::vector<TrianglePair>{{1, 0}});
    // Vertex 3 with face 0, vertex 0 with face 1, and no two edges without a common vertex but
    // (0, 1) with (2, 3) and (0, 2) with (1, 3).
    ASSERT_EQ(tests.size(), 4U);
    EXPECT_EQ(tests[0].kind, ElementaryKind::edge_edge);
    EXPECT_EQ(tests[1].kind, ElementaryKind::edge_edge);
    EXPECT_LT(tests[0].a, tests[0].b);
    const FeatureTest first{ElementaryKind::vertex_face, false, 3, 0, {3, 0, 1, 2}};
    const FeatureTest second{ElementaryKind::vertex_face, false, 0, 1, {0, 2, 1, 3}};
    EXPECT_EQ(tests[2], first);
    EXPECT_EQ(tests[3], second);
}

TEST(Representatives, BetweenTwoSurfaces) {
    const Representatives a(7, kThree), b(3, {{0, 1, 2}});
    const std::vector<FeatureTest> tests = feature_tests(a, b, std::vector<TrianglePair>{{1, 0}});
    ASSERT_EQ(tests.size(), 2 * 3 + 1 + 3U);
    EXPECT_EQ(tests[6], (FeatureTest{ElementaryKind::vertex_face, false, 3, 0, {3, 0, 1, 2}}));
    EXPECT_EQ(tests[7], (FeatureTest{ElementaryKind::vertex_face, true, 0, 1, {0, 2, 1, 3}}));
    EXPECT_THROW(feature_tests(a, a, {}), Error);
}

TEST(Representatives, BoxesOfFeaturesRejectTests) {
    Representatives surface(6, {{0, 1, 2}, {3, 4, 5}});
    const std::vector<TrianglePair> pairs{{0, 1}};
    EXPECT_EQ(self_feature_tests(surface, pairs).size(), 15U);
    // The second triangle lies 1 above the first; then its vertex 3 sinks below it.
    std::vector<Vec3> start{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1.2, 1, 1}, {1, 1.2, 1}};
    std::vector<Vec3> end = start;
    surface.set_motion(start, end);
    EXPECT_TRUE(self_feature_tests(surface, pairs).empty());
    EXPECT_EQ(self_feature_tests(surface, pairs, 1000).size(), 15U);
    end[3].z = -1;
    surface.set_motion(start, end);
    const auto tests = self_feature_tests(surface, pairs);
    EXPECT_LT(tests.size(), 15U);
    EXPECT_EQ(std::count_if(tests.begin(), tests.end(),
                            [](const FeatureTest& test) {
                                return test.kind == ElementaryKind::vertex_face && test.a == 3;
                            }),
              1);
    surface.set_triangles(6, surface.triangles()); // forgets the motion
    EXPECT_EQ(self_feature_tests(surface, pairs).size(), 15U);
}

TEST(Representatives, ChangesKeepEdgesOfOtherTriangles) {
    Representatives surface(7, kThree);
    const auto edges = surface.edges();
    const std::vector<std::uint8_t> represented = surface.represented();
    // Without the first triangle, the second one represents their common edge and its vertices.
    surface.set_triangles(8, Triangles{{0, 7, 2}, {2, 1, 3}, {4, 5, 6}});
    EXPECT_EQ(surface.represented()[1], 0b111110); // vertices 1 and 3, all three edges
    EXPECT_EQ(surface.represented()[2], represented[2]);
    ASSERT_EQ(surface.edges().size(), 9U); // (0, 1) is gone; (0, 7) and (2, 7) are new
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (edges[i][0] != 0) { // the edges of the first triangle alone begin at vertex 0
            EXPECT_EQ(surface.edges()[i], edges[i]);
        }
    surface.set_triangles(0, {});
    EXPECT_TRUE(surface.triangles().empty());
    for (const auto& edge : surface.edges())
        EXPECT_EQ(edge[0], 0xffffffffU);
    EXPECT_TRUE(self_feature_tests(surface, {}).empty());
}

TEST(Representatives, BadArgumentsChangeNothing) {
    EXPECT_THROW(Representatives(3, {{0, 1, 3}}), Error);
    Representatives surface(7, kThree);
    EXPECT_THROW(surface.set_triangles(6, kThree), Error);
    EXPECT_EQ(surface.vertex_count(), 7U);
    const std::vector<Vec3> at(7), nowhere(7, Vec3{std::numeric_limits<double>::quiet_NaN(), 0, 0});
    EXPECT_THROW(surface.set_motion(at, std::span(at).first(6)), Error);
    EXPECT_THROW(surface.set_motion(at, nowhere), Error);
    const std::vector<TrianglePair> pairs{{0, 2}}, outside{{0, 3}};
    EXPECT_EQ(self_feature_tests(surface, pairs).size(), 15U);
    EXPECT_THROW(self_feature_tests(surface, outside), Error);
    EXPECT_THROW(self_feature_tests(surface, pairs, -1), Error);
    EXPECT_THROW(self_feature_tests(surface, pairs, std::numeric_limits<double>::infinity()),
                 Error);
    const std::vector<TrianglePair> itself{{1, 1}};
    EXPECT_TRUE(self_feature_tests(surface, itself).empty());
    EXPECT_GT(surface.bytes(), 0U);
}

} // namespace
} // namespace abut::test
