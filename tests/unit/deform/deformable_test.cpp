#include <abut/deformable.h>
#include <abut/error.h>

#include "tests/support/moving_meshes.h"

#include <gtest/gtest.h>
#include <limits>
#include <span>
#include <vector>

namespace abut::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A triangle in the plane z = 0, and one below it that points a vertex up and rises by 2.
MovingMesh rising_tip() {
    MovingMesh moving;
    moving.mesh.positions = {{-2, -1, 0}, {2, -1, 0},    {0, 3, 0},
                             {0, 0, -1},  {-0.5, 0, -3}, {0.5, 0, -3}};
    moving.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    moving.end = moving.mesh.positions;
    for (std::size_t i = 3; i < 6; ++i)
        moving.end[i].z += 2;
    return moving;
}

TEST(Deformable, VertexThroughFace) {
    const Impacts impacts = self_impacts(rising_tip().deformable());
    ASSERT_EQ(impacts.list.size(), 1U);
    const FeatureImpact& impact = impacts.list[0];
    EXPECT_EQ(impact.kind, ElementaryKind::vertex_face);
    EXPECT_EQ(impact.status, Status::exact);
    EXPECT_FALSE(impact.face_first);
    EXPECT_EQ(impact.a, 3U);
    EXPECT_EQ(impact.b, 0U);
    EXPECT_NEAR(impact.time, 0.5, 1e-9);
    EXPECT_LE(impact.time, 0.5);
    EXPECT_NEAR(impact.barycentric[0], 0.375, 1e-9);
    EXPECT_NEAR(impact.barycentric[1], 0.375, 1e-9);
    EXPECT_NEAR(impact.barycentric[2], 0.25, 1e-9);
    EXPECT_NEAR(impact.normal.z, -1, 1e-9); // towards the vertex, which comes from below
}

TEST(Deformable, EdgesThatCross) {
    MovingMesh moving;
    moving.mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 0, -5}, {0, -1, 4}, {0, 1, 4}, {0, 0, 9}};
    moving.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    moving.end = moving.mesh.positions;
    for (std::size_t i = 3; i < 6; ++i)
        moving.end[i].z -= 5;
    const Impacts impacts = self_impacts(moving.deformable());
    ASSERT_EQ(impacts.list.size(), 1U);
    EXPECT_EQ(impacts.list[0].kind, ElementaryKind::edge_edge);
    EXPECT_NEAR(impacts.list[0].time, 0.8, 1e-9);
    EXPECT_NEAR(impacts.list[0].barycentric[0], 0.5, 1e-9);
    const Deformable surface = moving.deformable();
    EXPECT_EQ(surface.edges()[impacts.list[0].a], (std::array<std::uint32_t, 2>{0, 1}));
    EXPECT_EQ(surface.edges()[impacts.list[0].b], (std::array<std::uint32_t, 2>{3, 4}));
}

TEST(Deformable, FaceOfTheFirstAndVertexOfTheSecond) {
    const MovingMesh both = rising_tip();
    MovingMesh face, tip;
    face.mesh.positions = {both.mesh.positions.begin(), both.mesh.positions.begin() + 3};
    face.end = {both.end.begin(), both.end.begin() + 3};
    tip.mesh.positions = {both.mesh.positions.begin() + 3, both.mesh.positions.end()};
    tip.end = {both.end.begin() + 3, both.end.end()};
    face.mesh.triangles = tip.mesh.triangles = {{0, 1, 2}};
    const Deformable a = face.deformable(), b = tip.deformable();
    const Impacts ab = impacts(a, b), ba = impacts(b, a);
    ASSERT_EQ(ab.list.size(), 1U);
    ASSERT_EQ(ba.list.size(), 1U);
    EXPECT_TRUE(ab.list[0].face_first);
    EXPECT_FALSE(ba.list[0].face_first);
    EXPECT_EQ(ab.list[0].time, ba.list[0].time);
    EXPECT_EQ(time_of_impact(a, b), ab.list[0]);
    EXPECT_FALSE(is_free_of_impacts(a, b));
    EXPECT_TRUE(is_free_of_self_impacts(a));
    EXPECT_EQ(self_time_of_impact(a), std::nullopt);
}

