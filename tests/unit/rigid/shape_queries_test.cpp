#include <abut/error.h>
#include <abut/shape_queries.h>

#include "tests/support/infinity.h"
#include "tests/support/shapes.h"
#include "tests/unit/rigid/unit_box.h"

#include <gtest/gtest.h>
#include <limits>
#include <thread>

namespace abut::test {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// A right triangle at the origin with legs of length 4 along x and y. Its normal points up.
const Model kTriangle(Mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}});
const Model kNone(Mesh{});
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <typename Query>
void expect_refused(const Query& query) {
    try {
        query();
        ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
    }
}

TEST(NearestPoint, FeaturesByHand) {
    const Nearest face = nearest(kTriangle, Pose{}, {1, 1, 3});
    EXPECT_EQ(face.distance, 3);
    EXPECT_EQ(face.point, (Vec3{1, 1, 0}));
    EXPECT_EQ(face.feature, Feature::face);
    EXPECT_EQ(face.barycentric, (std::array{0.5, 0.25, 0.25}));
    const Nearest edge = nearest(kTriangle, Pose{}, {1, -3, 4});
    EXPECT_EQ(edge.distance, 5);
    EXPECT_EQ(edge.feature, Feature::edge);
    EXPECT_EQ(edge.index, 0);
    EXPECT_EQ(edge.barycentric, (std::array{0.75, 0.25, 0.0}));
    const Nearest vertex = nearest(kTriangle, Pose{}, {0, 7, 4});
    EXPECT_EQ(vertex.distance, 5);
    EXPECT_EQ(vertex.feature, Feature::vertex);
    EXPECT_EQ(vertex.index, 2);
    const Nearest moved = nearest(kTriangle, Pose{{10, 0, 0}, {1, 0, 0, 0}}, {11, 1, 3});
    EXPECT_EQ(moved.point, (Vec3{11, 1, 0}));
}

TEST(NearestPoint, TheLeastTriangleOfSeveral) {
    const Nearest n = nearest(kBox, Pose{}, {-1, -1, -1}); // several triangles share the corner
    EXPECT_EQ(n.triangle, 0U);
    EXPECT_EQ(n.feature, Feature::vertex);
    EXPECT_EQ(n.distance, std::sqrt(3.0));
}

TEST(NearestPoint, SignedInsideOfClosedModels) {
    const NearestOptions options{.signed_distance = true};
    EXPECT_EQ(nearest(kBox, Pose{}, {0.5, 0.5, 0.75}, options).distance, -0.25);
    EXPECT_EQ(nearest(kBox, Pose{}, {0.5, 0.5, 1.75}, options).distance, 0.75);
    EXPECT_EQ(nearest(kBox, Pose{}, {0.5, 0.5, 1}, options).distance, 0);
    EXPECT_EQ(nearest(kBox, scaling(-2, 1, 1), {-1, 0.5, 0.75}, options).distance, -0.25);
    const Nearest bound =
        nearest(kBox, Pose{}, {0.5, 0.5, 0.5}, {.upper_bound = 0.1, .signed_distance = true});
    EXPECT_EQ(bound.distance, -0.1);
    EXPECT_EQ(bound.status, Status::bound_only);
    expect_refused([&] { return nearest(kTriangle, Pose{}, Vec3{}, options); });
    expect_refused([&] { return nearest(kNone, Pose{}, Vec3{}, options); });
}

