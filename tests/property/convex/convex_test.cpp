// Convex bodies: hulls against exact predicates, distances against all vertices and against the
// triangles.

#include <abut/convex.h>
#include <abut/rigid.h>

#include "convex/body/convex_data.h"
#include "convex/convex_query.h"
#include "convex/search/gjk.h"
#include "math/predicates.h"
#include "math/transform.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <set>

namespace abut::test {
namespace {

std::vector<Vec3> ellipsoid(Random& random, int count) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const Vec3 d = random.direction();
        points.push_back({d.x, 0.7 * d.y, 0.4 * d.z});
    }
    return points;
}

/// Random points, about as large as a unit sphere.
std::vector<Vec3> body_points(Random& random, int kind) {
    std::vector<Vec3> points;
    switch (kind % 8) {
    case 0:
        return ellipsoid(random, random.integer(4, 30));
    case 1: // many coplanar and collinear points
        for (int i = 0; i < 40; ++i)
            points.push_back(0.5 * (random.on_lattice(3) - Vec3{1.5, 1.5, 1.5}));
        return points;
    case 2:
        return box_mesh({-0.7, -0.5, -0.4}, {0.7, 0.5, 0.4}).positions;
    case 3: // flat ends whose points are not quite coplanar after rounding
        return transformed(prism_mesh(-0.8, 0.8, 0.5, random.integer(3, 40)), random.pose(0))
            .positions;
    case 4:
        return ellipsoid(random, 400);
    case 5: // a needle
        for (const Vec3& p : ellipsoid(random, 30))
            points.push_back({p.x, 1e-3 * p.y, 1e-3 * p.z});
        return points;
    case 6: { // one set of coplanar points, no longer coplanar after rounding
        const Transform turn = random.pose(0);
        for (int i = 0; i < 40; ++i)
            points.push_back(apply(turn, 0.5 * (random.on_lattice(3) - Vec3{1.5, 1.5, 1.5})));
        return points;
    }
    default: // a polygon, a segment or a point
        for (int i = random.integer(1, 8); i > 0; --i)
            points.push_back({random.uniform(-1, 1), random.uniform(-1, 1), 0.25});
        return points;
    }
}

TEST(ConvexHull, HoldsAllPointsAndNoVertexIsSuperfluous) {
    Random random(7001);
    std::set<int> dimensions;
    int dropped = 0;
    for (int i = 0; i < many(200); ++i) {
        std::vector<Vec3> points = body_points(random, i);
        if (i % 3 == 0) // a coarse grid makes planes and lines exact
            for (Vec3& p : points)
                p = {std::round(8 * p.x), std::round(8 * p.y), std::round(8 * p.z)};
        const Convex body(points);
        const auto& v = body.vertices();
        double reach = 0;
        for (const Vec3& p : points)
            reach = std::max(reach, max_abs(p));
        dimensions.insert(body.dimension());
        if (body.dimension() < 3)
            continue;
        EXPECT_EQ(v.size() + body.face_count(), body.edges().size() + 2); // Euler's formula
        std::vector<std::set<std::size_t>> faces_at(v.size());
        for (std::size_t f = 0; f < body.face_count(); ++f) {
            const auto face = body.face(f);
            const Vec3 &a = v[face[0]], &b = v[face[1]], &c = v[face[2]];
            for (const Vec3& p : points)
                if (orient3d(a, b, c, p) > 0) {
                    // The hull holds the point only to rounding, which is allowed only where the
                    // points were rounded off their plane.
                    ASSERT_TRUE(i % 3 != 0 && (i % 8 == 3 || i % 8 == 6)) << i;
                    const Vec3 n = normalized_or_zero(cross(b - a, c - a));
                    ASSERT_LE(dot(n, p - a), 0x1p-45 * reach) << i;
                    ++dropped;
                }
            for (const std::uint32_t w : face) {
                ASSERT_EQ(orient3d(a, b, c, v[w]), 0) << i;
                faces_at[w].insert(f);
            }
        }
        for (const auto& faces : faces_at)
            ASSERT_GE(faces.size(), 3U) << i;
    }
    EXPECT_GE(dimensions.size(), 3U);
    EXPECT_GT(dropped, 0);
}

struct Case {
    const Convex &a, &b;
    Transform world_a, world_b;
};

/// The largest n . (p - from) over the placed body.
double farthest(const Convex& c, const Transform& world, const Vec3& n, const Vec3& from) {
    double most = -HUGE_VAL;
    for (const Vec3& p : c.vertices())
        most = std::max(most, dot(n, apply(world, p) - from));
    return most;
}

double extent_from(const Convex& c, const Transform& world, const Vec3& point) {
    double most = 0;
    for (const Vec3& p : c.vertices())
        most = std::max(most, length(apply(world, p) - point));
    return most;
}

