#pragma once

#include <abut/convex_pieces.h>

#include "convex/search/closest_points.h"
#include "math/transform.h"
#include "pieces/pieces_data.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace abut {

/// Two hulls of the hierarchies, by the numbers of their nodes.
struct HullPair {
    std::uint32_t a = 0, b = 0;
    friend bool operator==(const HullPair&, const HullPair&) = default;
};

/// Two solids under their transforms, in the frame with the world's axes and the first one's
/// origin. Refers to its arguments, which must outlive it.
class PlacedPieces {
public:
    /// Errors      Error{bad_argument} if a transform is not finite.
    PlacedPieces(const ConvexPiecesData& a, const Transform& world_from_a,
                 const ConvexPiecesData& b, const Transform& world_from_b);

    [[nodiscard]] const HullNode& node_a(std::uint32_t n) const { return a.tree.nodes[n]; }
    [[nodiscard]] const HullNode& node_b(std::uint32_t n) const { return b.tree.nodes[n]; }
    [[nodiscard]] bool are_pieces(const HullPair& p) const {
        return node_a(p.a).is_leaf() && node_b(p.b).is_leaf();
    }
    [[nodiscard]] PolytopePair hulls(const HullPair& p) const {
        return {node_a(p.a).hull, world_from_a, node_b(p.b).hull, world_from_b};
    }
    /// The vector from the centre of a's hull to that of b's.
    [[nodiscard]] Vec3 between(const HullPair& p) const {
        return apply_linear(world_from_b, node_b(p.b).middle) + shift_ -
               apply_linear(world_from_a, node_a(p.a).middle);
    }
    /// A lower bound of the distance of two hulls, by the spheres around them. If the spheres
    /// overlap, a negative number: the overlap relative to their size, -1 if they are concentric.
    [[nodiscard]] double sphere_gap(const HullPair& p) const {
        const double radii = most_a_ * node_a(p.a).radius + most_b_ * node_b(p.b).radius;
        const double gap = length(between(p)) - radii - rounding;
        return gap >= 0 || !(radii > 0) ? std::max(gap, -1.0) : std::max(gap / radii, -1.0);
    }
    /// An upper bound of the penetration depth of two hulls, by the same spheres.
    [[nodiscard]] double most_depth(const HullPair& p) const {
        return most_a_ * node_a(p.a).radius + most_b_ * node_b(p.b).radius - length(between(p)) +
               rounding;
    }
    [[nodiscard]] double smaller_radius(const HullPair& p) const {
        return std::min(most_a_ * node_a(p.a).radius, most_b_ * node_b(p.b).radius);
    }
    /// Bounds on the factors by which a's transform stretches a vector: at most most_a(), at least
    /// least_a().
    [[nodiscard]] double most_a() const { return most_a_; }
    [[nodiscard]] double most_b() const { return most_b_; }
    [[nodiscard]] double least_a() const { return least_stretch(least_sq_a_, world_from_a); }
    [[nodiscard]] double least_b() const { return least_stretch(least_sq_b_, world_from_b); }
    /// Bounds the error of any vertex that `apply` places.
    [[nodiscard]] double world_rounding() const {
        return rounding + 0x1p-51 * (sum_of_sizes(origin()) + sum_of_sizes(origin() + shift_));
    }
    /// Solids whose hulls are at least this far apart share no point, also if each vertex of their
    /// triangles is rounded separately.
    [[nodiscard]] double contact_zone() const { return 4 * world_rounding(); }
    /// The amount by which a bound of the distance of two hulls is lowered, for rounding and for
    /// what the hulls leave out.
    [[nodiscard]] double margin(const HullPair& p) const {
        return 2 * rounding + most_a_ * node_a(p.a).loss + most_b_ * node_b(p.b).loss;
    }
    /// No two points of the hulls' spheres are farther apart than the spheres' gap plus this.
    [[nodiscard]] double size(const HullPair& p) const {
        return 2 * (most_a_ * node_a(p.a).radius + most_b_ * node_b(p.b).radius);
    }
    /// The sum of the radii of the balls around the solids.
    [[nodiscard]] double size() const {
        return most_a_ * node_a(0).radius + most_b_ * node_b(0).radius;
    }
    /// Calls visit(child) for the pairs below a pair. The larger hull is opened.
    template <typename Visit>
    void for_each_child(const HullPair& p, const Visit& visit) const {
        const HullNode &na = node_a(p.a), &nb = node_b(p.b);
        const bool open_a =
            !na.is_leaf() && (nb.is_leaf() || most_a_ * na.radius >= most_b_ * nb.radius);
        for (std::uint32_t i = 0; i < (open_a ? na : nb).children; ++i)
            visit(open_a ? HullPair{na.child + i, p.b} : HullPair{p.a, nb.child + i});
    }
    [[nodiscard]] Vec3 origin() const {
        return {world_from_a.m[9], world_from_a.m[10], world_from_a.m[11]};
    }

    const ConvexPiecesData &a, &b;
    const Transform &world_from_a, &world_from_b;
    double rounding; ///< bounds the error of any coordinate in the frame

private:
    [[nodiscard]] static double least_stretch(double least_sq, const Transform& t);

    Vec3 shift_; ///< from the origin of a to that of b
    double most_a_, most_b_;
    double least_sq_a_, least_sq_b_; ///< negative, or far too small, if the map is no rotation
};

} // namespace abut
