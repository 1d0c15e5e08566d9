#include <abut/convex.h>
#include <abut/error.h>

#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace abut::test {
namespace {

const Convex kCube(box_mesh({0, 0, 0}, {1, 1, 1}));
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Convex hull(const std::vector<Vec3>& points) {
    return Convex(points);
}

std::string error_of(const Mesh& mesh, const ConvexOptions& options = {}) {
    try {
        const Convex body(mesh, options);
        return "none";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_mesh);
        return error.what();
    }
}

void expect_error(const Mesh& mesh, const std::string& part) {
    EXPECT_NE(error_of(mesh).find(part), std::string::npos) << error_of(mesh);
}

TEST(Convex, CoplanarTrianglesAreOneFace) {
    EXPECT_EQ(kCube.dimension(), 3);
    EXPECT_EQ(kCube.vertices().size(), 8U);
    EXPECT_EQ(kCube.edges().size(), 12U);
    ASSERT_EQ(kCube.face_count(), 6U);
    for (std::size_t f = 0; f < 6; ++f) {
        const auto face = kCube.face(f);
        ASSERT_EQ(face.size(), 4U);
        // Faces are counter-clockwise as seen from outside.
        const auto& v = kCube.vertices();
        const Vec3 normal = cross(v[face[1]] - v[face[0]], v[face[2]] - v[face[1]]);
        EXPECT_EQ(dot(normal, v[face[0]] - Vec3{0.5, 0.5, 0.5}), 0.5);
    }
}

TEST(Convex, SuperfluousPointsAreLeftOut) {
    std::vector<Vec3> points = box_mesh({0, 0, 0}, {2, 2, 2}).positions;
    const std::vector<Vec3> corners = points;
    points.insert(points.begin(), {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, 2, 2}, {2, 1, 2}});
    const Convex body = hull(points);
    EXPECT_EQ(body.vertices().size(), 8U);
    EXPECT_EQ(body.edges().size(), 12U);
    EXPECT_EQ(body.face_count(), 6U);
    ASSERT_EQ(body.source().size(), 8U);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_EQ(points[body.source()[i]], body.vertices()[i]);
}

TEST(Convex, PointsSegmentsAndPolygons) {
    const Convex point = hull({{1, 2, 3}, {1, 2, 3}});
    EXPECT_EQ(point.dimension(), 0);
    EXPECT_EQ(point.vertices().size(), 1U);
    EXPECT_EQ(point.face_count(), 0U);
    const Convex segment = hull({{1, 0, 0}, {0, 0, 0}, {3, 0, 0}, {2, 0, 0}});
    EXPECT_EQ(segment.dimension(), 1);
    EXPECT_EQ(segment.vertices().size(), 2U);
    EXPECT_EQ(segment.edges().size(), 1U);
    const Convex polygon = hull({{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}, {1, 1, 1}, {1, 0, 1}});
    EXPECT_EQ(polygon.dimension(), 2);
    EXPECT_EQ(polygon.vertices().size(), 4U);
    EXPECT_EQ(polygon.edges().size(), 4U);
    ASSERT_EQ(polygon.face_count(), 2U);
    EXPECT_EQ(polygon.face(0).size(), 4U);
    EXPECT_EQ(polygon.face(1).size(), 4U);

    const Pose at{};
    EXPECT_EQ(distance(point, at, polygon, at).distance, 2);
    EXPECT_EQ(distance(point, at, polygon, at).feature_b, Feature::edge); // at (1, 2, 1)
    EXPECT_EQ(distance(segment, at, polygon, at).distance, 1);
    EXPECT_EQ(distance(segment, at, segment, translation(0, 3, 4)).distance, 5);
    EXPECT_EQ(distance(point, at, point, translation(0, 3, 4)).distance, 5);
    EXPECT_EQ(distance(point, at, point, at).distance, 0);
    EXPECT_EQ(distance(polygon, at, polygon, translation(1, 1, 0)).distance, 0);
    EXPECT_EQ(distance(polygon, at, polygon, translation(1, 1, -2)).distance, 2);
    EXPECT_EQ(distance(segment, at, segment, translation(1, 0, 0)).distance, 0);
    EXPECT_EQ(distance(segment, at, segment, translation(5, 0, 0)).distance, 2);
    EXPECT_EQ(distance(kCube, at, hull({{0.5, 0.5, 3}}), at).distance, 2);
    EXPECT_EQ(distance(kCube, at, hull({{0.5, 0.5, 0.5}}), at).distance, 0);
}

