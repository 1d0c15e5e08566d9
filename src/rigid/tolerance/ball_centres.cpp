#include "rigid/tolerance/ball_centres.h"

#include "math/point_order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

/// Half of the angle that one flat piece of a cylinder or sphere may span: its ends are farther from
/// the axis than its middle by the factor 1 / cos(angle), which is below 1 + kCentreError.
constexpr double kHalfAngle = 0.0625;

/// The side of a face from `from` to `to`, which are in order for the face if `forward`.
struct Side {
    Vec3 from, to; ///< is_before(from, to)
    Vec3 apex, inward;
    bool forward;
};

Vec3 inward_normal(const Triangle& t) {
    return -normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
}

class CentrePolygons {
public:
    CentrePolygons(double radius, const std::function<bool(const FacePolygon&)>& take,
                   const std::function<bool(const Vec3&, double)>& is_settled)
        : radius_(radius), take_(take), is_settled_(is_settled) {}

    void run(const std::vector<Triangle>& faces) {
        std::vector<Side> sides;
        for (const Triangle& t : faces) {
            const Vec3 inward = inward_normal(t);
            if (inward == Vec3{})
                continue;
            const Vec3 by = radius_ * inward;
            give({t[0] + by, t[1] + by, t[2] + by});
            for (std::size_t i = 0; i < 3; ++i)
                add_side(t[i], t[(i + 1) % 3], t[(i + 2) % 3], inward, sides);
        }
        std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
            return is_before(s.from, t.from) || (s.from == t.from && is_before(s.to, t.to));
        });
        for (std::size_t begin = 0, end = 0; begin < sides.size() && going_; begin = end) {
            while (end < sides.size() && sides[end].from == sides[begin].from &&
                   sides[end].to == sides[begin].to)
                ++end;
            for (std::size_t i = begin; i < end; ++i)
                for (std::size_t j = i + 1; j < end; ++j)
                    if (sides[i].forward != sides[j].forward)
                        add_edge(sides[i], sides[j]);
        }
        add_vertices(sides);
    }

