#include "rigid/manifold/triangle_meeting.h"

#include "geometry/leaf/triangle_pair_batch.h"
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

/// Collects the pairs that meet, and those that may be within a margin.
class NearPairCollector : public LeafPairVisitor {
public:
    NearPairCollector(const PlacedPair& pair, double margin, MeetingPairs& pairs)
        : leaves_(pair), margin_sq_(margin * margin), pairs_(pairs) {}

    double visit(NodeRef leaf_a, NodeRef leaf_b, const LeafPairs& leaf_pairs) override {
        leaves_.set_leaves(leaf_a, leaf_b);
        for_each_pair(leaf_pairs.cross, [&](auto i, auto j) {
            pairs_.meeting.push_back({leaves_.indices(i, j), TriangleContact::cross});
            return true;
        });
        for_each_pair(leaf_pairs.may_meet, [&](auto i, auto j) {
            const TriangleContact kind = triangle_triangle_intersect(leaves_.a(i), leaves_.b(j));
            if (kind != TriangleContact::none)
                pairs_.meeting.push_back({leaves_.indices(i, j), kind});
            else
                pairs_.near.push_back(leaves_.indices(i, j));
            return true;
        });
        for_each_pair(leaf_pairs.may_be_near, [&](auto i, auto j) {
            pairs_.near.push_back(leaves_.indices(i, j));
            return true;
        });
        return margin_sq_;
    }

private:
    LeafTriangles leaves_;
    double margin_sq_;
    MeetingPairs& pairs_;
};

constexpr double kSlight = 16; ///< a length of so many roundings of a position may be rounding
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
    static constexpr std::size_t kSize = 256;
    std::array<Entry, kSize> entries_{};
};

/// Describes the meetings one by one.
class MeetingWriter {
public:
    MeetingWriter(const PlacedPair& placed, const ManifoldSide& a, const ManifoldSide& b,
                  double margin, TriangleMeetings& meetings)
        : placed_(placed), a_(a), b_(b), margin_(margin), rounding_(rounding_of_places(a, b)),
          meetings_(meetings) {}

    void add(const Contact& contact) {
        TriangleMeeting m =
            begin(contact.pair, contact.kind, face_a(contact.pair), face_b(contact.pair));
        const MeetingFace &fa = meetings_.faces[m.face_a], &fb = meetings_.faces[m.face_b];
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
        } else {
            add_touching(m, fa, fb);
        }
        end(m);
    }

    /// Adds a pair that may be near. It counts once `measure` was called.
    void add_near(const TrianglePair& pair) {
        const Waiting& w = waiting_[waiting_count_] = {pair, face_a(pair), face_b(pair)};
        batch_.set(waiting_count_, meetings_.faces[w.face_a].corners,
                   meetings_.faces[w.face_b].corners);
        if (++waiting_count_ == TrianglePairBatch::kLanes)
            measure();
    }

    /// Measures the pairs that wait.
    void measure() {
        if (waiting_count_ == 0)
            return;
        PairPoints found{};
        nearest_points(batch_, found);
        for (std::size_t lane = 0; lane < waiting_count_; ++lane)
            if (const Waiting& w = waiting_[lane];
                is_within_margin(w.pair, found.distance_sq[lane]))
                add_near(w, found.get_on_a(lane), found.get_gap(lane), found.distance_sq[lane]);
        waiting_count_ = 0;
    }

