#include "convex/expanding_polytope.h"

#include "geometry/point_triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Any unit vector across another vector.
Vec3 across(const Vec3& v) {
    const Vec3 size{std::abs(v.x), std::abs(v.y), std::abs(v.z)};
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                      : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                           : Vec3{0, 0, 1};
    return normalized_or_zero(cross(v, axis));
}

/// After so many corners the bounds have to do as they are.
constexpr std::uint32_t kMostSteps = 2000;

} // namespace

ExpandingPolytope::ExpandingPolytope(const PolytopePair& pair, double rounding)
    : pair_(pair), rounding_(rounding) {
    corners_.reserve(64);
    cone_from_.reserve(64);
    faces_.reserve(256);
    queue_.reserve(128);
}

ExpandingPolytope::Corner ExpandingPolytope::placed(const VertexPair& vertices) const {
    return {pair_.b.vertex(vertices.b) - pair_.a.vertex(vertices.a), vertices};
}

ExpandingPolytope::Corner ExpandingPolytope::farthest_corner(const Vec3& direction) const {
    return placed({farthest(*pair_.a.polytope, pair_.a.pulled_back(-direction)),
                   farthest(*pair_.b.polytope, pair_.b.pulled_back(direction))});
}

/// Makes four corners of a simplex that may have fewer, or is flat. False if no corner lies beyond
/// a plane through the origin: then `flat` is the answer.
bool ExpandingPolytope::complete(const DifferenceSimplex& start, NearestBoundary& flat) {
    for (std::uint32_t i = 0; i < start.count; ++i)
        corners_.push_back(placed(start.corners[i]));
    const auto at = [&](std::size_t i) { return corners_[i].at; };
    if (corners_.size() == 4) {
        const Vec3 normal = cross(at(1) - at(0), at(2) - at(0));
        if (std::abs(dot(normal, at(3) - at(0))) > rounding_ * length(normal))
            return true;
        // Flat: some three corners of it hold the origin too.
        std::size_t least = 0;
        double least_sq = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 4; ++i) {
            const Triangle t{at((i + 1) % 4), at((i + 2) % 4), at((i + 3) % 4)};
            const double sq = nearest_on_triangle({}, t).distance_sq;
            if (sq < least_sq)
                least_sq = sq, least = i;
        }
        corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(least));
    }
    while (corners_.size() < 4) {
        const Vec3 direction =
            corners_.size() == 1   ? Vec3{1, 0, 0}
            : corners_.size() == 2 ? across(at(1) - at(0))
                                   : normalized_or_zero(cross(at(1) - at(0), at(2) - at(0)));
        const Corner next = farthest_corner(direction);
        if (!(dot(direction, next.at) > rounding_)) {
            flat.normal = direction;
            flat.corners.fill(next.vertices);
            flat.weights = {1, 0, 0};
            return false;
        }
        corners_.push_back(next);
    }
    return true;
}

void ExpandingPolytope::add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                 const std::array<std::uint32_t, 3>& across_edges) {
    const Vec3 &p = corners_[a].at, &q = corners_[b].at, &r = corners_[c].at;
    Vec3 normal = cross(q - p, r - p);
    const double size = length(normal);
    normal = size > 0 ? (1 / size) * normal : Vec3{};
    const double offset = dot(normal, p);
    queue_.push_back({offset, static_cast<std::uint32_t>(faces_.size())});
    std::push_heap(queue_.begin(), queue_.end());
    faces_.push_back({{a, b, c}, across_edges, normal, offset, true});
}

