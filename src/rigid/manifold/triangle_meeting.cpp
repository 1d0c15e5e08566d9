#include "rigid/manifold/triangle_meeting.h"

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_segment.h"
#include "rigid/manifold/touching_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace abut {

namespace {

/// Collects the pairs that meet or are within a margin.
class NearPairCollector : public LeafPairVisitor {
public:
    NearPairCollector(const PlacedPair& pair, double margin)
        : leaves_(pair), margin_sq_(margin * margin) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& leaf_pairs) override {
        leaves_.set_leaves(leaf_a, leaf_b);
        for_each_pair(leaf_pairs.any(), [&](auto i, auto j) {
            const Triangle &ta = leaves_.a(i), &tb = leaves_.b(j);
            const TriangleContact kind = triangle_triangle_intersect(ta, tb);
            if (kind != TriangleContact::none ||
                triangle_triangle_distance(ta, tb).distance_sq <= margin_sq_)
                pairs.push_back({leaves_.indices(i, j), kind});
            return true;
        });
        return margin_sq_;
    }

    std::vector<Contact> pairs;

private:
    LeafTriangles leaves_;
    double margin_sq_;
};

/// A length of at most this many roundings of a position may be rounding.
constexpr double kSlight = 16;
/// The direction of a gap of at most this many roundings is rounded by 2^-10 or more.
constexpr double kSlightGap = 0x1p10;

struct CommonSegment {
    Vec3 from, to;
};

/// The segment in which a triangle cuts a plane, from the heights of its corners over the plane.
/// None if rounding leaves all corners on one side.
std::optional<CommonSegment> cut_of_plane(const Triangle& t, const std::array<double, 3>& heights) {
    const std::array<bool, 3> over{heights[0] > 0, heights[1] > 0, heights[2] > 0};
    if (over[0] == over[1] && over[1] == over[2])
        return std::nullopt;
    const std::size_t alone = over[0] == over[1] ? 2 : over[0] == over[2] ? 1 : 0;
    const auto at_edge = [&](std::size_t other) {
        const double share = heights[alone] / (heights[alone] - heights[other]);
        return t[alone] + share * (t[other] - t[alone]);
    };
    return CommonSegment{at_edge((alone + 1) % 3), at_edge((alone + 2) % 3)};
}

std::array<double, 3> heights_over(const Vec3& normal, const Vec3& point, const Triangle& t) {
    return {dot(normal, t[0] - point), dot(normal, t[1] - point), dot(normal, t[2] - point)};
}

/// The segment that two crossing triangles share, along n_a x n_b. In double precision: a segment
/// that rounding hides is that of the exact construction, or the point at which they are nearest.
CommonSegment common_segment(const Triangle& ta, const Vec3& n_a, const Triangle& tb,
                             const Vec3& n_b) {
    const auto on_a = cut_of_plane(ta, heights_over(n_b, tb[0], ta)),
               on_b = cut_of_plane(tb, heights_over(n_a, ta[0], tb));
    const auto nearest = [&] {
        const Vec3 point = triangle_triangle_distance(ta, tb).a;
        return CommonSegment{point, point};
    };
    if (!on_a || !on_b) {
        const Intersection common = triangle_triangle_segment(ta, tb);
        return common.count == 0
                   ? nearest()
                   : CommonSegment{common.corners[0], common.corners[common.count > 1 ? 1 : 0]};
    }
    const Vec3 along = cross(n_a, n_b);
    CommonSegment p = *on_a, q = *on_b;
    if (dot(along, p.to - p.from) < 0)
        std::swap(p.from, p.to);
    if (dot(along, q.to - q.from) < 0)
        std::swap(q.from, q.to);
    const CommonSegment common{dot(along, q.from - p.from) > 0 ? q.from : p.from,
                               dot(along, q.to - p.to) < 0 ? q.to : p.to};
    return dot(along, common.to - common.from) > 0 ? common : nearest();
}

/// The faces that some of the last meetings had, by triangle.
class RecentFaces {
public:
    /// The place of a triangle among the faces. Adds it if it is not among the recent ones.
    std::uint32_t face(const ManifoldSide& side, std::uint32_t triangle,
                       std::vector<MeetingFace>& faces) {
        Entry& entry = entries_[triangle % kSize];
        if (entry.triangle == triangle && entry.known)
            return entry.face;
        entry = {triangle, static_cast<std::uint32_t>(faces.size()), true};
        const Triangle t = side.triangle(triangle);
        const Vec3 normal = side.facing() * cross(t[1] - t[0], t[2] - t[0]);
        faces.push_back({t, side.vertices(triangle), normal, normalized_or_zero(normal)});
        return entry.face;
    }

private:
    struct Entry {
        std::uint32_t triangle = 0, face = 0;
        bool known = false;
    };
    static constexpr std::size_t kSize = 64;
    std::array<Entry, kSize> entries_{};
};