TEST(NearestPoint, ZeroOnTheSurfaceOnly) {
    const Model slanted(Mesh{{{0.1, 0.2, 0.3}, {1.7, 0.1, 0.9}, {0.4, 1.3, 2.1}}, {{0, 1, 2}}});
    const Vec3 third = (1.0 / 3) * (slanted.mesh().positions[0] + slanted.mesh().positions[1] +
                                    slanted.mesh().positions[2]);
    EXPECT_EQ(nearest(slanted, Pose{}, slanted.mesh().positions[1]).distance, 0);
    const double gap = nearest(slanted, Pose{}, third).distance; // rounding moves it off the plane
    EXPECT_EQ(gap == 0, contains(slanted, Pose{}, third).side == Side::on_surface);
    EXPECT_LT(gap, 1e-15);
    EXPECT_GT(nearest(kBox, Pose{}, {0.5, 0.5, 1 + 0x1p-52}).distance, 0);
    EXPECT_GT(nearest(kBox, Pose{}, {0.5, 0.5, -0x1p-1000}).distance, 0);
}

TEST(FirstHit, BoxByHand) {
    const RayHit in = first_hit(kBox, Pose{}, {{0.25, 0.5, 5}, {0, 0, -2}});
    EXPECT_TRUE(in.meet);
    EXPECT_EQ(in.t, 2);
    EXPECT_EQ(in.point, (Vec3{0.25, 0.5, 1}));
    EXPECT_EQ(in.side, HitSide::front);
    const RayHit out = first_hit(kBox, Pose{}, {{0.25, 0.5, 0.5}, {0, 0, -2}});
    EXPECT_EQ(out.t, 0.25);
    EXPECT_EQ(out.side, HitSide::back);
    EXPECT_FALSE(first_hit(kBox, Pose{}, {{0.25, 0.5, 5}, {0, 0, 1}}).meet);
    EXPECT_EQ(first_hit(kBox, Pose{}, {{0.25, 0.5, 5}, {0, 0, 1}, -kInfinity}).t, -5);
    EXPECT_EQ(first_hit(kBox, Pose{}, {{0.25, 0.5, 5}, {0, 0, -1}, 4.5}).t, 5);
}

TEST(FirstHit, TheRangeIncludesItsEnds) {
    const Ray ray{{0.25, 0.5, 5}, {0, 0, -1}};
    for (const auto& [t_min, t_max, hit] : {std::tuple{4.0, 4.0, true},
                                            {0.0, 4.0, true},
                                            {0.0, std::nextafter(4.0, 0.0), false},
                                            {5.0, kInfinity, true},
                                            {std::nextafter(5.0, 6.0), kInfinity, false},
                                            {4.25, 4.75, false},
                                            {4.0, 3.0, false},
                                            {kInfinity, kInfinity, false}})
        EXPECT_EQ(first_hit(kBox, Pose{}, {ray.origin, ray.direction, t_min, t_max}).meet, hit)
            << t_min << ' ' << t_max;
}

TEST(FirstHit, RaysInATrianglesPlaneHitWhereTheyEnter) {
    const RayHit hit = first_hit(kTriangle, Pose{}, {{-1, 1, 0}, {1, 0, 0}});
    EXPECT_TRUE(hit.meet);
    EXPECT_EQ(hit.t, 1);
    EXPECT_EQ(hit.side, HitSide::along);
    EXPECT_EQ(hit.barycentric, (std::array{0.75, 0.0, 0.25}));
    EXPECT_EQ(first_hit(kTriangle, Pose{}, {{1, 1, 0}, {1, 0, 0}}).t, 0);
    EXPECT_EQ(first_hit(kTriangle, Pose{}, {{-1, 4, 0}, {1, 0, 0}}).t, 1); // grazes a vertex
    EXPECT_FALSE(first_hit(kTriangle, Pose{}, {{-1, 4.0000000000000009, 0}, {1, 0, 0}}).meet);
    EXPECT_FALSE(first_hit(kTriangle, Pose{}, {{-1, 1, 0x1p-1000}, {1, 0, 0}}).meet);
}

