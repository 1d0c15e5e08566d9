#include "world/contacts/contact_candidates.h"

#include "world/contacts/capsule_height.h"
#include "world/contacts/four_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace abut {

namespace {

/// A corner of a face in the contact frame.
struct FlatCorner {
    double x = 0, y = 0, height = 0;
    std::uint32_t vertex = 0, edge = 0;
};
using FlatFace = boost::container::small_vector<FlatCorner, 8>;

FlatFace flattened(const ContactFace& face, const ContactFrame& frame) {
    FlatFace flat;
    flat.reserve(face.corners.size());
    for (const ContactFace::Corner& corner : face.corners)
        flat.push_back({dot(corner.at, frame.across_x), dot(corner.at, frame.across_y),
                        dot(corner.at, frame.normal), corner.vertex, corner.edge});
    return flat;
}

/// The plane of a polygon, as a height over the contact frame.
struct FacePlane {
    double x, y, height, slope_x, slope_y;

    FacePlane(const FlatCorner& on, const Vec3& normal, const ContactFrame& frame)
        : x(on.x), y(on.y), height(on.height) {
        const double up = dot(normal, frame.normal);
        slope_x = -dot(normal, frame.across_x) / up, slope_y = -dot(normal, frame.across_y) / up;
    }
    [[nodiscard]] double at(double px, double py) const {
        return height + slope_x * (px - x) + slope_y * (py - y);
    }
};

/// Twice the area of the triangle of the edge from p to q and the point c; positive on the left.
double left_of(const FlatCorner& p, const FlatCorner& q, double x, double y) {
    return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
}

double square(double v) {
    return v * v;
}

/// A corner of b's face while it is clipped, and the side from it to the next: an edge of b's face,
/// or of a's with kSideOfA added.
struct OutlineCorner {
    double x = 0, y = 0, height = 0;
    std::uint32_t side = 0;
};
constexpr std::uint32_t kSideOfA = 1U << 31;
using Outline = boost::container::small_vector<OutlineCorner, 16>;

/// Keeps the part of an outline to the left of the edge from p to q. New sides are called `side`. Returns
/// false, and keeps nothing, if that is the whole outline.
bool clip(const Outline& outline, const FlatCorner& p, const FlatCorner& q, std::uint32_t side,
          Outline& kept) {
    boost::container::small_vector<double, 16> lefts;
    double least = 0;
    for (const OutlineCorner& corner : outline) {
        lefts.push_back(left_of(p, q, corner.x, corner.y));
        least = std::min(least, lefts.back());
    }
    if (least >= 0)
        return false;
    kept.clear();
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t k = i + 1 == outline.size() ? 0 : i + 1;
        const OutlineCorner &from = outline[i], &to = outline[k];
        const double here = lefts[i], next = lefts[k];
        if (here >= 0)
            kept.push_back(from);
        if ((here >= 0) == (next >= 0))
            continue;
        const double t = here / (here - next);
        kept.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                        from.height + t * (to.height - from.height), here >= 0 ? side : from.side});
    }
    return true;
}

/// The corner of a face that is nearest across the normal.
struct NearestCorner {
    std::uint32_t vertex = 0;
    double distance_sq = std::numeric_limits<double>::infinity();

    /// A corner that is at the place.
    explicit NearestCorner(const FlatCorner& corner) : vertex(corner.vertex), distance_sq(0) {}
    NearestCorner(const FlatFace& face, double x, double y) {
        for (const FlatCorner& corner : face) {
            const double sq = square(corner.x - x) + square(corner.y - y);
            if (sq < distance_sq)
                vertex = corner.vertex, distance_sq = sq;
        }
    }
};

/// A vertex within this share of the region's extent takes part in the name of a corner.
constexpr double kNameReach = 0x1p-6;

/// The square of that distance, for a region between two corners of its bounding rectangle.
double name_reach_sq(double low_x, double low_y, double high_x, double high_y) {
    return square(kNameReach) * (square(high_x - low_x) + square(high_y - low_y));
}

/// The kind of name where the nearest vertices of both faces are as near as given, and `otherwise`
/// if neither is within reach.
FeatureKind kind_within(double reach_sq, const NearestCorner& a, const NearestCorner& b,
                        FeatureKind otherwise) {
    const bool near_a = a.distance_sq <= reach_sq, near_b = b.distance_sq <= reach_sq;
    return near_a && near_b ? FeatureKind::vertices
           : near_a         ? FeatureKind::vertex_of_a
           : near_b         ? FeatureKind::vertex_of_b
                            : otherwise;
}