TEST(Convex, DistancesAndFeaturesByHand) {
    const ConvexGap corners = distance(kCube, Pose{}, kCube, translation(3, 4, 1 + 2));
    EXPECT_DOUBLE_EQ(corners.distance, std::sqrt(4.0 + 9 + 4));
    EXPECT_EQ(corners.feature_a, Feature::vertex);
    EXPECT_EQ(kCube.vertices()[corners.id_a], (Vec3{1, 1, 1}));
    EXPECT_EQ(kCube.vertices()[corners.id_b], (Vec3{0, 0, 0}));
    EXPECT_EQ(corners.point_b, (Vec3{3, 4, 3}));
    EXPECT_EQ(corners.status, Status::exact);
    EXPECT_LT(corners.at_least, corners.distance); // rounded down
    EXPECT_GT(corners.at_least, corners.distance - 1e-12);

    const Convex tip = hull({{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}});
    const ConvexGap face = distance(kCube, Pose{}, tip, translation(0.25, 0.5, 3));
    EXPECT_EQ(face.distance, 2);
    EXPECT_EQ(face.feature_a, Feature::face);
    for (const std::uint32_t v : kCube.face(face.id_a))
        EXPECT_EQ(kCube.vertices()[v].z, 1);
    EXPECT_EQ(face.feature_b, Feature::vertex);
    EXPECT_EQ(tip.vertices()[face.id_b], (Vec3{0, 0, 0}));
    EXPECT_EQ(face.point_a, (Vec3{0.25, 0.5, 1}));

    // An edge along y above an edge along x.
    const Convex roof = hull({{0, -9, 0}, {0, 9, 0}, {5, 0, 5}, {-5, 0, 5}});
    const Convex ridge = hull({{-9, 0, 0}, {9, 0, 0}, {0, 5, -5}, {0, -5, -5}});
    const ConvexGap edges = distance(ridge, Pose{}, roof, translation(1, 2, 0.5));
    EXPECT_EQ(edges.distance, 0.5);
    EXPECT_EQ(edges.feature_a, Feature::edge);
    EXPECT_EQ(edges.feature_b, Feature::edge);
    for (const std::uint32_t v : ridge.edges()[edges.id_a])
        EXPECT_EQ(ridge.vertices()[v].z, 0);
    EXPECT_EQ(edges.point_a, (Vec3{1, 0, 0}));
    EXPECT_EQ(edges.point_b, (Vec3{1, 0, 0.5}));
}

TEST(Convex, TouchingIsToldFromALeastDistanceApart) {
    const double least = std::numeric_limits<double>::denorm_min();
    // Faces, edges and corners that touch, then one unit in the last place apart, either way.
    for (const Vec3& by : {Vec3{1, 0.25, 0.5}, Vec3{1, 1, 0.5}, Vec3{1, 1, 1}}) {
        const ConvexGap touching = distance(kCube, Pose{}, kCube, translation(by.x, by.y, by.z));
        EXPECT_EQ(touching.distance, 0);
        EXPECT_EQ(touching.status, Status::exact);
        const ConvexDepth depth = penetration(kCube, Pose{}, kCube, translation(by.x, by.y, by.z));
        EXPECT_TRUE(depth.meet);
        EXPECT_EQ(depth.depth, 0);
        EXPECT_EQ(depth.at_least, 0);
        const double beyond = std::nextafter(1, 2), before = std::nextafter(1, 0);
        const ConvexGap apart = distance(kCube, Pose{}, kCube, translation(beyond, by.y, by.z));
        EXPECT_EQ(apart.distance, 0x1p-52);
        EXPECT_GT(apart.at_least, 0);
        EXPECT_FALSE(penetration(kCube, Pose{}, kCube, translation(beyond, by.y, by.z)).meet);
        EXPECT_EQ(distance(kCube, Pose{}, kCube, translation(before, by.y, by.z)).distance, 0);
    }
    const Convex origin(std::vector<Vec3>{{0, 0, 0}});
    const ConvexGap smallest = distance(origin, Pose{}, origin, translation(least, 0, 0));
    EXPECT_EQ(smallest.distance, least);
    EXPECT_EQ(smallest.status, Status::exact);
    EXPECT_FALSE(penetration(origin, Pose{}, origin, translation(least, 0, 0)).meet);
    EXPECT_EQ(penetration(kCube, Pose{}, kCube, translation(0, 1 - 0x1p-53, least)).depth, 0x1p-53);
}

