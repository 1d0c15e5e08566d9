// Solids as unions of convex pieces: the pieces against rational arithmetic, the queries against
// those of the triangles.

#include <abut/convex_pieces.h>
#include <abut/shape_queries.h>

#include "convex/closest_points.h"
#include "convex/exact_hull.h"
#include "geometry/point_triangle_distance.h"
#include "math/predicates.h"
#include "pieces/hull_tree.h"
#include "pieces/pieces_data.h"
#include "pieces/relative_motion.h"
#include "rigid/solid.h"
#include "scenes/bodies.h"
#include "tests/support/rational_clip.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Cells of a lattice, at random; where the surface is no closed one, a U of them.
Mesh random_cells(Random& random, int n) {
    for (int attempt = 0; attempt < 40; ++attempt) {
        const auto side = static_cast<std::size_t>(n);
        std::vector<bool> solid(side * side * side);
        for (std::size_t i = 0; i < solid.size(); ++i)
            solid[i] = random.chance(0.55);
        Mesh m = cells_mesh(n, [&](int x, int y, int z) {
            return bool(
                solid[(static_cast<std::size_t>(x) * side + static_cast<std::size_t>(y)) * side +
                      static_cast<std::size_t>(z)]);
        });
        const MeshReport report = inspect(m);
        if (report.closed && report.flipped_edges == 0)
            return m;
    }
    return cells_mesh(3, [](int x, int /*y*/, int z) { return x != 1 || z == 0; });
}

Mesh random_star(Random& random) {
    std::vector<Vec3> polygon;
    const int n = random.integer(5, 12);
    for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n, r = random.uniform(0.5, 2);
        polygon.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
    return star_prism(polygon, random.uniform(0.3, 1.5));
}

constexpr int kKinds = 10;

/// About 2 across, not all of them in the middle.
Mesh make_solid(Random& random, int kind) {
    const auto seed = static_cast<std::uint64_t>(random.integer(1, 1000));
    switch (kind % kKinds) {
    case 0:
        return transformed(random_cells(random, 3), scaling(0.75, 0.75, 0.75));
    case 1:
        return random_star(random);
    case 2:
        return gear_mesh(random.integer(3, 8), 0.8, 1.2, 0.4);
    case 3:
        return scenes::boulder(128, seed);
    case 4:
        return torus_mesh(1, random.uniform(0.2, 0.6), random.integer(5, 14),
                          random.integer(4, 10));
    case 5: // a cavity
        return joined(box_mesh({-1, -1, -1}, {1, 1, 1}),
                      reversed(box_mesh({-0.5, -0.5, -0.5}, {0.6, 0.7, 0.8})));
    case 6: // two that go into each other
        return joined(random_star(random), box_mesh({-0.4, -0.4, -0.4}, {0.4, 0.4, 2}));
    case 7: // planes that are none, to rounding
        return transformed(random_cells(random, 3), random.pose(0));
    case 8:
        return with_degenerates(random, gear_mesh(4, 0.5, 1, 0.7), 4);
    default:
        return transformed(random_cells(random, 2), scaling(1, 1, 0.5));
    }
}

Triangle corners(const Mesh& mesh, std::uint32_t t) {
    const auto& v = mesh.triangles[t];
    return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
}

std::vector<RationalPlane> planes_of(const Convex& body) {
    std::vector<RationalPlane> planes;
    for (std::size_t f = 0; f < body.face_count(); ++f) {
        const auto face = body.face(f);
        const RationalVec3 a(body.vertices()[face[0]]), b(body.vertices()[face[1]]),
            c(body.vertices()[face[2]]);
        const RationalVec3 n = cross(b - a, c - a);
        planes.push_back({n, dot(n, a)});
    }
    return planes;
}

/// Whether a triangle enters the inside of a body.
class EntryTest {
public:
    explicit EntryTest(const Convex& body) : planes_(planes_of(body)) {
        for (const Vec3& v : body.vertices())
            extend(box_, v);
    }
    bool operator()(const Triangle& t) const {
        Box3 box;
        for (const Vec3& p : t)
            extend(box, p);
        return overlap(box, box_) && clip_enters(t, planes_);
    }

private:
    std::vector<RationalPlane> planes_;
    Box3 box_;
};

Vec3 random_point_of(Random& random, const Convex& body) {
    Vec3 sum;
    double weights = 0;
    for (const Vec3& v : body.vertices()) {
        const double w = -std::log(random.uniform(1e-9, 1));
        sum = sum + w * v, weights += w;
    }
    return (1 / weights) * sum;
}