/// The name of a place where an edge of a and an edge of b meet, or a vertex of one is on the
/// other.
std::uint64_t name_of(FeatureKind kind, const NearestCorner& a, const NearestCorner& b,
                      std::uint32_t edge_a, std::uint32_t edge_b) {
    switch (kind) {
    case FeatureKind::vertices:
        return feature_name(kind, a.vertex, b.vertex);
    case FeatureKind::vertex_of_a:
        return feature_name(kind, a.vertex, 0);
    case FeatureKind::vertex_of_b:
        return feature_name(kind, 0, b.vertex);
    default:
        return feature_name(kind, edge_a, edge_b);
    }
}

void add_candidate(ContactCandidates& candidates, const ContactCandidate& candidate) {
    for (ContactCandidate& known : candidates)
        if (known.feature == candidate.feature) {
            if (candidate.depth() > known.depth())
                known = candidate;
            return;
        }
    candidates.push_back(candidate);
}

/// Whether side i of a face with n corners follows side k.
bool follows(std::uint32_t i, std::uint32_t k, std::size_t n) {
    return i == (k + 1 == n ? 0 : k + 1);
}

/// Adds the corners of an outline with their names. In: the outline is not empty.
void add_named_corners(const Outline& outline, const FlatFace& a, const FlatFace& b,
                       const FacePlane& plane, ContactCandidates& candidates) {
    double low_x = outline[0].x, low_y = outline[0].y, high_x = low_x, high_y = low_y;
    for (const OutlineCorner& corner : outline) {
        low_x = std::min(low_x, corner.x), high_x = std::max(high_x, corner.x);
        low_y = std::min(low_y, corner.y), high_y = std::max(high_y, corner.y);
    }
    const double reach_sq = name_reach_sq(low_x, low_y, high_x, high_y);
    std::uint32_t last_side = outline.back().side;
    for (const OutlineCorner& corner : outline) {
        const bool of_a = (corner.side & kSideOfA) != 0, last_of_a = (last_side & kSideOfA) != 0;
        const FeatureKind crossing = of_a != last_of_a ? FeatureKind::edges
                                     : of_a            ? FeatureKind::vertex_of_a
                                                       : FeatureKind::vertex_of_b;
        // The outline runs around b's face as its corners do, and against those of a. So between two sides
        // of one face that follow each other is a corner of it.
        const std::uint32_t now = corner.side & ~kSideOfA, before = last_side & ~kSideOfA;
        const NearestCorner near_a =
            crossing == FeatureKind::vertex_of_a && follows(before, now, a.size())
                ? NearestCorner(a[before])
                : NearestCorner(a, corner.x, corner.y);
        const NearestCorner near_b =
            crossing == FeatureKind::vertex_of_b && follows(now, before, b.size())
                ? NearestCorner(b[now])
                : NearestCorner(b, corner.x, corner.y);
        const std::uint32_t side_a = of_a ? corner.side : last_side,
                            side_b = of_a ? last_side : corner.side;
        const FeatureKind kind = kind_within(reach_sq, near_a, near_b, crossing);
        const bool is_crossing = kind == FeatureKind::edges;
        add_candidate(candidates,
                      {corner.x, corner.y, plane.at(corner.x, corner.y), corner.height,
                       name_of(kind, near_a, near_b, is_crossing ? a[side_a & ~kSideOfA].edge : 0,
                               is_crossing ? b[side_b].edge : 0)});
        last_side = corner.side;
    }
}

void overlap_of_polygons(const ContactFace& face_a, const FlatFace& a, const FlatFace& b,
                         const ContactFrame& frame, ContactCandidates& candidates) {
    std::array<Outline, 2> outlines;
    std::size_t now = 0;
    outlines[now].reserve(b.size());
    for (std::size_t i = 0; i < b.size(); ++i)
        outlines[now].push_back({b[i].x, b[i].y, b[i].height, static_cast<std::uint32_t>(i)});
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!clip(outlines[now], a[i], a[i + 1 == a.size() ? 0 : i + 1],
                  kSideOfA | static_cast<std::uint32_t>(i), outlines[1 - now]))
            continue;
        now = 1 - now;
        if (outlines[now].empty())
            return;
    }
    add_named_corners(outlines[now], a, b, FacePlane(a[0], face_a.normal, frame), candidates);
}

/// The part of a segment from p to q that lies over a polygon, and the edges that end it.
struct SegmentOverPolygon {
    double begin = 0, end = 1;
    std::optional<std::size_t> begin_edge, end_edge;