TEST(Convex, AnySizeOfCoordinates) {
    for (const double size : {1e-200, 1e-100, 1e100, 1e200}) {
        const Transform a = scaling(size, size, size);
        Transform b = a;
        b.m[9] = 3 * size;
        EXPECT_NEAR(distance(kCube, a, kCube, b).distance, 2 * size, 1e-12 * size);
        b.m[9] = 0.75 * size;
        EXPECT_EQ(distance(kCube, a, kCube, b).distance, 0);
        EXPECT_NEAR(penetration(kCube, a, kCube, b).depth, 0.25 * size, 1e-12 * size);
    }
    const Transform huge = scaling(1e308, 1e308, 1e308);
    const Convex large = hull({{0, 0, 0}, {1e9, 0, 0}});
    EXPECT_THROW((void)distance(large, huge, kCube, Pose{}), Error);
    EXPECT_THROW((void)penetration(large, huge, kCube, Pose{}), Error);
}

TEST(Convex, BodiesAreSolid) {
    const Convex inner(box_mesh({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}));
    const ConvexGap nested = distance(kCube, Pose{}, inner, Pose{});
    EXPECT_EQ(nested.distance, 0);
    EXPECT_EQ(nested.at_least, 0);
    EXPECT_EQ(nested.point_a, nested.point_b);
    EXPECT_EQ(distance(inner, Pose{}, kCube, Pose{}).distance, 0);
    EXPECT_EQ(distance(kCube, Pose{}, kCube, Pose{}).distance, 0);
    for (const Vec3& touching : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{0.5, 1, 0.25}})
        EXPECT_EQ(distance(kCube, Pose{}, kCube, translation(touching.x, touching.y, touching.z))
                      .distance,
                  0);
}

TEST(Convex, TransformsMayBeAnyAffineMap) {
    const Transform mirror = scaling(-1, 2, 1), flat = scaling(1, 1, 0);
    EXPECT_EQ(distance(kCube, mirror, kCube, translation(2, 0, 0)).distance, 2);
    EXPECT_EQ(distance(kCube, translation(0, 5, 0), kCube, mirror).distance, 3);
    EXPECT_EQ(distance(kCube, flat, kCube, translation(0, 0, 4)).distance, 4);
    EXPECT_EQ(distance(kCube, flat, kCube, flat).distance, 0);
    EXPECT_EQ(distance(kCube, scaling(0, 0, 0), kCube, translation(0, 3, 4)).distance, 5);
}

TEST(Convex, MeshesAreChecked) {
    EXPECT_EQ(error_of(sphere_mesh(1, 12, 8)), "none");
    EXPECT_EQ(error_of(reversed(sphere_mesh(1, 12, 8))).substr(0, 17), "not a convex body");
    expect_error(open_box_mesh({0, 0, 0}, {1, 1, 1}), "not closed");
    expect_error(torus_mesh(1, 0.3, 12, 8), "dent");
    expect_error(joined(kCube.mesh(), transformed(kCube.mesh(), translation(1e-9, 0, 0))),
                 "more than once");
    expect_error({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}, "one plane");
    Mesh flipped = box_mesh({0, 0, 0}, {1, 1, 1});
    std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
    expect_error(flipped, "triangle 3");
    EXPECT_THROW(Convex(Mesh{}), Error);
    EXPECT_THROW(hull({}), Error);
    EXPECT_THROW(hull({{0, 0, kNaN}}), Error);
    EXPECT_THROW(hull({{0, 0, 2e18}}), Error);
    EXPECT_THROW(Convex(kCube.mesh(), {.relative_dent = -1}), Error);

    // A dent of this depth is or is not a dent, depending on the tolerance.
    Mesh dented = sphere_mesh(1, 12, 8);
    dented.positions[20] = (1 - 0.2) * dented.positions[20];
    expect_error(dented, "dent");
    EXPECT_NE(error_of(dented, {.relative_dent = 1e-3}), "none");
    EXPECT_EQ(error_of(dented, {.relative_dent = 0.1}), "none");
}