TEST(FirstHit, DegenerateTriangles) {
    const Model segment(Mesh{{{0, 0, 0}, {2, 0, 0}}, {{0, 1, 1}}});
    EXPECT_EQ(first_hit(segment, Pose{}, {{1, 0, 3}, {0, 0, -1}}).t, 3);
    EXPECT_EQ(first_hit(segment, Pose{}, {{1, 0, 3}, {0, 0, -1}}).side, HitSide::along);
    EXPECT_FALSE(first_hit(segment, Pose{}, {{1, 0x1p-60, 3}, {0, 0, -1}}).meet);
    EXPECT_EQ(first_hit(segment, Pose{}, {{-1, 0, 0}, {2, 0, 0}}).t, 0.5);
    const Model point(Mesh{{{1, 2, 3}}, {{0, 0, 0}}});
    EXPECT_EQ(first_hit(point, Pose{}, {{0, 0, 0}, {0.5, 1, 1.5}}).t, 2);
    EXPECT_FALSE(first_hit(point, Pose{}, {{0, 0, 0}, {0.5, 1, 1.25}}).meet);
}

/// A diagonal of the box passes through two corners and hits all their triangles, in order.
TEST(AllHits, ThroughTwoCorners) {
    const std::vector<RayHit> hits = all_hits(kBox, Pose{}, {{-1, -1, -1}, {1, 1, 1}});
    ASSERT_GE(hits.size(), 6U);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        EXPECT_EQ(hits[i].t, hits[i].t < 1.5 ? 1 : 2);
        if (i > 0) {
            EXPECT_TRUE(hits[i - 1].t < hits[i].t || hits[i - 1].triangle < hits[i].triangle);
        }
    }
    EXPECT_EQ(hits.back().t, 2);
    EXPECT_EQ(hits.back().point, (Vec3{1, 1, 1}));
    EXPECT_EQ(first_hit(kBox, Pose{}, {{-1, -1, -1}, {1, 1, 1}}).triangle, hits[0].triangle);
}

TEST(NearestPoint, VeryDistantPoints) {
    for (const double far : {1e3, 1e9, 1e15, 1e18})
        for (const double scale : {1.0, 0x1p-30, 0x1p-49, 0x1p-60}) {
            const Nearest n = nearest(kBox, scaling(scale, scale, scale), {far, scale / 2, 0});
            EXPECT_EQ(n.distance, far - scale) << far << ' ' << scale;
            if (far * 0x1p-20 < scale) { // otherwise rounding gives many nearest points
                EXPECT_EQ(n.point, (Vec3{scale, scale / 2, 0}));
            }
            const Ray ray{{far, scale / 2, scale / 4}, {-1, 0, 0}};
            EXPECT_EQ(first_hit(kBox, scaling(scale, scale, scale), ray).t, far - scale)
                << far << ' ' << scale;
        }
}

TEST(FirstHit, FromVeryFarAndWithOddDirections) {
    for (const double far : {1e3, 1e9, 1e15, 1e18}) {
        const RayHit hit = first_hit(kBox, Pose{}, {{0.25, 0.5, far}, {0, 0, -1}});
        EXPECT_TRUE(hit.meet) << far;
        EXPECT_EQ(hit.t, far - 1);
    }
    EXPECT_EQ(first_hit(kBox, Pose{}, {{0.25, 0.5, 5}, {0, 0, -0x1p-1074}}).t,
              kInfinity); // 4 * 2^1074
    EXPECT_EQ(first_hit(kBox, Pose{}, {{0.25, 0.5, 5}, {0, 0, -0x1p-1000}}).t, 0x1p1002);
    EXPECT_EQ(first_hit(kBox, Pose{}, {{0.25, 0.5, 5}, {0, 0, -0x1p1000}}).t, 0x1p-998);
}

