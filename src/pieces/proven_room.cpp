#include "pieces/proven_room.h"

#include "convex/hull/climb.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace abut {

namespace {

/// Returns the highest of the vertices that rounding may hide: those connected to `vertex` through
/// vertices of at least the height `least`.
std::uint32_t highest_hidden(const Polytope& polytope, const Vec3& direction, std::uint32_t vertex,
                             double least) {
    std::vector<bool> seen(polytope.vertices.size());
    std::vector<std::uint32_t> reached{vertex};
    seen[vertex] = true;
    double most = dot(direction, polytope.vertices[vertex].at);
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const HullVertex& v = polytope.vertices[reached[i]];
        for (std::uint32_t e = v.first_edge; e < v.first_edge + v.degree; ++e) {
            const double height = dot(direction, polytope.to(e));
            const std::uint32_t w = polytope.target(e);
            if (height < least || seen[w])
                continue;
            seen[w] = true;
            reached.push_back(w);
            if (height > most)
                most = height, vertex = w;
        }
    }
    return vertex;
}

/// Hulls of at most this many vertices are looked at as a whole where rounding may hide a vertex:
/// that takes less time than to follow neighbours.
constexpr std::size_t kScanned = 256;

std::uint32_t highest_of_all(const Polytope& polytope, const Vec3& direction) {
    std::uint32_t highest = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::uint32_t v = 0; v < polytope.vertices.size(); ++v)
        if (const double height = dot(direction, polytope.vertices[v].at); height > most)
            most = height, highest = v;
    return highest;
}

/// The highest vertex along a direction, given one that all neighbours are lower than by `lead`.
std::uint32_t highest(const Polytope& polytope, const Vec3& direction, std::uint32_t vertex,
                      double lead, double reach) {
    // Heights that differ by less may be in the other order.
    const double hidden = 0x1p-48 * sum_of_sizes(direction) * reach;
    if (lead > hidden)
        return vertex;
    if (polytope.vertices.size() <= kScanned)
        return highest_of_all(polytope, direction);
    const double least = dot(direction, polytope.vertices[vertex].at) - hidden;
    return highest_hidden(polytope, direction, vertex, least);
}

/// Two edges of the triangle between an edge and the next one around its vertex.
std::array<Vec3, 2> sides(const PlacedPolytope& side, std::uint32_t vertex, std::uint32_t edge) {
    const Polytope& p = *side.polytope;
    const HullVertex& v = p.vertices[vertex];
    return {apply_linear(*side.linear, p.to(edge) - v.at),
            apply_linear(*side.linear, p.to(p.after(v, edge)) - v.at)};
}

/// Directions that the features face, towards either side.
class FacingDirections {
public:
    FacingDirections(const PolytopePair& pair, const WalkState& at) {
        add(at.gap);
        add_normals(pair.a, at.a);
        add_normals(pair.b, at.b);
        const Vec3 u = along(pair.a, at.a), v = along(pair.b, at.b);
        if (at.a.kind != Feature::vertex && at.b.kind != Feature::vertex)
            add(cross(u, v));
        for (const Vec3& w : {u, v}) // perpendicular to an edge
            if (const double sq = length_sq(w); sq > 0)
                add(at.gap - (dot(at.gap, w) / sq) * w);
    }
    [[nodiscard]] const Vec3* begin() const { return directions_.data(); }
    [[nodiscard]] const Vec3* end() const { return directions_.data() + count_; }

private:
    static Vec3 along(const PlacedPolytope& side, const HullFeature& f) {
        return f.kind == Feature::vertex ? Vec3{} : sides(side, f.vertex, f.edge)[0];
    }
    /// Adds the normal of the triangle, or of both triangles at the edge.
    void add_normals(const PlacedPolytope& side, const HullFeature& f) {
        if (f.kind == Feature::vertex)
            return;
        const auto [u, v] = sides(side, f.vertex, f.edge);
        add(cross(u, v));
        if (f.kind == Feature::face)
            return;
        const Polytope& p = *side.polytope;
        const auto [s, t] = sides(side, f.vertex, p.before(p.vertices[f.vertex], f.edge));
        add(cross(s, t));
    }
    void add(const Vec3& direction) {
        if (direction == Vec3{} || !is_finite(direction))
            return;
        directions_.at(count_++) = dot(direction, directions_[0]) < 0 ? -direction : direction;
    }

    std::array<Vec3, 8> directions_;
    std::size_t count_ = 0;
};

} // namespace

VertexPair proven_farthest(const PolytopePair& pair, const Vec3& along, double reach_a,
                           double reach_b) {
    const Polytope &a = *pair.a.polytope, &b = *pair.b.polytope;
    const Vec3 direction_a = pair.a.pulled_back(along), direction_b = pair.b.pulled_back(-along);
    const FarthestPair found = farthest_with_lead(a, direction_a, b, direction_b);
    return {highest(a, direction_a, found.vertices.a, found.lead_a, reach_a),
            highest(b, direction_b, found.vertices.b, found.lead_b, reach_b)};
}

double proven_room(const PolytopePair& pair, const Vec3& along, double reach_a, double reach_b,
                   double margin) {
    const auto [a, b] = proven_farthest(pair, along, reach_a, reach_b);
    return dot(along, pair.b.vertex(b) - pair.a.vertex(a)) / length(along) - margin;
}

double proven_room_at(const PolytopePair& pair, const WalkState& at, double reach_a, double reach_b,
                      double margin, double enough) {
    double most = 0;
    for (const Vec3& direction : FacingDirections(pair, at)) {
        most = std::max(most, proven_room(pair, direction, reach_a, reach_b, margin));
        if (most >= enough)
            break;
    }
    return most;
}

} // namespace abut