TEST(Decomposition, HasEachTriangleOnceOnTheHullOfItsPieceInsideTheSolid) {
    Random random(8101);
    int volumes = 0, flat = 0, larger = 0, entered = 0, probes = 0;
    for (int i = 0; i < many(30); ++i) {
        const Mesh mesh = make_solid(random, i);
        const ConvexPieces pieces{Model(mesh)};
        std::vector<int> used(mesh.triangles.size());
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            const Convex hull = pieces.hull(p);
            const auto triangles = pieces.triangles(p);
            std::vector<bool> mine(mesh.triangles.size());
            for (const std::uint32_t t : triangles) {
                ++used[t];
                mine[t] = true;
                const Triangle c = corners(mesh, t);
                for (const Vec3& v : hull.vertices())
                    ASSERT_LE(orient3d(c[0], c[1], c[2], v), 0) << i << ' ' << t;
            }
            larger += triangles.size() > 1 ? 1 : 0;
            flat += hull.dimension() == 2 && triangles.size() > 1 ? 1 : 0;
            if (hull.dimension() == 3) {
                ++volumes;
                const EntryTest enters(hull);
                for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
                    if (!mine[t]) {
                        ASSERT_FALSE(enters(corners(mesh, t))) << i << ' ' << t;
                    }
            } else if (hull.dimension() < 2) {
                continue; // of triangles without an area: hairs outside, perhaps
            }
            // Just below a flat piece; anywhere in another.
            const Triangle first = corners(mesh, triangles[0]);
            const Vec3 normal = normalized_or_zero(cross(first[1] - first[0], first[2] - first[0]));
            const double below = hull.dimension() == 2 ? 1e-7 : 0;
            for (int k = 0; k < 3; ++k, ++probes) {
                const Vec3 point = random_point_of(random, hull) - below * normal;
                // Some hulls are as thin as rounding.
                if (nearest(pieces.model(), {}, point).distance > 1e-12) {
                    ASSERT_GE(winding_number(mesh, point), 1 - 1e-6) << i << " piece " << p;
                }
            }
            // The whole has triangles that enter the hull of two pieces, or the oracle sees none.
            if (p > 0 && hull.dimension() == 3) {
                std::vector<Vec3> both = hull.vertices();
                const Convex other = pieces.hull(p - 1);
                both.insert(both.end(), other.vertices().begin(), other.vertices().end());
                const EntryTest enters{Convex(both)};
                for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
                    if (enters(corners(mesh, t))) {
                        ++entered;
                        break;
                    }
            }
        }
        for (std::size_t t = 0; t < used.size(); ++t)
            ASSERT_EQ(used[t], 1) << i << ' ' << t;
    }
    EXPECT_GE(volumes, many(75));
    EXPECT_GE(flat, many(10));
    EXPECT_GE(larger, many(150));
    EXPECT_GE(entered, many(25));
    EXPECT_GE(probes, many(500));
}

TEST(HullTree, ParentsHoldTheirChildren) {
    Random random(8108);
    std::size_t parents = 0;
    for (int i = 0; i < many(30); ++i) {
        const ConvexPieces pieces{Model(make_solid(random, i))};
        const HullTree& tree = pieces.data().tree;
        std::vector<int> seen(pieces.size());
        for (const HullNode& node : tree.nodes) {
            for (const HullVertex& v : node.hull.vertices)
                ASSERT_LE(length(v.at - node.middle), node.radius);
            if (node.is_leaf()) {
                ++seen[node.piece];
                continue;
            }
            ++parents;
            for (std::uint32_t c = node.child; c < node.child + node.children; ++c)
                for (const HullVertex& v : tree.nodes[c].hull.vertices) {
                    // To what hulls leave out.
                    const Vec3 d = random.direction();
                    const std::uint32_t top = climb(node.hull, d, 0);
                    ASSERT_LE(dot(d, v.at), dot(d, node.hull.vertices[top].at) + 0x1p-44 * 4);
                }
        }
        for (const int n : seen)
            ASSERT_EQ(n, 1);
    }
    EXPECT_GE(parents, static_cast<std::size_t>(many(60)));
}

