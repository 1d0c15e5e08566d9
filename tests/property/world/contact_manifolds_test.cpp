// Contact manifolds of convex bodies: their points against the surfaces, the depths against other
// queries, names over small motions.

#include <abut/progress.h>
#include <abut/world.h>

#include "tests/property/world/box_of.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "world/solids/four_points.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <set>
#include <variant>

namespace abut::test {
namespace {

using Solid = std::variant<Sphere, Capsule, Box3, Convex>;
struct PlacedSolid {
    Solid shape;
    Pose pose;
};

BodyId add_to(World& world, const PlacedSolid& solid, const BodyOptions& options = {}) {
    return std::visit([&](const auto& shape) { return world.add(shape, solid.pose, options); },
                      solid.shape);
}

/// A half side, sometimes of no length.
double random_half(Random& random) {
    return random.chance(0.1) ? 0 : random.chance(0.1) ? 0.01 : random.uniform(0.1, 0.5);
}

/// The hull of a few points, of a box that is turned in its own frame, or of a flat polygon.
Convex random_hull(Random& random) {
    std::vector<Vec3> points;
    if (random.chance(0.3)) {
        const Transform turned = random.pose(0.1);
        const Vec3 half{random.uniform(0.1, 0.4), random.uniform(0.1, 0.4),
                        random.uniform(0.1, 0.4)};
        for (unsigned i = 0; i < 8; ++i)
            points.push_back(apply(turned, {i & 1U ? half.x : -half.x, i & 2U ? half.y : -half.y,
                                            i & 4U ? half.z : -half.z}));
        return Convex(points);
    }
    const bool is_flat = random.chance(0.2);
    const int count = random.integer(4, 24);
    for (int i = 0; i < count; ++i) {
        const Vec3 p = 0.5 * random.direction();
        points.push_back(is_flat ? Vec3{p.x, p.y, 0} : p);
    }
    return Convex(points);
}

Solid random_solid(Random& random) {
    switch (random.integer(0, 5)) {
    case 0:
        return Sphere{random.in_cube(0.1), random_half(random)};
    case 1:
        return Capsule{{random.in_cube(0.5), random.in_cube(0.5)}, random_half(random)};
    case 2:
    case 3:
        return random_hull(random);
    default:
        return box_of(random_half(random), random_half(random), random_half(random));
    }
}

/// Whether the solid has an inside, which another cannot pass through by a small motion.
bool is_thick(const PlacedSolid& solid) {
    if (const auto* box = std::get_if<Box3>(&solid.shape))
        return std::min({box->upper.x, box->upper.y, box->upper.z}) > 0;
    if (const auto* convex = std::get_if<Convex>(&solid.shape))
        return convex->dimension() == 3;
    const auto* capsule = std::get_if<Capsule>(&solid.shape);
    return (capsule != nullptr ? capsule->radius : std::get<Sphere>(solid.shape).radius) > 0;
}

/// Solids that lie in each other and near each other; some turned by quarters, so that faces are
/// parallel.
std::vector<PlacedSolid> random_solids(Random& random, int count) {
    std::vector<PlacedSolid> solids;
    for (int i = 0; i < count; ++i) {
        PlacedSolid solid{random_solid(random), random.pose(0.7)};
        if (random.chance(0.4))
            solid.pose.rotation = {1, 0, 0, double(random.integer(0, 1))};
        solids.push_back(solid);
    }
    return solids;
}

double distance_from_axis(const Segment& axis, const Vec3& p) {
    const Vec3 along = axis.b - axis.a;
    const double sq = length_sq(along);
    const double t = sq > 0 ? std::clamp(dot(p - axis.a, along) / sq, 0.0, 1.0) : 0;
    return length(p - (axis.a + t * along));
}

/// The distance of a point of the body's frame from the surface of the solid.
double from_surface(const Sphere& sphere, const Vec3& p) {
    return std::abs(length(p - sphere.centre) - sphere.radius);
}
double from_surface(const Capsule& capsule, const Vec3& p) {
    return std::abs(distance_from_axis(capsule.axis, p) - capsule.radius);
}
double from_surface(const Box3& box, const Vec3& p) {
    const Vec3 low = box.lower - p, high = p - box.upper;
    return std::abs(std::max({low.x, low.y, low.z, high.x, high.y, high.z}));
}
double from_surface(const Convex& convex, const Vec3& p) {
    double highest = -HUGE_VAL;
    for (std::size_t f = 0; f < convex.face_count(); ++f) {
        const auto loop = convex.face(f);
        const Vec3& first = convex.vertices()[loop[0]];
        Vec3 area;
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            area = area + cross(convex.vertices()[loop[i]] - first,
                                convex.vertices()[loop[i + 1]] - first);
        highest = std::max(highest, dot(normalized_or_zero(area), p - first));
    }
    return std::abs(highest);
}

double from_surface(const PlacedSolid& solid, const Vec3& p) {
    const Transform world = solid.pose;
    const Vec3 moved = p - Vec3{world.m[9], world.m[10], world.m[11]};
    return std::visit(
        [&](const auto& shape) { return from_surface(shape, pull_back(world, moved)); },
        solid.shape);
}

/// Whether two solids meet, b moved by `way`.
bool meet_after(const PlacedSolid& a, PlacedSolid b, const Vec3& way) {
    b.pose.translation = b.pose.translation + way;
    World world;
    add_to(world, a), add_to(world, b);
    return !world.collide().empty();
}

double deepest(const ContactManifold& manifold) {
    double depth = -HUGE_VAL;
    for (std::uint32_t i = 0; i < manifold.count; ++i)
        depth = std::max(depth, manifold.points[i].depth);
    return depth;
}

void expect_sound(const ContactManifold& manifold, double margin, double error) {
    EXPECT_LT(manifold.a.index, manifold.b.index);
    EXPECT_NEAR(length(manifold.normal), 1, 1e-12);
    ASSERT_GE(manifold.count, 1U);
    ASSERT_LE(manifold.count, 4U);
    std::set<std::uint64_t> names;
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        const ContactPoint& point = manifold.points[i];
        EXPECT_TRUE(names.insert(point.feature).second);
        EXPECT_LE(length(point.point_a - point.point_b - point.depth * manifold.normal), error);
        EXPECT_GE(point.depth, -margin - error);
        EXPECT_LE(point.depth, manifold.points[0].depth);
    }
}

TEST(ContactManifolds, PointsLieOnSurfacesAndDepthsSeparate) {
    Random random(6601);
    std::size_t met = 0, apart = 0, several = 0;
    for (int round = 0; round < many(150); ++round) {
        const double margin = random.chance(0.5) ? 0 : random.uniform(0, 0.3);
        const std::vector<PlacedSolid> solids = random_solids(random, 6);
        World world;
        for (const PlacedSolid& solid : solids)
            add_to(world, solid);
        const auto manifolds = world.contact_manifolds(margin);
        const auto gaps = world.within(margin);
        ASSERT_EQ(manifolds.size(), gaps.size());
        for (std::size_t i = 0; i < manifolds.size(); ++i) {
            const ContactManifold& manifold = manifolds[i];
            EXPECT_EQ(manifold.a, gaps[i].a);
            EXPECT_EQ(manifold.b, gaps[i].b);
            expect_sound(manifold, margin, 1e-12);
            EXPECT_NEAR(deepest(manifold), -gaps[i].distance, 1e-12);
            const PlacedSolid &a = solids[manifold.a.index], &b = solids[manifold.b.index];
            // Where two flat boxes cross, the witness points may lie beside both.
            for (std::uint32_t k = 0; k < manifold.count && (is_thick(a) || is_thick(b)); ++k) {
                EXPECT_LE(from_surface(a, manifold.points[k].point_a), 1e-11);
                EXPECT_LE(from_surface(b, manifold.points[k].point_b), 1e-11);
            }
            const double depth = deepest(manifold);
            EXPECT_FALSE(meet_after(a, b, (depth + 1e-9) * manifold.normal));
            if (depth > 1e-6) {
                EXPECT_TRUE(meet_after(a, b, (depth - 1e-9) * manifold.normal));
            }
            (depth > 0 ? met : apart) += 1, several += manifold.count > 1 ? 1 : 0;
        }
    }
    EXPECT_GT(met, 2U * static_cast<std::size_t>(many(150)));
    EXPECT_GT(apart, static_cast<std::size_t>(many(150)) / 4);
    EXPECT_GT(several, static_cast<std::size_t>(many(150)));
}

/// The names of a manifold's points.
std::set<std::uint64_t> names_of(const ContactManifold& manifold) {
    std::set<std::uint64_t> names;
    for (std::uint32_t i = 0; i < manifold.count; ++i)
        names.insert(manifold.points[i].feature);
    return names;
}

TEST(ContactManifolds, ABoxKeepsItsNamesWhileItSlidesAndTilts) {
    Random random(6602);
    World world;
    world.add(box_of(4, 4, 1), {{0, 0, -1}, {1, 0, 0, 0}}, {.is_static = true});
    const BodyId box = world.add(box_of(0.5, 0.4, 0.3), {});
    std::set<std::uint64_t> first;
    for (int step = 0; step < 100; ++step) {
        const double x = -3 + 0.06 * step;
        Pose pose{{x, 0.3 * x, 0.3 - 1e-3}, {1, 0, 0, 0.2}};
        pose.rotation[1] = random.uniform(-1e-3, 1e-3);
        pose.rotation[2] = random.uniform(-1e-3, 1e-3);
        world.move(box, pose);
        const auto manifolds = world.contact_manifolds(0.01);
        ASSERT_EQ(manifolds.size(), 1U);
        EXPECT_EQ(manifolds[0].count, 4U);
        if (step == 0)
            first = names_of(manifolds[0]);
        EXPECT_EQ(names_of(manifolds[0]), first);
    }
}

/// Boxes of the same size over each other: vertices and edges of both lie in the same places.
TEST(ContactManifolds, AStackKeepsItsNamesUnderNoise) {
    Random random(6603);
    World world;
    std::vector<BodyId> boxes(5);
    for (BodyId& box : boxes)
        box = world.add(box_of(0.5, 0.5, 0.5), {});
    std::vector<std::set<std::uint64_t>> first;
    for (int step = 0; step < 100; ++step) {
        for (int i = 0; i < 5; ++i) {
            const Vec3 noise = random.in_cube(2e-3), turn = random.in_cube(5e-4);
            world.move(boxes[static_cast<std::size_t>(i)],
                       {Vec3{0, 0, 0.9995 * i} + noise, {1, turn.x, turn.y, turn.z}});
        }
        const auto manifolds = world.contact_manifolds(0.02);
        ASSERT_EQ(manifolds.size(), 4U);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(manifolds[i].count, 4U);
            EXPECT_GT(std::abs(manifolds[i].normal.z), 0.99);
            if (step == 0)
                first.push_back(names_of(manifolds[i]));
            EXPECT_EQ(names_of(manifolds[i]), first[i]);
        }
    }
}

