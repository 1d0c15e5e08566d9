#include "world/curved/curved_seeds.h"

#include "convex/support/support_gap.h"
#include "geometry/point_triangle_distance.h"
#include "world/curved/edge_under_side.h"
#include "world/solids/contact_candidate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace abut {

namespace {

/// Parts of an edge, or of a distance, that are nothing but rounding.
constexpr double kNothing = 0x1p-40;

/// A number of an edge of the surface for names.
std::uint32_t number_of(const NearEdge& edge) {
    const auto [low, high] = std::minmax(edge.vertices[0], edge.vertices[1]);
    std::uint64_t key = std::uint64_t{low} << 32U | high;
    key *= 0x9E3779B97F4A7C15U;
    return static_cast<std::uint32_t>(key >> 33U);
}

/// Finds the seeds of one pair.
class SeedSearch {
public:
    SeedSearch(const SupportShape& solid, const CurvedPatch& patch, const PatchBounds& bounds,
               CurvedSeeds& found)
        : solid_(solid), patch_(patch), bounds_(bounds), found_(found) {}

    void find() {
        find_faces();
        for (const NearEdge& edge : patch_.edges())
            add_edge(edge);
        add_vertices();
    }

private:
    // --- Faces -----------------------------------------------------------------------------------

    void find_faces() {
        const auto triangles = patch_.triangles();
        by_plane_.clear();
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            if (triangles[i].is_front)
                by_plane_.push_back(i);
        std::sort(by_plane_.begin(), by_plane_.end(), [&](std::uint32_t i, std::uint32_t k) {
            return triangles[i].plane != triangles[k].plane
                       ? triangles[i].plane < triangles[k].plane
                       : i < k;
        });
        for (std::size_t i = 0, end = 0; i < by_plane_.size(); i = end) {
            for (end = i; end < by_plane_.size() &&
                          triangles[by_plane_[end]].plane == triangles[by_plane_[i]].plane;)
                ++end;
            add_face(std::span(by_plane_).subspan(i, end - i));
        }
    }

    void add_face(std::span<const std::uint32_t> plane) {
        const NearTriangle& first = patch_.triangles()[plane.front()];
        const Vec3& up = first.normal;
        const CurvedSide side = side_towards(solid_, -up);
        const CurvedSide::Corner& lowest = side.farthest(-up);
        const double deepest = dot(up, first.corners[0] - lowest.at);
        if (deepest < -bounds_.margin - bounds_.rounding)
            return;
        const bool is_flat = side.lies_across(up);
        const ContactFrame frame({}, up);
        begin_seed();
        bool is_over = false; // the lowest corner is over the face
        for (const CurvedSide::Corner& corner : side.corners)
            for (const std::uint32_t i : plane)
                if (add_corner(corner, patch_.triangles()[i], up)) {
                    is_over = is_over || corner.vertex == lowest.vertex;
                    break;
                }
        if (!is_over && !is_flat)
            is_over = add_beside_hollow(lowest, plane, up);
        const bool is_deep = deepest > bounds_.rounding;
        if ((!is_over && !is_flat) || (is_deep && !meets(plane))) {
            found_.places.resize(begin_);
            return;
        }
        for (const NearEdge& edge : patch_.edges())
            if (edge.is_near && !edge.is_flat &&
                (patch_.triangles()[edge.triangles[0]].plane == first.plane ||
                 patch_.triangles()[edge.triangles[1]].plane == first.plane))
                add_border(edge, first, side, frame);
        end_seed(up, first.body);
    }

    /// Adds the place of a face that is nearest to the foot of the lowest corner, if it lies on an edge beside a
    /// hollow: the face behind that edge keeps the solid from leaving over it. Returns whether it does.
    bool add_beside_hollow(const CurvedSide::Corner& lowest, std::span<const std::uint32_t> plane,
                           const Vec3& up) {
        const NearTriangle* face = nullptr;
        NearestOnTriangle nearest;
        nearest.distance_sq = HUGE_VAL;
        double depth = 0;
        for (const std::uint32_t i : plane) {
            const NearTriangle& t = patch_.triangles()[i];
            const double here = dot(up, t.corners[0] - lowest.at);
            const NearestOnTriangle on = nearest_on_triangle(lowest.at + here * up, t.corners);
            if (on.distance_sq < nearest.distance_sq)
                nearest = on, face = &t, depth = here;
        }
        const double reach = std::abs(depth) + bounds_.margin + bounds_.rounding;
        const auto is_there = [&](const NearEdge& edge) {
            return !edge.is_border && !edge.is_convex &&
                   (patch_.triangles()[edge.triangles[0]].plane == face->plane ||
                    patch_.triangles()[edge.triangles[1]].plane == face->plane) &&
                   nearest_on_triangle(nearest.point, {edge.from, edge.to, edge.to}).distance_sq <=
                       bounds_.rounding * bounds_.rounding;
        };
        if (nearest.distance_sq > reach * reach ||
            std::none_of(patch_.edges().begin(), patch_.edges().end(), is_there))
            return false;
        const auto inside = part_inside(solid_, nearest.point, up);
        if (!inside)
            return false;
        found_.places.push_back({nearest.point, nearest.point + inside->begin * up, -inside->begin,
                                 feature_name(FeatureKind::vertex_of_a, lowest.vertex, 0),
                                 face->triangle});
        return true;
    }