TEST(SegmentQueries, ByHand) {
    const Gap gap = distance(kBox, Pose{}, Segment{{2, 0.5, -7}, {2, 0.5, 9}});
    EXPECT_EQ(gap.distance, 1);
    EXPECT_EQ(gap.point_a.x, 1);
    EXPECT_EQ(gap.point_b.x, 2);
    EXPECT_EQ(distance(kBox, Pose{}, Segment{{0.5, 0.5, 0.5}, {0.5, 0.5, 3}}).distance, 0);
    EXPECT_EQ(distance(kBox, Pose{}, Segment{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.75}}).distance, 0.25);
    EXPECT_EQ(distance(kBox, Pose{}, Segment{{3, 0, 0}, {3, 0, 0}}).distance, 2);
    EXPECT_EQ(distance(kBox, Pose{}, Segment{{3, 0, 0}, {4, 0, 0}}, {.upper_bound = 1}).status,
              Status::bound_only);
    EXPECT_TRUE(overlaps(kBox, Pose{}, Segment{{0.5, 0.5, 0.5}, {0.5, 0.5, 1}}));
    EXPECT_FALSE(overlaps(kBox, Pose{}, Segment{{0.5, 0.5, 0.25}, {0.5, 0.5, 0.75}}));
    EXPECT_EQ(overlapping_triangles(kTriangle, Pose{}, Segment{{1, 1, 1}, {1, 1, -1}}), Numbers{0});
}

TEST(Overlaps, SpheresTouchAtTheirRadius) {
    EXPECT_TRUE(overlaps(kTriangle, Pose{}, Sphere{{1, -3, 4}, 5}));
    EXPECT_FALSE(overlaps(kTriangle, Pose{}, Sphere{{1, -3, 4}, std::nextafter(5, 0)}));
    EXPECT_TRUE(overlaps(kBox, Pose{}, Sphere{{0.5, 0.5, 0.5}, 0.5}));
    EXPECT_FALSE(overlaps(kBox, Pose{}, Sphere{{0.5, 0.5, 0.5}, 0.499}));
    EXPECT_TRUE(overlaps(kBox, Pose{}, Sphere{{0.5, 0.5, 0.5}, 100})); // the whole surface is
                                                                       // inside
    EXPECT_EQ(overlapping_triangles(kBox, Pose{}, Sphere{{0.5, 0.5, 0.5}, 100}).size(), 12U);
    EXPECT_TRUE(overlaps(kBox, Pose{}, Sphere{{1, 1, 1}, 0}));
}

TEST(Overlaps, Boxes) {
    EXPECT_TRUE(overlaps(kTriangle, Pose{}, Box3{{2, 2, 0}, {3, 3, 1}})); // touches the long edge
    EXPECT_FALSE(overlaps(kTriangle, Pose{}, Box3{{2, 2.0000000000000004, 0}, {3, 3, 1}}));
    EXPECT_TRUE(overlaps(kBox, Pose{}, Box3{{-1, -1, -1}, {2, 2, 2}}));
    EXPECT_FALSE(overlaps(kBox, Pose{}, Box3{{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}}));
    EXPECT_FALSE(overlaps(kBox, Pose{}, Box3{}));
    EXPECT_FALSE(overlaps(kBox, Pose{}, Box3{{0, 1, 0}, {1, 0, 1}}));
    const Box3 unit{{-1, -1, -1}, {1, 1, 1}};
    EXPECT_FALSE(overlaps(kBox, Pose{}, OrientedBox{Box3{}, Transform()}));
    // Rotated by 45 degrees about z. Its edge at x = -sqrt(2) just reaches the box's face, or just
    // does not.
    const auto turned = [&](double x) {
        return OrientedBox{
            unit, Pose{{x, 0.5, 0}, {std::cos(0.3926990817), 0, 0, std::sin(0.3926990817)}}};
    };
    EXPECT_TRUE(overlaps(kBox, Pose{}, turned(2.41)));
    EXPECT_FALSE(overlaps(kBox, Pose{}, turned(2.42)));
    EXPECT_TRUE(overlaps(kBox, Pose{}, OrientedBox{unit, scaling(100, 100, 100)})); // contains the
                                                                                    // whole box
    EXPECT_FALSE(overlaps(kBox, Pose{}, OrientedBox{unit, translation(0, 0, 3)}));
    // Flattened to a square through the box, and to one above it.
    EXPECT_TRUE(overlaps(kBox, Pose{}, OrientedBox{unit, scaling(1, 1, 0)}));
    Transform above = scaling(1, 1, 0);
    above.m[11] = 1.5;
    EXPECT_FALSE(overlaps(kBox, Pose{}, OrientedBox{unit, above}));
}