/// The faces of such a hull are flat only to rounding: it still stands on four points.
TEST(ContactManifolds, ATurnedHullOfABoxStandsOnFourPoints) {
    Random random(6607);
    for (int round = 0; round < many(30); ++round) {
        const Pose turn = random.pose(0);
        Pose back = turn;
        for (std::size_t i = 1; i < 4; ++i)
            back.rotation[i] = -turn.rotation[i];
        std::vector<Vec3> points;
        for (unsigned i = 0; i < 8; ++i)
            points.push_back(apply(
                Transform(turn), {i & 1U ? 0.5 : -0.5, i & 2U ? 0.4 : -0.4, i & 4U ? 0.3 : -0.3}));
        World world;
        world.add(box_of(4, 4, 1), {{0, 0, -1}, {1, 0, 0, 0}}, {.is_static = true});
        const BodyId hull = world.add(Convex(points), {});
        std::set<std::uint64_t> first;
        for (int step = 0; step < 20; ++step) {
            back.translation = {0.1 * step - 1, 0.05 * step, 0.3 + 1e-3 * (step % 3) - 2e-3};
            world.move(hull, back);
            const auto manifolds = world.contact_manifolds(0.01);
            ASSERT_EQ(manifolds.size(), 1U);
            ASSERT_EQ(manifolds[0].count, 4U);
            EXPECT_NEAR(manifolds[0].normal.z, 1, 1e-9);
            if (step == 0)
                first = names_of(manifolds[0]);
            EXPECT_EQ(names_of(manifolds[0]), first);
        }
    }
}

