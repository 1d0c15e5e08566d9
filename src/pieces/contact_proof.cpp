#include "pieces/contact_proof.h"

#include "geometry/triangle_triangle_intersect.h"
#include "pieces/placed_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

/// For more pairs of triangles than this, the trees are faster.
constexpr std::size_t kMostPairs = 128;

/// Bounds how far the points of a hull move when it shrinks so that the rest lies `depth` below its
/// surface. A flat piece that its triangles cover is the surface itself and does not move.
double shrinkage(const HullNode& piece, double most_stretch, double least_stretch, double depth) {
    if (piece.is_sheet)
        return 0;
    const double inner = least_stretch * piece.inner_radius;
    // A point moves by the share depth / (ball's radius) of its way to the ball's centre.
    return inner > depth ? 2 * depth * most_stretch * piece.radius / inner
                         : std::numeric_limits<double>::infinity();
}

/// The radius of a ball around the origin inside the difference of two hulls that proves that the
/// solids share a point. Infinite if no ball proves it.
double least_radius(const PlacedPieces& placed, const HullPair& pieces) {
    const double depth = 8 * placed.world_rounding();
    return 2 * depth +
           shrinkage(placed.node_a(pieces.a), placed.most_a(), placed.least_a(), depth) +
           shrinkage(placed.node_b(pieces.b), placed.most_b(), placed.least_b(), depth);
}

/// The volume that the tetrahedra below must exceed to prove such a ball, whatever rounding did to
/// corners and volumes. A tetrahedron with a face in a plane and the origin as its apex has six
/// times its volume at most equal to the plane's distance times the square of the longest edge.
double least_volume(const PlacedPieces& placed, const HullPair& pieces) {
    // The hulls meet to rounding, so no two of their points are farther apart than this.
    const double size = placed.size(pieces) + placed.rounding;
    return ((least_radius(placed, pieces) + 4 * placed.rounding) + 0x1p-44 * size) * size * size;
}

/// Returns whether the tetrahedron of a simplex holds the ball around the origin.
bool holds_ball(const PolytopePair& pair, const DifferenceSimplex& simplex, double least_volume) {
    std::array<Vec3, 4> at;
    for (std::size_t i = 0; i < 4; ++i)
        at[i] = pair.b.vertex(simplex.corners[i].b) - pair.a.vertex(simplex.corners[i].a);
    const Vec3 p = cross(at[0], at[1]), q = cross(at[2], at[3]);
    const std::array<double, 4> volumes{dot(at[1], q), -dot(at[0], q), dot(p, at[3]),
                                        -dot(p, at[2])};
    const auto [low, high] = std::minmax_element(volumes.begin(), volumes.end());
    return *low > least_volume || *high < -least_volume;
}

/// Returns whether the difference of a triangle and an edge, a prism, holds the ball.
bool holds_ball(const Triangle& t, const std::array<Vec3, 2>& edge, double least_volume) {
    const Vec3 along = edge[1] - edge[0], first = t[1] - t[0], second = t[2] - t[1];
    // The prism's bases are the triangle minus each end of the edge.
    const Vec3 normal = cross(first, second), from = t[0] - edge[0];
    const double before = dot(normal, from), behind = dot(normal, t[0] - edge[1]);
    const double sign = before > 0 ? 1 : -1;
    return sign * before > least_volume && -sign * behind > least_volume &&
           sign * dot(cross(first, along), from) > least_volume &&
           sign * dot(cross(second, along), t[1] - edge[0]) > least_volume &&
           sign * dot(cross(t[0] - t[2], along), t[2] - edge[0]) > least_volume;
}

Triangle corners_of(const PlacedPolytope& side, const HullFeature& f) {
    const Polytope& p = *side.polytope;
    return {side.vertex(f.vertex), side.place(p.to(f.edge)),
            side.place(p.to(p.after(p.vertices[f.vertex], f.edge)))};
}

/// Returns whether a walk has ended with an edge that surely passes through a triangle.
bool pierces(const PolytopePair& pair, const WalkState& at, double least_volume) {
    const bool a_is_face = at.a.kind == Feature::face;
    const HullFeature &face = a_is_face ? at.a : at.b, &edge = a_is_face ? at.b : at.a;
    if (face.kind != Feature::face || edge.kind != Feature::edge)
        return false;
    const PlacedPolytope &of_face = a_is_face ? pair.a : pair.b,
                         &of_edge = a_is_face ? pair.b : pair.a;
    return holds_ball(corners_of(of_face, face),
                      {of_edge.vertex(edge.vertex), of_edge.place(of_edge.polytope->to(edge.edge))},
                      least_volume);
}

bool triangles_meet(const PlacedPieces& placed, const HullPair& pieces) {
    const std::uint32_t piece_a = placed.node_a(pieces.a).piece,
                        piece_b = placed.node_b(pieces.b).piece;
    if (placed.a.triangles_of(piece_a).size() * placed.b.triangles_of(piece_b).size() > kMostPairs)
        return false;
    const auto of_a = placed_triangles(placed.a, piece_a, placed.world_from_a),
               of_b = placed_triangles(placed.b, piece_b, placed.world_from_b);
    return std::any_of(of_a.begin(), of_a.end(), [&](const PlacedTriangle& s) {
        return std::any_of(of_b.begin(), of_b.end(), [&](const PlacedTriangle& t) {
            return overlap(s.box, t.box) &&
                   triangle_triangle_intersect(s.corners, t.corners) != TriangleContact::none;
        });
    });
}

} // namespace

bool proves_contact(const PlacedPieces& placed, const HullPair& pieces,
                    const DifferenceSimplex& simplex) {
    const double least = least_volume(placed, pieces);
    return (simplex.count == 4 && holds_ball(placed.hulls(pieces), simplex, least)) ||
           triangles_meet(placed, pieces);
}

bool proves_contact(const PlacedPieces& placed, const HullPair& pieces,
                    const ClosestPointSearch& search) {
    if (search.simplex)
        return proves_contact(placed, pieces, *search.simplex);
    const double least = least_volume(placed, pieces);
    return pierces(placed.hulls(pieces), search.at, least) || triangles_meet(placed, pieces);
}

} // namespace abut
