#include "convex/search/epa.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "convex/search/epa.cpp"
#include "simd/foreach_target.h"
#include "convex/hull/climb-inl.h"
#include "convex/hull/placed_xyz-inl.h"
#include "convex/search/growing_boundary-inl.h"
#include "geometry/point_triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Limit on added corners; the bounds reached by then are returned.
constexpr std::uint32_t kMostSteps = 2000;
/// A polytope of more faces is not remembered.
constexpr std::uint32_t kMostKept = 160;
constexpr std::uint32_t kNoNumber = 0xffffffffU;

class EpaPolytope {
public:
    EpaPolytope(const PolytopePair& pair, double rounding)
        : a_(pair.a), b_(pair.b), rounding_(rounding),
          all_rounding_(rounding + world_rounding(pair)), boundary_(rounding) {
        open_.resize(64);
    }

    /// Begins with a tetrahedron around the origin. False if the difference is flat; `flat` is the
    /// answer then.
    bool begin(const DifferenceSimplex& start, NearestBoundary& flat) {
        if (!complete(start, flat))
            return false;
        const auto corner = [&](std::uint32_t i) HWY_ATTR { return boundary_.at(i); };
        // Its corners' order decides which faces are counter-clockwise.
        const Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
        const bool turned = dot(normal, corner(3) - corner(0)) > 0;
        const std::uint32_t one = turned ? 2 : 1, two = turned ? 1 : 2;
        boundary_.add_face(0, one, two), boundary_.add_face(0, two, 3);
        boundary_.add_face(two, one, 3), boundary_.add_face(one, 0, 3);
        boundary_.join({0, 0}, {3, 0}), boundary_.join({0, 1}, {2, 0});
        boundary_.join({0, 2}, {1, 0}), boundary_.join({1, 1}, {2, 2});
        boundary_.join({1, 2}, {3, 1}), boundary_.join({2, 1}, {3, 2});
        return true;
    }

    /// Begins with a remembered polytope. False if its faces do not go around the origin.
    bool recall(const DifferencePolytope& last) {
        recalled_ = true;
        for (const VertexPair& vertices : last.corners) {
            if (vertices.a >= a_.polytope().vertices.size() ||
                vertices.b >= b_.polytope().vertices.size())
                return false;
            boundary_.add_corner(placed(vertices), vertices);
        }
        for (const DifferencePolytope::Face& face : last.faces)
            boundary_.add_face(face.corners[0], face.corners[1], face.corners[2]);
        for (std::uint32_t f = 0; f < last.faces.size(); ++f)
            for (std::uint32_t k = 0; k < 3; ++k)
                boundary_.join({f, k}, last.faces[f].across[k]);
        return open_new_faces();
    }

    /// Adds corners until both bounds agree. False if a recalled polytope got a face that the
    /// origin is not below.
    bool expand(NearestBoundary& nearest) {
        open_new_faces();
        for (;;) {
            const std::uint32_t f = nearest_face();
            const GrowingBoundary::Face& face = boundary_.faces()[f];
            const VertexPair vertices = farthest_vertices(face.normal);
            const Xyz corner = placed(vertices);
            const double size = length(face.normal), scale = size > 0 ? 1 / size : 0;
            const double offset = scale * face.height;
            const double excess = scale * (dot(face.normal, to_vec3(corner)) - face.height);
            const double upper = std::max(offset + excess + rounding_, 0.0);
            upper_sq_ = std::min(upper_sq_, upper * upper);
            if (excess <= rounding_ || is_corner_of(face, vertices) ||
                nearest.steps == kMostSteps) {
                nearest.normal = scale * face.normal;
                nearest.depth = std::max(0.0, offset + std::max(0.0, excess));
                nearest.at_least = std::max(0.0, offset);
                const bool is_foot_inside = finish(face, offset, nearest);
                prove(f, is_foot_inside, nearest);
                return true;
            }
            ++nearest.steps;
            const bool one_ring = (recalled_ && fill_dent(vertices, f)) ||
                                  boundary_.grow(corner, vertices, f) || !recalled_;
            is_whole_ = is_whole_ && boundary_.is_one_ring();
            if (!open_new_faces() || !one_ring)
                return false;
        }
    }

    void remember(DifferencePolytope& now) const {
        now.corners.clear(), now.faces.clear();
        const auto& all = boundary_.faces();
        std::vector<std::uint32_t> number_of_face(all.size()),
            number_of_corner(boundary_.corners().size(), kNoNumber);
        std::uint32_t faces = 0;
        for (std::size_t f = 0; f < all.size(); ++f)
            if (all[f].alive())
                number_of_face[f] = faces++;
        if (faces > kMostKept || !boundary_.is_closed())
            return;
        for (const GrowingBoundary::Face& face : all) {
            if (!face.alive())
                continue;
            DifferencePolytope::Face& kept = now.faces.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& number = number_of_corner[face.corners[k]];
                if (number == kNoNumber) {
                    number = static_cast<std::uint32_t>(now.corners.size());
                    now.corners.push_back(boundary_.corners()[face.corners[k]].vertices);
                }
                kept.corners[k] = number;
                kept.across[k] = {number_of_face[face.across[k].face], face.across[k].edge};
            }
        }
    }

