#include "world/contacts/patch_points.h"

#include "geometry/point_triangle_distance.h"
#include "rigid/manifold/triangle_meeting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace abut {

namespace {

/// A face that leans from a direction by less than this angle is taken to stand along it, so that bodies at
/// rest, which tilt by less, keep their points. The points at such a face leave the solid by at most this
/// share of their depth.
constexpr double kUpright = 0x1p-12;

/// Names of places that are no vertices: two bits for the kind as in point_name, and a hash.
std::uint64_t place_name(std::uint64_t first, std::uint64_t second) {
    std::uint64_t h = first * 0x9E3779B97F4A7C15U ^ (second + 1) * 0xC2B2AE3D27D4EB4FU;
    h ^= h >> 29U, h *= 0xBF58476D1CE4E5B9U, h ^= h >> 32U;
    return std::uint64_t{3} << 62U | h >> 2U;
}

/// A solid seen along a direction: its lower side.
class LowerSide {
public:
    struct Slope {
        std::uint32_t plane;
        double up; ///< the part of its normal along the direction
    };

    LowerSide(const ConvexFaces& solid, const Vec3& up, double rounding)
        : solid_(solid), up_(up), rounding_(rounding) {
        for (std::uint32_t i = 0; i < solid.planes.size(); ++i) {
            const double along = dot(solid.planes[i].normal, up);
            (along < -kUpright  ? lower_
             : along > kUpright ? upper_
                                : upright_)
                .push_back({i, along});
        }
    }
    /// The height of a plane over a point, along the direction; linear in the point.
    [[nodiscard]] double height(const Slope& slope, const Vec3& p) const {
        const ConvexFaces::Plane& plane = solid_.planes[slope.plane];
        return (plane.offset - dot(plane.normal, p)) / slope.up;
    }
    /// How far a point lies outside a plane.
    [[nodiscard]] double outside(const Slope& slope, const Vec3& p) const {
        const ConvexFaces::Plane& plane = solid_.planes[slope.plane];
        return dot(plane.normal, p) - plane.offset;
    }
    /// The height at which a line along the direction enters the solid. None if it misses it.
    [[nodiscard]] std::optional<double> entry(const Vec3& p) const {
        for (const Slope& s : upright_)
            if (outside(s, p) > 4 * rounding_)
                return std::nullopt;
        double enters = -HUGE_VAL, leaves = HUGE_VAL;
        for (const Slope& s : lower_)
            enters = std::max(enters, height(s, p));
        for (const Slope& s : upper_)
            leaves = std::min(leaves, height(s, p));
        return enters <= leaves + 4 * rounding_ ? std::optional(enters) : std::nullopt;
    }
    /// Returns whether a vertex lies on the lower side.
    [[nodiscard]] bool holds(const Vec3& vertex) const {
        return std::any_of(lower_.begin(), lower_.end(),
                           [&](const Slope& s) { return outside(s, vertex) >= -4 * rounding_; });
    }
    [[nodiscard]] const auto& lower() const { return lower_; }
    [[nodiscard]] const auto& upper() const { return upper_; }
    [[nodiscard]] const auto& upright() const { return upright_; }

private:
    const ConvexFaces& solid_;
    Vec3 up_;
    double rounding_;
    boost::container::small_vector<Slope, 8> lower_, upper_, upright_;
};

/// A triangle of the surface seen along a direction.
struct SeenTriangle {
    struct Corner {
        double x, y;
    };
    std::array<Corner, 3> corners; ///< counter-clockwise
    Corner low, high;
    const PatchTriangle* triangle;
};

/// Finds the places and gives them names.
class PatchPointFinder {
public:
    PatchPointFinder(const ConvexFaces& solid, std::span<const PatchTriangle* const> part,
                     const Vec3& up, bool solid_is_a, const PatchLimits& limits,
                     std::vector<PatchPoint>& points)
        : solid_(solid), part_(part), up_(up), across_(perpendicular(up)),
          upwards_(cross(up, across_)), solid_is_a_(solid_is_a), limits_(limits),
          lower_(solid, up, limits.rounding), points_(points) {}

    void find() {
        points_.clear();
        see();
        add_vertices_of_solid();
        for (const PatchTriangle* t : part_)
            for (std::uint8_t k = 0; k < 3; ++k)
                if (!t->is_flat[k])
                    add_edge(*t, k);
        if (points_.empty())
            add_curve();
        drop_copies();
    }

private:
    void see() {
        for (const PatchTriangle* t : part_) {
            // The height over a triangle that stands on edge would be known too badly.
            constexpr double kFacesUp = 0x1p-20;
            if (!(dot(t->normal, up_) > kFacesUp))
                continue;
            SeenTriangle s{};
            s.triangle = t;
            for (std::size_t k = 0; k < 3; ++k)
                s.corners[k] = {dot(across_, t->corners[k]), dot(upwards_, t->corners[k])};
            const auto& c = s.corners;
            if ((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y) < 0)
                std::swap(s.corners[1], s.corners[2]);
            s.low = {std::min({c[0].x, c[1].x, c[2].x}), std::min({c[0].y, c[1].y, c[2].y})};
            s.high = {std::max({c[0].x, c[1].x, c[2].x}), std::max({c[0].y, c[1].y, c[2].y})};
            seen_.push_back(s);
        }
    }