TEST(Contains, ClosedSurfacesByCrossings) {
    EXPECT_EQ(contains(kBox, Pose{}, {0.5, 0.5, 0.5}).side, Side::inside);
    EXPECT_EQ(contains(kBox, Pose{}, {0.5, 0.5, 1}).side, Side::on_surface);
    EXPECT_EQ(contains(kBox, Pose{}, {0.5, 0.5, 1 + 0x1p-52}).side, Side::outside);
    EXPECT_EQ(contains(kBox, Pose{}, {1e17, 0.5, 0.5}).side, Side::outside);
    EXPECT_EQ(contains(kBox, Pose{}, {0.5, 0.5, 0.5}).method, ContainmentMethod::crossings);
    // Reversed triangles do not matter. A shell inside is a cavity.
    Mesh mesh = joined(box_mesh({0, 0, 0}, {3, 3, 3}), box_mesh({1, 1, 1}, {2, 2, 2}));
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    const Model hollow(mesh);
    EXPECT_EQ(contains(hollow, Pose{}, {0.5, 1.5, 1.5}).side, Side::inside);
    EXPECT_EQ(contains(hollow, Pose{}, {1.5, 1.5, 1.5}).side, Side::outside);
    EXPECT_EQ(contains(kNone, Pose{}, {1, 1, 1}).side, Side::outside);
    // A flattened box has no inside.
    EXPECT_EQ(contains(kBox, scaling(1, 1, 0), {0.5, 0.5, 0}).side, Side::on_surface);
    EXPECT_EQ(contains(kBox, scaling(1, 1, 0), {0.5, 0.5, 0.1}).side, Side::outside);
    EXPECT_EQ(contains(kBox, scaling(1, 1, 0), {0.5, 0.5, 0.1}).method,
              ContainmentMethod::crossings);
}

/// Triangles without an area lie in leaves whose boxes hold the points, so that each ray meets them.
TEST(Contains, TrianglesWithoutAnAreaChangeNothing) {
    Mesh box = box_mesh({0, 0, 0}, {1, 1, 1});
    for (std::uint32_t v = 0; v < 8; ++v)
        box.triangles.push_back({v, v, v});
    const Model model(box);
    for (const Vec3& point : {Vec3{0.5, 0.5, 0.5}, Vec3{0.1, 0.2, 0.3}, Vec3{0.9, 0.05, 0.6}}) {
        const Containment answer = contains(model, {}, point);
        EXPECT_EQ(answer.side, Side::inside) << point.x;
        EXPECT_EQ(answer.method, ContainmentMethod::crossings);
    }
    EXPECT_EQ(contains(model, {}, Vec3{1.1, 0.5, 0.5}).side, Side::outside);
    EXPECT_EQ(contains(model, {}, Vec3{1, 0.5, 0.5}).side, Side::on_surface);
}

