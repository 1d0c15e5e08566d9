// Every way in which two triangles can meet or just not meet, by hand.

#include "geometry/triangle_triangle_intersect.h"
#include "tests/unit/geometry/floor.h"

#include <gtest/gtest.h>

namespace abut {
namespace {

void expect(const Triangle& b, TriangleContact contact) {
    EXPECT_EQ(triangle_triangle_intersect(kFloor, b), contact);
    EXPECT_EQ(triangle_triangle_intersect(b, kFloor), contact);
}

TEST(TriangleIntersect, Crossing) {
    expect({Vec3{1, 1, -1}, Vec3{1, 1, 1}, Vec3{9, 9, 0}}, TriangleContact::cross);
    expect({Vec3{1, 1, -1}, Vec3{1.5, 1, -1}, Vec3{1, 1.5, 1}}, TriangleContact::cross);
}

TEST(TriangleIntersect, CrossingThroughASharedVertex) {
    expect({Vec3{0, 0, 0}, Vec3{2, 2, 1}, Vec3{2, 2, -1}}, TriangleContact::cross);
    expect({Vec3{0, 0, 0}, Vec3{-2, -2, 1}, Vec3{-2, -2, -1}}, TriangleContact::touch);
}

TEST(TriangleIntersect, Touching) {
    expect({Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{2, 1, 1}}, TriangleContact::touch); // vertex on face
    expect({Vec3{2, 0, 0}, Vec3{2, 0, 1}, Vec3{3, -1, 1}},
           TriangleContact::touch);                                                // vertex on edge
    expect({Vec3{4, 0, 0}, Vec3{5, 0, 1}, Vec3{5, 1, 1}}, TriangleContact::touch); // two vertices
    expect({Vec3{1, 1, 0}, Vec3{2, 1, 0}, Vec3{1, 1, 1}}, TriangleContact::touch); // edge on face
    expect({Vec3{-1, 0, 0}, Vec3{9, 0, 0}, Vec3{0, -1, 1}}, TriangleContact::touch); // edge on edge
    expect({Vec3{2, 0, -1}, Vec3{2, 0, 1}, Vec3{2, -1, 0}},
           TriangleContact::touch); // across an edge
    expect({Vec3{2, 0, 0}, Vec3{3, -1, -1}, Vec3{3, -1, 1}}, TriangleContact::touch);
}

TEST(TriangleIntersect, Coplanar) {
    expect(kFloor, TriangleContact::touch);
    expect({Vec3{1, 1, 0}, Vec3{1.5, 1, 0}, Vec3{1, 1.5, 0}}, TriangleContact::touch);   // inside
    expect({Vec3{-9, -9, 0}, Vec3{30, -9, 0}, Vec3{-9, 30, 0}}, TriangleContact::touch); // around
    expect({Vec3{4, 0, 0}, Vec3{5, 0, 0}, Vec3{5, 5, 0}}, TriangleContact::touch); // one vertex
    expect({Vec3{4, 0, 0}, Vec3{0, 4, 0}, Vec3{4, 4, 0}}, TriangleContact::touch); // one edge
    expect({Vec3{4, 1, 0}, Vec3{5, 0, 0}, Vec3{5, 5, 0}}, TriangleContact::none);
    expect({Vec3{3, 1.0000000000000002, 0}, Vec3{5, 1, 0}, Vec3{5, 5, 0}}, TriangleContact::none);
}

TEST(TriangleIntersect, NoContact) {
    expect({Vec3{1, 1, 0x1p-1074}, Vec3{1, 1, 1}, Vec3{2, 1, 1}}, TriangleContact::none);
    expect({Vec3{3, 3, -1}, Vec3{3, 3, 1}, Vec3{9, 9, 0}}, TriangleContact::none);
    expect({Vec3{0, 0, 1}, Vec3{4, 0, 1}, Vec3{0, 4, 1}}, TriangleContact::none); // parallel
    expect({Vec3{-1, -1, -1}, Vec3{-1, -1, 1}, Vec3{-9, 0, 0}}, TriangleContact::none);
}

TEST(TriangleIntersect, DegenerateTrianglesAreSegmentsAndPoints) {
    const Vec3 p{1, 1, 0}, above{1, 1, 1}, below{1, 1, -1}, off{3, 3, 0};
    expect({p, p, p}, TriangleContact::touch);
    expect({off, off, off}, TriangleContact::none);
    expect({above, below, above}, TriangleContact::touch); // pierces, but has no area
    expect({above, p, below}, TriangleContact::touch);
    expect({above, {1, 1, 2}, {1, 1, 3}}, TriangleContact::none);
    expect({Vec3{-1, 1, 0}, Vec3{9, 1, 0}, Vec3{3, 1, 0}},
           TriangleContact::touch); // across, in the plane
    expect({Vec3{3, 3, 0}, Vec3{4, 3, 0}, Vec3{5, 3, 0}}, TriangleContact::none);
    // Two segments, two points, and a point on a segment.
    const Triangle segment{Vec3{0, 0, 0}, Vec3{2, 2, 2}, Vec3{1, 1, 1}};
    const auto with_segment = [&](const Triangle& t) {
        return triangle_triangle_intersect(segment, t);
    };
    EXPECT_EQ(with_segment({Vec3{0, 2, 1}, Vec3{2, 0, 1}, Vec3{0, 2, 1}}), TriangleContact::touch);
    EXPECT_EQ(with_segment({Vec3{0, 2, 1}, Vec3{2, 0, 2}, Vec3{0, 2, 1}}), TriangleContact::none);
    EXPECT_EQ(with_segment({Vec3{1.5, 1.5, 1.5}, Vec3{9, 9, 9}, Vec3{8, 8, 8}}),
              TriangleContact::touch);
    EXPECT_EQ(with_segment({Vec3{3, 3, 3}, Vec3{9, 9, 9}, Vec3{8, 8, 8}}), TriangleContact::none);
    EXPECT_EQ(with_segment({p, p, p}), TriangleContact::none);
    EXPECT_EQ(with_segment({above, above, above}), TriangleContact::touch);
    EXPECT_EQ(triangle_triangle_intersect({p, p, p}, {p, p, p}), TriangleContact::touch);
    EXPECT_EQ(triangle_triangle_intersect({p, p, p}, {off, off, off}), TriangleContact::none);
}

TEST(TriangleIntersect, ProjectionAxisKeepsTheArea) {
    EXPECT_EQ(projection_axis(kFloor), 2);
    EXPECT_EQ(projection_axis({Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}), 0);
    EXPECT_EQ(projection_axis({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}), 1);
    EXPECT_EQ(projection_axis({Vec3{0, 0, 0}, Vec3{1, 2, 3}, Vec3{2, 4, 6}}), -1);
    // The cross product underflows to zero, although the triangle has an area.
    EXPECT_EQ(projection_axis({Vec3{0, 0, 0}, Vec3{0x1p-1000, 0, 0}, Vec3{0, 0x1p-1000, 0}}), 2);
}

} // namespace
} // namespace abut
