#include "tests/support/body.h"

#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

/// A box whose top has an additional vertex on its front edge, which the front has not.
Mesh t_junction_box() {
    Mesh m = box_mesh({0, 0, 0}, {1, 1, 1});
    m.positions.push_back({0.5, 0, 1});
    m.triangles[2] = {4, 8, 7};
    m.triangles.push_back({8, 5, 7});
    return m;
}

TEST(WindingNumber, Boxes) {
    const Mesh box = box_mesh({0, 0, 0}, {1, 1, 1});
    EXPECT_NEAR(winding_number(box, {0.5, 0.5, 0.5}), 1, 1e-14);
    EXPECT_NEAR(winding_number(box, {0.9, 0.1, 0.001}), 1, 1e-13);
    EXPECT_NEAR(winding_number(box, {1.5, 0.5, 0.5}), 0, 1e-14);
    EXPECT_NEAR(winding_number(reversed(box), {0.5, 0.5, 0.5}), -1, 1e-14);
    EXPECT_NEAR(winding_number(open_box_mesh({0, 0, 0}, {1, 1, 1}), {0.5, 0.5, 0.5}), 5.0 / 6,
                1e-14);
    EXPECT_NEAR(winding_number(joined(box, box), {0.5, 0.5, 0.5}), 2, 1e-14);
    EXPECT_NEAR(winding_number(t_junction_box(), {0.5, 0.5, 0.5}), 1, 1e-14);
}

