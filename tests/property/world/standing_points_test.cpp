// A body that lies on a half-space, on a mesh or on another body has the points that hold it, and keeps
// their names while it hardly moves.

#include <abut/vector.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

std::set<std::uint64_t> feature_names(const ContactManifold& manifold) {
    std::set<std::uint64_t> names;
    for (std::uint32_t i = 0; i < manifold.count; ++i)
        names.insert(manifold.points.at(i).feature);
    return names;
}

/// The extent of the points of a manifold along x and y.
Vec3 extent_of(const ContactManifold& manifold) {
    Box3 box;
    for (std::uint32_t i = 0; i < manifold.count; ++i)
        extend(box, manifold.points.at(i).point_b);
    return box.upper - box.lower;
}

/// Checks what all manifolds hold. Returns the only one.
ContactManifold checked_manifold(World& world, double margin, double depth) {
    const std::vector<ContactManifold> found = world.contact_manifolds(margin);
    EXPECT_EQ(found.size(), 1U);
    if (found.size() != 1)
        return {};
    const ContactManifold& manifold = found[0];
    EXPECT_EQ(feature_names(manifold).size(), manifold.count);
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        const ContactPoint& point = manifold.points.at(i);
        EXPECT_NEAR(point.depth, depth, 1e-12);
        EXPECT_LE(length(point.point_a - point.point_b - point.depth * manifold.normal), 1e-12);
        EXPECT_LE(point.depth, manifold.points[0].depth + 1e-15);
    }
    return manifold;
}

TEST(StandingPoints, BodiesOnAHalfSpaceHaveTheirCorners) {
    Random random(331);
    const Mesh box = box_mesh({-0.5, -0.25, 0}, {0.5, 0.25, 0.75});
    Mesh soup; // each triangle has its own vertices
    for (const auto& t : box.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (const std::uint32_t vertex : t)
            soup.positions.push_back(box.positions[vertex]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    for (int round = 0; round < many(40); ++round)
        for (int kind = 0; kind < 5; ++kind)
            for (const bool ground_first : {true, false}) {
                SCOPED_TRACE(std::to_string(kind) + " round " + std::to_string(round));
                const double gap =
                    std::array{0.0, 1e-9, -1e-9, -1e-4, 1e-3}.at(std::size_t(random.integer(0, 4)));
                const auto add = [&](World& world, const Pose& pose) {
                    switch (kind) {
                    case 0:
                        return world.add(Box3{{-0.5, -0.25, 0}, {0.5, 0.25, 0.75}}, pose);
                    case 1:
                        return world.add(Convex(box.positions), pose);
                    case 2:
                        return world.add(Model(box), pose);
                    case 3:
                        return world.add(Model(soup), pose);
                    default:
                        return world.add(Capsule{{{-0.5, 0, 0.2}, {0.5, 0, 0.2}}, 0.2}, pose);
                    }
                };
                World world;
                if (ground_first)
                    world.add(HalfSpace{{0, 0, 2}, 0}, {});
                const double turn = random.chance(0.5) ? 0 : random.uniform(0, 3);
                Pose pose{{random.uniform(-9, 9), 0, gap}, {std::cos(turn), 0, 0, std::sin(turn)}};
                const BodyId body = add(world, pose);
                if (!ground_first)
                    world.add(HalfSpace{{0, 0, 2}, 0}, {});
                const ContactManifold at_first = checked_manifold(world, 0.01, -gap);
                ASSERT_EQ(at_first.count, kind == 4 ? 2U : 4U);
                // Without a margin, rounding decides at a gap of 0 whether they touch, but not where.
                for (const ContactManifold& touching : world.contact_manifolds())
                    EXPECT_EQ(feature_names(touching), feature_names(at_first));
                EXPECT_GT(length(extent_of(at_first)), 0.99);
                // It slides, and tilts by rounding.
                pose.translation.x += 1e-3;
                pose.rotation[1] += 1e-15;
                world.move(body, pose);
                EXPECT_EQ(feature_names(checked_manifold(world, 0.01, -gap)),
                          feature_names(at_first));
            }
}

TEST(StandingPoints, OfATiltedBoxOnlyTheLowCornersCount) {
    World world;
    world.add(HalfSpace{{0, 0, 1}, 0}, {});
    const double angle = 0.05; // about the y axis: the edge at +x is low
    world.add(Model(box_mesh({-0.5, -0.25, -0.5}, {0.5, 0.25, 0.5})),
              {{0, 0, 0.5 * std::cos(angle) + 0.5 * std::sin(angle) - 1e-3},
               {std::cos(angle / 2), 0, std::sin(angle / 2), 0}});
    const auto found = world.contact_manifolds(0.01);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].count, 2U);
    EXPECT_NEAR(found[0].points[0].depth, 1e-3, 1e-12);
    const auto wide = world.contact_manifolds(0.1); // the other edge is 0.05 higher
    ASSERT_EQ(wide.size(), 1U);
    EXPECT_EQ(wide[0].count, 4U);
}