/// The points that `other` has too, up to an error.
std::size_t shared_points(const ContactManifold& manifold, const ContactManifold& other,
                          bool swapped, const Vec3& way, double error) {
    std::size_t shared = 0;
    for (std::uint32_t i = 0; i < manifold.count; ++i)
        for (std::uint32_t k = 0; k < other.count; ++k) {
            const ContactPoint &p = manifold.points[i], &q = other.points[k];
            if (length(p.point_a + way - (swapped ? q.point_b : q.point_a)) <= error &&
                length(p.point_b + way - (swapped ? q.point_a : q.point_b)) <= error) {
                ++shared;
                break;
            }
        }
    return shared;
}

TEST(ContactManifolds, ExchangedOrFarAwayBodiesHaveTheSameContacts) {
    Random random(6604);
    std::size_t points = 0, shared = 0, far = 0, manifolds_seen = 0;
    for (int round = 0; round < many(300); ++round) {
        PlacedSolid a{random_solid(random), random.pose(0.6)},
            b{random_solid(random), random.pose(0.6)};
        World world, exchanged, away;
        add_to(world, a), add_to(world, b);
        add_to(exchanged, b), add_to(exchanged, a);
        const Vec3 way{1e6, -1e6, 5e5};
        a.pose.translation = a.pose.translation + way,
        b.pose.translation = b.pose.translation + way;
        add_to(away, a), add_to(away, b);
        const auto here = world.contact_manifolds(0.1), there = away.contact_manifolds(0.1),
                   back = exchanged.contact_manifolds(0.1);
        ASSERT_EQ(here.size(), back.size());
        if (here.empty() || there.empty())
            continue;
        ++manifolds_seen;
        EXPECT_NEAR(deepest(here[0]), deepest(back[0]), 1e-12);
        EXPECT_NEAR(deepest(here[0]), deepest(there[0]), 1e-8);
        expect_sound(there[0], 0.1, 1e-8);
        points += here[0].count;
        shared += shared_points(here[0], back[0], true, {}, 1e-9);
        far += shared_points(here[0], there[0], false, way, 1e-6);
    }
    EXPECT_GT(manifolds_seen, static_cast<std::size_t>(many(300)) / 3);
    // Of several shortest motions, and of several points to leave out, either may be chosen.
    EXPECT_GT(double(shared), 0.95 * double(points));
    EXPECT_GT(double(far), 0.95 * double(points));
}