    /// Whether the solid meets one of some triangles. What lies over its lowest corner may lie above the solid.
    [[nodiscard]] bool meets(std::span<const std::uint32_t> plane) {
        return std::any_of(plane.begin(), plane.end(), [&](std::uint32_t i) {
            return meets(support_of(patch_.triangles()[i].corners));
        });
    }
    [[nodiscard]] bool meets(const SupportShape& part) {
        return support_gap(part, solid_, bounds_.rounding, SupportDepths::no, direction_)
                   .distance <= bounds_.rounding;
    }

    /// Adds a corner of the solid if its foot along `up` lies in a triangle.
    bool add_corner(const CurvedSide::Corner& corner, const NearTriangle& t, const Vec3& up) {
        const auto foot = foot_on(t, corner.at, up, kNothing * solid_.reach);
        if (!foot)
            return false;
        found_.places.push_back({*foot, corner.at, dot(up, *foot - corner.at),
                                 feature_name(FeatureKind::vertex_of_a, corner.vertex, 0),
                                 t.triangle});
        return true;
    }

    /// Adds the ends of the part of a face's border that lies under the solid's side.
    void add_border(const NearEdge& edge, const NearTriangle& face, const CurvedSide& side,
                    const ContactFrame& frame) {
        const auto part = part_under(edge, side, frame);
        if (!part)
            return;
        for (const bool at_end : {false, true}) {
            const double share = at_end ? part->end : part->begin;
            const auto& cut = at_end ? part->end_edge : part->begin_edge;
            const std::uint64_t name =
                cut ? feature_name(FeatureKind::edges, *cut, number_of(edge))
                    : feature_name(FeatureKind::vertex_of_b, 0, edge.vertices[at_end ? 1 : 0]);
            add_place_over(edge.from + share * (edge.to - edge.from), side, frame, name,
                           face.triangle);
        }
    }

    /// Adds a place of the surface under the solid's side.
    void add_place_over(const Vec3& on_surface, const CurvedSide& side, const ContactFrame& frame,
                        std::uint64_t name, std::uint32_t triangle) {
        const Vec3& up = frame.normal;
        double height = 0;
        if (side.is_disc()) {
            height = dot(side.normal, side.corners[0].at - on_surface) / dot(side.normal, up);
        } else {
            const auto inside = part_inside(solid_, on_surface, up);
            if (!inside)
                return;
            height = inside->begin;
        }
        found_.places.push_back({on_surface, on_surface + height * up, -height, name, triangle});
    }

    // --- Edges -----------------------------------------------------------------------------------

    void add_edge(const NearEdge& edge) {
        const NearTriangle *one = &patch_.triangles()[edge.triangles[0]],
                           *other = &patch_.triangles()[edge.triangles[1]];
        if (!edge.is_near || edge.is_flat || !(edge.is_border || edge.is_convex))
            return;
        if (!one->is_front)
            std::swap(one, other);
        const Vec3 along = normalized_or_zero(edge.to - edge.from);
        // Both sides of a border's triangle are outside.
        if ((!one->is_front && !edge.is_border) || along == Vec3{})
            return;
        // From the triangle over the edge, and on to the other triangle's normal.
        Vec3 out = cross(one->normal, along);
        const Vec3 inward =
            one->corners[0] + one->corners[1] + one->corners[2] - 1.5 * (edge.from + edge.to);
        if (dot(out, inward) > 0)
            out = -out;
        const double most =
            edge.is_border ? std::numbers::pi
                           : std::atan2(dot(other->normal, out), dot(other->normal, one->normal));
        if (const auto up = least_on_arc(edge.from, one->normal, out, most))
            add_edge_along(edge, *one, *up);
    }