TEST(Deformable, NeighboursAreNoPair) {
    MovingMesh moving; // two triangles with a common edge fold onto each other
    moving.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    moving.mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    moving.end = moving.mesh.positions;
    moving.end[3] = {0, 2, 0};
    // Still tested are the edges from vertices 2 and 3, and each of these vertices with the other
    // face.
    for (const FeatureImpact& impact : self_impacts(moving.deformable()).list) {
        if (impact.kind == ElementaryKind::vertex_face) {
            EXPECT_TRUE(impact.a == 2 || impact.a == 3);
        }
    }
    moving.end[3] = moving.mesh.positions[3];
    EXPECT_TRUE(self_impacts(moving.deformable()).list.empty());
}

TEST(Deformable, EqualPositionsAtDifferentIndicesMeet) {
    MovingMesh moving; // two triangles that touch along an edge but share no index
    moving.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, -1, 0}};
    moving.mesh.triangles = {{0, 1, 2}, {4, 3, 5}};
    moving.end = moving.mesh.positions;
    const Impacts impacts = self_impacts(moving.deformable());
    // Four vertices meet the other face. Each edge meets the edges of the other triangle that it
    // touches.
    std::size_t faces = 0;
    for (const FeatureImpact& impact : impacts.list) {
        EXPECT_EQ(impact.time, 0);
        faces += impact.kind == ElementaryKind::vertex_face ? 1 : 0;
    }
    EXPECT_EQ(faces, 4U);
    EXPECT_EQ(impacts.list.size(), 4U + 7U);
}

TEST(Deformable, NothingMeetsNothing) {
    for (const auto scheme : {Scheme::representative, Scheme::database, Scheme::features})
        for (const auto culling : {Culling::tree, Culling::grid, Culling::sweep}) {
            const DeformableOptions options{scheme, Assignment::greedy, culling};
            Deformable empty(Mesh{}, options);
            empty.set_motion(std::vector<Vec3>(), std::vector<Vec3>());
            EXPECT_TRUE(self_impacts(empty).list.empty());
            EXPECT_EQ(self_time_of_impact(empty), std::nullopt);
            const Deformable other = rising_tip().deformable(options);
            EXPECT_TRUE(impacts(empty, other).list.empty());
            EXPECT_TRUE(is_free_of_impacts(other, empty));
            EXPECT_TRUE(empty.edges().empty());
        }
}

TEST(Deformable, UnusedVerticesTakeNoPart) {
    for (const auto scheme : {Scheme::representative, Scheme::features}) {
        MovingMesh moving = rising_tip();
        moving.mesh.positions.push_back({0, 0.5, -1});
        moving.end.push_back({0, 0.5, 1});
        const Impacts impacts = self_impacts(moving.deformable({.scheme = scheme}));
        ASSERT_EQ(impacts.list.size(), 1U);
        EXPECT_EQ(impacts.list[0].a, 3U);
    }
}

TEST(Deformable, EdgesInTheirOrder) {
    Mesh mesh;
    mesh.positions.resize(4);
    mesh.triangles = {{2, 1, 3}, {0, 2, 1}, {0, 0, 3}};
    const Deformable surface(mesh);
    const std::vector<std::array<std::uint32_t, 2>> edges{{0, 1}, {0, 2}, {1, 2},
                                                          {0, 3}, {1, 3}, {2, 3}};
    EXPECT_EQ(surface.edges(), edges);
    EXPECT_EQ(surface.triangles(), mesh.triangles);
    EXPECT_EQ(surface.vertex_count(), 4U);
}

template <typename Call>
ErrorCode code_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.code();
    }
    ADD_FAILURE() << "no error";
    return ErrorCode::bad_argument;
}

