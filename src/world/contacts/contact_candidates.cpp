#include "world/contacts/contact_candidates.h"

#include "world/solids/capsule_height.h"
#include "world/solids/polygon_overlap.h"
#include "world/solids/segment_overlap.h"

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <optional>
#include <span>

namespace abut {

namespace {

using FlatFace = boost::container::small_vector<FlatCorner, 8>;

FlatFace flattened(const ContactFace& face, const ContactFrame& frame) {
    FlatFace flat;
    flat.reserve(face.corners.size());
    for (const ContactFace::Corner& corner : face.corners) {
        const Vec3 at = frame.coordinates(corner.at);
        flat.push_back({at.x, at.y, at.z, corner.vertex, corner.edge});
    }
    return flat;
}

std::span<const FlatCorner> corners_of(const FlatFace& face) {
    return {face.data(), face.size()};
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
    // Where an end lies over an edge of the polygon, rounding decides how much of the segment is over it, if
    // any. An end names all that is near it, by the whole segment's length: that does not change.
    const double reach_a_sq = name_reach_sq(0, 0, length * (q.x - p.x), length * (q.y - p.y)),
                 reach_b_sq = name_reach_sq(0, 0, q.x - p.x, q.y - p.y);
    const FacePlane plane(a[0], face_a.normal, frame);
    const Vec3 core_p{p.x, p.y, p.height}, core_q{q.x, q.y, q.height};
    const auto add = [&](double t, std::optional<std::size_t> edge, FeatureKind otherwise) {
        const Vec3 at = core_p + t * (core_q - core_p);
        const NearestCorner near_a(corners_of(a), at.x, at.y), near_b(corners_of(b), at.x, at.y);
        const FeatureKind kind = near_b.distance_sq <= reach_b_sq   ? FeatureKind::vertex_of_b
                                 : near_a.distance_sq <= reach_a_sq ? FeatureKind::vertex_of_a
                                                                    : otherwise;
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

} // namespace

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
        add_polygon_overlap(corners_of(flat_a), corners_of(flat_b),
                            FacePlane(flat_a[0], a.normal, frame), candidates);
    else if (a.is_polygon() && flat_b.size() == 1)
        overlap_of_point(a, flat_a, flat_b[0], b.radius, frame, candidates);
    else if (a.is_polygon())
        overlap_of_segment(a, flat_a, flat_b, b.radius, frame, candidates);
    else if (flat_a.size() == 2 && flat_b.size() == 2)
        add_segment_overlap({{flat_a[0], flat_a[1]}, a.radius}, {{flat_b[0], flat_b[1]}, b.radius},
                            candidates);
}

} // namespace abut
