#include "rigid/manifold/region_points.h"

#include "rigid/manifold/collected_vertices.h"
#include "rigid/manifold/gap_queue.h"
#include "rigid/manifold/parallel_rays.h"
#include "rigid/manifold/point_extremes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace abut {

namespace {

/// A place on the curve is moved towards the centre by this share: there the depth is not 0.
constexpr double kInwards = 0.125;
/// A place where surfaces only touch, by this one: beside it a line is inside both, or outside.
constexpr double kLittleInwards = 0x1p-6;
/// A vertex stands for a direction if it reaches at least this far, relative to the curve.
constexpr double kVertexReach = 0.5;
/// A vertex that reaches farther than this, relative to the curve, is not between the surfaces.
constexpr double kFarthestVertex = 1.5;
/// The middle of a region takes the place of its deepest vertex only if it is deeper by this share:
/// of two that are about as deep, the vertex keeps its name.
constexpr double kClearlyDeeper = 1.02;
/// Most candidates that are measured to widen a region.
constexpr std::ptrdiff_t kMostTried = 16;
/// A point that adds less than this share of the region's extent is not needed.
constexpr double kLeastSpread = 1e-3;
/// Points where the surfaces meet are chosen before those with a gap, as long as they add at least
/// this share of the region's extent. Else the points of a region whose places lie far apart, such
/// as the rim of a cup, would have gaps while deep places remain without a point.
constexpr double kMeetingSpread = 0.125;

/// A region of at most this many triangles is searched for its deepest line.
constexpr std::size_t kFewTriangles = 24;

/// Memory that a thread uses again for its next region.
struct ChoiceMemory {
    ParallelRays rays_a, rays_b;
    GapQueue gaps; ///< pairs whose points have not been collected
};

class PointChooser {
public:
    PointChooser(const ManifoldSide& a, const ManifoldSide& b,
                 std::span<const TriangleMeeting> region, const TriangleMeetings& meetings,
                 const RegionFrame& frame, const ChoiceOptions& options, ChoiceMemory& memory)
        : a_(a), b_(b), region_(region), meetings_(meetings), frame_(frame), memory_(memory),
          rounding_(rounding_of_heights(a, b)), margin_(options.margin + rounding_),
          last_(options.last) {}

    ModelManifold choose() {
        collect();
        std::optional<ContactPoint> first = deepest();
        manifold_.normal = frame_.normal;
        if (!first) {
            manifold_.status = Status::bound_only;
            const TriangleMeeting& m = meeting_ > 0 ? region_[meeting_ / 2] : nearest_gap();
            const Vec3 on_b = m.kind == TriangleContact::none ? m.to : m.from;
            first = ContactPoint{
                m.from,   on_b,    dot(frame_.normal, m.from - on_b), point_name::triangles(m.pair),
                m.pair.a, m.pair.b};
        }
        add(*first);
        tried_[static_cast<std::size_t>(tried_count_++)] = first->feature;
        for (const Among among : {Among::meeting, Among::all})
            for (bool more = true; more && manifold_.count < 4;)
                more = add_farthest(among);
        const auto used = manifold_.points.begin();
        std::iter_swap(used, std::max_element(used, used + manifold_.count,
                                              [](const ContactPoint& p, const ContactPoint& q) {
                                                  return p.depth < q.depth;
                                              }));
        return manifold_;
    }

private:
    enum class Among : std::uint8_t { meeting, all };

    void collect() {
        for (const TriangleMeeting& m : region_) {
            meeting_ += m.is_gap() ? 0 : 1;
            for (std::uint32_t i = 0; i < m.point_count; ++i)
                collect_fixed(m.pair, meetings_.points[m.first_point + i]);
            if (m.kind == TriangleContact::cross)
                collect_line(m.from, m.pair, point_name::triangles(m.pair));
        }
        // What is only near changes nothing above: what meets is the same with a margin as without.
        const double width = extent_of(Among::meeting);
        lowest_ -= width, highest_ += width;
        for (const TriangleMeeting& m : region_)
            if (m.kind == TriangleContact::cross)
                collect_vertices(m);
        const double radius = farthest_reach();
        memory_.rays_a.begin(a_, frame_, radius, is_small());
        memory_.rays_b.begin(b_, frame_, radius, is_small());
        if (meeting_ < region_.size())
            collect_gaps();
    }