/// Turned cells have points that are collinear and coplanar but for rounding: at such vertices a
/// walk must not end on the wrong side.
TEST(HullTree, WalksEndWhereverTheyBegin) {
    Random random(8110);
    int walks = 0, inside = 0;
    std::size_t left_out = 0;
    for (int i = 0; i < many(20); ++i) {
        const ConvexPieces pieces{Model(transformed(random_cells(random, 3), random.pose(0)))};
        const ConvexPiecesData& data = pieces.data();
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            const Polytope& hull = data.tree.nodes[data.tree.leaf_of[p]].hull;
            std::vector<Vec3> given;
            for (const std::uint32_t t : pieces.triangles(p))
                for (const Vec3& v : corners(pieces.model().mesh(), t))
                    given.push_back(v);
            const Convex body(given);
            if (body.dimension() < 3)
                continue;
            left_out += exact_hull(given).vertices.size() - hull.vertices.size();
            const Mesh surface = body.mesh();
            const Vec3 at = random_point_of(random, body) +
                            (i % 2 == 0 ? 0 : random.uniform(0, 1)) * random.direction();
            double expected = HUGE_VAL;
            bool out = false;
            for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
                const Triangle c = corners(surface, t);
                out = out || orient3d(c[0], c[1], c[2], at) > 0;
                expected =
                    std::min(expected, std::sqrt(point_triangle_distance(at, c).distance_sq));
            }
            inside += out ? 0 : 1;
            const Polytope point{{{at, 0, 0}}, {}, {}};
            const Transform unmoved;
            for (std::uint32_t v = 0; v < hull.vertices.size(); ++v, ++walks) {
                ClosestPointSearch search;
                search.at.a = vertex_feature(v);
                find_closest_points({hull, unmoved, point, unmoved}, 0x1p-49, search);
                ASSERT_NEAR(search.at.end == WalkEnd::meeting ? 0
                                                              : std::sqrt(search.at.distance_sq),
                            out ? expected : 0, 1e-12)
                    << i << " piece " << p << " from " << v;
            }
        }
    }
    EXPECT_GE(walks, many(200));
    EXPECT_GE(inside, many(10));
    EXPECT_GE(left_out, static_cast<std::size_t>(many(5)));
}

TEST(RelativeMotion, NoTwoPointsComeNearerThanItSays) {
    Random random(8109);
    int tight = 0;
    for (int i = 0; i < many(3000); ++i) {
        const BodyBall a{random.in_cube(), random.uniform(0, 1)},
            b{random.in_cube(), random.uniform(0, 1)};
        const bool rigid = i % 3 != 0, a_stands = i % 2 == 0;
        const auto step = [&](const Transform& from) {
            const Vec3 v = std::sin(random.uniform(0, 0.1)) * random.direction();
            const Transform turn(Pose{random.in_cube(0.1), {1, v.x, v.y, v.z}});
            return compose(turn, rigid ? from : compose(from, scaling(1.1, 0.9, 1)));
        };
        const PosePair from{
            compose(translation(random.uniform(-9, 9), 0, 0), random.linear_map(!rigid)),
            compose(translation(0, random.uniform(-9, 9), 0), random.linear_map(!rigid))};
        const PosePair to{a_stands ? from.a : step(from.a), step(from.b)};
        const double bound = most_approach(from, to, a, b);
        double most = 0;
        for (int k = 0; k < 30; ++k) {
            const Vec3 p = a.middle + a.radius * random.direction(),
                       q = b.middle + b.radius * random.direction();
            most = std::max(most, length(apply(from.b, q) - apply(from.a, p)) -
                                      length(apply(to.b, q) - apply(to.a, p)));
        }
        ASSERT_LE(most, bound) << i;
        tight += most > 0.3 * bound ? 1 : 0;
        // Bodies that move together have not moved.
        if (rigid) {
            const Transform together = random.pose(3);
            const PosePair moved{compose(together, from.a), compose(together, from.b)};
            ASSERT_LE(most_approach(from, moved, a, b), 1e-9);
        }
    }
    EXPECT_GE(tight, many(3000) / 15);
}

/// Two solids and where they stand.
struct Scene {
    Model a, b;
    Transform world_a, world_b;
};

