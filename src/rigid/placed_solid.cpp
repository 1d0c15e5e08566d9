#include "rigid/placed_solid.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "tree/traverse_one.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

std::array<float, 3> to_float(const Vec3& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Directions with no special relation to each other or to any axis; which one is tried k-th.
Vec3 ray_direction(std::uint32_t k) {
    const double u = 0.7548776662466927 * (k + 1),
                 v = 0.5698402909980532 * (k + 1); // plastic number
    const double z = 2 * (u - std::floor(u)) - 1, angle = 6.283185307179586 * (v - std::floor(v));
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

} // namespace

PlacedSolid::PlacedSolid(const Model& model, const Solid& solid, const Transform& world_from_model)
    : public_model_(model), model_(model.data()), solid_(solid), world_(world_from_model) {
    world_from_tree_ = compose(world_from_model, model_.model_from_tree());
    tree_from_world_ = inverse(world_from_tree_);
    least_stretch_ = abut::least_stretch(world_from_tree_);
    most_stretch_ = abut::most_stretch(world_from_tree_);
    const Aabb& box = model_.tree().bounds;
    double half = 0;
    for (std::size_t k = 0; k < 3; ++k)
        half = std::max({half, std::abs(double{box.lower[k]}), std::abs(double{box.upper[k]})});
    reach_ = most_stretch_ * 2 * half;
    const double world_size = std::abs(world_from_tree_.m[9]) + std::abs(world_from_tree_.m[10]) +
                              std::abs(world_from_tree_.m[11]) + reach_;
    // Rounding of a point on its way to single precision in the tree's frame, ray ends included.
    margin_ = 32 * 0x1p-24 * 4 * half + 64 * 0x1p-53 * world_size / least_stretch_;
    const auto& m = world_from_model.m;
    mirrored_ = dot(cross({m[0], m[1], m[2]}, {m[3], m[4], m[5]}), {m[6], m[7], m[8]}) < 0;
}

bool PlacedSolid::on_surface(const Vec3& point) const {
    const Vec3 p = apply(tree_from_world_, point);
    const Triangle as_triangle{point, point, point};
    bool on = false;
    for_each_overlap(model_.tree(), Aabb({p, p}, margin_), [&](std::uint32_t slot) {
        on = on || triangle_triangle_intersect(as_triangle, model_.world_triangle(slot, world_)) !=
                       TriangleContact::none;
    });
    return on;
}

bool PlacedSolid::odd_crossings(const Vec3& from, const Vec3& to, bool& clear) const {
    const Vec3 p = apply(tree_from_world_, from), q = apply(tree_from_world_, to);
    const TreeSegment segment{to_float(0.5 * (p + q)), to_float(0.5 * (q - p)),
                              static_cast<float>(margin_)};
    bool odd = false;
    clear = true;
    for_each_on_segment(model_.tree(), segment, [&](std::uint32_t slot) {
        const Triangle t = model_.world_triangle(slot, world_);
        const int side_from = orient3d(t[0], t[1], t[2], from),
                  side_to = orient3d(t[0], t[1], t[2], to);
        if (side_from * side_to > 0)
            return;
        const int u = orient3d(from, to, t[0], t[1]), v = orient3d(from, to, t[1], t[2]),
                  w = orient3d(from, to, t[2], t[0]);
        const bool in = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
        if (!in)
            return;
        if (side_from == 0 || side_to == 0 || u == 0 || v == 0 || w == 0)
            clear = false;
        else
            odd = !odd;
    });
    return odd;
}

bool PlacedSolid::contains_off_surface(const Vec3& point) const {
    const Transform& f = world_;
    const Vec3 o = apply(f, {model_.model_from_tree().m[9], model_.model_from_tree().m[10],
                             model_.model_from_tree().m[11]});
    const double far = length(point - o) + 2 * reach_;
    if (!(length(point - o) <= 2 * reach_))
        return false;
    const std::uint32_t wanted = solid_.closed ? 1 : 3;
    std::uint32_t clear_rays = 0, odd_rays = 0;
    // A ray is unclear with probability next to zero; the limit ends the loop on absurd input only.
    for (std::uint32_t k = 0; k < 64 && clear_rays < wanted; ++k) {
        bool clear = false;
        const bool odd = odd_crossings(point, point + far * ray_direction(k), clear);
        clear_rays += clear ? 1 : 0;
        odd_rays += clear && odd ? 1 : 0;
    }
    return 2 * odd_rays > clear_rays;
}

bool PlacedSolid::winds_around(const Vec3& point) const {
    if (solid_.closed)
        return contains(point);
    // The winding number does not change under an affine map that moves the mesh and the point.
    const Vec3 local = apply(inverse(world_), point);
    return std::abs(std::abs(winding_number(model_.mesh(), local)) - 1) <= kWindingRounding;
}

PlacedSolid::Nearest PlacedSolid::nearest(const Vec3& point, const NearestSearch& search) const {
    Nearest best;
    double best_sq = search.bound * search.bound;
    float tree_bound_sq = 0; // negative: near enough
    const auto narrow = [&](double distance) {
        const double d = distance / ((1 + search.slack) * least_stretch_);
        tree_bound_sq = distance <= search.enough ? -1 : round_up(d * d * (1 + 0x1p-20));
    };
    const auto visit = [&](std::uint32_t slot) {
        const ClosestPoints c = point_triangle_distance(point, world_slot(slot));
        if (c.distance_sq < best_sq) {
            best_sq = c.distance_sq;
            best = {std::sqrt(c.distance_sq), c.b, slot};
            narrow(best.distance);
        }
        return tree_bound_sq;
    };
    narrow(search.bound);
    if (search.seed != nullptr)
        visit(*search.seed);
    if (tree_bound_sq >= 0)
        for_each_near(model_.tree(), to_float(apply(tree_from_world_, point)),
                      static_cast<float>(margin_), tree_bound_sq, visit);
    return best;
}

} // namespace abut
