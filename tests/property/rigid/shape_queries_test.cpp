// Queries of one model against shapes equal tests of every triangle.

#include <abut/shape_queries.h>

#include "geometry/box_triangle_intersect.h"
#include "geometry/point_triangle_distance.h"
#include "geometry/ray_triangle_intersect.h"
#include "geometry/sphere_triangle_intersect.h"
#include "rigid/model/solid.h"
#include "tests/support/infinity.h"
#include "tests/support/oracle/brute_force.h"
#include "tests/support/oracle/rational_clip.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <numeric>

namespace abut::test {
namespace {

enum class PlacementKind { rigid, affine, uneven, far, flattened, on_grid, tiny, huge };

/// Approximate size of the placed model.
double scale_of(PlacementKind kind) {
    return kind == PlacementKind::tiny ? 1e-6 : kind == PlacementKind::huge ? 1e6 : 1;
}

Mesh make_queried_mesh(Random& random, int kind) {
    switch (kind) {
    case 0:
        return torus_mesh(1, 0.35, 12, 7);
    case 1: // open
        return grid_mesh(9, 9, false, false, [](double u, double v) {
            return Vec3{2 * u - 1, 2 * v - 1, 0.2 * std::sin(9 * u) * std::cos(5 * v)};
        });
    case 2:
        return soup_mesh(random, 120, 0.7, 0.2);
    default: // integer coordinates over four
        return with_degenerates(random,
                                transformed(joined(box_mesh({-3, -2, -2}, {3, 2, 2}),
                                                   box_mesh({-1, -3, -1}, {1, 3, 1})),
                                            scaling(0.25, 0.25, 0.25)),
                                12);
    }
}

Transform place(Random& random, PlacementKind kind) {
    const double mirror = random.chance(0.5) ? -1 : 1;
    switch (kind) {
    case PlacementKind::on_grid: // a quarter turn
        return Transform({0, 1, 0, -1, 0, 0, 0, 0, 1, 2, -1, 0.5});
    case PlacementKind::affine:
        return compose(random.pose(1),
                       Transform({1.3 * mirror, 0.4, 0, -0.3, 0.8, 0, 0, 0.5, 1.2, 0, 0, 0}));
    case PlacementKind::uneven:
        return compose(random.pose(1), compose(scaling(1, 1e-4, 1), random.pose(0)));
    case PlacementKind::flattened:
        return compose(random.pose(1), scaling(1, mirror < 0 ? 1 : 0, 0));
    case PlacementKind::far:
        return compose(translation(1e5, -2e5, 3e5), random.pose(0));
    case PlacementKind::tiny:
    case PlacementKind::huge:
        return compose(scaling(scale_of(kind), scale_of(kind), scale_of(kind)), random.pose(1));
    default:
        return random.pose(1);
    }
}

/// A placed model, and random shapes around it.
struct QueryScene {
    QueryScene(Random& r, PlacementKind kind)
        : random(r), model(make_queried_mesh(r, r.integer(0, 3))), world(place(r, kind)),
          triangles(placed_triangles(model.mesh(), world)), scale(scale_of(kind)) {
        for (const PlacedTriangle& t : triangles)
            for (const Vec3& p : t.corners)
                extend(box, p);
    }

    /// A corner, the middle of an edge, a point of a face, a point near the model, or one far from
    /// it.
    Vec3 point() {
        const Triangle& t = corners();
        const Vec3 size = box.upper - box.lower;
        switch (random.integer(0, 5)) {
        case 0:
            return t[0];
        case 1:
            return 0.5 * t[0] + 0.5 * t[1];
        case 2:
            return 0.25 * t[0] + 0.5 * t[1] + 0.25 * t[2];
        case 3:
            return 0.5 * (box.lower + box.upper) + 1000 * scale * random.in_cube();
        default:
            return box.lower +
                   Vec3{random.uniform(-0.3, 1.3) * size.x, random.uniform(-0.3, 1.3) * size.y,
                        random.uniform(-0.3, 1.3) * size.z} +
                   (random.chance(0.5) ? scale : 0) * random.in_cube(0.2);
        }
    }
    const Triangle& corners() {
        return triangles[static_cast<std::size_t>(random.integer(0, int(triangles.size()) - 1))]
            .corners;
    }
    template <typename Meets>
    std::vector<std::uint32_t> brute(const Meets& meets) const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            if (meets(triangles[i].corners))
                found.push_back(i);
        return found;
    }

