// Solids cut into convex pieces, and the hierarchy of the pieces' hulls, against rational
// arithmetic.

#include <abut/convex_pieces.h>
#include <abut/shape_queries.h>

#include "convex/hull/climb.h"
#include "convex/hull/exact_hull.h"
#include "convex/search/closest_points.h"
#include "geometry/point_triangle_distance.h"
#include "math/predicates.h"
#include "pieces/hull_tree.h"
#include "pieces/pieces_data.h"
#include "rigid/model/solid.h"
#include "tests/support/oracle/rational_clip.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

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

/// Tests whether a triangle enters the interior of a body.
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
                continue; // triangles of zero area; their hull may lie outside by a hair
            }
            // The point lies just below a flat piece, or anywhere in another.
            const Triangle first = corners(mesh, triangles[0]);
            const Vec3 normal = normalized_or_zero(cross(first[1] - first[0], first[2] - first[0]));
            const double below = hull.dimension() == 2 ? 1e-7 : 0;
            for (int k = 0; k < 3; ++k, ++probes) {
                const Vec3 point = random_point_of(random, hull) - below * normal;
                // Points nearer to the surface than this are not tested: some hulls are as thin as
                // rounding.
                if (nearest(pieces.model(), {}, point).distance > 1e-12) {
                    ASSERT_GE(winding_number(mesh, point), 1 - 1e-6) << i << " piece " << p;
                }
            }
            // Some triangles must enter the hull of two pieces together, or the oracle tests
            // nothing.
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
                    // Children are held up to the points that hulls leave out.
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

/// Points of rotated cells are collinear and coplanar up to rounding. A walk over such vertices
/// must not end on the wrong side.
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
            const Polytope point = make_polytope({&at, 1}, {});
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

} // namespace
} // namespace abut::test