TEST(ExamineSolid, ClosedOpenTurnedAndInconsistent) {
    const Mesh box = box_mesh({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(examine_solid(box).closed);
    EXPECT_EQ(examine_solid(box).outward, 1);
    EXPECT_EQ(examine_solid(reversed(box)).outward, -1);
    Mesh flipped = box;
    std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
    EXPECT_TRUE(examine_solid(flipped).solid);
    EXPECT_EQ(examine_solid(flipped).outward, 0);
    EXPECT_FALSE(examine_solid(open_box_mesh({0, 0, 0}, {1, 1, 1})).solid);
    EXPECT_FALSE(examine_solid({}).solid);
    EXPECT_EQ(examine_solid(joined(box, box_mesh({5, 5, 5}, {6, 6, 6}))).components.size(), 2U);
}

/// One more triangle, of any kind, leaves a box the same solid.
TEST(ExamineSolid, ATriangleTooManyChangesNothing) {
    const Mesh box = box_mesh({0, 0, 0}, {1, 1, 1});
    Mesh copy = box, reversed_copy = box, collapsed = box, flap = box, all = box;
    copy.triangles.push_back(box.triangles[0]);
    reversed_copy.triangles.push_back({3, 2, 0});
    collapsed.triangles.push_back({0, 0, 4});
    flap.positions.push_back({-1, 0, -1});
    flap.triangles.push_back({0, 1, 8});
    all = joined(box, box);
    for (const Mesh& mesh : {copy, reversed_copy, collapsed, flap, all}) {
        const Body body(mesh);
        EXPECT_TRUE(body.solid.closed);
        EXPECT_TRUE(body.solid.solid);
        EXPECT_EQ(body.solid.outward, 1);
        EXPECT_TRUE(body.placed.contains({0.5, 0.5, 0.5}));
        EXPECT_TRUE(body.placed.winds_around({0.5, 0.5, 0.5}));
        EXPECT_FALSE(body.placed.contains({-0.25, 0.5, 0.5}));
        EXPECT_TRUE(bounds_solid(mesh));
        EXPECT_EQ(meeting(body, Body(box_mesh({0.5, 0.25, 0.25}, {2, 0.75, 0.75}))).go_in, true);
    }
    EXPECT_FALSE(bounds_solid(open_box_mesh({0, 0, 0}, {1, 1, 1})));
}

/// A shell that faces inwards is a cavity, unless the orientation makes no sense.
TEST(ExamineSolid, NestedShells) {
    const Mesh outer = box_mesh({0, 0, 0}, {5, 5, 5}), inner = box_mesh({1, 1, 1}, {2, 2, 2}),
               beside = box_mesh({7, 0, 0}, {8, 1, 1});
    const Vec3 in_inner{1.5, 1.5, 1.5};
    EXPECT_TRUE(Body(joined(outer, inner)).placed.contains(in_inner));
    EXPECT_FALSE(Body(joined(outer, reversed(inner))).placed.contains(in_inner));
    EXPECT_FALSE(Body(joined(reversed(outer), inner)).placed.contains(in_inner));
    EXPECT_TRUE(Body(joined(reversed(outer), reversed(inner))).placed.contains(in_inner));
    // The box beside faces inwards, so nothing can be told from how shells face.
    const Body mixed(joined(joined(outer, inner), reversed(beside)));
    EXPECT_FALSE(mixed.placed.contains(in_inner));
    EXPECT_TRUE(mixed.placed.contains({7.5, 0.5, 0.5}));
    EXPECT_TRUE(mixed.placed.contains({3, 3, 3}));
    EXPECT_EQ(mixed.solid.outward, 0);
    EXPECT_TRUE(mixed.placed.is_oriented());
}

TEST(ExamineSolid, ABoxWithTJunctionsIsASolidByItsWindingNumber) {
    const Mesh box = t_junction_box();
    EXPECT_FALSE(examine_solid(box).closed);
    EXPECT_TRUE(examine_solid(box).solid);
    EXPECT_EQ(examine_solid(box).outward, 1);
    EXPECT_EQ(examine_solid(reversed(box)).outward, -1);
    const Body body(box, Pose{{7, 8, 9}, {1, 2, 3, 4}});
    const auto world = [&](const Vec3& p) { return apply(body.placed.model().world(), p); };
    EXPECT_TRUE(body.placed.winds_around(world({0.5, 0.5, 0.5})));
    EXPECT_FALSE(body.placed.winds_around(world({0.5, 0.5, 1.5})));
    EXPECT_TRUE(body.placed.contains(world({0.5, 0.01, 0.99})));
    EXPECT_FALSE(body.placed.contains(world({0.5, -0.01, 0.99})));
}

TEST(PlacedSolid, PointsOnTheSurfaceAreNotInside) {
    const Body box(box_mesh({0, 0, 0}, {1, 1, 1}));
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0.5, 0.25}, Vec3{0.5, 0.5, 1}, Vec3{0.25, 0, 1}}) {
        EXPECT_TRUE(box.placed.on_surface(p));
        EXPECT_FALSE(box.placed.contains(p));
    }
    EXPECT_TRUE(box.placed.contains({0x1p-1000, 0.5, 0.25}));
    EXPECT_FALSE(box.placed.on_surface({0x1p-1000, 0.5, 0.25}));
    EXPECT_FALSE(box.placed.contains({-0x1p-1000, 0.5, 0.25}));
    EXPECT_TRUE(box.placed.contains({0.5, 0.5, 0.9999999999999999}));
    EXPECT_FALSE(box.placed.contains({0.5, 0.5, 1.0000000000000002}));
    EXPECT_FALSE(box.placed.contains({1e9, 0, 0}));
}

TEST(PlacedSolid, AsksWhetherThereIsANearerPoint) {
    const Body box(box_mesh({0, 0, 0}, {1, 1, 1}));
    const Vec3 point{0.5, 0.5, 3}; // 2 over a face
    const auto distance = [&](double nearer) {
        return box.placed.nearest(point, {.bound = nearer, .enough = nearer}).distance;
    };
    EXPECT_EQ(distance(2.5), 2);
    EXPECT_EQ(distance(1.5), std::numeric_limits<double>::infinity());
}