    /// The direction between the ends of an arc in which a line is nearest to the solid, or leaves it soonest.
    /// None if that is an end of the arc.
    ///
    /// In          at: a point of the line. from, out: unit vectors across the line and each other; the arc
    ///             turns from the first to the second, by `most`.
    [[nodiscard]] std::optional<Vec3> least_on_arc(const Vec3& at, const Vec3& from,
                                                   const Vec3& out, double most) const {
        const auto up_at = [&](double angle) {
            return std::cos(angle) * from + std::sin(angle) * out;
        };
        const auto slope_at = [&](double angle) {
            const Vec3 turned = std::cos(angle) * out - std::sin(angle) * from;
            return dot(turned, at - farthest(solid_, -up_at(angle)));
        };
        const auto depth_at = [&](const Vec3& up) { return dot(up, at - farthest(solid_, -up)); };
        // Of a line that is apart, there is one minimum; of a line inside, there may be several.
        constexpr int kParts = 12;
        const double nothing = kNothing * solid_.reach;
        std::optional<Vec3> best;
        double least = HUGE_VAL, next = most > 0 ? slope_at(0) : 0;
        for (int i = 0; i < kParts && most > 0; ++i) {
            double low = most * i / kParts, high = most * (i + 1) / kParts;
            const double here = next;
            next = slope_at(high);
            if (here >= -nothing || next <= nothing)
                continue;
            for (int k = 0; k < 64 && low < high; ++k) {
                const double middle = 0.5 * (low + high);
                (slope_at(middle) < 0 ? low : high) = middle;
            }
            const Vec3 up = up_at(0.5 * (low + high));
            if (const double depth = depth_at(up); depth < least)
                least = depth, best = up;
        }
        return best;
    }

    void add_edge_along(const NearEdge& edge, const NearTriangle& face, const Vec3& up) {
        const CurvedSide side = side_towards(solid_, -up);
        const CurvedSide::Corner& lowest = side.farthest(-up);
        const double depth = dot(up, edge.from - lowest.at);
        if (depth < -bounds_.margin - bounds_.rounding ||
            (depth > bounds_.rounding && !meets(support_of(Triangle{edge.from, edge.to, edge.to}))))
            return;
        begin_seed();
        const ContactFrame frame({}, up);
        const Vec3 way = edge.to - edge.from;
        const auto share_of = [&](const Vec3& p) {
            return dot(p - edge.from, way) / length_sq(way);
        };
        const auto at = [&](double share) { return edge.from + share * way; };
        const std::uint32_t number = number_of(edge);
        if (side.lies_across(up)) {
            if (const auto part = part_under(edge, side, frame)) {
                add_place_over(
                    at(part->begin), side, frame,
                    feature_name(FeatureKind::edges, part->begin_edge.value_or(63), number),
                    face.triangle);
                if (part->end > part->begin)
                    add_place_over(
                        at(part->end), side, frame,
                        feature_name(FeatureKind::edges, part->end_edge.value_or(62), number),
                        face.triangle);
            } else if (side.corners.size() == 2) {
                add_line_along(edge, side, frame, face.triangle);
            }
        }
        if (found_.places.size() == begin_) {
            // Not over the edge: a vertex is nearer, or the edge is beside the line or disc.
            constexpr double kOver = 0x1p-20;
            const double share = share_of(lowest.at);
            const Vec3 foot = at(share);
            if (share < 0 || share > 1 ||
                length(lowest.at + depth * up - foot) > kOver * solid_.reach)
                return;
            found_.places.push_back({foot, foot - depth * up, depth,
                                     feature_name(FeatureKind::vertex_of_a, lowest.vertex, 0),
                                     face.triangle});
        }
        end_seed(up, face.body);
    }

    /// Adds the ends of the part in which a line of the solid and an edge that is nearly parallel to it lie over
    /// each other.
    void add_line_along(const NearEdge& edge, const CurvedSide& side, const ContactFrame& frame,
                        std::uint32_t triangle) {
        const Vec3 way = edge.to - edge.from;
        const Vec3& up = frame.normal;
        const auto share_of = [&](const Vec3& p) {
            return dot(p - edge.from, way) / length_sq(way);
        };
        const auto [low, high] =
            std::minmax({share_of(side.corners.front().at), share_of(side.corners.back().at)});
        if (low > 1 || high < 0)
            return;
        for (const CurvedSide::Corner& corner : side.corners) {
            const bool is_first = &corner == &side.corners.front();
            const Vec3 other = (is_first ? side.corners.back() : side.corners.front()).at;
            const std::uint64_t name =
                feature_name(FeatureKind::edges, corner.vertex, number_of(edge));
            // A line through an end leaves the solid somewhere by rounding.
            constexpr double kInwards = 0x1p-20;
            const double share = share_of(corner.at);
            const Vec3 foot = edge.from + share * way;
            const double depth = dot(up, foot - corner.at);
            if (share >= 0 && share <= 1 &&
                length(corner.at + depth * up - foot) <= bounds_.rounding) {
                found_.places.push_back({foot, foot - depth * up, depth, name, triangle});
                continue;
            }
            const double inner = share_of(corner.at + kInwards * (other - corner.at));
            add_place_over(edge.from + std::clamp(inner, 0.0, 1.0) * way, side, frame, name,
                           triangle);
        }
    }