bool share_a_point(const Scene& s) {
    if (collide(s.a, s.world_a, s.b, s.world_b).any())
        return true;
    // Where a surface goes through itself it may wind around a point twice: parity does not do.
    const auto contains_any = [](const Model& outer, const Transform& world_outer,
                                 const Model& inner, const Transform& world_inner) {
        const Transform outer_from_inner = compose(inverse(world_outer), world_inner);
        const auto& triangles = inner.mesh().triangles;
        return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
            const Vec3 p = apply(outer_from_inner, inner.mesh().positions[t[0]]);
            return std::abs(winding_number(outer.mesh(), p)) > 0.5;
        });
    };
    return contains_any(s.a, s.world_a, s.b, s.world_b) ||
           contains_any(s.b, s.world_b, s.a, s.world_a);
}

/// Of world coordinates, as the queries of triangles take them.
double rounding_at(const Transform& a, const Transform& b) {
    double size = 8;
    for (std::size_t i = 9; i < 12; ++i)
        size += std::abs(b.m[i]) + std::abs(a.m[i]);
    return 0x1p-48 * size;
}

/// Checks one answer against the triangles. Whether the solids are apart.
bool check(const Scene& s, const PiecesGap& gap) {
    if (gap.distance == 0) {
        // Nearer than rounding is at distance 0.
        const bool meet = share_a_point(s);
        EXPECT_TRUE(meet || distance(s.a, s.world_a, s.b, s.world_b).distance <=
                                rounding_at(s.world_a, s.world_b));
        return false;
    }
    const Gap surfaces = distance(s.a, s.world_a, s.b, s.world_b);
    EXPECT_NEAR(gap.distance, surfaces.distance,
                1e-12 * surfaces.distance + rounding_at(s.world_a, s.world_b));
    EXPECT_FALSE(share_a_point(s));
    EXPECT_NEAR(length(gap.point_b - gap.point_a), gap.distance,
                1e-12 + 64 * rounding_at(s.world_a, s.world_b));
    // The points lie on the triangles that are named.
    const auto on = [](const Model& m, const Transform& world, std::uint32_t triangle,
                       const Vec3& point) {
        Mesh one{m.mesh().positions, {m.mesh().triangles[triangle]}};
        return nearest(Model(one), world, point).distance <= 1e-9;
    };
    EXPECT_TRUE(on(s.a, s.world_a, gap.triangle_a, gap.point_a));
    EXPECT_TRUE(on(s.b, s.world_b, gap.triangle_b, gap.point_b));
    return true;
}

TEST(ConvexPiecesDistance, IsThatOfTheTriangles) {
    Random random(8102);
    int apart = 0, meet = 0;
    for (int i = 0; i < many(60); ++i) {
        const Model a(make_solid(random, random.integer(0, kKinds - 1))),
            b(transformed(make_solid(random, random.integer(0, kKinds - 1)),
                          i % 4 == 0 ? scaling(0.1, 0.1, 0.1) : Transform()));
        const ConvexPieces pieces_a(a), pieces_b(b);
        for (int k = 0; k < 8; ++k) {
            const bool rigid = k < 6;
            Scene s{a, b, random.linear_map(!rigid), random.linear_map(!rigid)};
            const Vec3 at = k == 5 ? random.in_cube(1e4) : random.in_cube(2);
            const Vec3 off = random.uniform(0, k == 0 ? 0.3 : 5) * random.direction();
            s.world_a = compose(translation(at.x, at.y, at.z), s.world_a);
            s.world_b = compose(translation(at.x + off.x, at.y + off.y, at.z + off.z), s.world_b);
            if (k == 4) // parallel, on a lattice
                s.world_a = translation(0, 0, 0),
                s.world_b = translation(std::round(off.x * 4) / 4, std::round(off.y * 4) / 4,
                                        std::round(off.z * 4) / 4);
            const PiecesGap gap = distance(pieces_a, s.world_a, pieces_b, s.world_b);
            (check(s, gap) ? apart : meet) += 1;
            const double tolerance = random.uniform(0, 2);
            if (std::abs(tolerance - gap.distance) > 1e-9) {
                EXPECT_EQ(within(pieces_a, s.world_a, pieces_b, s.world_b, tolerance),
                          gap.distance <= tolerance);
            }
            const double error = random.uniform(0, 1);
            const PiecesGap rough =
                distance(pieces_a, s.world_a, pieces_b, s.world_b, {.max_error = error});
            EXPECT_LE(rough.at_least, gap.distance + 1e-12);
            EXPECT_GE(rough.distance, gap.distance - 1e-12);
            EXPECT_LE(rough.distance, gap.distance + error + 1e-12);
        }
        if (testing::Test::HasFailure())
            FAIL() << "case " << i;
    }
    EXPECT_GE(apart, many(100));
    EXPECT_GE(meet, many(100));
}