    /// A triangle over a point, and how high it lies there.
    struct Over {
        double height;
        std::uint32_t triangle;
    };
    /// The first triangle ahead of a point, or the first one behind.
    [[nodiscard]] std::optional<Over> surface_over(const Vec3& p) const {
        const double x = dot(across_, p), y = dot(upwards_, p), slack = 16 * limits_.rounding;
        std::optional<Over> ahead, behind;
        for (const SeenTriangle& s : seen_) {
            if (x < s.low.x - slack || y < s.low.y - slack || x > s.high.x + slack ||
                y > s.high.y + slack || !holds(s, x, y, slack))
                continue;
            const Vec3& n = s.triangle->normal;
            const double height = dot(n, s.triangle->corners[0] - p) / dot(n, up_);
            std::optional<Over>& nearest = height >= -slack ? ahead : behind;
            if (!nearest || std::abs(height) < std::abs(nearest->height))
                nearest = {height, s.triangle->triangle};
        }
        return ahead ? ahead : behind;
    }
    static bool holds(const SeenTriangle& s, double x, double y, double slack) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto &p = s.corners[k], &q = s.corners[(k + 1) % 3];
            const double ux = q.x - p.x, uy = q.y - p.y;
            if (ux * (y - p.y) - uy * (x - p.x) < -slack * (std::abs(ux) + std::abs(uy)))
                return false;
        }
        return true;
    }

    void add_vertices_of_solid() {
        for (std::uint32_t v = 0; v < solid_.vertices.size(); ++v) {
            const Vec3& p = solid_.vertices[v];
            if (!lower_.holds(p))
                continue;
            corners_.push_back({dot(across_, p), dot(upwards_, p), v});
            if (const auto over = surface_over(p))
                add(p + over->height * up_, p, over->height, name_of_vertex(v), 0, over->triangle);
        }
    }

    [[nodiscard]] std::uint64_t name_of_vertex(std::uint32_t v) const {
        const std::uint32_t number = solid_.numbers[v];
        return solid_is_a_ ? point_name::vertex_a(number) : point_name::vertex_b(number);
    }

    /// A part of an edge: shares of the way from its start to its end.
    struct Span {
        double from = 0, to = 1;
        bool from_is_cut = false, to_is_cut = false;        ///< by a limit of depths
        std::uint32_t from_plane = kNone, to_plane = kNone; ///< that end it
        [[nodiscard]] bool is_empty() const { return !(from <= to); }
        /// Keeps where a linear function is not negative, from its values at both ends of the edge.
        void keep(double at_start, double at_end, std::uint32_t plane, bool is_limit) {
            if (at_start >= 0 && at_end >= 0)
                return;
            if (at_start < 0 && at_end < 0) {
                from = 1, to = 0;
                return;
            }
            const double zero = at_start / (at_start - at_end);
            if (at_start < 0 && zero >= from)
                from = zero, from_plane = plane, from_is_cut = is_limit;
            if (at_end < 0 && zero <= to)
                to = zero, to_plane = plane, to_is_cut = is_limit;
        }
    };
    static constexpr std::uint32_t kNone = 0xffffffff;

    /// The places on an edge of the surface that may be corners of the region.
    void add_edge(const PatchTriangle& t, std::uint8_t k) {
        const Vec3 &p = t.corners[k], &q = t.corners[(k + 1U) % 3];
        Span span;
        for (const auto& s : lower_.upright())
            span.keep(limits_.rounding - lower_.outside(s, p),
                      limits_.rounding - lower_.outside(s, q), s.plane, false);
        for (const auto& low : lower_.lower())
            for (const auto& high : lower_.upper()) {
                if (span.is_empty())
                    return;
                span.keep(limits_.rounding + lower_.height(high, p) - lower_.height(low, p),
                          limits_.rounding + lower_.height(high, q) - lower_.height(low, q),
                          std::abs(low.up) < std::abs(high.up) ? low.plane : high.plane, false);
            }
        for (const auto& low : lower_.lower())
            span.keep(limits_.margin + limits_.rounding - lower_.height(low, p),
                      limits_.margin + limits_.rounding - lower_.height(low, q), low.plane, true);
        if (span.is_empty())
            return;
        const std::uint64_t edge = edge_key(t.vertices[k], t.vertices[(k + 1U) % 3]);
        const auto vertex = [&](std::uint32_t v) {
            return solid_is_a_ ? point_name::vertex_b(v) : point_name::vertex_a(v);
        };
        if (span.from_plane == kNone)
            add_place(p, vertex(t.vertices[k]), 1, t.triangle);
        else if (!span.from_is_cut)
            add_place(p + span.from * (q - p), place_name(edge, span.from_plane), 2, t.triangle);
        if (span.to_plane == kNone)
            add_place(q, vertex(t.vertices[(k + 1U) % 3]), 1, t.triangle);
        else if (!span.to_is_cut)
            add_place(p + span.to * (q - p), place_name(edge, span.to_plane), 2, t.triangle);
        for (const auto& [share, plane] : turns_over(p, q, span))
            add_place(p + share * (q - p), place_name(edge, plane), 2, t.triangle);
    }

    /// Where the planes of the lower side take turns over an edge.
    struct Turn {
        double share;
        std::uint32_t plane; ///< the steeper of both
    };
    using Turns = boost::container::small_vector<Turn, 8>;
    [[nodiscard]] Turns turns_over(const Vec3& p, const Vec3& q, const Span& span) const {
        struct Line {
            double at_start, slope;
            std::uint32_t plane;
            [[nodiscard]] double at(double s) const { return at_start + s * slope; }
        };
        boost::container::small_vector<Line, 8> lines;
        for (const auto& low : lower_.lower()) {
            const double at_p = lower_.height(low, p);
            lines.push_back({at_p, lower_.height(low, q) - at_p, low.plane});
        }
        Turns turns;
        if (lines.size() < 2)
            return turns;
        // The entry is the largest of linear functions: their slopes grow along the way.
        const Line* line =
            &*std::max_element(lines.begin(), lines.end(), [&](const Line& l, const Line& m) {
                return std::pair(l.at(span.from), l.slope) < std::pair(m.at(span.from), m.slope);
            });
        for (double s = span.from; turns.size() < lines.size();) {
            double next = span.to;
            const Line* over = nullptr;
            for (const Line& other : lines) {
                if (!(other.slope > line->slope))
                    continue;
                const double meets =
                    (line->at_start - other.at_start) / (other.slope - line->slope);
                if (meets >= s && meets < next)
                    next = meets, over = &other;
            }
            if (over == nullptr)
                break;
            turns.push_back(
                {next, std::abs(line->slope) > std::abs(over->slope) ? line->plane : over->plane});
            s = next, line = over;
        }
        return turns;
    }

    /// The corners of the curve where the surface enters the solid.
    void add_curve() {
        for (const PatchTriangle* t : part_) {
            if (t->deep_area == Vec3{})
                continue;
            ClippedTriangle part(t->corners);
            part.keep_inside(solid_, 0);
            for (std::size_t k = 0; k < part.corners.size(); ++k) {
                const std::uint64_t before =
                                        part.corners[k == 0 ? part.corners.size() - 1 : k - 1].side,
                                    after = part.corners[k].side;
                add_place(part.corners[k].at, place_name(t->vertices[0], before << 32U | after), 3,
                          t->triangle);
            }
        }
    }

    /// Adds a place of the surface, if the solid lies over it.
    void add_place(const Vec3& p, std::uint64_t name, std::uint8_t rank, std::uint32_t triangle) {
        if (const auto entry = lower_.entry(p))
            add(p, p + *entry * up_, -*entry, name, rank, triangle);
    }
    void add(const Vec3& on_surface, const Vec3& on_solid, double depth, std::uint64_t name,
             std::uint8_t rank, std::uint32_t triangle) {
        if (std::abs(depth) <= limits_.rounding)
            depth = 0;
        if (!(depth >= -limits_.margin - limits_.rounding))
            return;
        points_.push_back({on_surface, on_solid, depth, name, dot(across_, on_solid),
                           dot(upwards_, on_solid), rank, triangle});
    }

    /// Gives places that lie beside a corner of the solid's lower side its name, so that small motions do
    /// not decide whether it is over the surface. Then keeps one point of each name, and of each place:
    /// the one with the lowest rank, or the deepest.
    void drop_copies() {
        if (points_.empty())
            return;
        double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_y = HUGE_VAL, high_y = -HUGE_VAL;
        for (const PatchPoint& p : points_) {
            low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
            low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
        }
        constexpr double kBeside = 0x1p-6;    // of the region's extent
        constexpr double kOnePlace = 0x1p-20; // of the solid's size
        const double near = kBeside * std::max(high_x - low_x, high_y - low_y),
                     one_place = kOnePlace * solid_.reach;
        for (PatchPoint& p : points_)
            if (p.rank > 0)
                if (const auto v = corner_beside(p, near))
                    p.feature = name_of_vertex(*v);
        std::sort(points_.begin(), points_.end(), [](const auto& p, const auto& q) {
            return std::tuple(p.rank, -p.depth, p.feature, p.x, p.y) <
                   std::tuple(q.rank, -q.depth, q.feature, q.x, q.y);
        });
        std::size_t kept = 0;
        for (const PatchPoint& p : points_) {
            const auto same = [&](const PatchPoint& q) {
                const double away = std::max(std::abs(p.x - q.x), std::abs(p.y - q.y));
                return q.feature == p.feature || away <= one_place ||
                       (p.rank > 0 && away <= near && p.depth <= q.depth + limits_.rounding);
            };
            const auto end = points_.begin() + static_cast<std::ptrdiff_t>(kept);
            if (std::none_of(points_.begin(), end, same))
                points_[kept++] = p;
        }
        points_.resize(kept);
    }

    /// The vertex of the lower side that is nearest to a point, seen along the direction, and within a
    /// distance; none if there is none.
    [[nodiscard]] std::optional<std::uint32_t> corner_beside(const PatchPoint& p,
                                                             double within) const {
        std::optional<std::uint32_t> best;
        double nearest = within * within;
        for (const LowerCorner& corner : corners_) {
            const double x = corner.x - p.x, y = corner.y - p.y, sq = x * x + y * y;
            if (sq <= nearest)
                nearest = sq, best = corner.vertex;
        }
        return best;
    }

    /// A vertex of the solid's lower side, seen along the direction.
    struct LowerCorner {
        double x, y;
        std::uint32_t vertex;
    };

    const ConvexFaces& solid_;
    std::span<const PatchTriangle* const> part_;
    Vec3 up_, across_, upwards_;
    bool solid_is_a_;
    PatchLimits limits_;
    LowerSide lower_;
    std::vector<PatchPoint>& points_;
    boost::container::small_vector<SeenTriangle, 16> seen_;
    boost::container::small_vector<LowerCorner, 8> corners_;
};

} // namespace