    Random& random;
    Model model;
    Transform world;
    std::vector<PlacedTriangle> triangles;
    double scale;
    Box3 box;
};

class ShapeQueries : public testing::TestWithParam<PlacementKind> {
protected:
    static constexpr int kScenes = 25, kShapes = 24;
    Random random_{2100 + static_cast<std::uint64_t>(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Placements, ShapeQueries,
                         testing::Values(PlacementKind::rigid, PlacementKind::affine,
                                         PlacementKind::uneven, PlacementKind::far,
                                         PlacementKind::flattened, PlacementKind::on_grid,
                                         PlacementKind::tiny, PlacementKind::huge));

double roundings(const QueryScene& s, const Vec3& p) {
    return 64 * 0x1p-53 *
           (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + length(s.box.lower) +
            length(s.box.upper));
}

TEST_P(ShapeQueries, NearestEqualsBruteForce) {
    int on = 0, cases = 0;
    std::array<int, 3> features{};
    for (int k = 0; k < kScenes; ++k) {
        QueryScene s(random_, GetParam());
        for (int i = 0; i < kShapes; ++i, ++cases) {
            const Vec3 p = s.point();
            double expected_sq = HUGE_VAL;
            for (const PlacedTriangle& t : s.triangles)
                expected_sq =
                    std::min(expected_sq, point_triangle_distance(p, t.corners).distance_sq);
            const double expected = std::sqrt(expected_sq), rounding = roundings(s, p);
            const Nearest n = nearest(s.model, s.world, p);
            ASSERT_NEAR(n.distance, expected, rounding);
            ASSERT_EQ(n.status, Status::exact);
            const auto touched =
                s.brute([&](const Triangle& t) { return sphere_triangle_intersect(p, 0, t); });
            ASSERT_EQ(n.distance == 0, !touched.empty());
            on += touched.empty() ? 0 : 1;
            if (!touched.empty()) {
                ASSERT_EQ(n.triangle, touched.front());
                ASSERT_EQ(n.point, p);
            }
            const Triangle& t = s.triangles[n.triangle].corners;
            Vec3 q{};
            int positive = 0;
            for (std::size_t v = 0; v < 3; ++v) {
                ASSERT_GE(n.barycentric[v], 0);
                q = q + n.barycentric[v] * t[v], positive += n.barycentric[v] > 0 ? 1 : 0;
            }
            ASSERT_NEAR(length(q - n.point), 0, rounding);
            ASSERT_NEAR(length(n.point - p), expected, rounding);
            ASSERT_LE(positive, 1 + static_cast<int>(n.feature));
            if (n.feature == Feature::vertex) {
                ASSERT_EQ(n.barycentric[n.index], 1);
            }
            if (n.feature == Feature::edge) {
                ASSERT_EQ(n.barycentric[(n.index + 2U) % 3], 0);
            }
            ++features[static_cast<std::size_t>(n.feature)];
            // An upper bound below or above the distance.
            if (expected > 8 * rounding) {
                const Nearest cut = nearest(s.model, s.world, p, {.upper_bound = 0.9 * expected});
                ASSERT_EQ(cut.status, Status::bound_only);
                ASSERT_EQ(cut.distance, 0.9 * expected);
                ASSERT_EQ(nearest(s.model, s.world, p, {.upper_bound = 1.1 * expected}).distance,
                          n.distance);
            }
        }
    }
    EXPECT_GT(on, cases / 20);
    EXPECT_LT(on, cases * 8 / 10);
    for (const int count : features)
        EXPECT_GT(count, cases / 30);
}

TEST_P(ShapeQueries, RaysEqualBruteForce) {
    int hits = 0, cases = 0;
    for (int k = 0; k < kScenes; ++k) {
        QueryScene s(random_, GetParam());
        for (int i = 0; i < kShapes; ++i, ++cases) {
            Ray ray{s.point(), {}};
            const Triangle t = s.corners();
            ray.direction = i % 4 == 0   ? t[1] - t[0] // along an edge, so in planes of triangles
                            : i % 4 == 1 ? random_.direction()
                                         : s.point() - ray.origin;
            if (i % 4 == 0 && random_.chance(0.7))
                ray.origin = t[0] - 2.0 * ray.direction;
            if (ray.direction == Vec3{})
                continue;
            ray.direction = std::ldexp(1.0, i % 3 * random_.integer(-200, 200)) * ray.direction;
            if (i % 5 == 0)
                ray.t_min = -kInfinity;
            else if (i % 5 == 1)
                ray.t_max = 0.5 / std::max(1e-300, length(ray.direction));
            std::vector<std::pair<std::uint32_t, RayTriangleHit>> expected;
            for (std::uint32_t j = 0; j < s.triangles.size(); ++j)
                if (const auto hit = ray_triangle_intersect(ray, s.triangles[j].corners))
                    expected.emplace_back(j, *hit);
            std::sort(expected.begin(), expected.end(), [&](const auto& a, const auto& b) {
                const int order = compare_hits(ray, s.triangles[a.first].corners, a.second,
                                               s.triangles[b.first].corners, b.second);
                return order != 0 ? order < 0 : a.first < b.first;
            });
            const std::vector<RayHit> all = all_hits(s.model, s.world, ray);
            const RayHit first = first_hit(s.model, s.world, ray);
            ASSERT_EQ(all.size(), expected.size()) << k << ' ' << i;
            ASSERT_EQ(first.meet, !expected.empty()) << k << ' ' << i;
            hits += first.meet ? 1 : 0;
            for (std::size_t h = 0; h < all.size(); ++h) {
                ASSERT_EQ(all[h].triangle, expected[h].first);
                ASSERT_TRUE(all[h].t >= ray.t_min && all[h].t <= ray.t_max);
                ASSERT_NEAR(all[h].t, expected[h].second.t, 1e-12 * std::abs(expected[h].second.t));
                if (h > 0) {
                    ASSERT_GE(all[h].t, all[h - 1].t);
                }
                const Vec3 at = ray.origin + all[h].t * ray.direction;
                ASSERT_LE(length(at - all[h].point),
                          roundings(s, ray.origin) + 0x1p-38 * length(at - ray.origin));
            }
            if (first.meet) {
                ASSERT_EQ(first.triangle, all[0].triangle);
                ASSERT_EQ(first.t, all[0].t);
                ASSERT_EQ(first.point, all[0].point);
            }
        }
    }
    EXPECT_GT(hits, cases * 2 / 10);
    EXPECT_LT(hits, cases * 95 / 100);
}

/// All four kinds of overlap, often with the smallest shape that meets, or a slightly smaller one.
TEST_P(ShapeQueries, OverlapsEqualBruteForce) {
    int meet = 0, cases = 0;
    const auto check = [&](const QueryScene& s, const auto& shape, const auto& meets) {
        const std::vector<std::uint32_t> expected = s.brute(meets);
        EXPECT_EQ(overlapping_triangles(s.model, s.world, shape), expected);
        EXPECT_EQ(overlaps(s.model, s.world, shape), !expected.empty());
        ++cases, meet += expected.empty() ? 0 : 1;
    };
    for (int k = 0; k < kScenes; ++k) {
        QueryScene s(random_, GetParam());
        for (int i = 0; i < kShapes; ++i) {
            const Vec3 p = s.point(), q = s.point();
            const double distance = nearest(s.model, s.world, p).distance;
            const double radius = i % 3 == 0   ? std::abs(random_.nudge(distance, 1))
                                  : i % 3 == 1 ? 0.5 * distance
                                               : random_.uniform(0, 0.5) * s.scale;
            check(s, Sphere{p, radius},
                  [&](const Triangle& t) { return sphere_triangle_intersect(p, radius, t); });
            Box3 box;
            extend(box, p), extend(box, p + (i % 2 == 0 ? 0.3 : 0.01) * (q - p));
            check(s, box, [&](const Triangle& t) { return box_triangle_intersect(box, t); });
            // Under the identity the box equals the axis-aligned one, and its corners are not
            // rounded.
            check(s, OrientedBox{box, Transform()},
                  [&](const Triangle& t) { return box_triangle_intersect(box, t); });
            const Segment segment{p, i % 4 == 0 ? p : p + (i % 2 == 0 ? 1 : 0.1) * (q - p)};
            const Triangle as_triangle{segment.a, segment.b, segment.b};
            check(s, segment, [&](const Triangle& t) {
                return triangle_triangle_intersect(as_triangle, t) != TriangleContact::none;
            });
            const Gap gap = abut::distance(s.model, s.world, segment);
            double expected_sq = HUGE_VAL;
            for (const PlacedTriangle& t : s.triangles)
                expected_sq = std::min(
                    expected_sq, triangle_triangle_distance(t.corners, as_triangle).distance_sq);
            ASSERT_NEAR(gap.distance, std::sqrt(expected_sq),
                        roundings(s, segment.a) + roundings(s, segment.b));
            ASSERT_EQ(gap.distance == 0, overlaps(s.model, s.world, segment));
            ASSERT_EQ(gap.triangle_b, 0U);
            ASSERT_FALSE(HasFailure()) << k << ' ' << i;
        }
    }
    EXPECT_GT(meet, cases * 2 / 10);
    EXPECT_LT(meet, cases * 9 / 10);
}

/// Boxes under integer transforms have exact corners, so clipping in rationals decides.
TEST(OrientedBoxes, EqualClippingByRationals) {
    Random random(2120);
    int meet = 0, cases = 0;
    for (int k = 0; k < 40; ++k) {
        Mesh mesh;
        for (int i = 0; i < 90; ++i)
            mesh.positions.push_back(random.on_lattice(12) - Vec3{6, 6, 6});
        for (std::uint32_t i = 0; i < 90; i += 3)
            mesh.triangles.push_back({i, i + 1, i + 2 - (i % 4 == 0 ? 1 : 0)});
        const Model model(mesh);
        for (int i = 0; i < 20; ++i) {
            Transform t;
            do
                for (double& m : t.m)
                    m = random.integer(-2, 2);
            while (stretch_of(t).least == 0);
            const Vec3 low = random.on_lattice(2) - Vec3{1, 1, 1};
            const OrientedBox box{{low, low + random.on_lattice(2)}, t};
            const auto planes = rational_planes(box.box, t);
            std::vector<std::uint32_t> expected;
            for (std::uint32_t j = 0; j < mesh.triangles.size(); ++j) {
                const auto& v = mesh.triangles[j];
                if (clip_meets({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]},
                               planes))
                    expected.push_back(j);
            }
            ASSERT_EQ(overlapping_triangles(model, Pose{}, box), expected) << k << ' ' << i;
            ++cases, meet += expected.empty() ? 0 : 1;
        }
    }
    EXPECT_GT(meet, cases * 2 / 10);
    EXPECT_LT(meet, cases * 95 / 100);
}

/// A query of a model with one triangle skips nothing. So the whole mesh must give the same triangles,
/// also for boxes so thin and so far from the origin that the normals of their faces are mostly
/// rounding.
TEST(OrientedBoxes, ThinAndFarEqualOneTriangleAtATime) {
    Random random(2122);
    int meet = 0, cases = 0;
    for (int k = 0; k < 24; ++k) {
        const double away = std::pow(10.0, random.uniform(0, 9));
        const Vec3 centre = away * random.in_cube();
        Mesh mesh = soup_mesh(random, 60, 1, 0.5);
        for (Vec3& p : mesh.positions)
            p = p + centre;
        const Model model(mesh);
        std::vector<Model> alone;
        for (const auto& t : mesh.triangles)
            alone.emplace_back(Mesh{
                {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, {{0, 1, 2}}});
        for (int i = 0; i < 12; ++i) {
            const auto half = [&] { return std::pow(10.0, random.uniform(-12, 0)); };
            const Vec3 h{half(), half(), random.uniform(0.1, 1)};
            Pose pose = random.pose(0);
            pose.translation = centre + random.in_cube(0.5);
            const OrientedBox box{{-1 * h, h}, pose};
            std::vector<std::uint32_t> expected;
            for (std::uint32_t j = 0; j < alone.size(); ++j)
                if (overlaps(alone[j], Pose{}, box))
                    expected.push_back(j);
            ASSERT_EQ(overlapping_triangles(model, Pose{}, box), expected) << k << ' ' << i;
            ++cases, meet += expected.empty() ? 0 : 1;
        }
    }
    EXPECT_GT(meet, cases * 2 / 10);
}

/// Every ray from inside a closed surface meets it, also through vertices and edges.
TEST(Rays, NoneSlipsThroughAClosedSurface) {
    Random random(2121);
    struct Case {
        Mesh mesh;
        Vec3 inside;
    };
    const std::vector<Case> cases{{box_mesh({-2, -4, -6}, {2, 4, 6}), {1, 0, 1}},
                                  {torus_mesh(1, 0.4, 24, 12), {1, 0.05, 0.02}},
                                  {sphere_mesh(1, 20, 12), {}},
                                  {sphere_mesh(1e-6, 9, 6), {1e-7, 2e-7, 0}}};
    for (const auto& [mesh, inside] : cases) {
        const Model model(mesh);
        for (const Transform& world : {Transform(), Transform(random.pose(100)),
                                       compose(random.pose(1e5), scaling(2, 0.5, -1))}) {
            const auto triangles = placed_triangles(mesh, world);
            const Vec3 o = apply(world, inside);
            if (contains(model, world, o).side != Side::inside) {
                // A solid of size 1e-6 that is 1e5 away is lost to rounding.
                ASSERT_EQ(length(mesh.positions[0]), 1e-6);
                continue;
            }
            for (int i = 0; i < 1500; ++i) {
                const Triangle& t = triangles[static_cast<std::size_t>(
                                                  random.integer(0, int(triangles.size()) - 1))]
                                        .corners;
                const Vec3 aim = i % 4 == 0   ? t[0]
                                 : i % 4 == 1 ? 0.5 * t[0] + 0.5 * t[1]
                                 : i % 4 == 2 ? random.nudge(0.3 * t[0] + 0.7 * t[1], 2)
                                              : (1.0 / 3) * (t[0] + t[1] + t[2]);
                const Ray ray{o, aim - o};
                const RayHit hit = first_hit(model, world, ray);
                ASSERT_TRUE(hit.meet) << i;
                if (mesh.positions.size() != std::size_t{24} * 12) { // convex: nothing lies behind
                                                                     // the hit
                    ASSERT_LE((hit.t - 1) * length(aim - o), 256 * 0x1p-53 * (length(aim) + 1));
                }
                ASSERT_FALSE(all_hits(model, world, ray).empty());
            }
        }
    }
}

TEST(ManyShapes, EqualSingleQueries) {
    Random random(2122);
    const Model model(torus_mesh(1, 0.35, 30, 20));
    const Transform world = random.pose(1);
    std::vector<Vec3> points;
    std::vector<Ray> rays;
    for (int i = 0; i < 1000; ++i) {
        points.push_back(apply(world, random.in_cube(1.4)));
        rays.push_back({points.back(), random.direction()});
    }
    const auto nearests = nearest(model, world, points, {.signed_distance = true});
    const auto hits = first_hit(model, world, rays);
    const auto sides = contains(model, world, points);
    int inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Nearest n = nearest(model, world, points[i], {.signed_distance = true});
        ASSERT_EQ(n.distance, nearests[i].distance);
        ASSERT_EQ(n.triangle, nearests[i].triangle);
        ASSERT_EQ(contains(model, world, points[i]).side, sides[i].side);
        ASSERT_EQ(n.distance < 0, sides[i].side == Side::inside);
        const RayHit h = first_hit(model, world, rays[i]);
        ASSERT_EQ(h.meet, hits[i].meet);
        ASSERT_EQ(h.t, hits[i].t);
        inside += sides[i].side == Side::inside ? 1 : 0;
    }
    EXPECT_GT(inside, 50);
    EXPECT_LT(inside, 500);
}

/// The winding number decides for a surface with a missing triangle too, away from the hole.
TEST(Containment, OpenSurfacesByWindingNumber) {
    Random random(2123);
    Mesh open = sphere_mesh(1, 24, 16);
    const Model closed(open);
    open.triangles.erase(open.triangles.begin() + 5);
    const Model model(open);
    int inside = 0, asked = 0;
    for (const double mirror : {1.0, -1.0}) {
        const Transform world = compose(random.pose(10), scaling(mirror, 1.5, 0.5));
        for (int i = 0; i < 300; ++i) {
            const Vec3 local = random.in_cube(1.2);
            if (local.z < -0.5 || std::abs(length(local) - 1) < 0.05) // the hole is at the pole
                continue;
            const Vec3 p = apply(world, local);
            const Containment c = contains(model, world, p);
            ASSERT_EQ(c.method, ContainmentMethod::winding);
            ASSERT_EQ(c.side, contains(closed, world, p).side);
            const bool in = c.side == Side::inside;
            ASSERT_NEAR(c.winding_number, in ? mirror : 0, 0.1);
            ++asked, inside += in ? 1 : 0;
        }
    }
    EXPECT_GT(inside, asked / 5);
    EXPECT_LT(inside, asked * 4 / 5);
}

} // namespace
} // namespace abut::test
