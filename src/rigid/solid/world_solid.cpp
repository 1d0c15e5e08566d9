#include "rigid/solid/world_solid.h"

#include "core/stop.h"
#include "geometry/point_triangle_distance.h"
#include "math/predicates.h"
#include "rigid/model/solid.h"

#include <cmath>

namespace abut {

namespace {

/// Returns the k-th direction of a sequence with no special relation to each other or to an axis.
Vec3 ray_direction(std::uint32_t k) {
    const double u = 0.7548776662466927 * (k + 1),
                 v = 0.5698402909980532 * (k + 1); // plastic number
    const double z = 2 * (u - std::floor(u)) - 1, angle = 6.283185307179586 * (v - std::floor(v));
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

} // namespace

bool WorldSolid::contains_off_surface(const Vec3& point) const {
    const double off = length(point - middle());
    if (!(off <= 2 * reach()))
        return false;
    if (is_on_inner_face(point))
        return true;
    const double far = off + 2 * reach();
    const std::uint32_t wanted = closed() ? 1 : 3;
    std::uint32_t clear_rays = 0, inside_rays = 0;
    // A ray is unclear with probability near zero, so only absurd input reaches the limit.
    for (std::uint32_t k = 0; k < 64 && clear_rays < wanted; ++k) {
        const std::optional<int> count = crossings(point, point + far * ray_direction(k));
        clear_rays += count ? 1 : 0;
        inside_rays += count && is_inside(*count) ? 1 : 0;
    }
    return 2 * inside_rays > clear_rays;
}

bool WorldSolid::contains_off_surface(const Vec3& point, const Vec3& known, bool inside) const {
    const std::optional<int> count = closed() ? crossings(known, point) : std::nullopt;
    if (!count)
        return contains_off_surface(point);
    if (!is_oriented())
        return (*count % 2 != 0) != inside;
    // The boundary may wind around a point twice, so a way out of one shell need not lead outside.
    const bool is_left_or_entered = inside ? *count > 0 : *count < 0;
    return is_left_or_entered ? contains_off_surface(point) : inside;
}

bool WorldSolid::winds_around(const Vec3& point) const {
    if (closed())
        return contains(point);
    const double number = is_oriented() ? winding(point) : std::abs(winding(point));
    return number > 0.5 && std::abs(number - std::round(number)) <= kWindingRounding;
}

void for_each_block_pair(
    const WorldSolid& a, const WorldSolid& b, const Vec3& shift,
    const std::function<bool(const WorldSolid::Block&, const WorldSolid::Block&)>& visit) {
    const auto moved = [](const Box3& box, const Vec3& by) {
        const double rounding = 0x1p-50 * (max_abs(box.lower) + max_abs(box.upper) + max_abs(by));
        return grown({box.lower + by, box.upper + by}, rounding);
    };
    bool go_on = true;
    a.for_each_block(moved(b.world_box(), shift), [&](const WorldSolid::Block& of_a) {
        b.for_each_block(moved(of_a.box, -shift),
                         [&](const WorldSolid::Block& of_b) { return go_on = visit(of_a, of_b); });
        return go_on;
    });
}

std::optional<int> crossings(const PlacedModel& model, const Vec3& from, const Vec3& to,
                             PreparedFaces* faces, std::span<const std::int8_t> weights) {
    int count = 0;
    bool clear = true;
    const auto cross = [&](std::uint32_t slot, const Triangle& t, int side_from, int side_to) {
        if (side_from * side_to > 0)
            return;
        // A triangle without an area separates nothing, and no sign tells where the segment passes.
        if (side_from == 0 && side_to == 0 && collinear(t[0], t[1], t[2]))
            return;
        const int u = orient3d(from, to, t[0], t[1]), v = orient3d(from, to, t[1], t[2]),
                  w = orient3d(from, to, t[2], t[0]);
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)))
            return;
        const int weight = weights.empty() ? 1 : weights[model.data().triangle_at(slot)];
        if (weight == 0)
            return;
        clear = clear && side_from != 0 && side_to != 0 && u != 0 && v != 0 && w != 0;
        count += weight * side_to;
    };
    if (faces != nullptr)
        model.for_each_on_segment(from, to, [&](std::uint32_t slot) {
            const PreparedTriangle& face = faces->get(slot, [&] { return model.world_slot(slot); });
            cross(slot, face.corners(), face.side(from), face.side(to));
        });
    else
        model.for_each_on_segment(from, to, [&](std::uint32_t slot) {
            const Triangle t = model.world_slot(slot);
            cross(slot, t, orient3d(t[0], t[1], t[2], from), orient3d(t[0], t[1], t[2], to));
        });
    return clear ? std::optional(count) : std::nullopt;
}

WorldSolid::Nearest nearest_point(const PlacedModel& model, const Vec3& point,
                                  const WorldSolid::NearestSearch& search, PreparedFaces* faces) {
    WorldSolid::Nearest best;
    double best_sq = search.bound * search.bound;
    const auto bound_sq = [&](double distance) {
        const double d = distance / (1 + search.slack);
        return d * d;
    };
    double next_sq = bound_sq(search.bound);
    const auto visit = [&](std::uint32_t slot) {
        const auto triangle = [&] { return model.world_slot(slot); };
        const ClosestPoints c = faces != nullptr ? faces->get(slot, triangle).nearest(point)
                                                 : point_triangle_distance(point, triangle());
        if (c.distance_sq < best_sq) {
            best_sq = c.distance_sq;
            best = {std::sqrt(c.distance_sq), c.b, slot};
            next_sq = best.distance <= search.enough ? kStopTraversal : bound_sq(best.distance);
        }
        return next_sq;
    };
    if (search.seed != nullptr)
        visit(*search.seed);
    if (next_sq >= 0)
        model.for_each_near(point, next_sq, visit);
    return best;
}

} // namespace abut