/// Twice the area of the hull of some places.
double hull_area(std::vector<std::array<double, 2>> places) {
    std::sort(places.begin(), places.end());
    std::vector<std::array<double, 2>> hull;
    for (int half = 0; half < 2; ++half) {
        const std::size_t begin = hull.size();
        for (const auto& p : places) {
            while (hull.size() >= begin + 2) {
                const auto &o = hull[hull.size() - 2], &q = hull.back();
                if ((q[0] - o[0]) * (p[1] - o[1]) - (q[1] - o[1]) * (p[0] - o[0]) > 0)
                    break;
                hull.pop_back();
            }
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(places.begin(), places.end());
    }
    double sum = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const auto &p = hull[i], &q = hull[(i + 1) % hull.size()];
        sum += p[0] * q[1] - p[1] * q[0];
    }
    return sum;
}

double hull_area(const std::vector<RegionPoint>& points) {
    std::vector<std::array<double, 2>> places;
    places.reserve(points.size());
    for (const RegionPoint& each : points)
        places.push_back({each.x, each.y});
    return hull_area(places);
}

TEST(ContactManifolds, FourPointsHoldAQuarterOfTheArea) {
    Random random(6605);
    double least = 1;
    for (int round = 0; round < many(2000); ++round) {
        std::vector<RegionPoint> points;
        const int count = random.integer(5, 12);
        const double stretch = random.uniform(0.05, 1);
        for (int i = 0; i < count; ++i) {
            const Vec3 d = random.direction();
            points.push_back(
                {stretch * d.x, d.y, random.uniform(0, 1), static_cast<std::uint64_t>(i)});
        }
        double deepest = 0;
        for (const RegionPoint& each : points)
            deepest = std::max(deepest, each.depth);
        std::vector<RegionPoint> kept;
        for (const std::size_t i : four_points(points, 0, {}))
            kept.push_back(points[i]);
        ASSERT_EQ(kept.size(), 4U);
        EXPECT_EQ(kept[0].depth, deepest);
        for (std::size_t i = 1; i < kept.size(); ++i)
            EXPECT_LE(kept[i].depth, kept[i - 1].depth);
        least = std::min(least, hull_area(kept) / hull_area(points));
    }
    std::cout << "least share of the area " << least << '\n';
    EXPECT_GE(least, 0.25);
}

