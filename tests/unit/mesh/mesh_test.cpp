#include <abut/error.h>
#include <abut/mesh.h>

#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

const Mesh kCube = box_mesh({0, 0, 0}, {1, 2, 3});

TEST(Inspect, Cube) {
    const MeshReport r = inspect(kCube);
    EXPECT_EQ(r.vertices, 8U);
    EXPECT_EQ(r.distinct_vertices, 8U);
    EXPECT_EQ(r.triangles, 12U);
    EXPECT_EQ(r.degenerate_triangles, 0U);
    EXPECT_EQ(r.duplicate_triangles, 0U);
    EXPECT_EQ(r.boundary_edges, 0U);
    EXPECT_EQ(r.nonmanifold_edges, 0U);
    EXPECT_EQ(r.flipped_edges, 0U);
    EXPECT_EQ(r.components, 1U);
    EXPECT_TRUE(r.closed);
    EXPECT_EQ(r.bounds, (Box3{{0, 0, 0}, {1, 2, 3}}));
}

TEST(Inspect, EqualPositionsCountAsOne) {
    Mesh soup;
    for (const auto& t : kCube.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (const std::uint32_t v : t)
            soup.positions.push_back(kCube.positions[v]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    // -0.0 equals 0.0.
    for (std::size_t i = 0; i < soup.positions.size(); i += 2)
        if (soup.positions[i].x == 0)
            soup.positions[i].x = -0.0;
    const MeshReport r = inspect(soup);
    EXPECT_EQ(r.vertices, 36U);
    EXPECT_EQ(r.distinct_vertices, 8U);
    EXPECT_TRUE(r.closed);
    EXPECT_EQ(r.components, 1U);
}

TEST(Inspect, OpenBox) {
    const MeshReport r = inspect(open_box_mesh({0, 0, 0}, {1, 1, 1}));
    EXPECT_EQ(r.triangles, 10U);
    EXPECT_EQ(r.boundary_edges, 4U);
    EXPECT_FALSE(r.closed);
}

TEST(Inspect, FlippedTriangle) {
    Mesh m = kCube;
    std::swap(m.triangles[0][1], m.triangles[0][2]);
    const MeshReport r = inspect(m);
    EXPECT_EQ(r.flipped_edges, 3U);
    EXPECT_TRUE(r.closed); // every edge is still used by two triangles
}

TEST(Inspect, NonmanifoldEdge) {
    Mesh m = kCube;
    m.positions.push_back({9, 9, 9});
    m.triangles.push_back({0, 1, 8}); // a fin on the edge 0-1
    const MeshReport r = inspect(m);
    EXPECT_EQ(r.nonmanifold_edges, 1U);
    EXPECT_EQ(r.boundary_edges, 2U);
    EXPECT_FALSE(r.closed);
}

TEST(Inspect, DuplicateAndDegenerateTriangles) {
    Mesh m = kCube;
    m.triangles.push_back({3, 0, 2}); // the first triangle, from another vertex
    m.triangles.push_back({0, 3, 2}); // the first triangle, reversed
    m.triangles.push_back({1, 1, 1});
    m.triangles.push_back({0, 7, 0});
    m.positions.push_back({0.5, 1, 1.5});
    m.triangles.push_back({0, 7, 8}); // all three on the space diagonal
    const MeshReport r = inspect(m);
    EXPECT_EQ(r.duplicate_triangles, 2U);
    EXPECT_EQ(r.degenerate_triangles, 3U);
    EXPECT_FALSE(r.closed);
}

TEST(Inspect, TrianglesWithTwoEqualVerticesDoNotOpenAMesh) {
    Mesh m = kCube;
    m.triangles.push_back({0, 7, 0});
    EXPECT_TRUE(inspect(m).closed);
}

TEST(Inspect, UnreferencedVertices) {
    Mesh m = kCube;
    m.positions.push_back({100, 100, 100});
    const MeshReport r = inspect(m);
    EXPECT_EQ(r.vertices, 9U);
    EXPECT_EQ(r.distinct_vertices, 9U);
    EXPECT_EQ(r.components, 1U);
    EXPECT_EQ(r.bounds, (Box3{{0, 0, 0}, {1, 2, 3}}));
    EXPECT_TRUE(r.closed);
}

TEST(Inspect, ComponentsAreJoinedByVertices) {
    const Mesh two = joined(kCube, box_mesh({5, 0, 0}, {6, 1, 1}));
    EXPECT_EQ(inspect(two).components, 2U);
    EXPECT_TRUE(inspect(two).closed);
    EXPECT_EQ(inspect(joined(kCube, box_mesh({1, 2, 3}, {4, 4, 4}))).components, 1U); // share one
                                                                                      // corner
}

TEST(Inspect, NothingAtAll) {
    const MeshReport r = inspect({});
    EXPECT_EQ(r.triangles, 0U);
    EXPECT_EQ(r.components, 0U);
    EXPECT_FALSE(r.closed);
    EXPECT_EQ(r.bounds, Box3{});
}

void expect_bad(const Mesh& mesh, const std::string& text) {
    try {
        (void)inspect(mesh);
        FAIL() << "no error: " << text;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_mesh);
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST(Inspect, BadMeshesAreErrors) {
    Mesh m = kCube;
    m.triangles[3][1] = 8;
    expect_bad(m, "triangle 3 uses vertex 8 of 8");
    m = kCube;
    m.positions[5].y = std::numeric_limits<double>::quiet_NaN();
    expect_bad(m, "vertex 5");
    m.positions[5].y = -std::numeric_limits<double>::infinity();
    expect_bad(m, "not finite");
    m.positions[5].y = -1.0000000000000002e18;
    expect_bad(m, "beyond 1e18");
    m.positions[5].y = -1e18;
    EXPECT_NO_THROW((void)inspect(m));
    expect_bad({{}, {{0, 0, 0}}}, "uses vertex 0 of 0");
}

} // namespace
} // namespace abut::test