private:
    /// A pair that has not been measured yet.
    struct Waiting {
        TrianglePair pair;
        std::uint32_t face_a = 0, face_b = 0;
    };

    std::uint32_t face_a(const TrianglePair& pair) {
        return recent_a_.face(a_, pair.a, meetings_.faces);
    }
    std::uint32_t face_b(const TrianglePair& pair) {
        return recent_b_.face(b_, pair.b, meetings_.faces);
    }

    [[nodiscard]] TriangleMeeting begin(const TrianglePair& pair, TriangleContact kind,
                                        std::uint32_t face_a, std::uint32_t face_b) const {
        TriangleMeeting m;
        m.pair = pair, m.kind = kind;
        m.face_a = face_a, m.face_b = face_b;
        m.normal_a = meetings_.faces[face_a].unit_normal;
        m.normal_b = meetings_.faces[face_b].unit_normal;
        m.first_point = static_cast<std::uint32_t>(meetings_.points.size());
        return m;
    }

    void end(TriangleMeeting& m) {
        m.point_count = static_cast<std::uint32_t>(meetings_.points.size()) - m.first_point;
        meetings_.all.push_back(m);
    }

    /// Whether a measured pair is near. Where the distance is the margin, to rounding, the triangles
    /// in the world decide, as they do for `within`.
    [[nodiscard]] bool is_within_margin(const TrianglePair& pair, double distance_sq) const {
        const double margin_sq = margin_ * margin_;
        if (std::abs(distance_sq - margin_sq) > 0x1p-20 * margin_sq)
            return distance_sq < margin_sq;
        return triangle_triangle_distance(placed_.triangle_a(pair.a), placed_.triangle_b(pair.b))
                   .distance_sq <= margin_sq;
    }

    void add_near(const Waiting& w, const Vec3& on_a, const Vec3& gap, double distance_sq) {
        if (distance_sq < meetings_.nearest_sq)
            meetings_.nearest_sq = distance_sq, meetings_.nearest = w.pair;
        const double distance = std::sqrt(distance_sq);
        if (distance <= kSlightGap * rounding_) {
            add_slight(w, on_a, gap, distance);
            return;
        }
        const MeetingFace &fa = meetings_.faces[w.face_a], &fb = meetings_.faces[w.face_b];
        const Vec3 way = (1 / distance) * gap;
        const double cos_a = dot(way, fa.unit_normal), cos_b = dot(way, fb.unit_normal);
        if (looks_away(cos_a, cos_b))
            return;
        TriangleMeeting& m =
            meetings_.all.emplace_back(begin(w.pair, TriangleContact::none, w.face_a, w.face_b));
        m.from = on_a, m.to = on_a + gap;
        // At right angles, as flush faces are; a short gap is tilted by rounding.
        const double right_angle = 0x1p-30 + kSlight * rounding_ / distance;
        const bool across_a = std::abs(cos_a) < right_angle,
                   across_b = std::abs(cos_b) < right_angle;
        m.is_beside =
            a_.is_oriented() && b_.is_oriented() ? across_a || across_b : across_a && across_b;
        m.weight = weight_of(distance);
    }

    /// Adds a pair whose gap may be rounding.
    void add_slight(const Waiting& w, const Vec3& on_a, const Vec3& gap, double distance) {
        const MeetingFace &fa = meetings_.faces[w.face_a], &fb = meetings_.faces[w.face_b];
        TriangleMeeting m = begin(w.pair, TriangleContact::none, w.face_a, w.face_b);
        m.from = on_a, m.to = on_a + gap;
        m.is_slight = true;
        add_direction(m, fa, fb, distance);
        if (looks_away(dot(m.across, m.normal_a), dot(m.across, m.normal_b)))
            return;
        m.weight = weight_of(distance);
        for (const FixedPoint& p : near_points(m, meetings_, margin_))
            meetings_.points.push_back(p);
        end(m);
    }

    /// Whether a face looks away from the other: it is the far side of a thin body, or lies inside the
    /// other one. In: cosines of the gap's direction with the normals.
    [[nodiscard]] bool looks_away(double cos_a, double cos_b) const {
        constexpr double kLooksAway = 0.5; // by more than 120 degrees
        return (a_.is_oriented() && cos_a < -kLooksAway) ||
               (b_.is_oriented() && cos_b > kLooksAway);
    }

    /// What a gap lacks to the margin. A pair whose gap equals the margin still has a direction.
    [[nodiscard]] double weight_of(double distance) const {
        return std::max(margin_ - distance, 0x1p-40 * margin_);
    }

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

    const PlacedPair& placed_;
    const ManifoldSide& a_;
    const ManifoldSide& b_;
    double margin_;
    double rounding_;
    TriangleMeetings& meetings_;
    RecentFaces recent_a_, recent_b_;
    TrianglePairBatch batch_{};
    std::array<Waiting, TrianglePairBatch::kLanes> waiting_{};
    std::size_t waiting_count_ = 0;
};

} // namespace

