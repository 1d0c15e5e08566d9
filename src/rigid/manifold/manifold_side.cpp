#include "rigid/manifold/manifold_side.h"

#include "math/predicates.h"
#include "math/transform.h"
#include "tree/traverse_one.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// +1 if the line passes a triangle against its normal, -1 along it, 0 if it misses the triangle or
/// lies in its plane.
int passing_side(const Vec3& point, const Vec3& direction, const Triangle& t) {
    const int s0 = turn_around_line(point, direction, t[0], t[1]),
              s1 = turn_around_line(point, direction, t[1], t[2]);
    if (s0 * s1 < 0)
        return 0;
    const int s2 = turn_around_line(point, direction, t[2], t[0]);
    if (s0 * s2 < 0 || s1 * s2 < 0)
        return 0;
    const int sum = s0 + s1 + s2;
    return (sum < 0) - (sum > 0);
}

/// The projection along a line to a plane of two axes, in which the line is the origin.
class AlongLine {
public:
    /// In          size: bounds the distance of the triangles' vertices from the point.
    AlongLine(const Vec3& point, const Vec3& direction, double size)
        : rounding_(0x1p-46 * (magnitude(point) + size)) {
        const double x = std::abs(direction.x), y = std::abs(direction.y),
                     z = std::abs(direction.z);
        main_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        const double main = component(direction, main_);
        first_ = (main_ + 1) % 3, second_ = (main_ + 2) % 3;
        slope_[0] = component(direction, first_) / main;
        slope_[1] = component(direction, second_) / main;
        for (int axis = 0; axis < 3; ++axis)
            point_[axis] = component(point, axis);
    }
    /// Returns true only if the line misses the box around a triangle's projection. False proves
    /// nothing.
    [[nodiscard]] bool misses(const Triangle& t) const {
        std::array<double, 3> u{}, v{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double along = component(t[k], main_) - point_[main_];
            u[k] = component(t[k], first_) - point_[first_] - slope_[0] * along;
            v[k] = component(t[k], second_) - point_[second_] - slope_[1] * along;
        }
        const auto on_one_side = [this](const std::array<double, 3>& w) {
            return std::min({w[0], w[1], w[2]}) > rounding_ ||
                   std::max({w[0], w[1], w[2]}) < -rounding_;
        };
        return on_one_side(u) || on_one_side(v);
    }

private:
    int main_, first_, second_; ///< axes; the direction is largest along the main one
    std::array<double, 2> slope_{};
    std::array<double, 3> point_{};
    double rounding_;
};

} // namespace

ManifoldSide::ManifoldSide(const Model& model, const Transform& world_from_model,
                           const Vec3& origin)
    : model_(model, world_from_model, origin), solid_(model.data().solid()),
      facing_(is_mirroring(world_from_model) ? -solid_.outward : solid_.outward) {}

bool ManifoldSide::take_earlier(std::uint32_t slot, const Triangle& t, const Vec3& point,
                                const Vec3& direction, SurfaceHit& hit) const {
    const int side = passing_side(point, direction, t);
    if (side == 0)
        return false;
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double along = dot(normal, direction);
    // The height on a triangle seen on edge is not bounded by its corners' heights.
    if (std::abs(along) <= 0x1p-20 * length(normal))
        return false;
    const double height = dot(normal, t[0] - point) / along;
    if (!(height >= 0) || (hit.found && height >= hit.height))
        return false;
    hit = {true, height, !is_oriented() || side * facing() < 0, slot};
    return true;
}

ManifoldSide::SurfaceHit ManifoldSide::first_hit(const Vec3& point, const Vec3& direction) const {
    SurfaceHit first;
    const double far = length(model_.middle() - point) + model_.reach();
    // Bounds the rounding of the segment's end.
    const double error = 16 * 0x1p-53 * (magnitude(point) + far);
    const auto clipped = model_.tree_segment(point, point + far * direction, error);
    if (!clipped || !(far > 0))
        return first;
    const AlongLine line(point, direction, 2 * far);
    float bound = 1;
    for_each_along_segment(model_.data().tree(), clipped->segment, [&](std::uint32_t slot) {
        const Triangle t = model_.world_slot(slot);
        if (line.misses(t) || !take_earlier(slot, t, point, direction, first))
            return bound;
        const double s =
            2 * (first.height / far - clipped->begin) / (clipped->end - clipped->begin) - 1;
        // The margin exceeds the rounding of s; NaN leaves the bound at 1.
        if (s < 1 - 0x1p-18)
            bound = round_up(std::max(s, -1.0) + 0x1p-18);
        return bound;
    });
    return first;
}

ManifoldSide::LineHit ManifoldSide::top_along(const Vec3& point, const Vec3& direction) const {
    return top_along(point, direction,
                     [this](const Vec3& p, const Vec3& way) { return first_hit(p, way); });
}

} // namespace abut