    SegmentOverPolygon(const FlatFace& polygon, const FlatCorner& p, const FlatCorner& q) {
        for (std::size_t i = 0; i < polygon.size() && begin <= end; ++i) {
            const FlatCorner &from = polygon[i], &to = polygon[i + 1 == polygon.size() ? 0 : i + 1];
            const double at_p = left_of(from, to, p.x, p.y), at_q = left_of(from, to, q.x, q.y);
            if (at_p >= 0 && at_q >= 0)
                continue;
            if (at_p < 0 && at_q < 0) {
                end = -1;
                return;
            }
            const double t = at_p / (at_p - at_q);
            if (at_p < 0 && t > begin)
                begin = t, begin_edge = i;
            if (at_q < 0 && t < end)
                end = t, end_edge = i;
        }
    }
};

void overlap_of_segment(const ContactFace& face_a, const FlatFace& a, const FlatFace& b,
                        double radius, const ContactFrame& frame, ContactCandidates& candidates) {
    const FlatCorner &p = b[0], &q = b[1];
    const SegmentOverPolygon part(a, p, q);
    if (!(part.begin <= part.end))
        return;
    const double length = part.end - part.begin;
    const double reach_sq = name_reach_sq(0, 0, length * (q.x - p.x), length * (q.y - p.y));
    const FacePlane plane(a[0], face_a.normal, frame);
    const Vec3 core_p{p.x, p.y, p.height}, core_q{q.x, q.y, q.height};
    const auto add = [&](double t, std::optional<std::size_t> edge, FeatureKind otherwise) {
        const Vec3 at = core_p + t * (core_q - core_p);
        const NearestCorner near_a(a, at.x, at.y), near_b(b, at.x, at.y);
        const FeatureKind kind = kind_within(reach_sq, near_a, near_b, otherwise);
        const double height =
            radius > 0 ? -capsule_height(core_p, core_q, radius, at.x, at.y, -1).value_or(-at.z)
                       : at.z;
        add_candidate(candidates,
                      {at.x, at.y, plane.at(at.x, at.y), height,
                       name_of(kind, near_a, near_b, edge ? a[*edge].edge : 0, p.edge)});
    };
    add(part.begin, part.begin_edge,
        part.begin_edge ? FeatureKind::edges : FeatureKind::vertex_of_b);
    add(part.end, part.end_edge, part.end_edge ? FeatureKind::edges : FeatureKind::vertex_of_b);
}

/// A vertex with a radius over a polygon.
void overlap_of_point(const ContactFace& face_a, const FlatFace& a, const FlatCorner& vertex,
                      double radius, const ContactFrame& frame, ContactCandidates& candidates) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (left_of(a[i], a[i + 1 == a.size() ? 0 : i + 1], vertex.x, vertex.y) < 0)
            return;
    candidates.push_back(
        {vertex.x, vertex.y, FacePlane(a[0], face_a.normal, frame).at(vertex.x, vertex.y),
         vertex.height - radius, feature_name(FeatureKind::vertex_of_b, 0, vertex.vertex)});
}

/// The parameter of the point of the segment from p to q that is nearest to a point across the
/// normal; none if it is an end, or if the segment is parallel to the normal.
std::optional<double> inner_nearest(const FlatCorner& p, const FlatCorner& q, double x, double y) {
    const double length_sq = square(q.x - p.x) + square(q.y - p.y);
    const double along = (x - p.x) * (q.x - p.x) + (y - p.y) * (q.y - p.y);
    if (!(along >= 0 && along <= length_sq && length_sq > 0))
        return std::nullopt;
    return along / length_sq;
}

/// The ends of the part in which two capsules lie side by side.
void overlap_of_segments(const FlatFace& a, double radius_a, const FlatFace& b, double radius_b,
                         ContactCandidates& candidates) {
    const double radii = radius_a + radius_b;
    if (!(radii > 0))
        return;
    const Vec3 a0{a[0].x, a[0].y, a[0].height}, a1{a[1].x, a[1].y, a[1].height};
    const Vec3 b0{b[0].x, b[0].y, b[0].height}, b1{b[1].x, b[1].y, b[1].height};
    const double reach_sq =
        square(kNameReach) * std::min(square(a1.x - a0.x) + square(a1.y - a0.y),
                                      square(b1.x - b0.x) + square(b1.y - b0.y));
    // The end of one axis and the point of the other beside it; the place of contact divides their
    // difference as the radii.
    const auto add = [&](double x_a, double y_a, double x_b, double y_b, FeatureKind end) {
        // One of the two is straight beside the other's axis, so that no place is over both.
        if (square(x_b - x_a) + square(y_b - y_a) > square(radii))
            return;
        const double share = radius_a / radii;
        const double x = x_a + share * (x_b - x_a), y = y_a + share * (y_b - y_a);
        const auto top = capsule_height(a0, a1, radius_a, x, y, 1),
                   bottom = capsule_height(b0, b1, radius_b, x, y, -1);
        if (!top || !bottom)
            return;
        const NearestCorner near_a(a, x_a, y_a), near_b(b, x_b, y_b);
        add_candidate(candidates,
                      {x, y, *top, -*bottom,
                       name_of(kind_within(reach_sq, near_a, near_b, end), near_a, near_b, 0, 0)});
    };
    for (const FlatCorner& end : a)
        if (const auto t = inner_nearest(b[0], b[1], end.x, end.y))
            add(end.x, end.y, b0.x + *t * (b1.x - b0.x), b0.y + *t * (b1.y - b0.y),
                FeatureKind::vertex_of_a);
    for (const FlatCorner& end : b)
        if (const auto t = inner_nearest(a[0], a[1], end.x, end.y))
            add(a0.x + *t * (a1.x - a0.x), a0.y + *t * (a1.y - a0.y), end.x, end.y,
                FeatureKind::vertex_of_b);
}

} // namespace