TEST(Convex, PenetrationByHand) {
    const ConvexDepth side = penetration(kCube, Pose{}, kCube, translation(0.25, 0.5, 0.75));
    EXPECT_TRUE(side.meet);
    EXPECT_EQ(side.depth, 0.25);
    EXPECT_LE(side.at_least, 0.25);
    EXPECT_GT(side.at_least, 0.25 - 1e-13);
    EXPECT_EQ(side.direction, (Vec3{0, 0, 1}));
    EXPECT_EQ(side.point_a.z, 1);
    EXPECT_EQ(side.point_b.z, 0.75);
    EXPECT_EQ(side.status, Status::exact);
    EXPECT_EQ(penetration(kCube, Pose{}, kCube, Pose{}).depth, 1);
    EXPECT_EQ(penetration(kCube, Pose{}, kCube, translation(0, 1, 0)).depth, 0);
    EXPECT_FALSE(penetration(kCube, Pose{}, kCube, translation(0, 2, 0)).meet);

    // Flat bodies separate out of the common plane or sideways.
    const Convex square = hull({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    EXPECT_EQ(penetration(square, Pose{}, square, translation(0.5, 0, 0)).depth, 0);
    EXPECT_EQ(penetration(kCube, Pose{}, square, translation(0, 0, 0.75)).depth, 0.25);
    const Convex point = hull({{0.5, 0.5, 0.875}});
    const ConvexDepth inside = penetration(kCube, Pose{}, point, Pose{});
    EXPECT_EQ(inside.depth, 0.125);
    EXPECT_EQ(inside.point_a, (Vec3{0.5, 0.5, 1}));
    EXPECT_EQ(inside.point_b, (Vec3{0.5, 0.5, 0.875}));
    const Convex needle = hull({{0.5, 0.5, -1}, {0.5, 0.5, 3}});
    EXPECT_EQ(penetration(kCube, Pose{}, needle, Pose{}).depth, 0.5);
    EXPECT_EQ(penetration(needle, Pose{}, point, Pose{}).depth, 0);
}

TEST(Convex, BadArguments) {
    Transform bad;
    bad.m[4] = kNaN;
    EXPECT_THROW(distance(kCube, bad, kCube, Pose{}), Error);
    EXPECT_THROW(distance(kCube, Pose{}, kCube, bad), Error);
    bad.m[4] = 1, bad.m[11] = std::numeric_limits<double>::infinity();
    EXPECT_THROW(distance(kCube, Pose{}, kCube, bad), Error);
    EXPECT_THROW(penetration(kCube, Pose{}, kCube, bad), Error);
    EXPECT_THROW(distance(kCube, Pose{}, kCube, Pose{}, {.absolute_error = -1}), Error);
    EXPECT_THROW(distance(kCube, Pose{}, kCube, Pose{}, {.absolute_error = kNaN}), Error);
}

TEST(Convex, AWarmStartOfOtherBodiesDoesNoHarm) {
    const Convex big(sphere_mesh(1, 40, 20)), point = hull({{0, 0, 0}});
    for (const double offset : {0.0, 3.0}) {
        ConvexWarmStart warm_start;
        for (const Convex* a : {&big, &kCube, &point, &big})
            for (const Convex* b : {&big, &point, &kCube, &big}) {
                const Transform at = translation(offset, 0.1, 0.2);
                EXPECT_DOUBLE_EQ(distance(*a, Pose{}, *b, at, {.warm_start = &warm_start}).distance,
                                 distance(*a, Pose{}, *b, at).distance);
            }
    }
}

} // namespace
} // namespace abut::test