/// The largest distance of a point beyond a plane of the body; 0 inside. The map must not
/// mirror. Planes of needles are rounded by a thousand times as much as points.
double outside(const Convex& c, const Transform& world, const Vec3& point) {
    const auto at = [&](std::uint32_t v) { return apply(world, c.vertices()[v]); };
    double most = 0;
    for (std::size_t f = 0; f < c.face_count(); ++f) {
        const auto face = c.face(f);
        const Vec3 corner = at(face[0]);
        const Vec3 n = normalized_or_zero(cross(at(face[1]) - corner, at(face[2]) - corner));
        most = std::max(most, dot(n, point - corner));
    }
    return most;
}

double distance_from_feature(const Convex& c, const Transform& world, Feature kind,
                             std::uint32_t id, const Vec3& point) {
    const auto at = [&](std::uint32_t v) { return apply(world, c.vertices()[v]); };
    if (kind == Feature::vertex)
        return length(point - at(id));
    if (kind == Feature::edge) {
        const auto [v, w] = c.edges()[id];
        return length(cross(point - at(v), normalized_or_zero(at(w) - at(v))));
    }
    const auto face = c.face(id);
    double least = HUGE_VAL;
    // The face's plane comes from its largest triangle, because corners may nearly lie on one line.
    double largest = -1;
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        const Vec3 n = cross(at(face[k]) - at(face[0]), at(face[k + 1]) - at(face[0]));
        if (length(n) > largest) {
            largest = length(n);
            least = std::abs(dot(normalized_or_zero(n), point - at(face[0])));
        }
    }
    return least;
}

/// Proves the answer from all vertices.
void prove(const Case& c, const ConvexGap& gap, double rounding) {
    if (gap.distance == 0) {
        if (c.a.dimension() == 3) {
            EXPECT_LE(outside(c.a, c.world_a, gap.point_a), 1024 * rounding);
        }
        if (c.b.dimension() == 3) {
            EXPECT_LE(outside(c.b, c.world_b, gap.point_b), 1024 * rounding);
        }
        return;
    }
    const Vec3 n = normalized_or_zero(gap.point_b - gap.point_a);
    if (gap.distance > 1e6 * rounding) {
        EXPECT_NEAR(length(gap.point_b - gap.point_a), gap.distance, 16 * rounding);
        // The witness points are rounded, which turns the direction between them.
        const double extent = extent_from(c.a, c.world_a, gap.point_a) +
                              extent_from(c.b, c.world_b, gap.point_b) + gap.distance;
        const double turned = 16 * rounding * extent / gap.distance;
        EXPECT_LE(farthest(c.a, c.world_a, n, gap.point_a), 64 * rounding + turned);
        EXPECT_LE(farthest(c.b, c.world_b, -n, gap.point_b), 64 * rounding + turned);
    }
    EXPECT_LE(distance_from_feature(c.a, c.world_a, gap.feature_a, gap.id_a, gap.point_a),
              64 * rounding);
    EXPECT_LE(distance_from_feature(c.b, c.world_b, gap.feature_b, gap.id_b, gap.point_b),
              64 * rounding);
}

enum class Placement { near, far, small, large, parallel };

class ConvexDistance : public testing::TestWithParam<Placement> {};

/// The Minkowski difference of two needles can be flat to rounding.
TEST(ConvexDistanceOfNeedles, IsProven) {
    Random random(7019);
    int meet = 0, apart = 0;
    for (int i = 0; i < many(4000); ++i) {
        const Convex a(body_points(random, 5)), b(body_points(random, i % 4 == 0 ? 0 : 5));
        const Case c{a, b, random.pose(0), random.pose(0.01)};
        const ConvexGap gap = distance(c.a, c.world_a, c.b, c.world_b);
        prove(c, gap, 0x1p-50);
        ++(gap.distance == 0 ? meet : apart);
        ASSERT_FALSE(HasFailure()) << i;
    }
    EXPECT_GT(meet, many(4000) / 20);
    EXPECT_GT(apart, many(4000) / 20);
}