TEST(Deformable, BadInputIsAnErrorAndChangesNothing) {
    const MovingMesh moving = rising_tip();
    Deformable surface = moving.deformable();
    const Impacts before = self_impacts(surface);
    auto bad = moving.end;
    bad[4].y = kNaN;
    EXPECT_EQ(code_of([&] { surface.advance(bad); }), ErrorCode::bad_mesh);
    EXPECT_EQ(code_of([&] { surface.set_motion(bad, moving.end); }), ErrorCode::bad_mesh);
    bad[4].y = 1e19;
    EXPECT_EQ(code_of([&] { surface.set_motion(moving.end, bad); }), ErrorCode::bad_mesh);
    bad.pop_back();
    EXPECT_EQ(code_of([&] { surface.advance(bad); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { surface.set_motion(moving.end, bad); }), ErrorCode::bad_argument);
    Mesh mesh = moving.mesh;
    mesh.triangles[1][2] = 6;
    EXPECT_EQ(code_of([&] { surface.set_mesh(mesh); }), ErrorCode::bad_mesh);
    EXPECT_EQ(code_of([&] { const Deformable broken(mesh); }), ErrorCode::bad_mesh);
    EXPECT_EQ(code_of([&] { self_impacts(surface, {.absolute_error = -1}); }),
              ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { self_time_of_impact(surface, {.absolute_error = kNaN}); }),
              ErrorCode::bad_argument);
    EXPECT_EQ(self_impacts(surface).list, before.list);
    const Deformable other = moving.deformable({.scheme = Scheme::markup});
    EXPECT_EQ(code_of([&] { impacts(surface, other); }), ErrorCode::bad_argument);
    const Deformable swept = moving.deformable({.culling = Culling::sweep});
    EXPECT_EQ(code_of([&] { impacts(swept, surface); }), ErrorCode::bad_argument);
}

/// Bounds of boxes stay finite, so that unused children of a node never come within the thickness.
TEST(Deformable, EverythingIsWithinALargeThickness) {
    const MovingMesh moving = rising_tip();
    for (const auto culling : {Culling::tree, Culling::grid, Culling::sweep}) {
        const Deformable surface = moving.deformable({.culling = culling});
        for (const double large : {1e3, 1e40, 1e300}) {
            const Impacts all = self_impacts(surface, {.thickness = large});
            EXPECT_EQ(all.list.size(), 6U + 9U) << large;
            EXPECT_EQ(self_time_of_impact(surface, {.thickness = large}), all.list.at(0)) << large;
            EXPECT_EQ(self_within(surface, large).size(), 6U + 9U) << large;
        }
    }
}

/// Arrays of doubles and of floats are the same step as vectors, if the values are.
TEST(Deformable, TakesArraysOfNumbers) {
    const MovingMesh moving = rising_tip();
    const std::size_t n = moving.mesh.positions.size();
    std::vector<Vec3> ends[2];
    std::vector<double> doubles[2];
    std::vector<float> floats[2];
    for (std::size_t i = 0; i < n; ++i)
        for (int end = 0; end < 2; ++end) {
            const Vec3 p = end == 0 ? moving.mesh.positions[i] : moving.end[i];
            for (const double x : {p.x, p.y, p.z}) {
                floats[end].push_back(static_cast<float>(x));
                doubles[end].push_back(double{floats[end].back()});
            }
            const double* last = &doubles[end][3 * i];
            ends[end].push_back({last[0], last[1], last[2]});
        }
    Deformable expected(moving.mesh), of_doubles(moving.mesh), of_floats(moving.mesh);
    expected.set_motion(ends[0], ends[1]);
    of_doubles.set_motion(doubles[0], doubles[1]);
    of_floats.set_motion(floats[0], floats[1]);
    const auto impacts = self_impacts(expected).list;
    ASSERT_FALSE(impacts.empty());
    EXPECT_EQ(self_impacts(of_doubles).list, impacts);
    EXPECT_EQ(self_impacts(of_floats).list, impacts);
    expected.advance(std::span<const Vec3>(ends[0]));
    of_doubles.advance(doubles[0]);
    of_floats.advance(floats[0]);
    const auto back = self_impacts(expected).list;
    ASSERT_FALSE(back.empty());
    EXPECT_EQ(self_impacts(of_doubles).list, back);
    EXPECT_EQ(self_impacts(of_floats).list, back);

    std::vector<float> short_floats(3 * n - 1), large(3 * n), none(3 * n);
    large[4] = 1e19F;
    none[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(code_of([&] { of_floats.advance(short_floats); }), ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { of_floats.set_motion(short_floats, floats[1]); }),
              ErrorCode::bad_argument);
    EXPECT_EQ(code_of([&] { of_floats.advance(large); }), ErrorCode::bad_mesh);
    EXPECT_EQ(code_of([&] { of_floats.set_motion(floats[0], none); }), ErrorCode::bad_mesh);
    EXPECT_EQ(self_impacts(of_floats).list, back);
}

} // namespace
} // namespace abut::test