TEST(StandingPoints, ACapsuleOnAMeshHasItsEnds) {
    Random random(332);
    const std::array<Model, 2> grounds{
        Model(box_mesh({-20, -20, -1}, {20, 20, 0})),
        Model(grid_mesh(40, 40, false, false, [](double u, double v) {
            return Vec3{20 * u - 10, 20 * v - 10, 0};
        }))};
    for (int round = 0; round < many(60); ++round)
        for (const Model& ground : grounds)
            for (const bool ground_first : {true, false}) {
                const double gap =
                    std::array{0.0, 1e-9, -1e-9, -1e-4, 1e-3}.at(std::size_t(random.integer(0, 4)));
                World world;
                if (ground_first)
                    world.add(ground, {});
                const double turn = random.chance(0.5) ? 0 : random.uniform(0, 3);
                Pose pose{{random.uniform(-5, 5), random.uniform(-5, 5), gap},
                          {std::cos(turn), 0, 0, std::sin(turn)}};
                const BodyId body = world.add(Capsule{{{-0.5, 0, 0.2}, {0.5, 0, 0.2}}, 0.2}, pose);
                if (!ground_first)
                    world.add(ground, {});
                const ContactManifold at_first = checked_manifold(world, 0.01, -gap);
                ASSERT_EQ(at_first.count, 2U);
                for (const ContactManifold& touching : world.contact_manifolds())
                    EXPECT_EQ(feature_names(touching), feature_names(at_first));
                EXPECT_NEAR(length(extent_of(at_first)), 1, 1e-6);
                for (int step = 0; step < 5; ++step) { // over many triangles
                    pose.translation.x += 0.3;
                    world.move(body, pose);
                    const ContactManifold later = checked_manifold(world, 0.01, -gap);
                    EXPECT_EQ(feature_names(later), feature_names(at_first));
                }
            }
}

TEST(StandingPoints, ACapsuleOverARidgeHasItsMiddle) {
    const Model ridge(
        Mesh{{{-1, -2, -1}, {1, -2, -1}, {0, -2, 0}, {-1, 2, -1}, {1, 2, -1}, {0, 2, 0}},
             {{0, 2, 5}, {0, 5, 3}, {2, 1, 4}, {2, 4, 5}}});
    World world;
    world.add(ridge, {});
    world.add(Capsule{{{-0.5, 0, 0.2}, {0.5, 0, 0.2}}, 0.2}, {{0, 0, -1e-3}, {1, 0, 0, 0}});
    const auto found = world.contact_manifolds(0.01);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].count, 1U);
    EXPECT_NEAR(found[0].points[0].depth, 1e-3, 1e-12);
    EXPECT_NEAR(found[0].points[0].point_a.x, 0, 1e-9);
}

TEST(StandingPoints, ABallKeepsItsNameOnAMesh) {
    World world;
    world.add(
        Model(grid_mesh(
            40, 40, false, false,
            [](double u, double v) {
                return Vec3{20 * u - 10, 20 * v - 10, 0.01 * std::sin(9 * u) * std::cos(7 * v)};
            })),
        {});
    const BodyId ball = world.add(Sphere{{}, 0.3}, {});
    std::set<std::uint64_t> names;
    for (int step = 0; step < 50; ++step) {
        world.move(ball, {{0.11 * step - 3, 0.07 * step, 0.3}, {1, 0, 0, 0}});
        for (const ContactManifold& manifold : world.contact_manifolds(0.05))
            for (const std::uint64_t name : feature_names(manifold))
                names.insert(name);
    }
    EXPECT_EQ(names.size(), 1U);
}

/// A prism of twelve sides between two heights.
Mesh twelve_sided(double low, double high) {
    Mesh mesh = prism_mesh(low, high, 0.5, 12);
    for (Vec3& p : mesh.positions) // its axis is x
        p = {p.y, p.z, p.x};
    return mesh;
}

struct NamedShape {
    const char* name;
    AnyShape shape;
};

std::vector<NamedShape> lying_bodies() {
    const Mesh box = box_mesh({-0.5, -0.4, 0}, {0.5, 0.4, 0.6}), prism = twelve_sided(0, 0.8);
    return {{"box", Box3{{-0.5, -0.4, 0}, {0.5, 0.4, 0.6}}},
            {"mesh box", Model(box)},
            {"convex box", Convex(box)},
            {"prism", Convex(prism)},
            {"mesh prism", Model(prism)}};
}

std::vector<NamedShape> flat_grounds() {
    const auto floor = [](int n) {
        return Model(grid_mesh(n, n, false, false, [](double u, double v) {
            return Vec3{4 * u - 2, 4 * v - 2, 0};
        }));
    };
    const Mesh same = box_mesh({-0.5, -0.4, -0.6}, {0.5, 0.4, 0}), prism = twelve_sided(-0.8, 0);
    return {{"half-space", HalfSpace{{0, 0, 1}, 0}},
            {"floor of 0.25 m cells", floor(16)},
            {"floor of 1 m cells", floor(4)},
            {"large box", Box3{{-2, -2, -1}, {2, 2, 0}}},
            {"large mesh box", Model(box_mesh({-2, -2, -1}, {2, 2, 0}))},
            {"equal box", Box3{{-0.5, -0.4, -0.6}, {0.5, 0.4, 0}}},
            {"equal mesh box", Model(same)},
            {"equal convex box", Convex(same)},
            {"prism", Convex(prism)},
            {"mesh prism", Model(prism)}};
}

