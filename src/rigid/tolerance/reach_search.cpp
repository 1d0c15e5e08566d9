#include "rigid/tolerance/reach_search.h"

#include "core/stop.h"
#include "geometry/triangle_triangle_intersect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace abut {

namespace {

/// The planes of a convex cell around a triangle; their normals point out of it.
using CellPlanes = boost::container::static_vector<CuttingPlane, 8>;

/// The points over and under a triangle, at most `height` from its plane. Empty if the triangle has
/// no area.
CellPlanes prism_around(const Triangle& t, double height) {
    const Vec3 normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
    CellPlanes planes;
    if (normal == Vec3{})
        return planes;
    for (std::size_t i = 0; i < 3; ++i)
        planes.push_back({t[i], normalized_or_zero(cross(t[(i + 1) % 3] - t[i], normal))});
    planes.push_back({t[0] + height * normal, normal});
    planes.push_back({t[0] - height * normal, -normal});
    return planes;
}

/// Points within `limit` of a triangle, beyond its edges too: the prism grown by half of the limit
/// in the triangle's plane, with corners cut off at that distance from the vertices. A point of it
/// is at most limit / sqrt(2) beside the triangle and limit / sqrt(2) over or under its plane.
CellPlanes neighbourhood_of(const Triangle& t, double limit) {
    CellPlanes planes = prism_around(t, limit * 0.70710678);
    if (planes.empty())
        return planes;
    for (std::size_t i = 0; i < 3; ++i)
        planes[i].point = planes[i].point + 0.5 * limit * planes[i].normal;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 inward =
            normalized_or_zero(t[(i + 1) % 3] - t[i]) + normalized_or_zero(t[(i + 2) % 3] - t[i]);
        const Vec3 outward = -normalized_or_zero(inward);
        planes.push_back({t[i] + 0.5 * limit * outward, outward});
    }
    return planes;
}

/// A convex cell of points within `limit` of an edge or a vertex of a triangle, with x in it if x is
/// nearer than the limit: a box in a cylinder around the edge, or in a ball around the vertex. It is as
/// high as it must be to hold x; the higher, the narrower. Empty if there is no such cell.
///
/// In          x: a point beside the triangle.
CellPlanes cell_beside(const PreparedTriangle& t, const Vec3& x, double limit, double rounding) {
    const double half_square = std::sqrt(0.5);
    CellPlanes planes;
    const Vec3 q = t.nearest(x).b;
    const double distance = length(x - q);
    if (distance == 0 || distance >= limit)
        return planes;
    Vec3 along;
    CuttingPlane begin, end;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &p = t.corners()[i], &r = t.corners()[(i + 1) % 3];
        const Vec3 edge = normalized_or_zero(r - p);
        if (dot(q - p, edge) > 0 && dot(r - q, edge) > 0 && length(cross(q - p, edge)) <= rounding)
            along = edge, begin = {p, -edge}, end = {r, edge};
    }
    const Vec3 up = normalized_or_zero(x - q - dot(x - q, along) * along);
    if (up == Vec3{})
        return planes;
    const double height = std::max(0.5 * (distance + limit), half_square * limit);
    double width = std::sqrt(limit * limit - height * height);
    if (along == Vec3{}) {
        width *= half_square;
        along = normalized_or_zero(perpendicular(up));
        begin = {q - width * along, -along}, end = {q + width * along, along};
    }
    const Vec3 aside = cross(up, along);
    for (const double sign : {-1.0, 1.0}) {
        planes.push_back({q + sign * height * up, sign * up});
        planes.push_back({q + sign * width * aside, sign * aside});
    }
    planes.push_back(begin);
    planes.push_back(end);
    return planes;
}

/// A polygon to compare with many triangles.
class MeetingTest {
public:
    MeetingTest(const FacePolygon& polygon, double rounding)
        : polygon_(polygon), rounding_(rounding) {
        for (std::size_t i = 2; i < polygon.size(); ++i)
            normal_ = normal_ + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
        normal_ = normalized_or_zero(normal_);
    }

    /// Exact for the polygon's rounded corners.
    [[nodiscard]] bool meets(const Triangle& t) const {
        if (is_over_or_under(t, polygon_[0], normal_) ||
            is_over_or_under(polygon_, t[0], normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]))))
            return false;
        for (std::size_t i = 2; i < polygon_.size(); ++i)
            if (triangle_triangle_intersect({polygon_[0], polygon_[i - 1], polygon_[i]}, t) !=
                TriangleContact::none)
                return true;
        return false;
    }

private:
    /// Returns whether all points lie on one side of a plane, by more than the rounding.
    template <typename Points>
    [[nodiscard]] bool is_over_or_under(const Points& points, const Vec3& on_plane,
                                        const Vec3& normal) const {
        bool over = true, under = true;
        for (const Vec3& p : points) {
            const double height = dot(p - on_plane, normal);
            over = over && height > rounding_;
            under = under && height < -rounding_;
        }
        return over || under;
    }

    const FacePolygon& polygon_;
    const double rounding_;
    Vec3 normal_;
};