/// No piece of the cube reaches its middle.
TEST(ConvexPiecesDistance, OfOneDeepInsideOfTheOther) {
    Random random(8107);
    const Model a(pitted_cube_mesh());
    const ConvexPieces pieces_a(a);
    int contained = 0, apart = 0;
    for (int i = 0; i < many(10); ++i) {
        const Model b(transformed(make_solid(random, i), scaling(0.04, 0.04, 0.04)));
        const ConvexPieces pieces_b(b);
        PiecesWorkspace workspace;
        for (int k = 0; k < 20; ++k) {
            const Transform turn = random.pose(0);
            const Vec3 at = Vec3{3.5, 3.5, 3.5} + random.in_cube(k % 2 == 0 ? 1.5 : 4.5);
            const Scene s{a, b, {}, compose(translation(at.x, at.y, at.z), turn)};
            const PiecesGap gap =
                distance(pieces_a, s.world_a, pieces_b, s.world_b, {.workspace = &workspace});
            apart += check(s, gap) ? 1 : 0;
            contained += collide(pieces_b, s.world_b, pieces_a, s.world_a).contained ? 1 : 0;
            if (gap.distance == 0) {
                EXPECT_TRUE(contains(a, s.world_a, gap.point_a).side != Side::outside ||
                            nearest(a, s.world_a, gap.point_a).distance <= 1e-12);
            }
        }
    }
    EXPECT_GE(contained, many(10));
    EXPECT_GE(apart, many(10));
}

/// Brings b against a: apart by next to nothing, or inside by that.
TEST(ConvexPiecesDistance, OfSolidsThatAlmostTouch) {
    Random random(8103);
    int apart = 0, meet = 0;
    for (int i = 0; i < many(60); ++i) {
        const Model a(make_solid(random, i)), b(make_solid(random, random.integer(0, kKinds - 1)));
        const ConvexPieces pieces_a(a), pieces_b(b);
        Scene s{a, b, random.pose(0), random.pose(0)};
        const Vec3 direction = random.direction();
        const Transform turn = s.world_b;
        double offset = 8;
        const auto place = [&](double by) {
            const Vec3 d = by * direction;
            s.world_b = compose(translation(d.x, d.y, d.z), turn);
        };
        for (int step = 0; step < 100; ++step) {
            place(offset);
            const double gap = distance(a, s.world_a, b, s.world_b).distance;
            offset -= gap;
            if (gap < 1e-9 || offset < 0)
                break;
        }
        if (offset < 0)
            continue; // one passes through the hole of the other
        for (const double by : {1e-3, 1e-6, 1e-9, 0.0, -1e-9, -1e-6, -1e-3}) {
            place(offset + by);
            (check(s, distance(pieces_a, s.world_a, pieces_b, s.world_b)) ? apart : meet) += 1;
        }
    }
    EXPECT_GE(apart, many(100));
    EXPECT_GE(meet, many(60));
}

class ConvexPiecesPath : public testing::TestWithParam<bool> {};