/// The steps of a body that lies still but for a small motion.
class LyingBody {
public:
    LyingBody(Random& random, const AnyShape& body, const AnyShape& ground, bool is_aligned)
        : random_(random) {
        test::add(world_, ground, {});
        at_.translation.z = -1e-4;
        if (!is_aligned) {
            const double turn = random.uniform(0, 3);
            at_.translation = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), -1e-4};
            at_.rotation = {std::cos(turn), 0, 0, std::sin(turn)};
        }
        body_ = test::add(world_, body, at_);
    }
    /// Moves a little, and counts names and new ones.
    void step(double motion, double margin) {
        const auto some = [&] { return random_.uniform(-motion, motion); };
        Pose pose = at_;
        pose.translation = pose.translation + Vec3{some(), some(), some()};
        for (double& q : pose.rotation)
            q += some();
        world_.move(body_, pose);
        const std::vector<ContactManifold> manifolds = world_.contact_manifolds(margin);
        ASSERT_EQ(manifolds.size(), 1U);
        ASSERT_EQ(manifolds[0].count, 4U);
        std::set<std::uint64_t> now;
        for (const ContactPoint& point : manifolds[0].points) {
            now.insert(point.feature);
            EXPECT_NEAR(point.depth, 1e-4, 10 * motion + 1e-12);
            EXPECT_LE(point.depth, manifolds[0].points[0].depth);
        }
        EXPECT_EQ(now.size(), 4U);
        EXPECT_LE(std::abs(1 - manifolds[0].normal.z), 100 * motion * motion + 1e-15);
        for (const std::uint64_t name : now)
            fresh += last_.empty() || last_.contains(name) ? 0 : 1;
        all += last_.empty() ? 0 : now.size();
        last_ = now;
    }
    std::size_t fresh = 0, all = 0;

private:
    Random& random_;
    World world_;
    Pose at_;
    BodyId body_;
    std::set<std::uint64_t> last_;
};

TEST(NamesAtRest, StayOnEveryGround) {
    Random random(331);
    std::size_t fresh = 0, all = 0;
    for (const NamedShape& body : lying_bodies())
        for (const NamedShape& ground : flat_grounds())
            for (const double margin : {0.0, 0.01})
                for (int round = 0; round < many(6); ++round) {
                    SCOPED_TRACE(std::string(body.name) + " on " + ground.name + ", margin " +
                                 std::to_string(margin) + ", round " + std::to_string(round));
                    LyingBody lies(random, body.shape, ground.shape, round % 3 == 0);
                    for (int step = 0; step < 12; ++step)
                        ASSERT_NO_FATAL_FAILURE(lies.step(step < 8 ? 1e-6 : 1e-15, margin));
                    const bool is_large = std::string(ground.name).find("equal") != 0 &&
                                          std::string(ground.name).find("prism") > 20;
                    if (is_large) {
                        EXPECT_EQ(lies.fresh, 0U);
                    }
                    fresh += lies.fresh, all += lies.all;
                }
    std::cout << fresh << " of " << all << " names are new\n";
    EXPECT_LE(fresh, all / 200);
}

TEST(StandingPoints, TheEndOfACapsuleKeepsItsNameOverAnEdgeOrCornerOfABox) {
    Random random(20261406);
    std::cout << "seed 20261406\n";
    const int rounds = many(300);
    int met = 0;
    for (int round = 0; round < rounds; ++round) {
        const bool over_corner = random.chance(0.5);
        const auto tilt = [&] { return random.uniform(0, 0.3); };
        const Vec3 normal =
            normalized_or_zero({tilt(), over_corner ? tilt() : 0, random.uniform(0.7, 1)});
        const double radius = 0.3;
        const Vec3 centre =
            Vec3{1, over_corner ? 1 : random.uniform(-0.9, 0.9), 1} + (radius - 0.002) * normal;
        const Vec3 axis = random.direction();
        if (dot(axis, normal) < 0.1)
            continue;
        World world;
        world.add(Box3{{-1, -1, -1}, {1, 1, 1}}, {});
        const BodyId capsule = world.add(Capsule{{{}, axis}, radius}, {centre});
        std::set<std::uint64_t> first;
        for (int step = 0; step < 10; ++step) {
            world.move(capsule, {centre + random.in_cube(1e-8)});
            const auto found = world.contact_manifolds(0.02);
            ASSERT_EQ(found.size(), 1U);
            std::set<std::uint64_t> names;
            for (std::uint32_t i = 0; i < found[0].count; ++i) {
                names.insert(found[0].points[i].feature);
                for (std::uint32_t k = 0; k < i; ++k)
                    EXPECT_GT(length(found[0].points[i].point_a - found[0].points[k].point_a),
                              1e-6);
            }
            if (step == 0)
                first = names;
            EXPECT_EQ(names, first) << "round " << round << " step " << step;
        }
        ++met;
    }
    EXPECT_GT(met, rounds / 4);
}

} // namespace
} // namespace abut::test