void find_patch_points(const ConvexFaces& solid, std::span<const PatchTriangle* const> part,
                       const Vec3& up, bool solid_is_a, const PatchLimits& limits,
                       std::vector<PatchPoint>& points) {
    PatchPointFinder(solid, part, up, solid_is_a, limits, points).find();
}

void add_place_of_features(const Vec3& on_surface, const Vec3& on_solid, const Vec3& up,
                           std::span<const PatchTriangle* const> part, const ConvexFaces& solid,
                           bool solid_is_a, std::vector<PatchPoint>& points) {
    // Shares of the solid's size: a vertex that is as near names the place; an edge holds it, to rounding.
    constexpr double kNameReach = 0x1p-10, kOnLine = 0x1p-30;
    const double near = kNameReach * solid.reach;
    std::optional<std::uint64_t> name;
    for (std::uint32_t v = 0; v < solid.vertices.size() && !name; ++v)
        if (length(solid.vertices[v] - on_solid) <= near)
            name = solid_is_a ? point_name::vertex_a(solid.numbers[v])
                              : point_name::vertex_b(solid.numbers[v]);
    std::uint64_t edge = 0;
    std::uint32_t triangle = 0;
    double nearest_sq = HUGE_VAL;
    for (const PatchTriangle* t : part) {
        if (const double sq = nearest_on_triangle(on_surface, t->corners).distance_sq;
            sq < nearest_sq)
            nearest_sq = sq, triangle = t->triangle;
        for (std::size_t k = 0; k < 3 && !name; ++k) {
            const Vec3 &p = t->corners[k], &q = t->corners[(k + 1) % 3];
            if (length(p - on_surface) <= near)
                name = solid_is_a ? point_name::vertex_b(t->vertices[k])
                                  : point_name::vertex_a(t->vertices[k]);
            const Vec3 way = normalized_or_zero(q - p), from = on_surface - p;
            if (length(from - dot(from, way) * way) <= kOnLine * solid.reach)
                edge = edge_key(t->vertices[k], t->vertices[(k + 1) % 3]);
        }
    }
    const Vec3 across = perpendicular(up);
    const PatchPoint added{on_surface,
                           on_solid,
                           dot(up, on_surface - on_solid),
                           name.value_or(place_name(edge, 0xffffffff)),
                           dot(across, on_solid),
                           dot(cross(up, across), on_solid),
                           2,
                           triangle};
    // It replaces a point of the same name, and those beside it.
    std::erase_if(points, [&](const PatchPoint& p) {
        return p.feature == added.feature || std::hypot(p.x - added.x, p.y - added.y) <= near;
    });
    points.push_back(added);
}

} // namespace abut