TEST_P(ConvexDistance, EqualsTheDistanceOfTheTriangles) {
    const Placement placement = GetParam();
    Random random(7010 + static_cast<std::uint64_t>(placement));
    int meet = 0, cases = 0;
    std::array<std::array<int, 3>, 3> features{};
    for (int i = 0; i < many(600); ++i) {
        const int kind_a = random.integer(0, 7), kind_b = random.integer(0, 7);
        const Convex a(body_points(random, kind_a)), b(body_points(random, kind_b));
        const double scale = placement == Placement::small   ? 1e-6
                             : placement == Placement::large ? 1e6
                                                             : 1;
        const Transform size = scaling(scale, scale, scale);
        const Vec3 at = placement == Placement::far ? random.in_cube(1e5) : random.in_cube(3);
        Vec3 off = random.uniform(0, 1.9) * random.direction();
        Transform turn_a = random.pose(0), turn_b = random.pose(0);
        if (placement == Placement::parallel) {
            turn_a = turn_b = Transform();
            off = {std::round(off.x * 8) / 8, std::round(off.y * 8) / 8, std::round(off.z * 8) / 8};
        }
        const Case c{
            a, b,
            compose(translation(scale * at.x, scale * at.y, scale * at.z), compose(turn_a, size)),
            compose(
                translation(scale * (at.x + off.x), scale * (at.y + off.y), scale * (at.z + off.z)),
                compose(turn_b, size))};
        const double rounding = 0x1p-52 * scale * (2 + length(at) + length(off));
        const ConvexGap gap = distance(c.a, c.world_a, c.b, c.world_b);
        prove(c, gap, rounding);
        const Model model_a(a.mesh()), model_b(b.mesh());
        const double surfaces = distance(model_a, c.world_a, model_b, c.world_b).distance;
        if (gap.distance > 0) {
            EXPECT_NEAR(gap.distance, surfaces, 1e-12 * surfaces + 16 * rounding);
            ++features[static_cast<std::size_t>(gap.feature_a)]
                      [static_cast<std::size_t>(gap.feature_b)];
        } else if (a.dimension() < 3 && b.dimension() < 3) {
            EXPECT_LE(surfaces, 16 * rounding);
        }
        EXPECT_NEAR(distance(c.b, c.world_b, c.a, c.world_a).distance, gap.distance,
                    1e-12 * gap.distance + 16 * rounding);
        meet += gap.distance == 0 ? 1 : 0;
        ++cases;
        ASSERT_FALSE(HasFailure())
            << "case " << i << ", kinds " << kind_a << ' ' << kind_b << ", distance "
            << gap.distance << ", of the surfaces " << surfaces;
    }
    EXPECT_GT(meet, cases / 5);
    EXPECT_LT(meet, cases * 4 / 5);
    EXPECT_GT(features[0][2], 0);
    EXPECT_GT(features[1][1], 0);
    EXPECT_GT(features[2][0], 0);
    EXPECT_GT(features[0][1], 0);
}
INSTANTIATE_TEST_SUITE_P(Placements, ConvexDistance,
                         testing::Values(Placement::near, Placement::far, Placement::small,
                                         Placement::large, Placement::parallel));

TEST(ConvexPath, AWarmStartChangesNothing) {
    Random random(7020);
    int meet = 0, apart = 0, far_jumps = 0;
    for (int i = 0; i < many(40); ++i) {
        const Convex a(body_points(random, i)), b(body_points(random, i / 7));
        ConvexWarmStart warm_start;
        Vec3 at = random.uniform(0.2, 2) * random.direction();
        Transform turn = random.pose(0);
        const Transform step = Pose{{}, {1, 0.01 * random.uniform(-1, 1), 0.008, 0.004}};
        for (int s = 0; s < 60; ++s) {
            at = at + 0.02 * random.direction() - 0.01 * normalized_or_zero(at);
            turn = compose(step, turn);
            if (random.chance(0.05)) {
                turn = random.pose(0), at = random.uniform(0.2, 2) * random.direction();
                ++far_jumps;
            }
            Transform world_b = turn;
            world_b.m[9] = at.x, world_b.m[10] = at.y, world_b.m[11] = at.z;
            const Case c{a, b, Transform(), world_b};
            const ConvexGap warm =
                distance(a, c.world_a, b, c.world_b, {.warm_start = &warm_start});
            const ConvexGap cold = distance(a, c.world_a, b, c.world_b);
            EXPECT_NEAR(warm.distance, cold.distance, 1e-12 * cold.distance + 1e-14);
            prove(c, warm, 1e-15);
            (warm.distance > 0 ? apart : meet) += 1;
            ASSERT_FALSE(HasFailure()) << "body " << i << ", step " << s;
        }
    }
    EXPECT_GT(meet, apart / 5);
    EXPECT_GT(apart, meet / 5);
    EXPECT_GT(far_jumps, 20);
}