/// Describes the meetings one by one.
class MeetingWriter {
public:
    MeetingWriter(const ManifoldSide& a, const ManifoldSide& b, double margin,
                  TriangleMeetings& meetings)
        : a_(a), b_(b), margin_(margin), rounding_(rounding_of_places(a, b)), meetings_(meetings) {}

    void add(const Contact& contact) {
        TriangleMeeting m;
        m.pair = contact.pair, m.kind = contact.kind;
        m.face_a = recent_a_.face(a_, m.pair.a, meetings_.faces);
        m.face_b = recent_b_.face(b_, m.pair.b, meetings_.faces);
        const MeetingFace &fa = meetings_.faces[m.face_a], &fb = meetings_.faces[m.face_b];
        m.normal_a = fa.unit_normal, m.normal_b = fb.unit_normal;
        m.first_point = static_cast<std::uint32_t>(meetings_.points.size());
        if (contact.kind == TriangleContact::cross) {
            const CommonSegment s = common_segment(fa.corners, fa.normal, fb.corners, fb.normal);
            m.from = s.from, m.to = s.to;
            m.weight = length(s.to - s.from);
            // Faces that are coplanar to rounding cross along rounding noise.
            constexpr double kCoplanarSq = 0x1p-80;
            if (length_sq(cross(m.normal_a, m.normal_b)) < kCoplanarSq)
                m.to = m.from, m.weight = 0;
            // Triangles touch if they pass each other by no more than rounding.
            if (!(m.weight > kSlight * rounding_) || hardly_passes(fa.corners, fb) ||
                hardly_passes(fb.corners, fa))
                add_touching(m, s, fa, fb);
        } else if (contact.kind == TriangleContact::touch) {
            add_touching(m, fa, fb);
        } else if (!add_near(m, fa, fb)) {
            return;
        }
        m.point_count = static_cast<std::uint32_t>(meetings_.points.size()) - m.first_point;
        meetings_.all.push_back(m);
    }

private:
    void add_touching(TriangleMeeting& m, const MeetingFace& fa, const MeetingFace& fb) {
        const Intersection common = triangle_triangle_segment(fa.corners, fb.corners);
        const auto& c = common.corners;
        m.from = m.to = c[0];
        for (std::uint32_t k = 0; k < common.count; ++k) {
            meetings_.points.push_back({c[k], c[k], name_of(c[k], m.pair, k, fa, fb)});
            m.weight += length(c[k] - c[(k + 1) % common.count]);
        }
        add_direction(m, fa, fb);
    }

    /// Returns whether a triangle lies on one side of a face's plane, to rounding.
    [[nodiscard]] bool hardly_passes(const Triangle& t, const MeetingFace& face) const {
        const auto heights = heights_over(face.unit_normal, face.corners[0], t);
        const auto [low, high] = std::minmax({heights[0], heights[1], heights[2]});
        return face.unit_normal != Vec3{} && std::min(high, -low) <= kSlight * rounding_;
    }

    /// As above, for triangles that cross, but only touch to rounding.
    void add_touching(TriangleMeeting& m, const CommonSegment& s, const MeetingFace& fa,
                      const MeetingFace& fb) {
        m.kind = TriangleContact::touch;
        const TouchingDirection found = add_direction(m, fa, fb);
        boost::container::static_vector<Vec3, 6> corners = found.outline;
        // The line in which planes cross that are one to rounding may be anywhere.
        if (corners.empty() && found.in_one_plane)
            corners.push_back(triangle_triangle_distance(fa.corners, fb.corners).a);
        if (corners.empty()) {
            corners.push_back(s.from);
            if (s.to != s.from)
                corners.push_back(s.to);
        }
        m.from = m.to = corners[0];
        for (std::uint32_t k = 0; k < corners.size(); ++k)
            meetings_.points.push_back(
                {corners[k], corners[k], name_of(corners[k], m.pair, k, fa, fb)});
    }

    TouchingDirection add_direction(TriangleMeeting& m, const MeetingFace& fa,
                                    const MeetingFace& fb, double gap = 0) const {
        TouchingDirection found =
            touching_direction({fa.corners, fb.corners, fa.unit_normal, fb.unit_normal,
                                a_.is_oriented(), b_.is_oriented()},
                               rounding_ + 0.125 * gap);
        m.common_area = found.area, m.across = found.across;
        return found;
    }