/// Returns a triangle of the surface that shares a point with a polygon, if there is one. Exact for
/// the polygon's rounded corners.
std::optional<Triangle> triangle_met_by(const FacePolygon& polygon, const WorldSolid& surface,
                                        const ReachSearch::Options& options) {
    std::optional<Triangle> met;
    const Box3 box = grown(box_of(polygon), options.rounding);
    const MeetingTest test(polygon, options.rounding);
    surface.for_each_surface_block(box, [&](const WorldSolid::Block& block) {
        block.model.for_each_near_hull({polygon.data(), polygon.size()}, options.rounding,
                                       [&](std::uint32_t slot) {
                                           if (met)
                                               return;
                                           const Triangle t = block.model.world_slot(slot);
                                           if (test.meets(t))
                                               met = t;
                                       });
        return !met;
    });
    return met;
}

template <typename Slots>
void remember(Slots& slots, std::uint32_t slot) {
    if (const auto at = std::find(slots.begin(), slots.end(), slot); at != slots.end())
        slots.erase(at);
    if (slots.size() == slots.capacity())
        slots.pop_back();
    slots.insert(slots.begin(), slot);
}

} // namespace

Proof ReachSearch::add(const FacePolygon& polygon) {
    if (proof_ != Proof::holds || polygon.size() < 3)
        return proof_;
    if (!options_.both_sides && !overlap(box_of(polygon), box_))
        return proof_;
    left_ += static_cast<std::uint64_t>(kShareOfPolygon * static_cast<double>(options_.budget));
    push(within_bounds(polygon), last_);
    while (!waiting_.empty() && proof_ == Proof::holds) {
        Piece piece = waiting_.back();
        waiting_.pop_back();
        poll_stop();
        if (left_ == 0)
            proof_ = Proof::open;
        else
            --left_, examine(piece);
        last_ = piece;
    }
    waiting_.clear();
    return proof_;
}

/// The part of a polygon that is under all bounds, unless it has too many corners to be cut.
FacePolygon ReachSearch::within_bounds(FacePolygon polygon) const {
    for (const CuttingPlane& bound : options_.bounds) {
        if (polygon.size() < 3 || polygon.size() > kMostCornersToCut)
            break;
        if (std::ranges::all_of(polygon, [&](const Vec3& corner) {
                return dot(corner - bound.point, bound.normal) <= options_.rounding;
            }))
            continue;
        polygon = cut(polygon, bound, options_.rounding).inside;
    }
    return polygon;
}

bool ReachSearch::rules_out(const Vec3& middle, double radius) {
    return rules_out_by(solid_, last_.side, middle, radius);
}

bool ReachSearch::rules_out_by_either(const Vec3& middle, double radius) {
    return rules_out(middle, radius) ||
           rules_out_by(*options_.own, last_.side_of_own, middle, radius);
}

bool ReachSearch::rules_out_by(const WorldSolid& surface, KnownSide& side, const Vec3& middle,
                               double radius) {
    const double enough = std::max(radius, limit_ - radius);
    const WorldSolid::Nearest nearest = surface.nearest(middle, {.enough = enough});
    if (nearest.distance + radius <= limit_)
        return true;
    return !options_.both_sides && nearest.distance > radius + options_.rounding &&
           !is_inside(surface, middle, side);
}

bool ReachSearch::is_near(const FacePolygon& polygon, const WorldSolid& surface,
                          const Slots& slots) const {
    // Twice the rounding: then every piece that is smaller than the rounding is near or beyond.
    const double limit = limit_ + 2 * options_.rounding;
    return std::ranges::any_of(slots, [&](std::uint32_t slot) {
        const PreparedTriangle& t = surface.prepared_slot(slot);
        return std::ranges::all_of(
            polygon, [&](const Vec3& corner) { return t.distance_sq(corner) <= limit * limit; });
    });
}

void ReachSearch::examine(Piece& piece) {
    if (is_near(piece.polygon, solid_, piece.near) || is_near_own(piece))
        return;
    Sample sample{middle_of(piece.polygon), 0, {}};
    sample.radius = reach_from(piece.polygon, sample.point);
    const std::uint32_t* seed = piece.near.empty() ? nullptr : piece.near.data();
    sample.nearest = solid_.nearest(sample.point, {.seed = seed});
    remember(piece.near, sample.nearest.slot);
    if (is_near(piece.polygon, solid_, {sample.nearest.slot}))
        return;
    const double distance = sample.nearest.distance, limit = limit_ + options_.rounding;
    if (distance <= limit && divide_near(piece, solid_.prepared_slot(sample.nearest.slot)))
        return;
    if (distance > limit && options_.both_sides)
        return refute(piece, sample);
    if (options_.both_sides)
        return halve(piece);
    const std::optional<Triangle> met = distance <= sample.radius + options_.rounding
                                            ? triangle_met_by(piece.polygon, solid_, options_)
                                            : std::nullopt;
    const bool inside = distance > options_.rounding && is_inside(solid_, sample.point, piece.side);
    if (!met && !inside && distance > options_.rounding)
        return;
    if (options_.own != nullptr) {
        if (settled_by_own(piece, sample, distance > limit && inside))
            return;
    } else if (distance > limit && inside) {
        if (options_.raise > 0 && !met)
            move_to_deepest_corner(piece.polygon, sample);
        return refute(piece, sample);
    }
    if (met && divide_near(piece, PreparedTriangle(*met)))
        return;
    halve(piece);
}