    // --- Vertices --------------------------------------------------------------------------------

    void add_vertices() {
        ends_.clear();
        for (const NearEdge& edge : patch_.edges())
            for (const std::size_t k : {0U, 1U})
                ends_.push_back({edge.vertices.at(k), k == 0 ? edge.from : edge.to,
                                 k == 0 ? edge.to : edge.from, &edge});
        std::stable_sort(ends_.begin(), ends_.end(),
                         [](const End& s, const End& t) { return s.vertex < t.vertex; });
        for (std::size_t i = 0, end = 0; i < ends_.size(); i = end) {
            for (end = i; end < ends_.size() && ends_[end].vertex == ends_[i].vertex;)
                ++end;
            add_vertex(std::span(ends_).subspan(i, end - i));
        }
    }

    /// An edge at a vertex.
    struct End {
        std::uint32_t vertex = 0;
        Vec3 at, other;
        const NearEdge* edge = nullptr;
    };

    void add_vertex(std::span<const End> ends) {
        const NearTriangle* front = nullptr;
        for (const End& end : ends)
            if (end.edge->is_near && !end.edge->is_flat &&
                (end.edge->is_border || end.edge->is_convex))
                for (const std::uint32_t i : end.edge->triangles)
                    if (front == nullptr && (end.edge->is_border || patch_.triangles()[i].is_front))
                        front = &patch_.triangles()[i];
        if (front == nullptr)
            return;
        const Vec3& at = ends.front().at;
        SupportShape point;
        point.centre = at;
        Vec3 direction;
        const SupportGap gap =
            support_gap(point, solid_, std::nextafter(bounds_.margin + bounds_.rounding, HUGE_VAL),
                        SupportDepths::yes, direction);
        if (gap.distance > bounds_.margin + bounds_.rounding || gap.normal == Vec3{})
            return;
        for (const End& end : ends)
            if (dot(gap.normal, end.other - at) > kNothing * solid_.reach)
                return; // an edge there rises towards the solid
        begin_seed();
        found_.places.push_back({at, at + gap.distance * gap.normal, -gap.distance,
                                 feature_name(FeatureKind::vertex_of_b, 0, ends.front().vertex),
                                 front->triangle});
        end_seed(gap.normal, front->body);
    }

    // --- Both ------------------------------------------------------------------------------------

    void begin_seed() { begin_ = static_cast<std::uint32_t>(found_.places.size()); }
    void end_seed(const Vec3& up, std::uint32_t body) {
        CurvedSeed seed{up, -HUGE_VAL, body, begin_, begin_};
        for (std::uint32_t i = begin_; i < found_.places.size(); ++i)
            if (found_.places[i].depth >= -bounds_.margin - bounds_.rounding) {
                seed.depth = std::max(seed.depth, found_.places[i].depth);
                found_.places[seed.end++] = found_.places[i];
            }
        found_.places.resize(seed.end);
        if (seed.end > seed.begin)
            found_.seeds.push_back(seed);
    }

    const SupportShape& solid_;
    const CurvedPatch& patch_;
    const PatchBounds& bounds_;
    CurvedSeeds& found_;
    std::vector<std::uint32_t> by_plane_;
    std::vector<End> ends_;
    std::uint32_t begin_ = 0;
    Vec3 direction_; ///< of the last distance: a guess for the next one
};

} // namespace

std::optional<Vec3> foot_on(const NearTriangle& t, const Vec3& from, const Vec3& up,
                            double rounding) {
    const Vec3 foot = from + (dot(t.normal, t.corners[0] - from) / dot(t.normal, up)) * up;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &p = t.corners[k], &q = t.corners[(k + 1) % 3], &r = t.corners[(k + 2) % 3];
        const Vec3 way = q - p, inward = cross(t.normal, way);
        const double sign = with_sign(1, dot(inward, r - p));
        if (sign * dot(inward, foot - p) < -rounding * length(way))
            return std::nullopt;
    }
    return foot;
}

void find_seeds(const SupportShape& solid, const CurvedPatch& patch, const PatchBounds& bounds,
                CurvedSeeds& found) {
    found.seeds.clear(), found.places.clear();
    SeedSearch(solid, patch, bounds, found).find();
}

} // namespace abut