    [[nodiscard]] PointCandidate candidate(PointCandidate::Kind kind, const Vec3& at,
                                           const TrianglePair& pair, std::uint64_t feature) const {
        return {kind, at, {}, pair, feature, last_.has(feature)};
    }

    /// Collects a place that lies on both surfaces.
    void collect_line(const Vec3& at, const TrianglePair& pair, std::uint64_t feature) {
        const double height = dot(frame_.normal, at - frame_.centre);
        lowest_ = std::min(lowest_, height), highest_ = std::max(highest_, height);
        take_everywhere(curve_, frame_.right(at), frame_.up(at),
                        candidate(PointCandidate::Kind::line, at, pair, feature));
    }

    [[nodiscard]] bool is_small() const { return meeting_ <= kFewTriangles; }
    [[nodiscard]] const TriangleMeeting& nearest_gap() const {
        return *std::max_element(
            region_.begin(), region_.end(),
            [](const TriangleMeeting& m, const TriangleMeeting& n) { return m.weight < n.weight; });
    }
    /// Whether the points of a pair that is only near lie along the normal, to less than a right angle.
    [[nodiscard]] bool is_gap_along_normal(const TriangleMeeting& m) const {
        return m.is_gap() && is_along_normal(m.from - m.to);
    }
    /// In          way: of a gap, from b to a.
    [[nodiscard]] bool is_along_normal(const Vec3& way) const {
        constexpr double kCosOfGap = 0x1p-30;
        return dot(frame_.normal, way) <= -(kCosOfGap * length(way) + rounding_);
    }

    /// Collects the points of pairs that are only near. Of many such pairs only the nearest, those of
    /// the last step, and those that reach farther than the points collected so far are looked at.
    void collect_gaps() {
        memory_.gaps.clear();
        const TriangleMeeting* nearest = nullptr;
        for (const TriangleMeeting& m : region_) {
            if (!is_gap_along_normal(m))
                continue;
            if (nearest == nullptr || m.weight > nearest->weight)
                nearest = &m;
            if (was_any_chosen(m))
                collect_points(m);
            else
                memory_.gaps.add(m, meetings_.faces[m.face_a].corners, frame_);
        }
        if (nearest == nullptr)
            return;
        collect_points(*nearest);
        for (std::size_t k = 0; k < kAround; ++k) {
            memory_.gaps.sort(k, gaps_[k].reach);
            while (const TriangleMeeting* m = memory_.gaps.take(gaps_[k].reach))
                collect_points(*m);
        }
    }
    void collect_points(const TriangleMeeting& m) {
        for (const FixedPoint& p : points_along(m, meetings_, frame_.normal, margin_, rounding_))
            collect_fixed(m.pair, p);
    }
    /// Whether a point of a pair may have been chosen in the last step.
    [[nodiscard]] bool was_any_chosen(const TriangleMeeting& m) const {
        bool any = last_.has(point_name::triangles(m.pair));
        for (std::size_t k = 0; k < 3; ++k)
            any = any || last_.has(point_name::vertex_a(meetings_.faces[m.face_a].vertices[k])) ||
                  last_.has(point_name::vertex_b(meetings_.faces[m.face_b].vertices[k]));
        return any;
    }
    void collect_fixed(const TrianglePair& pair, const FixedPoint& p) {
        if (frame_.is_given) {
            if (p.a == p.b)
                collect_line(p.a, pair, p.feature);
            return;
        }
        // A gap straight across the normal is that of another face, as of the second wall of a corner.
        // Along the normal it would look like a touch, and one against the normal like a depth.
        constexpr double kSlightGap = 0x1p8; // roundings
        const Vec3 way = p.a - p.b;
        if (length(way) > kSlightGap * rounding_ && !is_along_normal(way))
            return;
        const double depth = dot(frame_.normal, way);
        PointCandidate c = candidate(PointCandidate::Kind::fixed, p.a, pair, p.feature);
        c.on_b = p.b;
        take_everywhere(depth >= -rounding_ ? fixed_ : gaps_, frame_.right(p.a), frame_.up(p.a), c);
        deepest_fixed_.take(depth, c);
    }