TEST(Interpenetrate, BoxesThatOnlyTouch) {
    const Body box(box_mesh({0, 0, 0}, {1, 1, 1}));
    const auto touches = [&](const Mesh& other) {
        for (const Mesh& m : {other, reversed(other)}) {
            const Body b(m);
            const Meeting one = meeting(box, b), two = meeting(b, box);
            EXPECT_FALSE(one.contacts.empty());
            EXPECT_EQ(one.contacts.size(), two.contacts.size());
            EXPECT_FALSE(one.go_in);
            EXPECT_FALSE(two.go_in);
        }
    };
    touches(box_mesh({0.2, 0.2, 1}, {0.8, 0.8, 2}));    // rests on it
    touches(box_mesh({0, 0, 1}, {1, 1, 2}));            // face on equal face
    touches(box_mesh({-1, -1, -1}, {2, 2, 0}));         // stands on it
    touches(box_mesh({0.5, 0.5, 1}, {1.5, 1.5, 2}));    // overhanging
    touches(box_mesh({1, 0, 1}, {2, 1, 2}));            // edge on edge
    touches(box_mesh({1, 0.3, 1}, {2, 0.7, 2}));        // edge within an edge
    touches(box_mesh({1, 1, 1}, {2, 2, 2}));            // corner on corner
    touches(transformed(box_mesh({0, 0, 0}, {1, 1, 1}), // an edge across an edge
                        Transform({0.5, 0.5, 0, -0.5, 0.5, 0, 0, 0, 1, 1.5, 0, 0.5})));
}

TEST(Interpenetrate, BoxesThatGoIn) {
    const Body box(box_mesh({0, 0, 0}, {1, 1, 1}));
    const auto depth = [&](const Mesh& other) {
        double result = 0;
        for (const Mesh& m : {other, reversed(other)}) {
            const Body b(m);
            const Meeting one = meeting(box, b), two = meeting(b, box);
            EXPECT_TRUE(one.go_in);
            EXPECT_TRUE(two.go_in);
            EXPECT_NEAR(one.depth.depth, two.depth.depth, 0.011 * one.depth.depth);
            EXPECT_GE(one.depth.at_most, one.depth.depth);
            EXPECT_NEAR(length(one.depth.point_a - one.depth.point_b), one.depth.depth, 1e-14);
            EXPECT_NEAR(length(one.depth.direction), 1, 1e-12);
            result = one.depth.depth;
        }
        return result;
    };
    // The cross-sections are aligned: only coplanar faces overlap.
    EXPECT_NEAR(depth(box_mesh({0.99, 0, 0}, {1.99, 1, 1})), 0.01, 1e-4);
    EXPECT_NEAR(depth(box_mesh({0.5, 0, 0}, {1.5, 1, 1})), 0.5, 5e-3);
    EXPECT_NEAR(depth(box_mesh({0.9, 0.9, 0.9}, {2, 2, 2})), 0.1, 1e-3);       // corner in corner
    EXPECT_NEAR(depth(box_mesh({0, 0.2, 0.2}, {0.25, 0.8, 0.8})), 0.25, 3e-3); // flush inside
    EXPECT_GT(depth(box_mesh({0, 0, 0}, {0.5, 1, 1})), 0.4);                   // half of it
    EXPECT_NEAR(depth(box_mesh({0.4, 0.4, -1}, {0.6, 0.6, 2})), 0.4, 0.11);    // right through
}

/// No point of either surface lies inside the other, so the depth is the length of the separating
/// motion. The search for a point of positive depth once used its whole budget here, seconds for
/// each pair.
TEST(Interpenetrate, TheSameBoxTwice) {
    const Body a(box_mesh({0, 0, 0}, {1, 1, 1})), b(reversed(box_mesh({0, 0, 0}, {1, 1, 1})));
    EXPECT_TRUE(meeting(a, b).go_in);
    EXPECT_NEAR(meeting(a, b).depth.depth, 1, 0.005);
}

TEST(Interpenetrate, PipesLaidIntoEachOther) {
    const Body pipe(prism_mesh(0, 3, 0.5, 24));
    const Body next(prism_mesh(2.9, 6, 0.5, 24)), flush(prism_mesh(3, 6, 0.5, 24));
    const Meeting in = meeting(pipe, next);
    for (const Contact& c : in.contacts)
        EXPECT_EQ(c.kind, TriangleContact::touch); // no triangle crosses another
    EXPECT_TRUE(in.go_in);
    EXPECT_NEAR(in.depth.depth, 0.1, 1e-3);
    EXPECT_FALSE(meeting(pipe, flush).go_in);
    EXPECT_FALSE(meeting(pipe, flush).contacts.empty());
    // Both are rotated off all axes by one transform.
    const Transform turned = Pose{{10, -20, 30}, {1, 0.2, -0.3, 0.4}};
    const Body pipe_turned(prism_mesh(0, 3, 0.5, 24), turned),
        next_turned(prism_mesh(2.9, 6, 0.5, 24), turned);
    EXPECT_TRUE(meeting(pipe_turned, next_turned).go_in);
    EXPECT_NEAR(meeting(pipe_turned, next_turned).depth.depth, 0.1, 1e-3);
}

