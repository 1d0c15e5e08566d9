#include "convex/expanding_polytope.h"

#include "convex/climb.h"
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

constexpr std::uint32_t next(std::uint32_t k) {
    return k == 2 ? 0 : k + 1;
}

/// After so many corners the bounds have to do as they are.
constexpr std::uint32_t kMostSteps = 2000;
/// Faces of a polytope that is worth to be remembered.
constexpr std::uint32_t kMostKept = 160;
constexpr std::uint32_t kNone = 0xffffffffU;

} // namespace

ExpandingPolytope::ExpandingPolytope(const PolytopePair& pair, double rounding)
    : pair_(pair), rounding_(rounding) {
    corners_.reserve(64);
    faces_.reserve(256);
    open_.resize(64);
    visible_.resize(64);
    horizon_.resize(64);
}

ExpandingPolytope::Corner ExpandingPolytope::placed(const VertexPair& vertices) const {
    return {pair_.b.vertex(vertices.b) - pair_.a.vertex(vertices.a), vertices, 0};
}

ExpandingPolytope::Corner ExpandingPolytope::farthest_corner(const Vec3& direction) const {
    return placed(farthest(pair_, -direction));
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
    around_ = around_ && (!recalled_ || face.offset > rounding_);
    // Else it is never the nearest. (Values are chosen, here and below: branches would be coins'.)
    if (open_.size() == open_count_)
        open_.resize(2 * open_count_);
    open_[open_count_] = number;
    open_count_ += face.offset <= upper_ ? 1 : 0;
}

/// Takes the nearest face from those that are open, and forgets those that will not be it.
std::uint32_t ExpandingPolytope::nearest_face() {
    std::size_t kept = 0, nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < open_count_; ++i) {
        const std::uint32_t f = open_[i];
        const double offset = faces_[f].offset;
        nearest = offset < least ? kept : nearest;
        least = offset < least ? offset : least;
        open_[kept] = f;
        kept += offset <= upper_ ? 1 : 0;
    }
    open_count_ = kept;
    return open_[nearest];
}

/// Faces that see the corner, beginning with one of them, go; the border around them stays. (Both
/// lists are written to always, and counted by what is seen: branches would be coins'.)
void ExpandingPolytope::remove_visible(const Vec3& corner, std::uint32_t seen_by) {
    visible_[0] = seen_by;
    faces_[seen_by].gone = 1;
    std::size_t visible = 1, horizon = 0;
    for (std::size_t i = 0; i < visible; ++i) {
        if (visible + 3 > visible_.size())
            visible_.resize(2 * visible_.size());
        if (horizon + 3 > horizon_.size())
            horizon_.resize(2 * horizon_.size());
        for (const Side& side : faces_[visible_[i]].across) {
            Face& beyond = faces_[side.face];
            const std::uint32_t seen = above(beyond, corner) > rounding_ ? 1 : 0;
            const std::uint32_t alive = 1 - beyond.gone;
            visible_[visible] = side.face;
            horizon_[horizon] = side;
            visible += seen & alive;
            horizon += (1 - seen) & alive;
            beyond.gone |= seen;
        }
    }
    for (std::size_t i = 0; i < visible; ++i)
        faces_[visible_[i]].remove();
    horizon_count_ = horizon;
}

void ExpandingPolytope::join(const Side& one, const Side& other) {
    faces_[one.face].across[one.edge] = other;
    faces_[other.face].across[other.edge] = one;
}

void ExpandingPolytope::add_corner(const Corner& corner, std::uint32_t seen_by) {
    remove_visible(corner.at, seen_by);
    const auto point = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back(corner);
    const auto first = static_cast<std::uint32_t>(faces_.size());
    for (std::size_t i = 0; i < horizon_count_; ++i) {
        const Side side = horizon_[i];
        const Face& beyond = faces_[side.face];
        const std::uint32_t from = beyond.corners[next(side.edge)], to = beyond.corners[side.edge];
        const auto face = static_cast<std::uint32_t>(faces_.size());
        // Two cones at one corner: its faces would not be one ring any more.
        around_ = around_ && (!recalled_ || corners_[from].cone < first);
        corners_[from].cone = face;
        add_face(from, to, point);
        join({face, 0}, side);
    }
    for (std::uint32_t f = first; f < faces_.size(); ++f)
        join({f, 1}, {corners_[faces_[f].corners[1]].cone, 2});
}