ContactFrame::ContactFrame(const Vec3& origin_in_world, const Vec3& unit_normal)
    : origin(origin_in_world), normal(unit_normal) {
    // [Duff et al. 2017], without a square root.
    const Vec3& n = unit_normal;
    const double sign = std::copysign(1.0, n.z), p = -1 / (sign + n.z), q = n.x * n.y * p;
    across_x = {1 + sign * n.x * n.x * p, sign * q, -sign * n.x};
    across_y = {q, sign + n.y * n.y * p, -n.y};
}

ContactFrame ContactFrame::turned_round() const {
    ContactFrame turned;
    turned.origin = origin, turned.normal = -normal;
    turned.across_x = across_y, turned.across_y = across_x;
    return turned;
}

std::uint64_t feature_name(FeatureKind kind, std::uint32_t of_a, std::uint32_t of_b) {
    constexpr std::uint32_t kNumber = (1U << 31) - 1;
    return std::uint64_t{static_cast<std::uint8_t>(kind)} << 62 |
           std::uint64_t{of_a & kNumber} << 31 | (of_b & kNumber);
}

std::uint64_t turned_round(std::uint64_t feature) {
    constexpr std::uint64_t kNumber = (std::uint64_t{1} << 31) - 1;
    const auto kind = static_cast<FeatureKind>(feature >> 62);
    const FeatureKind turned = kind == FeatureKind::vertex_of_a   ? FeatureKind::vertex_of_b
                               : kind == FeatureKind::vertex_of_b ? FeatureKind::vertex_of_a
                                                                  : kind;
    return feature_name(turned, static_cast<std::uint32_t>(feature & kNumber),
                        static_cast<std::uint32_t>(feature >> 31 & kNumber));
}

void add_overlap_corners(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                         ContactCandidates& candidates) {
    if (a.corners.empty() || b.corners.empty())
        return;
    if (!a.is_polygon() && b.is_polygon()) {
        add_overlap_corners(b, a, frame.turned_round(), candidates);
        for (ContactCandidate& each : candidates)
            each = {each.y, each.x, -each.height_b, -each.height_a, turned_round(each.feature)};
        return;
    }
    const FlatFace flat_a = flattened(a, frame), flat_b = flattened(b, frame);
    if (b.is_polygon())
        overlap_of_polygons(a, flat_a, flat_b, frame, candidates);
    else if (a.is_polygon() && flat_b.size() == 1)
        overlap_of_point(a, flat_a, flat_b[0], b.radius, frame, candidates);
    else if (a.is_polygon())
        overlap_of_segment(a, flat_a, flat_b, b.radius, frame, candidates);
    else if (flat_a.size() == 2 && flat_b.size() == 2)
        overlap_of_segments(flat_a, a.radius, flat_b, b.radius, candidates);
}

void keep_four(ContactCandidates& candidates, double rounding,
               std::span<const std::uint64_t> last) {
    if (candidates.size() <= 4) {
        for (std::size_t i = 1; i < candidates.size(); ++i)
            for (std::size_t k = i; k > 0 && candidates[k].depth() > candidates[k - 1].depth(); --k)
                std::swap(candidates[k], candidates[k - 1]);
        return;
    }
    boost::container::small_vector<RegionPoint, 12> points;
    points.reserve(candidates.size());
    for (const ContactCandidate& c : candidates)
        points.push_back({c.x, c.y, c.depth(), c.feature});
    ContactCandidates kept;
    for (const std::size_t i : four_points(std::span(points.data(), points.size()), rounding, last))
        kept.push_back(candidates[i]);
    candidates = kept;
}

} // namespace abut