TEST(Interpenetrate, ASnugRingAroundAPrism) {
    const Body prism(prism_mesh(-1, 4, 0.5, 16)), ring(ring_mesh(1, 2, 0.5, 0.8, 16)),
        tight(ring_mesh(1, 2, 0.45, 0.8, 16)), loose(ring_mesh(1, 2, 0.55, 0.8, 16));
    EXPECT_TRUE(ring.solid.closed);
    EXPECT_EQ(ring.solid.outward, 1);
    EXPECT_FALSE(meeting(prism, ring).contacts.empty());
    EXPECT_FALSE(meeting(prism, ring).go_in);
    EXPECT_FALSE(meeting(ring, prism).go_in);
    EXPECT_TRUE(meeting(prism, tight).go_in);
    EXPECT_TRUE(meeting(prism, loose).contacts.empty());
}

TEST(Interpenetrate, OpenSheets) {
    // The floor has an edge along x = 0, and the walls have one along z = 0.
    const Mesh floor{{{-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}},
                     {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
    const Mesh wall{{{0, -1, -1}, {0, -1, 0}, {0, -1, 1}, {0, 1, -1}, {0, 1, 0}, {0, 1, 1}},
                    {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
    Mesh upper = wall;
    upper.triangles.erase(upper.triangles.begin(), upper.triangles.begin() + 2);
    const Body a(floor), through(wall), on_top(upper);
    for (const Contact& c : meeting(a, through).contacts)
        EXPECT_EQ(c.kind, TriangleContact::touch);
    EXPECT_TRUE(meeting(a, through).go_in);
    EXPECT_TRUE(meeting(through, a).go_in);
    EXPECT_FALSE(meeting(a, on_top).go_in);
    EXPECT_FALSE(meeting(on_top, a).go_in);
    // One on the other, face to face.
    EXPECT_FALSE(meeting(a, a).go_in);
    const Body crossing(transformed(wall, translation(0.3, 0, 0.2)));
    EXPECT_TRUE(meeting(a, crossing).go_in);
    EXPECT_GT(meeting(a, crossing).depth.depth, 0);
}

TEST(PenetrationDepth, SphereInSphere) {
    for (const double apart : {1.9, 1.5, 1.1}) {
        const Body a(sphere_mesh(1, 64, 32)), b(sphere_mesh(1, 64, 32), translation(apart, 0, 0));
        const Meeting m = meeting(a, b);
        ASSERT_TRUE(m.go_in);
        // The search allows 1 %. The chords of 64 sides lie up to 0.0024 inside the sphere, on both
        // sides.
        EXPECT_NEAR(m.depth.depth, 2 - apart, 0.01 * (2 - apart) + 0.005);
        EXPECT_LE(m.depth.depth, 2 - apart + 1e-12);
        EXPECT_GE(m.depth.at_most, 2 - apart - 0.005);
        EXPECT_GT(m.depth.direction.x, 0.9); // b moves away along +x
    }
}

TEST(PenetrationDepth, TheThresholdIsDecided) {
    const Body a(box_mesh({0, 0, 0}, {1, 1, 1})), b(box_mesh({0.99, 0.1, 0.1}, {2, 0.9, 0.9}));
    for (const double threshold : {0.005, 0.0099, 0.0101, 0.02}) {
        DepthSearch options;
        options.threshold = threshold;
        const Meeting m = meeting(a, b, options);
        ASSERT_TRUE(m.go_in);
        EXPECT_EQ(m.depth.at_most > threshold, threshold < 0.01) << threshold;
    }
}

} // namespace
} // namespace abut::test