TEST(Contains, OpenSurfacesByWindingNumber) {
    const Model open(open_box_mesh({0, 0, 0}, {1, 1, 1}));
    const Containment low = contains(open, Pose{}, {0.5, 0.5, 0.25});
    EXPECT_EQ(low.method, ContainmentMethod::winding);
    EXPECT_EQ(low.side, Side::inside);
    EXPECT_NEAR(contains(open, Pose{}, {0.5, 0.5, 0.5}).winding_number, 5.0 / 6, 1e-12);
    EXPECT_NEAR(contains(open, scaling(1, 1, -1), {0.5, 0.5, -0.5}).winding_number, -5.0 / 6,
                1e-12);
    EXPECT_EQ(contains(open, Pose{}, {0.5, 0.5, 1.25}).side, Side::outside);
    EXPECT_EQ(contains(open, Pose{}, {0, 0.5, 0.5}).side, Side::on_surface);
    // Beside a closed box, the open one is asked outside of it only.
    const Model beside(joined(open_box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({5, 0, 0}, {6, 1, 1})));
    EXPECT_EQ(contains(beside, Pose{}, {5.5, 0.5, 0.5}).method, ContainmentMethod::crossings);
    EXPECT_EQ(contains(beside, Pose{}, {5.5, 0.5, 0.5}).side, Side::inside);
    EXPECT_NEAR(contains(beside, Pose{}, {0.5, 0.5, 0.5}).winding_number, 5.0 / 6, 1e-12);
    EXPECT_EQ(contains(beside, Pose{}, {0.5, 0.5, 0.25}).side, Side::inside);
    EXPECT_THROW((void)nearest(beside, Pose{}, {5.5, 0.5, 0.5}, {.signed_distance = true}), Error);
}

/// Four triangles use the edge that two boxes share. Each of them is a shell.
TEST(Contains, ShellsThatShareAnEdgeAreClosed) {
    const Model pair(joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({1, 1, 0}, {2, 2, 1})));
    for (const auto& [point, side] : {std::pair(Vec3{0.5, 0.5, 0.5}, Side::inside),
                                      std::pair(Vec3{1.5, 1.5, 0.5}, Side::inside),
                                      std::pair(Vec3{1.5, 0.5, 0.5}, Side::outside)}) {
        EXPECT_EQ(contains(pair, Pose{}, point).side, side);
        EXPECT_EQ(contains(pair, Pose{}, point).method, ContainmentMethod::crossings);
    }
}

/// Two boxes that overlap by half, as one mesh: what both fill is inside, and its faces within are
/// no boundary.
TEST(Contains, ShellsThatOverlapAreAUnion) {
    const Model pair(
        joined(box_mesh({0, 0, 0}, {1, 0.8, 0.6}), box_mesh({0.5, 0, 0}, {1.5, 0.8, 0.6})));
    for (const Vec3& point : {Vec3{0.25, 0.4, 0.3}, Vec3{0.75, 0.4, 0.3}, Vec3{1.25, 0.4, 0.3},
                              Vec3{0.5, 0.4, 0.3}, Vec3{1, 0.4, 0.3}})
        EXPECT_EQ(contains(pair, Pose{}, point).side, Side::inside) << point.x;
    EXPECT_EQ(contains(pair, Pose{}, {0.75, 0.4, 0}).side, Side::on_surface);
    EXPECT_EQ(contains(pair, Pose{}, {1.6, 0.4, 0.3}).side, Side::outside);
    EXPECT_NEAR(nearest(pair, Pose{}, {0.5, 0.4, 0.3}, {.signed_distance = true}).distance, -0.3,
                1e-15);
    EXPECT_EQ(nearest(pair, Pose{}, {0.5, 0.4, 0.3}).distance, 0); // without a sign: all triangles
}

TEST(Contains, AnyThreadMayAskFirst) {
    const Model model(torus_mesh(1, 0.4, 40, 30));
    std::vector<std::thread> threads;
    std::array<Side, 4> sides{};
    for (std::size_t i = 0; i < sides.size(); ++i)
        threads.emplace_back([&, i] { sides[i] = contains(model, Pose{}, {1, 0, 0}).side; });
    for (std::thread& thread : threads)
        thread.join();
    for (const Side side : sides)
        EXPECT_EQ(side, Side::inside);
}