private:
    void give(const FacePolygon& polygon) { going_ = going_ && take_(polygon); }

    static void add_side(const Vec3& p, const Vec3& q, const Vec3& apex, const Vec3& inward,
                         std::vector<Side>& sides) {
        if (p == q)
            return;
        const bool forward = is_before(p, q);
        sides.push_back({forward ? p : q, forward ? q : p, apex, inward, forward});
    }

    /// Gives the strips around an edge of two faces, if the solid's angle there exceeds 180 degrees.
    void add_edge(const Side& s, const Side& t) {
        // A face that was added both ways has no angle with itself.
        if (s.apex == t.apex)
            return;
        // Then the apex of each face lies outside of the other one.
        if (!(dot(t.apex - s.from, s.inward) < 0 || dot(s.apex - s.from, t.inward) < 0))
            return;
        reflex_ends_.push_back({s.from, s.to});
        reflex_ends_.push_back({s.to, s.from});
        const double angle = std::atan2(length(cross(s.inward, t.inward)), dot(s.inward, t.inward));
        // With R = (1 + e) radius and an angle of at most e = kCentreError, a ball around q + R u holds
        // the ball of radius (1 - e) around a centre on the polygon of one of the faces.
        if (angle <= kCentreError)
            return;
        const auto count = static_cast<int>(std::ceil(angle / (2 * kHalfAngle)));
        const Vec3 across = normalized_or_zero(t.inward - dot(t.inward, s.inward) * s.inward);
        for (int i = 0; i < count && going_; ++i) {
            const double step = angle / count, out = radius_ / std::cos(0.5 * step);
            const auto at = [&](int k) {
                return out * (std::cos(k * step) * s.inward + std::sin(k * step) * across);
            };
            give({s.from + at(i), s.to + at(i), s.to + at(i + 1), s.from + at(i + 1)});
        }
    }

    /// An end of an edge at which the solid's angle exceeds 180 degrees.
    struct ReflexEnd {
        Vec3 at, other;
    };

    struct SideEnd {
        Vec3 at;
        std::size_t side;
    };

    void add_vertices(const std::vector<Side>& sides) {
        if (reflex_ends_.size() < 3)
            return;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            ends_.push_back({sides[i].from, i});
            ends_.push_back({sides[i].to, i});
        }
        std::sort(ends_.begin(), ends_.end(), [](const SideEnd& p, const SideEnd& q) {
            return is_before(p.at, q.at) || (p.at == q.at && p.side < q.side);
        });
        std::sort(reflex_ends_.begin(), reflex_ends_.end(), [](const auto& p, const auto& q) {
            return is_before(p.at, q.at) || (p.at == q.at && is_before(p.other, q.other));
        });
        for (std::size_t begin = 0, end = 0; begin < reflex_ends_.size() && going_; begin = end) {
            while (end < reflex_ends_.size() && reflex_ends_[end].at == reflex_ends_[begin].at)
                ++end;
            if (end - begin >= 3)
                add_vertex(reflex_ends_[begin].at, sides);
        }
    }

    /// Gives the pieces of a sphere around a vertex whose directions u lean away from all edges, and
    /// into the solid.
    void add_vertex(const Vec3& vertex, const std::vector<Side>& sides) {
        edges_.clear();
        Vec3 outward;
        const auto add = [&](const Side& s, const Vec3& other) {
            const Vec3 edge = normalized_or_zero(other - vertex),
                       to_apex = normalized_or_zero(s.apex - vertex);
            edges_.push_back(edge);
            // Each face comes twice, once for either of its edges at the vertex.
            const bool turns_left = (s.from == vertex) == s.forward;
            outward = outward + (turns_left ? 1.0 : -1.0) * cross(edge, to_apex);
        };
        const auto first = std::lower_bound(
            ends_.begin(), ends_.end(), vertex,
            [](const SideEnd& end, const Vec3& v) { return is_before(end.at, v); });
        for (auto end = first; end != ends_.end() && end->at == vertex; ++end) {
            const Side& side = sides[end->side];
            add(side, side.from == vertex ? side.to : side.from);
        }
        for (int octant = 0; octant < 8; ++octant) {
            const double x = octant & 1 ? 1 : -1, y = octant & 2 ? 1 : -1, z = octant & 4 ? 1 : -1;
            add_directions(vertex, {Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}}, outward);
        }
    }

    /// In          directions: a triangle of unit vectors.
    void add_directions(const Vec3& vertex, const Triangle& directions, const Vec3& outward) {
        const auto all_lean = [&](const Vec3& to) {
            return std::ranges::all_of(directions, [&](const Vec3& u) { return dot(u, to) > 0; });
        };
        if (!going_ || all_lean(outward) || std::ranges::any_of(edges_, all_lean))
            return;
        const Vec3 middle = normalized_or_zero(directions[0] + directions[1] + directions[2]);
        double cosine = 1;
        for (const Vec3& u : directions)
            cosine = std::min(cosine, dot(middle, u));
        if (cosine >= std::cos(kHalfAngle)) {
            const double out = radius_ / cosine;
            give({vertex + out * directions[0], vertex + out * directions[1],
                  vertex + out * directions[2]});
            return;
        }
        if (is_settled_(vertex + radius_ * cosine * middle, reach_of_cap(cosine)))
            return;
        std::array<Vec3, 3> mid;
        for (std::size_t i = 0; i < 3; ++i)
            mid[i] = normalized_or_zero(directions[i] + directions[(i + 1) % 3]);
        add_directions(vertex, {directions[0], mid[0], mid[2]}, outward);
        add_directions(vertex, {directions[1], mid[1], mid[0]}, outward);
        add_directions(vertex, {directions[2], mid[2], mid[1]}, outward);
        add_directions(vertex, mid, outward);
    }

    /// The radius of the ball around the middle of a cap's base that holds the pieces of the cap: all
    /// centres in directions whose angle to its axis has at least this cosine.
    [[nodiscard]] double reach_of_cap(double cosine) const {
        const double out = 1 + kCentreError; // the farthest corner of a piece, in radii
        const double base = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        return radius_ * std::hypot(out * base, (out - 1) * cosine);
    }

    const double radius_;
    const std::function<bool(const FacePolygon&)>& take_;
    const std::function<bool(const Vec3&, double)>& is_settled_;
    bool going_ = true;
    std::vector<ReflexEnd> reflex_ends_;
    std::vector<SideEnd> ends_;
    std::vector<Vec3> edges_; ///< directions of the edges at the vertex in question
};

} // namespace

void for_each_centre_polygon(const std::vector<Triangle>& faces, double radius,
                             const std::function<bool(const FacePolygon&)>& take,
                             const std::function<bool(const Vec3&, double)>& is_settled) {
    CentrePolygons(radius, take, is_settled).run(faces);
}

} // namespace abut