    /// The vertices of each triangle that lie behind the other one. A vertex counts once.
    void collect_vertices(const TriangleMeeting& m) {
        const MeetingFace &fa = meetings_.faces[m.face_a], &fb = meetings_.faces[m.face_b];
        const Vec3 &n = frame_.normal, out_a = outward(a_, m.normal_a, n),
                   out_b = outward(b_, m.normal_b, -n);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vb = fb.vertices[k], va = fa.vertices[k];
            if (const Vec3& p = fb.corners[k];
                !collected_b_.has(vb) && dot(out_a, p - m.from) < 0) {
                collected_b_.add(vb);
                collect_vertex(
                    vertices_b_, lowest_b_, -dot(n, p - frame_.centre),
                    candidate(PointCandidate::Kind::vertex_b, p, m.pair, point_name::vertex_b(vb)));
            }
            if (const Vec3& p = fa.corners[k];
                !collected_a_.has(va) && dot(out_b, p - m.from) < 0) {
                collected_a_.add(va);
                collect_vertex(
                    vertices_a_, highest_a_, dot(n, p - frame_.centre),
                    candidate(PointCandidate::Kind::vertex_a, p, m.pair, point_name::vertex_a(va)));
            }
        }
    }
    /// Open surfaces count as facing the other side.
    [[nodiscard]] static Vec3 outward(const ManifoldSide& side, const Vec3& normal,
                                      const Vec3& way) {
        return side.is_oriented() || dot(normal, way) >= 0 ? normal : -normal;
    }
    void collect_vertex(Extremes& extremes, Extreme& deepest, double depth,
                        const PointCandidate& c) {
        const double x = frame_.right(c.at), y = frame_.up(c.at);
        // Measured along two axes: enough to leave out the far corners of large triangles.
        constexpr std::size_t kQuarter = kAround / 4;
        if (x > kFarthestVertex * curve_[0].reach || y > kFarthestVertex * curve_[kQuarter].reach ||
            -x > kFarthestVertex * curve_[2 * kQuarter].reach ||
            -y > kFarthestVertex * curve_[3 * kQuarter].reach)
            return;
        take_everywhere(extremes, x, y, c);
        deepest.take(depth, c);
    }

    /// Measures a candidate. None if it does not lie between the surfaces.
    [[nodiscard]] std::optional<ContactPoint> measured(const PointCandidate& c) const {
        const Vec3& n = frame_.normal;
        ContactPoint p;
        p.feature = c.feature;
        p.triangle_a = c.pair.a, p.triangle_b = c.pair.b;
        if (c.kind == PointCandidate::Kind::none)
            return std::nullopt;
        if (c.kind == PointCandidate::Kind::fixed) {
            p.point_a = c.at, p.point_b = c.on_b;
        } else {
            p.point_a = p.point_b = c.at;
            if (c.kind != PointCandidate::Kind::vertex_a) {
                const ManifoldSide::LineHit top = memory_.rays_a.top_along(c.at, n);
                if (!top.found)
                    return std::nullopt;
                p.point_a = c.at + top.height * n, p.triangle_a = top.triangle;
            }
            if (c.kind != PointCandidate::Kind::vertex_b) {
                const ManifoldSide::LineHit bottom = memory_.rays_b.top_along(c.at, -n);
                if (!bottom.found)
                    return std::nullopt;
                p.point_b = c.at - bottom.height * n, p.triangle_b = bottom.triangle;
            }
        }
        // A vertex of b leaves a near the curve; otherwise it is in another part of a.
        if ((c.kind == PointCandidate::Kind::vertex_b && !is_near_curve(p.point_a)) ||
            (c.kind == PointCandidate::Kind::vertex_a && !is_near_curve(p.point_b)))
            return std::nullopt;
        p.depth = dot(n, p.point_a - p.point_b);
        if (std::abs(p.depth) <= rounding_)
            p.depth = 0;
        if (!(p.depth >= -margin_))
            return std::nullopt;
        return p;
    }