TEST(ContactManifolds, AreTheSameForAnyNumberOfThreads) {
    Random random(6606);
    const std::vector<PlacedSolid> solids = random_solids(random, 60);
    const auto contacts_on = [&](int threads) {
        set_threads(threads);
        World world;
        for (const PlacedSolid& solid : solids)
            add_to(world, solid);
        world.contact_manifolds(0.1);
        return world.contact_manifolds(0.1);
    };
    const auto one = contacts_on(1), four = contacts_on(4);
    set_threads(0);
    ASSERT_EQ(one.size(), four.size());
    EXPECT_GT(one.size(), 60U);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].normal, four[i].normal);
        ASSERT_EQ(one[i].count, four[i].count);
        for (std::uint32_t k = 0; k < one[i].count; ++k) {
            EXPECT_EQ(one[i].points[k].point_a, four[i].points[k].point_a);
            EXPECT_EQ(one[i].points[k].feature, four[i].points[k].feature);
        }
    }
}

/// Ten balls in a row, far apart, and a body that overlaps the first one.
struct Row {
    World world;
    BodyId extra;

    Row(const Vec3& place, std::uint32_t groups) {
        for (int i = 0; i < 10; ++i)
            world.add(Sphere{{}, 1}, {{10.0 * i, 0, 0}});
        extra = world.add(Sphere{{}, 1}, {place}, {.groups = groups});
        static_cast<void>(world.advance(0)), static_cast<void>(world.contact_manifolds(0.1));
    }
    /// Puts another body in the place of the extra one, with the same index.
    void exchange(const Vec3& place, std::uint32_t groups) {
        world.remove(extra);
        world.update(), world.update();
        const BodyId next = world.add(Sphere{{}, 1}, {place}, {.groups = groups});
        EXPECT_EQ(next.index, extra.index);
        extra = next;
    }
    void expect_pairs(std::size_t count) {
        EXPECT_EQ(world.collide().size(), count);
        EXPECT_EQ(world.advance(0).size(), count);
        EXPECT_EQ(world.contact_manifolds(0.1).size(), count);
    }
};

TEST(ContactManifolds, ABodyWithTheIndexOfAnotherFollowsItsOwnRules) {
    for (const Vec3& place : {Vec3{0.5, 0, 0}, Vec3{10.5, 0, 0}, Vec3{5, 0, 0}}) {
        Row allowed({0.5, 0, 0}, 1), forbidden({0.5, 0, 0}, 0);
        const std::size_t overlaps = place.x == 5 ? 0 : 1;
        allowed.expect_pairs(1), forbidden.expect_pairs(0);
        allowed.exchange(place, 0), forbidden.exchange(place, 1);
        allowed.expect_pairs(0), forbidden.expect_pairs(overlaps);
        allowed.exchange({5, 0, 0}, 1), forbidden.exchange({5, 0, 0}, 1);
        allowed.expect_pairs(0), forbidden.expect_pairs(0);
    }
}

TEST(ContactManifolds, BallsFarAwayKeepTheirPoint) {
    World world;
    const double far = 0x1p40;
    world.add(Sphere{{}, 0.2501}, {{far, 0, 0}});
    world.add(Sphere{{}, 0.2501}, {{far + 0.75, 0, 0}});
    const auto manifolds = world.contact_manifolds(0.25);
    ASSERT_EQ(manifolds.size(), 1U);
    EXPECT_EQ(manifolds[0].count, 1U);
}

TEST(ContactManifolds, BoxModelsHaveFourPoints) {
    const Mesh ground = box_mesh({-10, -10, -1}, {10, 10, 0});
    const Model box(box_mesh({-1, -1, -1}, {1, 1, 1}));
    for (int kind = 0; kind < 3; ++kind) {
        World world;
        if (kind == 0)
            world.add(Model(ground), {}, {.is_static = true});
        else if (kind == 1)
            world.add(Box3{{-10, -10, -1}, {10, 10, 0}}, {}, {.is_static = true});
        else
            world.add(Convex(ground.positions), {}, {.is_static = true});
        world.add(box, {{3, 2, 0.99}});
        const auto manifolds = world.contact_manifolds();
        ASSERT_EQ(manifolds.size(), 1U);
        EXPECT_EQ(manifolds[0].count, 4U);
        EXPECT_LT(length(manifolds[0].normal - Vec3{0, 0, 1}), 1e-12);
        for (const ContactPoint& point : manifolds[0].points)
            EXPECT_NEAR(point.depth, 0.01, 1e-12);
    }
}

} // namespace
} // namespace abut::test