TEST_P(ConvexPiecesPath, AWorkspaceChangesNoAnswer) {
    const bool both_move = GetParam();
    Random random(8104 + (both_move ? 1 : 0));
    int apart = 0, meet = 0, few = 0;
    for (int i = 0; i < many(30); ++i) {
        const Model a(make_solid(random, random.integer(0, kKinds - 1))),
            b(transformed(make_solid(random, random.integer(0, kKinds - 1)),
                          i % 5 == 0 ? scaling(0.1, 0.1, 0.1) : Transform()));
        const ConvexPieces pieces_a(a), pieces_b(b);
        PiecesWorkspace workspace;
        const Vec3 axis = random.direction(), across = random.direction();
        const double from = random.uniform(-6, -2), step = random.uniform(0.01, 0.1);
        const bool affine = i % 7 == 0;
        const Transform shape = affine ? random.linear_map(true) : Transform();
        for (int k = 0; k < 100; ++k) {
            const double angle = 0.02 * k;
            const auto turned = [&](double by, const Vec3& at) {
                const Vec3 v = std::sin(by) * axis;
                return Transform(Pose{at, {std::cos(by), v.x, v.y, v.z}});
            };
            const Vec3 at = (from + step * k) * across + Vec3{0, 0, 0.5};
            Scene s{a, b, both_move ? turned(-angle, {3 * std::sin(angle), 0, 0}) : Transform(),
                    compose(turned(angle, at), shape)};
            if (k % 40 == 39)
                s.world_b = random.pose(3);
            const PiecesGap warm =
                distance(pieces_a, s.world_a, pieces_b, s.world_b, {.workspace = &workspace});
            const PiecesGap cold = distance(pieces_a, s.world_a, pieces_b, s.world_b);
            (warm.distance > 0 ? apart : meet) += 1;
            few += warm.counters.hull_pairs <= 2 ? 1 : 0;
            ASSERT_NEAR(warm.distance, cold.distance,
                        1e-12 * cold.distance + rounding_at(s.world_a, s.world_b))
                << i << ' ' << k << " surfaces " << distance(a, s.world_a, b, s.world_b).distance
                << " warm " << warm.piece_a << " " << warm.piece_b << " cold " << cold.piece_a
                << " " << cold.piece_b << " sizes " << pieces_a.size() << " " << pieces_b.size()
                << " hulls "
                << distance(pieces_a.hull(warm.piece_a), s.world_a, pieces_b.hull(warm.piece_b),
                            s.world_b)
                       .distance
                << " " << warm.counters.hull_pairs << " f " << int(warm.feature_a) << " "
                << int(warm.feature_b) << " simp " << warm.counters.simplices;
            if (k % 10 == 0) {
                check(s, warm);
            }
            // Questions of other kinds in between share the workspace.
            if (k % 7 == 3) {
                const double tolerance = cold.distance + (k % 2 == 0 ? 0.01 : -0.01);
                ASSERT_EQ(within(pieces_a, s.world_a, pieces_b, s.world_b, std::max(0.0, tolerance),
                                 &workspace),
                          tolerance >= cold.distance || cold.distance == 0);
            }
            if (k % 7 == 5) {
                ASSERT_EQ(
                    collide(pieces_a, s.world_a, pieces_b, s.world_b, {.workspace = &workspace})
                        .meet,
                    cold.distance == 0);
            }
        }
        if (testing::Test::HasFailure())
            FAIL() << "case " << i;
    }
    EXPECT_GE(apart, many(800));
    EXPECT_GE(meet, many(100));
    EXPECT_GE(few, many(200));
}

INSTANTIATE_TEST_SUITE_P(Motions, ConvexPiecesPath, testing::Bool(),
                         [](const auto& motion) { return motion.param ? "Both" : "One"; });

TEST(ConvexPiecesCollide, FindsAllPiecesAndTriangles) {
    Random random(8106);
    std::size_t pairs = 0, triangles = 0;
    int none = 0;
    for (int i = 0; i < many(40); ++i) {
        const Model a(make_solid(random, random.integer(0, kKinds - 1))),
            b(make_solid(random, random.integer(0, kKinds - 1)));
        const ConvexPieces pieces_a(a), pieces_b(b);
        const Transform world_a = random.pose(0.5), world_b = random.pose(1.5);
        const PiecesContacts all = collide(pieces_a, world_a, pieces_b, world_b,
                                           {.mode = ContactMode::all, .triangles = true});
        ASSERT_EQ(all.triangles, collide(a, world_a, b, world_b, {.mode = ContactMode::all}).pairs);
        std::vector<PiecePair> expected;
        std::vector<Convex> hulls_b;
        for (std::uint32_t q = 0; q < pieces_b.size(); ++q)
            hulls_b.push_back(pieces_b.hull(q));
        for (std::uint32_t p = 0; p < pieces_a.size(); ++p) {
            const Convex hull = pieces_a.hull(p);
            for (std::uint32_t q = 0; q < pieces_b.size(); ++q)
                if (distance(hull, world_a, hulls_b[q], world_b).distance == 0)
                    expected.push_back({p, q});
        }
        ASSERT_EQ(all.pairs, expected) << i;
        pairs += all.pairs.size(), triangles += all.triangles.size();
        none += all.meet ? 0 : 1;
        ASSERT_EQ(all.meet, distance(pieces_a, world_a, pieces_b, world_b).distance == 0);
    }
    EXPECT_GE(pairs, static_cast<std::size_t>(many(100)));
    EXPECT_GE(triangles, static_cast<std::size_t>(many(100)));
    EXPECT_GE(none, many(2));
}

} // namespace
} // namespace abut::test