/// Where a recalled polytope is dented along an edge of the face, with the corner on the other side:
/// the edge that fills the dent takes its place. Whether there was one.
bool ExpandingPolytope::fill_dent(const VertexPair& corner, std::uint32_t face) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Side beyond = faces_[face].across[k];
        if (corners_[faces_[beyond.face].corners[next(next(beyond.edge))]].vertices == corner) {
            flip({face, k});
            return true;
        }
    }
    return false;
}

/// The other two corners of an edge's faces are joined in its place.
void ExpandingPolytope::flip(const Side& side) {
    const Side back = faces_[side.face].across[side.edge];
    const Face f = faces_[side.face], g = faces_[back.face];
    const std::uint32_t k = side.edge, j = back.edge;
    const std::uint32_t f_corner = f.corners[next(next(k))], g_corner = g.corners[next(next(j))];
    faces_[side.face].remove(), faces_[back.face].remove();
    const auto left = static_cast<std::uint32_t>(faces_.size()), right = left + 1;
    add_face(f.corners[k], g_corner, f_corner), add_face(g_corner, g.corners[j], f_corner);
    join({left, 1}, {right, 2});
    join({left, 0}, g.across[next(j)]), join({right, 0}, g.across[next(next(j))]);
    join({left, 2}, f.across[next(next(k))]), join({right, 1}, f.across[next(k)]);
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

std::optional<NearestBoundary> ExpandingPolytope::begin(const DifferenceSimplex& start) {
    NearestBoundary flat;
    if (!complete(start, flat))
        return flat;
    if (dot(cross(corners_[1].at - corners_[0].at, corners_[2].at - corners_[0].at),
            corners_[3].at - corners_[0].at) > 0)
        std::swap(corners_[1], corners_[2]);
    add_face(0, 1, 2), add_face(0, 2, 3), add_face(2, 1, 3), add_face(1, 0, 3);
    join({0, 0}, {3, 0}), join({0, 1}, {2, 0}), join({0, 2}, {1, 0});
    join({1, 1}, {2, 2}), join({1, 2}, {3, 1}), join({2, 1}, {3, 2});
    return std::nullopt;
}

bool ExpandingPolytope::recall(const DifferencePolytope& last) {
    recalled_ = true;
    for (const VertexPair& vertices : last.corners) {
        if (vertices.a >= pair_.a.polytope->vertices.size() ||
            vertices.b >= pair_.b.polytope->vertices.size())
            return false;
        corners_.push_back(placed(vertices));
    }
    for (const DifferencePolytope::Face& face : last.faces) {
        add_face(face.corners[0], face.corners[1], face.corners[2]);
        faces_.back().across = face.across;
        if (!around_)
            return false;
    }
    return true;
}

/// Whether all faces that are left meet along their edges, two and two: rounding may have undone that.
bool ExpandingPolytope::is_closed() const {
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        for (std::uint32_t k = 0; faces_[f].alive() && k < 3; ++k) {
            const Side& other = faces_[f].across[k];
            const Side& back = faces_[other.face].across[other.edge];
            if (!faces_[other.face].alive() || back.face != f || back.edge != k)
                return false;
        }
    return true;
}

void ExpandingPolytope::remember(DifferencePolytope& now) const {
    now.corners.clear(), now.faces.clear();
    std::vector<std::uint32_t> number_of_face(faces_.size()),
        number_of_corner(corners_.size(), kNone);
    std::uint32_t faces = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f)
        if (faces_[f].alive())
            number_of_face[f] = faces++;
    if (faces > kMostKept || !is_closed())
        return;
    for (const Face& face : faces_) {
        if (!face.alive())
            continue;
        DifferencePolytope::Face& kept = now.faces.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& number = number_of_corner[face.corners[k]];
            if (number == kNone) {
                number = static_cast<std::uint32_t>(now.corners.size());
                now.corners.push_back(corners_[face.corners[k]].vertices);
            }
            kept.corners[k] = number;
            kept.across[k] = {number_of_face[face.across[k].face], face.across[k].edge};
        }
    }
}

std::optional<NearestBoundary> ExpandingPolytope::expand() {
    NearestBoundary nearest;
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
        if (!recalled_ || !fill_dent(corner.vertices, f))
            add_corner(corner, f);
        if (!around_)
            return std::nullopt;
    }
}

} // namespace abut