TEST(ConvexLevels, AllowedErrorsAreRespected) {
    Random random(7030);
    const Convex a(ellipsoid(random, 3000)), b(ellipsoid(random, 700));
    int coarse = 0, cases = 0;
    for (int i = 0; i < many(300); ++i) {
        const Transform world_a = compose(random.linear_map(i % 2 == 0), scaling(0.5, 0.5, 0.5));
        Transform world_b = random.pose(0);
        const Vec3 at = random.uniform(0.5, 4) * random.direction();
        world_b.m[9] = at.x, world_b.m[10] = at.y, world_b.m[11] = at.z;
        const double exact = distance(a, world_a, b, world_b).distance;
        const double error = std::pow(10, random.uniform(-4, -0.5));
        const ConvexGap gap = distance(a, world_a, b, world_b, {.absolute_error = error});
        ASSERT_GE(gap.distance, exact - 1e-14);
        ASSERT_LE(gap.distance, exact + error);
        ASSERT_LE(gap.at_least, exact + 1e-14);
        ASSERT_GE(gap.at_least, gap.distance - error);
        coarse += gap.status == Status::converged ? 1 : 0;
        ++cases;
    }
    EXPECT_GT(coarse, cases / 8);
    EXPECT_LT(coarse, cases);
}

TEST(ConvexLevels, LargeBodiesAreFoundThroughSmallerHulls) {
    Random random(7040);
    const Convex a(ellipsoid(random, 12000)), b(ellipsoid(random, 5000));
    int meet = 0;
    for (int i = 0; i < 200; ++i) {
        Transform world_b = random.pose(0);
        const Vec3 at = random.uniform(0.5, 2.5) * random.direction();
        world_b.m[9] = at.x, world_b.m[10] = at.y, world_b.m[11] = at.z;
        const Case c{a, b, random.pose(0), world_b};
        const ConvexGap gap = distance(a, c.world_a, b, c.world_b);
        prove(c, gap, 1e-15);
        meet += gap.distance == 0 ? 1 : 0;
    }
    EXPECT_GT(meet, 20);
    EXPECT_LT(meet, 180);
}

/// The simplex search alone, from any start vertex, agrees with the walk on features.
TEST(SimplexSearch, AgreesWithTheWalk) {
    Random random(7201);
    int apart = 0, meet = 0;
    for (int i = 0; i < many(1500); ++i) {
        const Convex a(body_points(random, i)), b(body_points(random, i / 8));
        const Transform world_a = random.pose(0), world_b = random.pose(1.2);
        const double rounding = rounding_of(a.data(), world_a, b.data(), world_b);
        const PolytopePair pair(a.data().levels[0].polytope, world_a, b.data().levels[0].polytope,
                                world_b);
        DifferenceSimplex start;
        start.count = 1;
        start.corners[0] = {static_cast<std::uint32_t>(random.integer(0, 1'000'000)) %
                                static_cast<std::uint32_t>(a.vertices().size()),
                            static_cast<std::uint32_t>(random.integer(0, 1'000'000)) %
                                static_cast<std::uint32_t>(b.vertices().size())};
        const GjkState found = gjk(pair, start, rounding);
        const ConvexGap walked = distance(a, world_a, b, world_b);
        ASSERT_NEAR(found.meeting ? 0 : std::sqrt(found.distance_sq), walked.distance,
                    1e-7 * walked.distance + 64 * rounding)
            << i;
        ++(walked.distance > 0 ? apart : meet);
    }
    EXPECT_GT(apart, many(1500) / 5);
    EXPECT_GT(meet, many(1500) / 10);
}

/// A flat body is no nearer than its triangles: the middle of its box lies in none of them.
TEST(ConvexDistance, OfFlatBodiesIsThatOfTheirTriangles) {
    Random random(7301);
    const Convex block(box_mesh({-0.5, -0.75, -1}, {0.5, 0.75, 1}).positions);
    const Model surface(block.mesh());
    int near = 0;
    for (int i = 0; i < many(900); ++i) {
        const double s = random.uniform(0.1, 2);
        const std::vector<Vec3> corners =
            random.chance(0.5)
                ? std::vector<Vec3>{{s, 0, 0}, {0, s, 0}, {0, 0, s}}
                : std::vector<Vec3>{random.in_cube(1), random.in_cube(1), random.in_cube(1)};
        const Transform world = random.pose(0.8);
        const double found = distance(Convex(corners), {}, block, world).distance,
                     truth =
                         distance(Model(Mesh{corners, {{0, 1, 2}}}), {}, surface, world).distance;
        if (truth == 0) // or inside
            continue;
        const bool is_inside = [&] {
            const Vec3 p = apply(inverse(world), corners[0]);
            return std::abs(p.x) < 0.5 && std::abs(p.y) < 0.75 && std::abs(p.z) < 1;
        }();
        EXPECT_NEAR(found, is_inside ? 0 : truth, 1e-12) << i;
        near += !is_inside && truth < 0.3 ? 1 : 0;
    }
    EXPECT_GT(near, many(900) / 40);
}

} // namespace
} // namespace abut::test