    /// Whether a point is as high as the curve, give or take the curve's width.
    [[nodiscard]] bool is_near_curve(const Vec3& p) const {
        const double height = dot(frame_.normal, p - frame_.centre);
        return lowest_ <= height && height <= highest_;
    }

    /// The deepest line that is found from the middle of the curve on. A curve of few triangles is
    /// searched in steps that halve: where edges cross, the deepest line is where they cross.
    [[nodiscard]] std::optional<ContactPoint> deepest_inside() const {
        constexpr int kRounds = 6;
        PointCandidate line{PointCandidate::Kind::line, frame_.centre, {}, {}, point_name::kMiddle};
        std::optional<ContactPoint> best = measured(line);
        if (!is_small())
            return best;
        double step = 0.25 * extent_of(Among::meeting);
        for (int round = 0; round < kRounds; ++round, step *= 0.5) {
            const Vec3 from = line.at;
            for (const Vec3& way :
                 {frame_.across, frame_.upwards, -frame_.across, -frame_.upwards}) {
                const PointCandidate other{line.kind, from + step * way, {}, {}, line.feature};
                const std::optional<ContactPoint> p = measured(other);
                if (p && (!best || p->depth > best->depth))
                    best = p, line.at = other.at;
            }
        }
        return best;
    }

    [[nodiscard]] std::optional<ContactPoint> deepest() const {
        std::optional<ContactPoint> best;
        const auto take = [&](const PointCandidate& c) {
            const std::optional<ContactPoint> p = measured(c);
            if (p && (!best || p->depth > best->depth))
                best = p;
        };
        take(lowest_b_.candidate);
        take(highest_a_.candidate);
        // The middle of faces that lie on each other is as deep as their corners, which carry more.
        for (std::size_t k = 0; frame_.is_given && k < kAround; ++k)
            take(standing_for(k, Among::meeting));
        if (frame_.crosses || (frame_.is_given && !best))
            if (const std::optional<ContactPoint> p = deepest_inside();
                p && (!best || p->depth > kClearlyDeeper * best->depth))
                best = p;
        take(deepest_fixed_.candidate);
        return best;
    }

    void add(const ContactPoint& p) { manifold_.points[manifold_.count++] = p; }

    /// The place of a point, seen along the normal.
    struct Place {
        double x = 0, y = 0;
    };
    [[nodiscard]] Place place(const Vec3& p) const { return {frame_.right(p), frame_.up(p)}; }

    /// By how much a place would widen the hull of the chosen points: a length.
    [[nodiscard]] double spread(const Place& p) const {
        std::array<Place, 3> q;
        for (std::uint32_t i = 0; i < manifold_.count; ++i)
            q[i] = place(manifold_.points[i].point_b);
        if (manifold_.count == 1)
            return std::hypot(p.x - q[0].x, p.y - q[0].y);
        const auto over = [&](const Place& r, const Place& s) { // the height over a line
            const double x = s.x - r.x, y = s.y - r.y, l = std::hypot(x, y);
            return l > 0 ? (x * (p.y - r.y) - y * (p.x - r.x)) / l : 0;
        };
        if (manifold_.count == 2)
            return std::abs(over(q[0], q[1]));
        const double turn =
            (q[1].x - q[0].x) * (q[2].y - q[0].y) - (q[1].y - q[0].y) * (q[2].x - q[0].x) < 0 ? -1
                                                                                              : 1;
        return -std::min(
            {turn * over(q[0], q[1]), turn * over(q[1], q[2]), turn * over(q[2], q[0])});
    }

    /// Whether a name belongs to a chosen point, or to a candidate without a measure.
    [[nodiscard]] bool is_tried(std::uint64_t feature) const {
        return std::find(tried_.begin(), tried_.begin() + tried_count_, feature) !=
               tried_.begin() + tried_count_;
    }