void ExpandingPolytope::add_corner(const Corner& corner, std::uint32_t seen_by) {
    const auto point = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back(corner);
    cone_from_.resize(corners_.size());
    visible_.assign(1, seen_by);
    horizon_.clear();
    faces_[seen_by].alive = false;
    for (std::size_t i = 0; i < visible_.size(); ++i)
        for (const std::uint32_t beyond : faces_[visible_[i]].across)
            if (faces_[beyond].alive && above(faces_[beyond], corner.at) > rounding_) {
                faces_[beyond].alive = false;
                visible_.push_back(beyond);
            }
    for (const std::uint32_t f : visible_)
        for (std::size_t k = 0; k < 3; ++k)
            if (const Face& face = faces_[f]; faces_[face.across[k]].alive)
                horizon_.push_back({face.corners[k], face.corners[(k + 1) % 3], face.across[k]});
    const auto first = static_cast<std::uint32_t>(faces_.size());
    for (const HorizonEdge& edge : horizon_) {
        const auto face = static_cast<std::uint32_t>(faces_.size());
        cone_from_[edge.from] = face;
        Face& beyond = faces_[edge.beyond];
        for (std::size_t k = 0; k < 3; ++k)
            if (beyond.corners[k] == edge.to && beyond.corners[(k + 1) % 3] == edge.from)
                beyond.across[k] = face;
        add_face(edge.from, edge.to, point, {edge.beyond, 0, 0});
    }
    for (std::uint32_t f = first; f < faces_.size(); ++f) {
        const std::uint32_t next = cone_from_[faces_[f].corners[1]];
        faces_[f].across[1] = next;
        faces_[next].across[2] = f;
    }
}

void ExpandingPolytope::add_hint(const VertexPair& vertices) {
    const Corner corner = placed(vertices);
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        if (faces_[f].alive && above(faces_[f], corner.at) > rounding_) {
            add_corner(corner, f);
            return;
        }
}

/// The point of the plane, which lies in this face or in one that is coplanar with it.
void ExpandingPolytope::finish(const Face& face, NearestBoundary& nearest) const {
    const Vec3 point = face.offset * face.normal;
    double least_sq = std::numeric_limits<double>::infinity();
    for (const Face& f : faces_) {
        if (!f.alive || f.offset > face.offset + rounding_)
            continue;
        const auto corner = [&](std::size_t k) -> const Corner& { return corners_[f.corners[k]]; };
        const NearestOnTriangle n =
            nearest_on_triangle(point, {corner(0).at, corner(1).at, corner(2).at});
        if (!(n.distance_sq < least_sq))
            continue;
        least_sq = n.distance_sq;
        nearest.weights = n.weights;
        for (std::size_t k = 0; k < 3; ++k)
            nearest.corners[k] = corner(k).vertices;
    }
}

NearestBoundary ExpandingPolytope::run(const DifferenceSimplex& start,
                                       std::span<const VertexPair> hints) {
    NearestBoundary nearest;
    if (!complete(start, nearest))
        return nearest;
    cone_from_.resize(4);
    if (dot(cross(corners_[1].at - corners_[0].at, corners_[2].at - corners_[0].at),
            corners_[3].at - corners_[0].at) > 0)
        std::swap(corners_[1], corners_[2]);
    add_face(0, 1, 2, {3, 2, 1});
    add_face(0, 2, 3, {0, 2, 3});
    add_face(2, 1, 3, {0, 3, 1});
    add_face(1, 0, 3, {0, 1, 2});
    for (const VertexPair& hint : hints)
        add_hint(hint);
    for (;;) {
        std::pop_heap(queue_.begin(), queue_.end());
        const std::uint32_t f = queue_.back().face;
        queue_.pop_back();
        if (!faces_[f].alive)
            continue;
        const Face face = faces_[f];
        const Corner corner = farthest_corner(face.normal);
        const double excess = above(face, corner.at);
        const bool own = std::any_of(face.corners.begin(), face.corners.end(), [&](std::uint32_t c) {
            return corners_[c].vertices == corner.vertices;
        });
        if (excess <= rounding_ || own || nearest.steps == kMostSteps) {
            nearest.normal = face.normal;
            nearest.depth = std::max(0.0, face.offset + std::max(0.0, excess));
            nearest.at_least = std::max(0.0, face.offset);
            finish(face, nearest);
            return nearest;
        }
        ++nearest.steps;
        add_corner(corner, f);
    }
}

} // namespace abut