MeetingPairs meeting_pairs(const PlacedPair& pair, double margin) {
    MeetingPairs pairs;
    if (margin > 0) {
        NearPairCollector collector(pair, margin, pairs);
        PairTraversal traversal = pair.traversal(margin * margin);
        pair.visit_nearest(traversal, collector);
    } else {
        Counters counters;
        pairs.meeting = find_contacts(pair, ContactMode::all, counters);
    }
    std::sort(pairs.meeting.begin(), pairs.meeting.end(),
              [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
    return pairs;
}

void describe_meetings(const PlacedPair& placed, const ManifoldSide& a, const ManifoldSide& b,
                       const MeetingPairs& pairs, double margin, TriangleMeetings& meetings) {
    meetings.all.clear();
    meetings.points.clear();
    meetings.faces.clear();
    meetings.nearest_sq = std::numeric_limits<double>::infinity();
    meetings.all.reserve(pairs.meeting.size() + pairs.near.size());
    MeetingWriter writer(placed, a, b, margin, meetings);
    SearchSteps steps;
    for (const Contact& contact : pairs.meeting) {
        steps.take();
        writer.add(contact);
    }
    for (const TrianglePair& pair : pairs.near) {
        steps.take();
        writer.add_near(pair);
    }
    writer.measure();
    const auto meets = [](const TriangleMeeting& m) { return !m.is_gap(); };
    if (!std::is_partitioned(meetings.all.begin(), meetings.all.end(), meets))
        std::stable_partition(meetings.all.begin(), meetings.all.end(), meets);
}

NearPoints near_points(const TriangleMeeting& m, const TriangleMeetings& meetings, double margin) {
    const MeetingFace &fa = meetings.faces[m.face_a], &fb = meetings.faces[m.face_b];
    const Triangle &ta = fa.corners, &tb = fb.corners;
    const double most_sq = margin * margin;
    NearPoints points;
    for (std::size_t k = 0; k < 3; ++k) {
        if (const auto on_a = nearest_on_triangle(tb[k], ta); on_a.distance_sq <= most_sq)
            points.push_back({on_a.point, tb[k], point_name::vertex_b(fb.vertices[k])});
        if (const auto on_b = nearest_on_triangle(ta[k], tb); on_b.distance_sq <= most_sq)
            points.push_back({ta[k], on_b.point, point_name::vertex_a(fa.vertices[k])});
    }
    const ClosestPoints nearest = triangle_triangle_distance(ta, tb);
    if (nearest.on_a.kind != Feature::vertex && nearest.on_b.kind != Feature::vertex)
        points.push_back({nearest.a, nearest.b, point_name::triangles(m.pair)});
    return points;
}

NearPoints points_along(const TriangleMeeting& m, const TriangleMeetings& meetings,
                        const Vec3& normal, double margin, double rounding) {
    const MeetingFace &fa = meetings.faces[m.face_a], &fb = meetings.faces[m.face_b];
    NearPoints points;
    const auto add = [&](const Vec3& on_a, const Vec3& on_b, std::uint64_t name) {
        const double gap = dot(normal, on_b - on_a);
        if (gap > 0 && gap <= margin)
            points.push_back({on_a, on_b, name});
    };
    // The place of a face on the line along the normal through a point.
    const auto place_over = [&](const Vec3& p, const MeetingFace& face) -> std::optional<Vec3> {
        constexpr double kAcross = 0x1p-20;
        const double slope = dot(face.unit_normal, normal);
        if (!(std::abs(slope) > kAcross))
            return std::nullopt;
        const Vec3 place = p + (dot(face.unit_normal, face.corners[0] - p) / slope) * normal;
        const double off = kSlight * rounding / std::abs(slope);
        return nearest_on_triangle(place, face.corners).distance_sq <= off * off
                   ? std::optional(place)
                   : std::nullopt;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (const auto on_a = place_over(fb.corners[k], fa))
            add(*on_a, fb.corners[k], point_name::vertex_b(fb.vertices[k]));
        if (const auto on_b = place_over(fa.corners[k], fb))
            add(fa.corners[k], *on_b, point_name::vertex_a(fa.vertices[k]));
    }
    const double near = kSlight * rounding;
    const bool is_there = std::any_of(points.begin(), points.end(), [&](const FixedPoint& p) {
        return max_abs(p.a - m.from) <= near && max_abs(p.b - m.to) <= near;
    });
    if (!is_there && length(cross(m.to - m.from, normal)) <= near) {
        std::uint64_t name = point_name::triangles(m.pair);
        for (std::size_t k = 0; k < 6; ++k)
            if (k < 3 && max_abs(fa.corners[k] - m.from) <= near)
                name = point_name::vertex_a(fa.vertices[k]);
            else if (k >= 3 && max_abs(fb.corners[k - 3] - m.to) <= near)
                name = point_name::vertex_b(fb.vertices[k - 3]);
        add(m.from, m.to, name);
    }
    return points;
}

} // namespace abut