private:
    [[nodiscard]] HWY_INLINE Xyz placed(const VertexPair& vertices) const {
        return b_.vertex(vertices.b) - a_.vertex(vertices.a);
    }
    [[nodiscard]] HWY_INLINE VertexPair farthest_vertices(const Vec3& direction) const {
        return rings::farthest_two(a_.polytope(), a_.pulled_back(-direction), b_.polytope(),
                                   b_.pulled_back(direction));
    }
    [[nodiscard]] bool is_corner_of(const GrowingBoundary::Face& face,
                                    const VertexPair& vertices) const {
        bool is_one = false;
        for (const std::uint32_t c : face.corners)
            is_one |= boundary_.corners()[c].vertices == vertices;
        return is_one;
    }

    /// Completes a simplex of fewer corners, or a flat one, to four corners. False if no corner
    /// lies beyond some plane through the origin: then `flat` is the answer.
    bool complete(const DifferenceSimplex& start, NearestBoundary& flat) {
        for (std::uint32_t i = 0; i < start.count; ++i)
            boundary_.add_corner(placed(start.corners[i]), start.corners[i]);
        const auto at = [&](std::uint32_t i) HWY_ATTR { return boundary_.at(i); };
        if (start.count == 4) {
            const Vec3 normal = cross(at(1) - at(0), at(2) - at(0));
            if (std::abs(dot(normal, at(3) - at(0))) > rounding_ * length(normal))
                return true;
            // The simplex is flat: three of its corners hold the origin too.
            std::uint32_t least = 0;
            double least_sq = std::numeric_limits<double>::infinity();
            for (std::uint32_t i = 0; i < 4; ++i) {
                const Triangle t{at((i + 1) % 4), at((i + 2) % 4), at((i + 3) % 4)};
                const double sq = nearest_on_triangle({}, t).distance_sq;
                if (sq < least_sq)
                    least_sq = sq, least = i;
            }
            boundary_.remove_corner(least);
        }
        while (boundary_.corners().size() < 4) {
            const std::size_t count = boundary_.corners().size();
            const Vec3 direction = count == 1 ? Vec3{1, 0, 0}
                                   : count == 2
                                       ? perpendicular(at(1) - at(0))
                                       : normalized_or_zero(cross(at(1) - at(0), at(2) - at(0)));
            const VertexPair next = farthest_vertices(direction);
            const Xyz corner = placed(next);
            if (!(dot(direction, to_vec3(corner)) > rounding_)) {
                flat.normal = direction;
                flat.corners.fill(next);
                flat.weights = {1, 0, 0};
                return false;
            }
            boundary_.add_corner(corner, next);
        }
        return true;
    }

    /// Opens the faces that were added since the last call and that may be the nearest. False if
    /// the polytope was recalled and the origin is not below one of them. (Here and below, values
    /// are selected without branches, which could not be predicted.)
    HWY_INLINE bool open_new_faces() {
        const auto& faces = boundary_.faces();
        if (open_.size() < open_count_ + (faces.size() - seen_))
            open_.resize(2 * (open_count_ + (faces.size() - seen_)));
        bool around = true;
        for (; seen_ < faces.size(); ++seen_) {
            const GrowingBoundary::Face& face = faces[seen_];
            around &= !recalled_ || face.height > face.slack;
            open_[open_count_] = static_cast<std::uint32_t>(seen_);
            open_count_ += face.offset_sq <= upper_sq_ ? 1 : 0;
        }
        return around;
    }

    /// Returns the nearest open face. Drops faces beyond the upper bound.
    HWY_INLINE std::uint32_t nearest_face() {
        std::size_t kept = 0, nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < open_count_; ++i) {
            const std::uint32_t f = open_[i];
            const double offset_sq = boundary_.faces()[f].offset_sq;
            nearest = offset_sq < least ? kept : nearest;
            least = offset_sq < least ? offset_sq : least;
            open_[kept] = f;
            kept += offset_sq <= upper_sq_ ? 1 : 0;
        }
        open_count_ = kept;
        return open_[nearest];
    }

    /// If the recalled polytope has a dent along an edge of the face, with `corner` across that
    /// edge, flips the edge, which fills the dent. Returns whether there was one.
    bool fill_dent(const VertexPair& corner, std::uint32_t face) {
        for (std::uint32_t k = 0; k < 3; ++k)
            if (boundary_.corner_across({face, k}).vertices == corner) {
                boundary_.flip({face, k});
                return true;
            }
        return false;
    }

    /// Writes the weights of the plane's nearest point, which lies in this face or in a coplanar
    /// one. Returns whether it lies in this one.
    bool finish(const GrowingBoundary::Face& face, double offset, NearestBoundary& nearest) const {
        const Vec3 point = offset * nearest.normal;
        double least_sq = std::numeric_limits<double>::infinity();
        const auto try_face = [&](const GrowingBoundary::Face& f) HWY_ATTR {
            const NearestOnTriangle n =
                nearest_on_triangle(point, {boundary_.at(f.corners[0]), boundary_.at(f.corners[1]),
                                            boundary_.at(f.corners[2])});
            if (!(n.distance_sq < least_sq))
                return;
            least_sq = n.distance_sq;
            nearest.weights = n.weights;
            for (std::size_t k = 0; k < 3; ++k)
                nearest.corners[k] = boundary_.corners()[f.corners[k]].vertices;
        };
        try_face(face);
        if (least_sq <= rounding_ * rounding_)
            return true;
        const double farthest = std::max(offset, 0.0) + rounding_;
        for (const GrowingBoundary::Face& f : boundary_.faces())
            if (f.offset_sq <= farthest * farthest)
                try_face(f);
        return false;
    }

    /// Proves both bounds (docs/convex.md, "Proofs"). `f` is the nearest face; `nearest` is
    /// complete but for the flags and `at_least`.
    HWY_INLINE void prove(std::uint32_t f, bool is_foot_inside, NearestBoundary& nearest) const {
        const double at_least =
            least_along(boundary_.faces()[f], nearest.normal) - 4 * all_rounding_;
        if (!(is_whole_ && at_least > 0 && is_around(at_least)))
            return;
        nearest.at_least = at_least;
        nearest.is_inside_proven = true;
        const bool all_were_seen = !a_.polytope().columns.empty() && !b_.polytope().columns.empty();
        nearest.is_depth_proven =
            all_were_seen || (is_facet(f, nearest.normal) &&
                              (is_foot_inside || is_foot_near(boundary_.faces()[f], nearest)));
    }

    /// Returns whether the foot of the origin in a face's plane lies within about the face's size
    /// of it, as in the other half of a parallelogram. Rounding that turns the plane then moves it
    /// there about as much as at the corners.
    [[nodiscard]] HWY_NOINLINE bool is_foot_near(const GrowingBoundary::Face& face,
                                                 const NearestBoundary& nearest) const {
        const Vec3 foot = nearest.depth * nearest.normal;
        const Vec3 p = boundary_.at(face.corners[0]) - foot,
                   q = boundary_.at(face.corners[1]) - foot,
                   r = boundary_.at(face.corners[2]) - foot;
        const double most = 2 * length_sq(face.normal);
        return std::abs(dot(cross(q, r), face.normal)) <= most &&
               std::abs(dot(cross(r, p), face.normal)) <= most &&
               std::abs(dot(cross(p, q), face.normal)) <= most;
    }

    [[nodiscard]] HWY_INLINE double least_along(const GrowingBoundary::Face& face,
                                                const Vec3& direction) const {
        return std::min({dot(direction, boundary_.at(face.corners[0])),
                         dot(direction, boundary_.at(face.corners[1])),
                         dot(direction, boundary_.at(face.corners[2]))});
    }

    /// Returns whether, whatever rounding has done to the corners, all faces turn their inner side
    /// to the origin and no point of a face is nearer to it than `radius`.
    [[nodiscard]] HWY_INLINE bool is_around(double radius) const {
        double size_sq = 0;
        for (const GrowingBoundary::Corner& corner : boundary_.corners())
            size_sq = std::max(size_sq, length_sq(corner.at));
        // Twice what rounding may have added to a height, or to the radius times the normal.
        const double doubt = 64 * all_rounding_ * size_sq, radius_sq = radius * radius;
        bool around = size_sq > 0x1p-600;
        for (const GrowingBoundary::Face& face : boundary_.faces()) {
            // h - doubt / 2 >= radius |n|, divided by |n| and squared.
            const bool beyond = face.offset_sq * (face.height - doubt) >= radius_sq * face.height;
            around = around && (beyond || !face.alive() || is_beyond(face, doubt, radius));
        }
        return around;
    }
    /// The test of `is_around` for a face whose plane is nearer than the radius, or whose normal is
    /// too short to tell. Points of a face are convex combinations of its corners, so the corners
    /// decide.
    [[nodiscard]] HWY_NOINLINE bool is_beyond(const GrowingBoundary::Face& face, double doubt,
                                              double radius) const {
        return face.height > doubt &&
               least_along(face, normalized_or_zero(face.normal)) >= radius + 3 * all_rounding_;
    }

    /// Returns whether a face of the polytope certainly lies in a face of the difference: a
    /// triangle of one body and a vertex of the other, or two edges. Decided by the neighbours, as
    /// for a walk's distance.
    [[nodiscard]] bool is_facet(std::uint32_t f, const Vec3& normal) const {
        const GrowingBoundary::Face& face = boundary_.faces()[f];
        std::uint32_t a[3], b[3];
        std::uint32_t count_a = 0, count_b = 0;
        const auto add = [](std::uint32_t v, std::uint32_t* list, std::uint32_t& count) HWY_ATTR {
            if ((count < 1 || list[0] != v) && (count < 2 || list[1] != v))
                list[count++] = v;
        };
        double edge_sq = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const GrowingBoundary::Corner& corner = boundary_.corners()[face.corners[k]];
            add(corner.vertices.a, a, count_a), add(corner.vertices.b, b, count_b);
            edge_sq = std::max(
                edge_sq, length_sq(boundary_.corners()[face.corners[(k + 1) % 3]].at - corner.at));
        }
        if (count_a + count_b != 4)
            return false;
        const double height_sq = length_sq(face.normal) / edge_sq,
                     rounding_sq = rounding_ * rounding_,
                     least_behind = 0x1p118 * rounding_sq * rounding_sq;
        const double behind_a = behind(a_, a_.pulled_back(-normal), a, count_a),
                     behind_b = behind(b_, b_.pulled_back(normal), b, count_b);
        return least_behind > 0x1p-900 && behind_a < 0 && behind_b < 0 &&
               behind_a * behind_a * height_sq >= least_behind &&
               behind_b * behind_b * height_sq >= least_behind;
    }

    /// The largest excess of a neighbour along a direction over a vertex, an edge or a triangle:
    /// negative if all neighbours lie behind; 0 if the vertices are no such feature.
    [[nodiscard]] HWY_INLINE static double behind(const PlacedXyz& side, const Vec3& n,
                                                  const std::uint32_t* vertices,
                                                  std::uint32_t count) {
        const Polytope& p = side.polytope();
        const HullVertex& v = p.vertices[vertices[0]];
        if (count == 1)
            return rings::highest_neighbour(p, v, n).most;
        const std::uint32_t end = v.first_edge + v.degree;
        std::uint32_t edge = v.first_edge;
        while (edge < end && p.target(edge) != vertices[1])
            ++edge;
        if (edge == end)
            return 0;
        const auto excess = [&](std::uint32_t e) HWY_ATTR { return dot(n, p.to(e) - v.at); };
        const std::uint32_t left = p.after(v, edge), right = p.before(v, edge);
        if (count == 2)
            return std::max(excess(left), excess(right));
        // All neighbours of a triangle lie on one side of it: one of them tells which.
        if (p.target(left) == vertices[2])
            return excess(p.after(v, left));
        return p.target(right) == vertices[2] ? excess(left) : 0;
    }

    PlacedXyz a_, b_;
    double rounding_;
    double all_rounding_;  ///< rounding_ with that of positions in the world's frame
    bool is_whole_ = true; ///< the boundary is closed
    double upper_sq_ = std::numeric_limits<double>::infinity(); ///< bound of depth squared
    GrowingBoundary boundary_;
    std::vector<std::uint32_t> open_; ///< faces that may be the nearest; some are removed or unused
    std::size_t open_count_ = 0;      ///< used slots
    std::size_t seen_ = 0;            ///< number of faces that open_new_faces has seen
    bool recalled_ = false;
};

