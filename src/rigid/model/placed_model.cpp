#include "rigid/model/placed_model.h"

#include "geometry/triangle_triangle_intersect.h"
#include "volume/float_vector.h"

#include <utility>

namespace abut {

namespace {

/// The range of s in [0, 1] in which p + s d may lie within `half` of the origin on every axis.
std::pair<double, double> clip_to_cube(const Vec3& p, const Vec3& d, double half) {
    double begin = 0, end = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double c = component(p, axis), e = component(d, axis);
        if (e == 0) {
            if (std::abs(c) > half)
                end = -1;
            continue;
        }
        const double s = (-half - c) / e, t = (half - c) / e;
        begin = std::max(begin, std::min(s, t)), end = std::min(end, std::max(s, t));
    }
    return {begin, end};
}

} // namespace

PlacedModel::PlacedModel(const Model& model, const Transform& world_from_model,
                         const std::optional<Vec3>& origin)
    : model_(model), world_(world_from_model), origin_(origin.value_or(Vec3{})) {
    require_finite(world_from_model, "transform");
    if (make_frame(origin.has_value()))
        return;
    // The copy has the same positions, by the same formula; the identity keeps them.
    model_ = baked(model, world_);
    world_ = {};
    make_frame(origin.has_value());
}

bool PlacedModel::make_frame(bool has_origin) {
    // Beyond these, cubes of terms in the inverse leave the range of doubles; or one direction is
    // so much shorter than another that rounding hides it.
    constexpr double kLeastStretch = 0x1p-300, kMostStretch = 0x1p300, kLeastRatio = 0x1p-30;
    world_from_tree_ = compose(world_, data().model_from_tree());
    tree_from_world_ = inverse(world_from_tree_);
    const auto [least, most] = stretch_of(world_from_tree_);
    least_stretch_ = least, most_stretch_ = most;
    half_ = 0;
    if (!data().tree().empty())
        for (std::size_t k = 0; k < 3; ++k)
            half_ = std::max({half_, std::abs(double{data().tree().bounds.lower[k]}),
                              std::abs(double{data().tree().bounds.upper[k]})});
    reach_ = most_stretch_ * 2 * half_;
    world_extent_ = magnitude(middle()) + reach_;
    if (has_origin)
        move_to_origin();
    return data().tree().empty() ||
           (least_stretch_ > kLeastStretch && most_stretch_ < kMostStretch &&
            least_stretch_ > kLeastRatio * most_stretch_ && margin(0) < 1e18);
}

/// Places the tree's frame relative to the origin, by a vertex whose positions in both frames are
/// known without the rounding of far places.
void PlacedModel::move_to_origin() {
    // `least` is far below the margin of single precision, and far above the rounding of world
    // positions unless these are 2^27 times as far away as the model is large. So the margin is the
    // same wherever the model is.
    const double least = 0x1p-18 * half_,
                 needed = 128 * 0x1p-53 * (world_extent_ + magnitude(origin_)) / least_stretch_;
    origin_margin_ = std::max(least, needed);
    if (data().tree().empty())
        return;
    const Vec3 to_first = apply_linear(world_from_tree_, data().first_in_tree());
    const Vec3 middle = world_slot(0)[0] - to_first;
    world_from_tree_.m[9] = middle.x, world_from_tree_.m[10] = middle.y;
    world_from_tree_.m[11] = middle.z;
    tree_from_world_ = inverse(world_from_tree_);
    world_extent_ = magnitude(middle) + reach_;
}

Aabb PlacedModel::tree_box(const Box3& box) const {
    const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper, half = 0.5 * box.upper - 0.5 * box.lower;
    const Vec3 p = apply(tree_from_world_, middle);
    const auto& m = tree_from_world_.m;
    const Vec3 h{std::abs(m[0]) * half.x + std::abs(m[3]) * half.y + std::abs(m[6]) * half.z,
                 std::abs(m[1]) * half.x + std::abs(m[4]) * half.y + std::abs(m[7]) * half.z,
                 std::abs(m[2]) * half.x + std::abs(m[5]) * half.y + std::abs(m[8]) * half.z};
    return Aabb({p - h, p + h}, margin(magnitude(middle) + magnitude(half)));
}

Aabb PlacedModel::tree_box(std::span<const Vec3> points, double distance) const {
    Box3 box;
    double size = 0;
    for (const Vec3& point : points) {
        extend(box, apply(tree_from_world_, point));
        size = std::max(size, magnitude(point));
    }
    return Aabb(grown(box, distance / least_stretch_), margin(size));
}

TreeHalfSpace PlacedModel::tree_half_space(const HalfSpace& space) const {
    const Vec3 normal =
        normalized_or_zero(pull_back(world_from_tree_, normalized_or_zero(space.normal)));
    if (normal == Vec3{})
        return {{}, std::numeric_limits<float>::infinity()};
    // The margin of a point also covers the sums of products in a node's frame; doubled, since axes
    // are perpendicular only to single precision.
    const double offset = dot(normal, apply(tree_from_world_, space.point));
    return {to_float(normal), round_up(offset + 2 * margin(magnitude(space.point)))};
}

std::optional<ClippedSegment> PlacedModel::tree_segment(const Vec3& from, const Vec3& to,
                                                        double error) const {
    const double margin = this->margin(magnitude(from) + magnitude(to)) + error / least_stretch_;
    // If the margin exceeds the model's size, any of its triangles may be met. Squares must stay
    // finite.
    if (!(margin <= half_))
        return ClippedSegment{{{}, {}, round_up(2 * half_)}, 0, 1};
    const Vec3 p = apply(tree_from_world_, from), d = apply(tree_from_world_, to) - p;
    const auto [begin, end] = clip_to_cube(p, d, half_ + 2 * margin);
    if (!(begin <= end))
        return std::nullopt;
    const Vec3 q = p + begin * d, r = p + end * d;
    return ClippedSegment{
        {to_float(0.5 * (q + r)), to_float(0.5 * (r - q)), round_up(margin)}, begin, end};
}

std::optional<std::uint32_t> PlacedModel::triangle_at(const Vec3& point) const {
    const Triangle as_triangle{point, point, point};
    std::optional<std::uint32_t> least;
    for_each_overlap({point, point}, [&](std::uint32_t slot) {
        const std::uint32_t triangle = data().triangle_at(slot);
        if ((!least || triangle < *least) &&
            triangle_triangle_intersect(as_triangle, world_slot(slot)) != TriangleContact::none)
            least = triangle;
    });
    return least;
}

} // namespace abut