    /// A vertex that lies at the point names it; else the two triangles do.
    [[nodiscard]] std::uint64_t name_of(const Vec3& p, const TrianglePair& pair,
                                        std::uint32_t corner, const MeetingFace& fa,
                                        const MeetingFace& fb) const {
        const auto is_at = [&](const Vec3& vertex) {
            return max_abs(vertex - p) <= kSlight * rounding_;
        };
        for (std::size_t k = 0; k < 3; ++k)
            if (is_at(fb.corners[k]))
                return point_name::vertex_b(fb.vertices[k]);
        for (std::size_t k = 0; k < 3; ++k)
            if (is_at(fa.corners[k]))
                return point_name::vertex_a(fa.vertices[k]);
        return point_name::triangles(pair, corner);
    }

    /// Adds the nearest points, and those of each vertex within the margin. Returns false, and adds
    /// nothing, if a face looks away from the other: it is the far side of a thin body, or lies
    /// inside the other one.
    bool add_near(TriangleMeeting& m, const MeetingFace& fa, const MeetingFace& fb) {
        const Triangle &ta = fa.corners, &tb = fb.corners;
        const ClosestPoints nearest = triangle_triangle_distance(ta, tb);
        meetings_.nearest_sq = std::min(meetings_.nearest_sq, nearest.distance_sq);
        const double distance = std::sqrt(nearest.distance_sq);
        m.is_slight = distance <= kSlightGap * rounding_;
        if (m.is_slight)
            add_direction(m, fa, fb, distance);
        const Vec3 gap = m.is_slight ? m.across : normalized_or_zero(nearest.b - nearest.a);
        constexpr double kLooksAway = 0.5; // by more than 120 degrees
        if ((a_.is_oriented() && dot(gap, m.normal_a) < -kLooksAway) ||
            (b_.is_oriented() && dot(gap, m.normal_b) > kLooksAway))
            return false;
        m.from = nearest.a, m.to = nearest.b;
        // At right angles, as flush faces are; a short gap is tilted by rounding.
        const double right_angle = 0x1p-30 + kSlight * rounding_ / std::max(distance, rounding_);
        const bool across_a = std::abs(dot(gap, m.normal_a)) < right_angle,
                   across_b = std::abs(dot(gap, m.normal_b)) < right_angle;
        m.is_beside = !m.is_slight && (a_.is_oriented() && b_.is_oriented() ? across_a || across_b
                                                                            : across_a && across_b);
        // A pair whose gap equals the margin still has a direction.
        m.weight = std::max(margin_ - distance, 0x1p-40 * margin_);
        const double most_sq = margin_ * margin_;
        auto& points = meetings_.points;
        for (std::size_t k = 0; k < 3; ++k) {
            if (const auto on_a = nearest_on_triangle(tb[k], ta); on_a.distance_sq <= most_sq)
                points.push_back({on_a.point, tb[k], point_name::vertex_b(fb.vertices[k])});
            if (const auto on_b = nearest_on_triangle(ta[k], tb); on_b.distance_sq <= most_sq)
                points.push_back({ta[k], on_b.point, point_name::vertex_a(fa.vertices[k])});
        }
        if (nearest.on_a.kind != Feature::vertex && nearest.on_b.kind != Feature::vertex)
            points.push_back({nearest.a, nearest.b, point_name::triangles(m.pair)});
        return true;
    }

    const ManifoldSide& a_;
    const ManifoldSide& b_;
    double margin_;
    double rounding_;
    TriangleMeetings& meetings_;
    RecentFaces recent_a_, recent_b_;
};

} // namespace

std::vector<Contact> meeting_pairs(const PlacedPair& pair, double margin) {
    std::vector<Contact> pairs;
    if (margin > 0) {
        NearPairCollector collector(pair, margin);
        PairTraversal traversal = pair.traversal(margin * margin);
        pair.visit_nearest(traversal, collector);
        pairs = std::move(collector.pairs);
    } else {
        Counters counters;
        pairs = find_contacts(pair, ContactMode::all, counters);
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
    return pairs;
}

void describe_meetings(const ManifoldSide& a, const ManifoldSide& b,
                       const std::vector<Contact>& pairs, double margin,
                       TriangleMeetings& meetings) {
    meetings.all.clear();
    meetings.points.clear();
    meetings.faces.clear();
    meetings.nearest_sq = std::numeric_limits<double>::infinity();
    meetings.all.reserve(pairs.size());
    MeetingWriter writer(a, b, margin, meetings);
    SearchSteps steps;
    for (const Contact& contact : pairs) {
        steps.take();
        writer.add(contact);
    }
}

} // namespace abut