TEST(ShapeQueries, EmptyModelsMeetNothing) {
    const Transform flat = scaling(0, 0, 0);
    for (const Transform& world : {Transform(), flat}) {
        EXPECT_EQ(nearest(kNone, world, Vec3{}).distance, kInfinity);
        EXPECT_EQ(nearest(kNone, world, Vec3{}).status, Status::bound_only);
        EXPECT_EQ(nearest(kNone, world, Vec3{}, {.upper_bound = 3}).distance, 3);
        EXPECT_FALSE(first_hit(kNone, world, {{0, 0, 0}, {1, 0, 0}}).meet);
        EXPECT_TRUE(all_hits(kNone, world, {{0, 0, 0}, {1, 0, 0}}).empty());
        EXPECT_FALSE(overlaps(kNone, world, Sphere{{0, 0, 0}, 1e9}));
        EXPECT_FALSE(overlaps(kNone, world, Box3{{-1, -1, -1}, {1, 1, 1}}));
        EXPECT_FALSE(overlaps(kNone, world, OrientedBox{{{-1, -1, -1}, {1, 1, 1}}, Transform()}));
        EXPECT_FALSE(overlaps(kNone, world, Segment{{-1, -1, -1}, {1, 1, 1}}));
        EXPECT_EQ(distance(kNone, world, Segment{}).status, Status::bound_only);
        EXPECT_EQ(contains(kNone, world, Vec3{}).side, Side::outside);
    }
    EXPECT_EQ(nearest(kBox, flat, {3, 4, 0}).distance, 5); // all points collapse to the origin
    EXPECT_EQ(first_hit(kBox, flat, {{3, 4, 0}, {-3, -4, 0}}).t, 1);
}

TEST(ShapeQueries, BadArgumentsAreErrors) {
    Transform bad;
    bad.m[5] = kNaN;
    for (const double v : {kNaN, kInfinity, 2e18}) {
        const Vec3 p{0, v, 0};
        expect_refused([&] { return nearest(kBox, Pose{}, p); });
        expect_refused([&] { return nearest(kBox, Pose{}, std::vector{Vec3{}, p}); });
        expect_refused([&] { return first_hit(kBox, Pose{}, {p, {1, 0, 0}}); });
        expect_refused([&] { return distance(kBox, Pose{}, Segment{{}, p}); });
        expect_refused([&] { return overlaps(kBox, Pose{}, Segment{p, {}}); });
        expect_refused([&] { return overlaps(kBox, Pose{}, Sphere{p, 1}); });
        expect_refused([&] { return overlaps(kBox, Pose{}, Sphere{{}, v}); });
        expect_refused([&] { return overlaps(kBox, Pose{}, Box3{{}, p}); });
        expect_refused([&] { return overlaps(kBox, Pose{}, OrientedBox{{{}, p}, Transform()}); });
        expect_refused([&] { return contains(kBox, Pose{}, p); });
        expect_refused([&] { return contains(kBox, Pose{}, std::vector{p}); });
    }
    expect_refused([&] { return first_hit(kBox, Pose{}, {{}, {0, 0, 0}}); });
    expect_refused([&] { return first_hit(kBox, Pose{}, {{}, {0, kInfinity, 0}}); });
    expect_refused([&] { return all_hits(kBox, Pose{}, {{}, {0, 0, 1}, kNaN}); });
    expect_refused([&] { return all_hits(kBox, Pose{}, {{}, {0, 0, 1}, 0, kNaN}); });
    expect_refused([&] { return overlaps(kBox, Pose{}, Sphere{{}, -1}); });
    expect_refused([&] { return overlaps(kBox, Pose{}, OrientedBox{{{}, {}}, bad}); });
    expect_refused([&] { return nearest(kBox, Pose{}, Vec3{}, {.upper_bound = -1}); });
    expect_refused([&] { return nearest(kBox, Pose{}, Vec3{}, {.upper_bound = kNaN}); });
    expect_refused([&] { return nearest(kBox, bad, Vec3{}); });
    expect_refused([&] { return contains(kBox, bad, Vec3{}); });
    expect_refused([&] { return first_hit(kBox, bad, {{}, {1, 0, 0}}); });
}

} // namespace
} // namespace abut::test