    /// The candidate for a direction: the vertex or fixed point that is farthest, unless it lies
    /// far inside the curve; else a place on the curve. Of the kind `none` if all were tried. A
    /// fixed point, whose depth may be 0, does not replace a vertex at the same place.
    [[nodiscard]] PointCandidate standing_for(std::size_t direction, Among among) const {
        const Extreme& curve = curve_[direction];
        const Extreme* best = nullptr;
        for (const Extremes* e : {&vertices_b_, &vertices_a_, &fixed_, &gaps_}) {
            const Extreme& extreme = (*e)[direction];
            if (among == Among::meeting && e == &gaps_)
                continue;
            if (extreme.candidate.kind != PointCandidate::Kind::none &&
                !is_tried(extreme.candidate.feature) &&
                extreme.reach >= kVertexReach * curve.reach &&
                (best == nullptr || extreme.reach > best->reach + 0x1p-20 * std::abs(best->reach)))
                best = &extreme;
        }
        if (best != nullptr)
            return best->candidate;
        if (is_tried(curve.candidate.feature))
            return {};
        PointCandidate c = curve.candidate;
        c.at = c.at + (frame_.is_given ? kLittleInwards : kInwards) * (frame_.centre - c.at);
        return c;
    }

    /// Adds the point that widens the chosen ones most. Returns false if none does.
    bool add_farthest(Among among) {
        const double least =
            (among == Among::meeting ? kMeetingSpread : kLeastSpread) * extent_of(Among::all);
        while (tried_count_ < kMostTried) {
            double best_spread = least;
            PointCandidate best;
            for (std::size_t k = 0; k < kAround; ++k) {
                const PointCandidate c = standing_for(k, among);
                if (c.kind == PointCandidate::Kind::none)
                    continue;
                if (const double s = favoured(spread(place(c.at)), c); s > best_spread)
                    best_spread = s, best = c;
            }
            if (best.kind == PointCandidate::Kind::none)
                return false;
            tried_[static_cast<std::size_t>(tried_count_++)] = best.feature;
            if (const std::optional<ContactPoint> p = measured(best)) {
                add(*p);
                return true;
            }
        }
        return false;
    }

    [[nodiscard]] double extent_of(Among among) const {
        double extent = 0;
        for (std::size_t k = 0; k < kAround / 2; ++k)
            for (const Extremes* e : {&fixed_, &gaps_, &vertices_a_, &vertices_b_, &curve_})
                if ((among == Among::all || e != &gaps_) &&
                    (*e)[k].candidate.kind != PointCandidate::Kind::none)
                    extent = std::max(extent, (*e)[k].reach + (*e)[k + kAround / 2].reach);
        return extent;
    }

    /// The largest distance from the centre, seen along the normal, of what has been collected.
    [[nodiscard]] double farthest_reach() const {
        // The extremes in eight directions bound it to 1 / cos(pi / 8).
        constexpr double kBetweenDirections = 1.0824;
        double reach = 0;
        for (const Extremes* e : {&vertices_a_, &vertices_b_, &curve_})
            for (const Extreme& extreme : *e)
                reach = std::max(reach, extreme.reach);
        return kBetweenDirections * reach;
    }

    const ManifoldSide& a_;
    const ManifoldSide& b_;
    std::span<const TriangleMeeting> region_;
    const TriangleMeetings& meetings_;
    const RegionFrame& frame_;
    ChoiceMemory& memory_;
    double rounding_; ///< bounds that of heights
    double margin_;
    LastNames last_;
    Extremes vertices_a_, vertices_b_, fixed_, gaps_, curve_; ///< fixed_ have no gap
    Extreme lowest_b_, highest_a_, deepest_fixed_;
    std::size_t meeting_ = 0;         ///< number of pairs that meet; they come first
    double lowest_ = 0, highest_ = 0; ///< heights over the centre; see is_near_curve
    std::array<std::uint64_t, kMostTried> tried_{};
    std::ptrdiff_t tried_count_ = 0;
    ModelManifold manifold_;
    CollectedVertices collected_a_, collected_b_;
};

} // namespace

ModelManifold choose_points(const ManifoldSide& a, const ManifoldSide& b,
                            std::span<const TriangleMeeting> region,
                            const TriangleMeetings& meetings, const RegionFrame& frame,
                            const ChoiceOptions& options) {
    static thread_local ChoiceMemory memory;
    return PointChooser(a, b, region, meetings, frame, options, memory).choose();
}

} // namespace abut