/// Looks at the second surface. Returns whether the piece needs no further look: it is proven,
/// refuted or divided.
bool ReachSearch::settled_by_own(Piece& piece, const Sample& sample, bool deep) {
    const WorldSolid& own = *options_.own;
    const double limit = limit_ + options_.rounding;
    const std::uint32_t* seed = piece.near_own.empty() ? nullptr : piece.near_own.data();
    const WorldSolid::Nearest nearest = own.nearest(sample.point, {.seed = seed});
    remember(piece.near_own, nearest.slot);
    if (nearest.distance <= limit)
        return is_near_own(piece) || divide_near(piece, own.prepared_slot(nearest.slot));
    if (is_inside(own, sample.point, piece.side_of_own)) {
        if (deep)
            refute(piece, sample);
        return deep;
    }
    if (nearest.distance > sample.radius + options_.rounding)
        return true;
    const std::optional<Triangle> met = triangle_met_by(piece.polygon, own, options_);
    return !met || divide_near(piece, PreparedTriangle(*met));
}

bool ReachSearch::is_near_own(const Piece& piece) const {
    return options_.own != nullptr && is_near(piece.polygon, *options_.own, piece.near_own);
}

/// Moves a sample to the corner that is farther from the surface than it, if one is.
void ReachSearch::move_to_deepest_corner(const FacePolygon& polygon, Sample& sample) const {
    const std::uint32_t seed = sample.nearest.slot;
    for (const Vec3& corner : polygon) {
        const WorldSolid::Nearest nearest = solid_.nearest(corner, {.seed = &seed});
        if (nearest.distance > sample.nearest.distance)
            sample.point = corner, sample.nearest = nearest;
    }
}

void ReachSearch::refute(const Piece& piece, const Sample& sample) {
    counterexample_ = sample.point;
    depth_ = sample.nearest.distance;
    if (options_.raise == 0) {
        proof_ = Proof::fails;
        return;
    }
    limit_ = depth_ * (1 + options_.raise);
    waiting_.push_back(piece);
}

/// Cuts away the part of a piece that a cell around a triangle proves to be near. Returns false if
/// that would leave the piece whole.
bool ReachSearch::divide_near(const Piece& piece, const PreparedTriangle& t) {
    const auto try_cell = [&](const CellPlanes& planes) {
        return cut_away(piece, {planes.data(), planes.size()});
    };
    return try_cell(prism_around(t.corners(), limit_)) ||
           try_cell(neighbourhood_of(t.corners(), limit_)) ||
           try_cell(cell_beside(t, middle_of(piece.polygon), limit_, options_.rounding));
}

bool ReachSearch::cut_away(const Piece& piece, std::span<const CuttingPlane> cell) {
    boost::container::static_vector<FacePolygon, 8> outside;
    FacePolygon inside = piece.polygon;
    for (const CuttingPlane& plane : cell) {
        const CutPolygon parts = cut(inside, plane, options_.rounding);
        if (parts.inside.empty())
            return false;
        if (!parts.outside.empty())
            outside.push_back(parts.outside);
        inside = parts.inside;
    }
    if (cell.empty())
        return false;
    for (const FacePolygon& polygon : outside)
        push(polygon, piece);
    return true;
}

void ReachSearch::push(const FacePolygon& polygon, const Piece& parent) {
    if (polygon.size() < 3)
        return;
    if (polygon.size() <= kMostCornersToCut) {
        Piece piece = parent;
        piece.polygon = polygon;
        waiting_.push_back(piece);
        return;
    }
    const std::size_t half = polygon.size() / 2;
    FacePolygon first(polygon.begin(), polygon.begin() + half + 1),
        second(polygon.begin() + half, polygon.end());
    second.push_back(polygon[0]);
    push(first, parent);
    push(second, parent);
}

void ReachSearch::halve(const Piece& piece) {
    const CutPolygon parts = halved(piece.polygon, 0);
    if (parts.inside.empty() || parts.outside.empty()) {
        proof_ = Proof::open; // the piece is smaller than the rounding of its coordinates
        return;
    }
    push(parts.inside, piece);
    push(parts.outside, piece);
}

} // namespace abut