void expand_from(const PolytopePair& pair, double rounding, const DifferenceSimplex& start,
                 DifferencePolytope* grown, NearestBoundary& nearest) {
    EpaPolytope polytope(pair, rounding);
    if (polytope.begin(start, nearest))
        polytope.expand(nearest);
    if (grown != nullptr)
        polytope.remember(*grown);
}

bool expand_last(const PolytopePair& pair, double rounding, DifferencePolytope& last,
                 NearestBoundary& nearest) {
    EpaPolytope polytope(pair, rounding);
    if (!polytope.recall(last) || !polytope.expand(nearest))
        return false;
    polytope.remember(last);
    return true;
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(expand_from);
HWY_EXPORT(expand_last);

NearestBoundary expand_simplex(const PolytopePair& pair, double rounding,
                               const DifferenceSimplex& start, DifferencePolytope* grown) {
    NearestBoundary nearest;
    HWY_DYNAMIC_DISPATCH(expand_from)(pair, rounding, start, grown, nearest);
    return nearest;
}

std::optional<NearestBoundary> expand_again(const PolytopePair& pair, double rounding,
                                            DifferencePolytope& last) {
    NearestBoundary nearest;
    if (!HWY_DYNAMIC_DISPATCH(expand_last)(pair, rounding, last, nearest))
        return std::nullopt;
    return nearest;
}

} // namespace abut
#endif
