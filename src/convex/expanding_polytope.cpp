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
    faces_.reserve(256);
    open_.reserve(64);
    visible_.reserve(64);
    horizon_.reserve(64);
}

ExpandingPolytope::Corner ExpandingPolytope::placed(const VertexPair& vertices) const {
    return {pair_.b.vertex(vertices.b) - pair_.a.vertex(vertices.a), vertices, 0};
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
        const Vec3 direction = corners_.size() == 1 ? Vec3{1, 0, 0}
                               : corners_.size() == 2
                                   ? across(at(1) - at(0))
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

/// With the edges' other sides still to be set. (Written field by field: a whole face, put together
/// elsewhere and copied at once, would wait for its parts.)
void ExpandingPolytope::add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto number = static_cast<std::uint32_t>(faces_.size());
    Face& face = faces_.emplace_back();
    face.corners[0] = a, face.corners[1] = b, face.corners[2] = c;
    const Vec3 &p = corners_[a].at, &q = corners_[b].at, &r = corners_[c].at;
    const Vec3 normal = cross(q - p, r - p);
    const double size = length(normal);
    const double scale = size > 0 ? 1 / size : 0;
    face.normal.x = scale * normal.x, face.normal.y = scale * normal.y;
    face.normal.z = scale * normal.z;
    face.offset = scale * dot(normal, p);
    if (face.offset <= upper_) // else it is never the nearest
        open_.push_back(number);
}

/// Takes the nearest face from those that are open, and forgets those that will not be it.
std::uint32_t ExpandingPolytope::nearest_face() {
    std::size_t kept = 0, nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t f : open_) {
        const double offset = faces_[f].offset;
        if (offset > upper_)
            continue;
        nearest = offset < least ? kept : nearest;
        least = std::min(least, offset);
        open_[kept++] = f;
    }
    open_.resize(kept);
    return open_[nearest];
}

/// Faces that see the corner, beginning with one of them, and the border around them.
void ExpandingPolytope::remove_visible(const Vec3& corner, std::uint32_t seen_by) {
    visible_.clear();
    visible_.push_back(seen_by);
    horizon_.clear();
    faces_[seen_by].remove();
    for (std::size_t i = 0; i < visible_.size(); ++i) {
        const Face& face = faces_[visible_[i]];
        for (std::size_t k = 0; k < 3; ++k) {
            Face& beyond = faces_[face.across[k]];
            // Nothing is above a face that is gone.
            if (above(beyond, corner) > rounding_) {
                beyond.remove();
                visible_.push_back(face.across[k]);
            }
        }
    }
    for (const std::uint32_t f : visible_)
        for (std::size_t k = 0; k < 3; ++k)
            if (faces_[faces_[f].across[k]].alive())
                horizon_.push_back(3 * f + static_cast<std::uint32_t>(k));
}

void ExpandingPolytope::add_corner(const Corner& corner, std::uint32_t seen_by) {
    remove_visible(corner.at, seen_by);
    const auto point = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back(corner);
    const auto first = static_cast<std::uint32_t>(faces_.size());
    for (const std::uint32_t edge : horizon_) {
        const std::uint32_t k = edge % 3, from = faces_[edge / 3].corners[k],
                            to = faces_[edge / 3].corners[(k + 1) % 3],
                            other = faces_[edge / 3].across[k];
        const auto face = static_cast<std::uint32_t>(faces_.size());
        corners_[from].cone = face;
        Face& beyond = faces_[other];
        for (std::size_t j = 0; j < 3; ++j)
            if (beyond.corners[j] == to)
                beyond.across[j] = face;
        add_face(from, to, point);
        faces_[face].across[0] = other;
    }
    for (std::uint32_t f = first; f < faces_.size(); ++f) {
        const std::uint32_t next = corners_[faces_[f].corners[1]].cone;
        faces_[f].across[1] = next;
        faces_[next].across[2] = f;
    }
}

void ExpandingPolytope::add_hint(const VertexPair& vertices) {
    const Corner corner = placed(vertices);
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        if (faces_[f].alive() && above(faces_[f], corner.at) > rounding_) {
            add_corner(corner, f);
            return;
        }
}

/// The point of the plane, which lies in this face or in one that is coplanar with it.
void ExpandingPolytope::finish(const Face& face, NearestBoundary& nearest) const {
    const Vec3 point = face.offset * face.normal;
    double least_sq = std::numeric_limits<double>::infinity();
    const auto try_face = [&](const Face& f) {
        const auto corner = [&](std::size_t k) -> const Corner& { return corners_[f.corners[k]]; };
        const NearestOnTriangle n =
            nearest_on_triangle(point, {corner(0).at, corner(1).at, corner(2).at});
        if (!(n.distance_sq < least_sq))
            return;
        least_sq = n.distance_sq;
        nearest.weights = n.weights;
        for (std::size_t k = 0; k < 3; ++k)
            nearest.corners[k] = corner(k).vertices;
    };
    try_face(face);
    if (least_sq <= rounding_ * rounding_)
        return;
    for (const Face& f : faces_)
        if (f.offset <= face.offset + rounding_)
            try_face(f);
}

NearestBoundary ExpandingPolytope::run(const DifferenceSimplex& start,
                                       std::span<const VertexPair> hints) {
    NearestBoundary nearest;
    if (!complete(start, nearest))
        return nearest;
    if (dot(cross(corners_[1].at - corners_[0].at, corners_[2].at - corners_[0].at),
            corners_[3].at - corners_[0].at) > 0)
        std::swap(corners_[1], corners_[2]);
    add_face(0, 1, 2), add_face(0, 2, 3), add_face(2, 1, 3), add_face(1, 0, 3);
    faces_[0].across = {3, 2, 1}, faces_[1].across = {0, 2, 3};
    faces_[2].across = {0, 3, 1}, faces_[3].across = {0, 1, 2};
    for (const VertexPair& hint : hints)
        add_hint(hint);
    for (;;) {
        const std::uint32_t f = nearest_face();
        const Face& face = faces_[f];
        const Corner corner = farthest_corner(face.normal);
        const double excess = above(face, corner.at);
        upper_ = std::min(upper_, face.offset + excess + rounding_);
        const bool own =
            std::any_of(face.corners.begin(), face.corners.end(),
                        [&](std::uint32_t c) { return corners_[c].vertices == corner.vertices; });
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
