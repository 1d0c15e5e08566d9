#include "ccd/nearest_on_patch.h"

#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"
#include "math/rounding.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The nearest point's position, and the part of the patch that holds it.
struct Foot {
    double x = 0, y = 0;
    bool along_x = false, along_y = false; ///< neither: at a corner; both: inside
    bool along_diagonal = false;           ///< of a triangle: on the side opposite to `corner`
};

Foot foot_of(const FlatPatch& patch) {
    if (patch.kind == ElementaryKind::edge_edge) {
        const SegmentPoints n = nearest_on_segments(-patch.side_x, patch.side_y, patch.corner);
        const auto is_inside = [](double s) { return s > 0 && s < 1; };
        return {n.s, n.t, is_inside(n.s), is_inside(n.t)};
    }
    const auto corners = patch.corners();
    const Triangle triangle{corners[0], corners[1], corners[2]};
    if (const TriangleFoot foot = foot_within({}, triangle); foot.within)
        return {foot.weights[1], foot.weights[2], true, true};
    const NearestOnTriangle n = nearest_on_triangle({}, triangle);
    const bool inside = n.dimension == 2, edge = n.dimension == 1;
    return {n.weights[1], n.weights[2], inside || (edge && n.index == 0),
            inside || (edge && n.index == 2), edge && n.index == 1};
}

/// The part of `v` perpendicular to a line.
Vec3 across(const Vec3& v, const Vec3& line) {
    const double sq = length_sq(line);
    return sq > 0 ? v - (dot(v, line) / sq) * line : v;
}

/// The direction perpendicular to two vectors, however small the angle between them. The cross
/// product's rounding error, divided by that angle, leaves a part along the vectors; that part is
/// removed.
Vec3 across(const Vec3& x, const Vec3& y, const Vec3& area) {
    const Vec3 n = normalized_or_zero(area), beside = across(across(y, x), x);
    const double xx = length_sq(x), bb = length_sq(beside);
    if (!(xx > 0 && bb > 0))
        return n;
    // n - u x - v beside has no part along x or y.
    const double u = dot(n, x) / xx, v = (dot(n, y) - u * dot(x, y)) / bb;
    return n - u * x - v * beside;
}

/// Lower bound on the patch's distance from how far its corners are along a direction.
struct Bound {
    double lower = 0;
    Vec3 direction;
};

class Bounds {
public:
    explicit Bounds(const FlatPatch& patch) : corners_(patch.corners()) {}

    void add(const Vec3& towards) {
        // Squares of shorter vectors lose digits to underflow.
        const double sq = length_sq(towards);
        if (!(sq > 0x1p-900))
            return;
        const Vec3 n = (1 / std::sqrt(sq)) * towards;
        double least = dot(n, corners_[0]);
        for (std::size_t i = 1; i < corners_.size(); ++i)
            least = std::min(least, dot(n, corners_[i]));
        // The length of n exceeds 1 by at most 6 eps.
        if (const double lower = (1 - 8 * kUnitRoundoff) * (least - kAlongOff); lower > best_.lower)
            best_ = {lower, n};
    }
    /// Adds all directions in which the nearest point of a convex patch may lie: to each corner,
    /// perpendicular to each side, and perpendicular to the patch.
    void add_all(const FlatPatch& patch, const Vec3& area) {
        const Vec3 n = across(patch.side_x, patch.side_y, area);
        add(n), add(-n);
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const Vec3 &from = corners_[i], side = corners_[(i + 1) % corners_.size()] - from;
            add(from);
            add(across(across(from, side), side));
        }
    }
    [[nodiscard]] const Bound& best() const { return best_; }

private:
    std::array<Vec3, 4> corners_;
    Bound best_;
};

/// The direction from the origin to the nearest point. The gap is off by roundings of the
/// coordinates, which may be many times its length. So its part along the side that holds the
/// nearest point is removed; inside the patch, the patch's normal is used.
Vec3 direction_of(const FlatPatch& patch, const Foot& foot, const Vec3& gap, const Vec3& area) {
    if (foot.along_x && foot.along_y)
        return dot(area, gap) < 0 ? -area : area;
    if (foot.along_x)
        return across(gap, patch.side_x);
    if (foot.along_y)
        return across(gap, patch.side_y);
    return foot.along_diagonal ? across(gap, patch.side_y - patch.side_x) : gap;
}

} // namespace

std::array<Vec3, 4> FlatPatch::corners() const {
    const Vec3 beyond_x = corner + side_x, beyond_y = corner + side_y;
    return {corner, beyond_x, kind == ElementaryKind::vertex_face ? beyond_y : beyond_x + side_y,
            beyond_y};
}

Vec3 normal_of_patch(const FlatPatch& patch) {
    return across(patch.side_x, patch.side_y, cross(patch.side_x, patch.side_y));
}

NearestOnPatch nearest_on_patch(const FlatPatch& patch) {
    const Foot foot = foot_of(patch);
    const Vec3 gap = patch.corner + foot.x * patch.side_x + foot.y * patch.side_y;
    NearestOnPatch nearest;
    nearest.x = foot.x, nearest.y = foot.y;
    nearest.distance = length(gap);
    // A coordinate of the gap is off by 4 eps for its vectors, 4 eps for products and sums, and 1
    // eps where rounded weights sum to more than 1: in all by 9 sqrt(3) eps.
    nearest.upper = (1 + 4 * kUnitRoundoff) * nearest.distance + 18 * kUnitRoundoff;

    const Vec3 area = cross(patch.side_x, patch.side_y);
    Bounds bounds(patch);
    bounds.add(direction_of(patch, foot, gap, area));
    // Tries all directions for needles and nearly parallel edges.
    constexpr double kLoose = 1e-9;
    if (nearest.upper - bounds.best().lower > kLoose * nearest.upper + 4 * kAlongOff)
        bounds.add_all(patch, area);
    nearest.lower = bounds.best().lower;
    nearest.direction = bounds.best().direction;
    return nearest;
}

} // namespace abut
