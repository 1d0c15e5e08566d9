#pragma once

#include <abut/convex_pieces.h>
#include <abut/shape_queries.h>

#include "math/predicates.h"
#include "math/transform.h"
#include "pieces/pieces_data.h"
#include "tests/support/oracle/brute_force.h"
#include "tests/support/oracle/precise_distance.h"
#include "tests/support/random.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

/// The answers of solids of convex pieces, compared with every pair of their triangles by exact
/// signs, and with each other.
namespace abut::test {

/// Whether a surface winds around a point off it: exact, by the triangles that a ray crosses.
inline bool winds_around(const std::vector<PlacedTriangle>& surface, const Vec3& point,
                         Random& random) {
    for (;;) {
        const Vec3 far = point + 1e3 * random.direction();
        int count = 0;
        bool is_clear = true;
        for (const PlacedTriangle& triangle : surface) {
            const Triangle& t = triangle.corners;
            if (collinear(t[0], t[1], t[2]))
                continue;
            const int from = orient3d(t[0], t[1], t[2], point),
                      to = orient3d(t[0], t[1], t[2], far);
            const int u = orient3d(point, far, t[0], t[1]), v = orient3d(point, far, t[1], t[2]),
                      w = orient3d(point, far, t[2], t[0]);
            const bool holds = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
            if (from * to > 0 || !holds)
                continue;
            is_clear = is_clear && from != 0 && to != 0 && u != 0 && v != 0 && w != 0;
            count += to;
        }
        if (is_clear)
            return count != 0;
    }
}

/// What two solids are to each other, by all their triangles.
struct PiecesTruth {
    std::vector<TrianglePair> touching;
    bool meet = false;
    double distance = 0;
};

inline PiecesTruth look(const Model& a, const Transform& world_a, const Model& b,
                        const Transform& world_b, Random& random) {
    const auto of_a = placed_triangles(a.mesh(), world_a),
               of_b = placed_triangles(b.mesh(), world_b);
    PiecesTruth truth;
    truth.touching = brute_pairs(of_a, of_b);
    const auto holds_one = [&](const auto& outer, const auto& inner) {
        return std::any_of(inner.begin(), inner.end(), [&](const PlacedTriangle& t) {
            return winds_around(outer, t.corners[0], random);
        });
    };
    truth.meet = !truth.touching.empty() || holds_one(of_a, of_b) || holds_one(of_b, of_a);
    if (!truth.meet)
        truth.distance = brute_distance(of_a, of_b);
    return truth;
}

/// Distance of two surfaces to 100 digits, if in double precision it is `distance` to an error.
inline Precise precise_least(const Model& a, const Transform& world_a, const Model& b,
                             const Transform& world_b, double distance, double error) {
    const auto of_a = placed_triangles(a.mesh(), world_a),
               of_b = placed_triangles(b.mesh(), world_b);
    Precise least = std::numeric_limits<double>::infinity();
    const double bound = distance + 2 * error;
    for (const PlacedTriangle& s : of_a)
        for (const PlacedTriangle& t : of_b)
            if (box_distance_sq(s.box, t.box) * (1 - 1e-12) <= bound * bound &&
                triangle_triangle_distance(s.corners, t.corners).distance_sq * (1 - 1e-12) <=
                    bound * bound)
                keep_least(least, precise_distance(s.corners, t.corners));
    return least;
}

/// The distance of a point from a triangle of a model.
inline double off(const Model& m, const Transform& world, std::uint32_t triangle,
                  const Vec3& point) {
    const Mesh one{m.mesh().positions, {m.mesh().triangles[triangle]}};
    return nearest(Model(one), world, point).distance;
}

/// The largest coordinate of a placed model.
inline double extent(const Model& m, const Transform& world) {
    double largest = 0;
    for (const Vec3& position : m.mesh().positions) {
        const Vec3 p = apply(world, position);
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest;
}

/// All four queries say what the triangles say. Whether the solids meet.
inline bool agree(const ConvexPieces& a, const Transform& world_a, const ConvexPieces& b,
                  const Transform& world_b, PiecesWarmStart* warm_start, Random& random) {
    const PiecesTruth truth = look(a.model(), world_a, b.model(), world_b, random);
    const double rounding = 0x1p-47 * (8 + extent(a.model(), world_a) + extent(b.model(), world_b));

    const PiecesGap gap = distance(a, world_a, b, world_b, {.warm_start = warm_start});
    EXPECT_EQ(gap.distance == 0, truth.meet) << gap.distance;
    EXPECT_NEAR(gap.distance, truth.distance, 1e-12 * truth.distance + rounding);
    EXPECT_LE(gap.at_least, gap.distance);
    // A hundred digits take time: mostly where the bound is above what double precision finds.
    if (gap.at_least > truth.distance || random.chance(0.02)) {
        EXPECT_LE(gap.at_least,
                  precise_least(a.model(), world_a, b.model(), world_b, truth.distance, rounding))
            << truth.distance - gap.at_least;
    }
    EXPECT_EQ(gap.status, Status::exact);
    if (gap.distance > 0) {
        EXPECT_LE(off(a.model(), world_a, gap.triangle_a, gap.point_a), rounding);
        EXPECT_LE(off(b.model(), world_b, gap.triangle_b, gap.point_b), rounding);
    }

    const double cold = distance(a, world_a, b, world_b).distance;
    EXPECT_TRUE(within(a, world_a, b, world_b, cold, {.warm_start = warm_start}));
    EXPECT_EQ(within(a, world_a, b, world_b, 0, {.warm_start = warm_start}), truth.meet);
    if (const double less = cold * (1 - 1e-9) - 2 * rounding; less > 0) {
        EXPECT_FALSE(within(a, world_a, b, world_b, less, {.warm_start = warm_start}));
    }

    const PiecesContacts first = collide(a, world_a, b, world_b, {.warm_start = warm_start});
    const PiecesContacts all =
        collide(a, world_a, b, world_b, {.mode = ContactMode::all, .triangles = true});
    EXPECT_EQ(first.meet, truth.meet);
    EXPECT_EQ(all.meet, truth.meet);
    EXPECT_EQ(all.triangles, truth.touching);
    const auto is_listed = [&](const PiecePair& pair) {
        return std::binary_search(all.pairs.begin(), all.pairs.end(), pair);
    };
    EXPECT_TRUE(std::all_of(first.pairs.begin(), first.pairs.end(), is_listed));
    for (const TrianglePair& t : truth.touching)
        EXPECT_TRUE(is_listed(PiecePair{a.data().piece_of[t.a], b.data().piece_of[t.b]}));
    EXPECT_EQ(collide(a, world_a, b, world_b, {.mode = ContactMode::all}).pairs, all.pairs);

    const PiecesDepth depth = penetration(a, world_a, b, world_b, {.separation = false});
    EXPECT_EQ(depth.meet, truth.meet);
    if (!truth.meet) {
        EXPECT_EQ(depth.depth, 0);
    }
    return truth.meet;
}

} // namespace abut::test
