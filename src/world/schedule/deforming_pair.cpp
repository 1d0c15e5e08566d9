#include "world/schedule/deforming_pair.h"

#include "geometry/triangle_triangle_intersect.h"
#include "math/transform.h"
#include "rigid/motion/motion_bounds.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Rounding error of a length, relative to the quantities it was computed from.
constexpr double kStepRounding = 0x1p-44;
/// Error of a box that is transformed from a node's axes to its tree's, relative to its
/// coordinates. The axes are orthogonal only to single precision.
constexpr double kNodeRounding = 0x1p-19;

Box3 widened(const Aabb& box, double margin) {
    return grown(Box3{{box.lower[0], box.lower[1], box.lower[2]},
                      {box.upper[0], box.upper[1], box.upper[2]}},
                 margin);
}

Transform tree_from_node(const NodeFrame& frame) {
    Transform t;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column)
            t.m[3 * column + row] = frame.turn[row][column];
        t.m[9 + row] = frame.origin[row];
    }
    return t;
}

Motion turning(Motion motion) {
    motion.velocity = {};
    return motion;
}

double half_diagonal(const Box3& box) {
    return 0.5 * length(box.upper - box.lower);
}

Vec3 place(const MovingVertex& vertex, double time) {
    return (1 - time) * vertex.start + time * vertex.end;
}

double farthest_from(const Vec3& centre, const Triangle& triangle) {
    return std::max(
        {length(triangle[0] - centre), length(triangle[1] - centre), length(triangle[2] - centre)});
}

} // namespace

DeformingPair::DeformingPair(const DeformableData& deformable, const MovingBody& body)
    : a_(deformable), b_(offset_surface_of(body.shape)),
      is_model_(std::holds_alternative<Model>(body.shape) ||
                std::holds_alternative<ConvexShape>(body.shape)),
      moving_(body.motion), turning_(turning(body.motion)), velocity_(body.motion.velocity) {
    Box3 surface, step;
    for (const MovingVertex& vertex : deformable.vertices) {
        extend(surface, vertex.start);
        extend(step, vertex.start), extend(step, vertex.end);
    }
    const Box3 start = bounds_of(body.shape, body.own_bounds, turning_.start());
    size_ = std::min(half_diagonal(surface), half_diagonal(start));
    double scale = max_abs(velocity_) + max_abs(body.motion.centre);
    for (const Box3& box : {step, start})
        scale += max_abs(box.lower) + max_abs(box.upper);
    margin_ = kStepRounding * scale;
}

std::span<const std::uint32_t> DeformingPair::triangles_a(NodeRef leaf) const {
    const std::uint32_t number = leaf_number(leaf);
    return {a_.swept.leaves.faces.ids(number), a_.swept.leaves.faces.count(number)};
}

Box3 DeformingPair::box_a(std::uint32_t name, double time) const {
    const MovingTree& tree = tree_a();
    const MovingBox moving = name == kRootName
                                 ? moving_tree::bounds_of(tree.nodes[0])
                                 : moving_tree::box_of(tree.nodes[node_of(name)], lane_of(name));
    const Box3 start = widened(moving.start, margin_), end = widened(moving.end, margin_);
    return {place({start.lower, end.lower}, time) - shift(time),
            place({start.upper, end.upper}, time) - shift(time)};
}

Box3 DeformingPair::box_b(std::uint32_t name, const TimeRange& range) const {
    const ModelData& data = b_.surface.data();
    Transform surface_from_box = data.model_from_tree();
    Box3 own = widened(data.tree().bounds, 0);
    if (name != kRootName) {
        const Node& node = data.tree().nodes[node_of(name)];
        surface_from_box = compose(surface_from_box, tree_from_node(node.frame));
        own = widened(node.box(lane_of(name)), kNodeRounding * double{node.reach});
    }
    const double half = 0.5 * (range.end - range.begin);
    const Transform middle = compose(turning_.at(range.begin + half), b_.body_from_surface);
    const Box3 box = placed_bounds(own, compose(middle, surface_from_box));
    const Vec3 centre = turning_.centre(0);
    const double reach = length(max(max(box.lower - centre, centre - box.lower),
                                    max(box.upper - centre, centre - box.upper)));
    // A point moves by at most the arc of its rotation, and by at most the diameter of its sphere.
    const double turned = std::min(half * turning_.speed_of_rotation(), 2.0) * reach;
    return grown(box, turned + b_.radius + margin_);
}

Triangle DeformingPair::triangle_a(std::uint32_t triangle, double time) const {
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = place(a_.vertices[a_.triangles[triangle][i]], time) - shift(time);
    return corners;
}

Triangle DeformingPair::triangle_b(std::uint32_t slot, double time) const {
    return b_.surface.data().world_slot(slot, compose(turning_.at(time), b_.body_from_surface));
}

double DeformingPair::free_time(std::uint32_t triangle_a, const Triangle& a, const Triangle& b,
                                const ClosestPoints& closest, double time, double tolerance) const {
    const double distance = std::sqrt(closest.distance_sq), taken = margin_ + 0.5 * tolerance;
    const Vec3 n = normalized_or_zero(closest.b - closest.a), w = turning_.angular_velocity();
    const double rate = turning_.speed_of_rotation();
    const double reach = farthest_from(turning_.centre(time), b) + margin_;
    double low = HUGE_VAL, high = -HUGE_VAL, way_a = -HUGE_VAL, way_b = -HUGE_VAL, most_a = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const MovingVertex& vertex = a_.vertices[a_.triangles[triangle_a][i]];
        const Vec3 way = vertex.end - vertex.start - velocity_;
        high = std::max(high, dot(a[i] - closest.a, n));
        low = std::min(low, dot(b[i] - closest.a, n));
        way_a = std::max(way_a, dot(way, n));
        way_b = std::max(way_b, -dot(turning_.velocity_at(b[i], time), n));
        most_a = std::max(most_a, length(way));
    }
    // Projected onto n, a ends at `high` and b begins at `low`.
    Approach along;
    along.gap = low - high - b_.radius - taken;
    along.closing = way_a + way_b + margin_;
    along.bend = rate * rate * reach;
    along.fastest = way_a + reach * length(cross(w, n)) + margin_;
    const double any = (distance - b_.radius - taken) / (most_a + rate * reach + margin_);
    return std::max(abut::free_time(along), (1 - kStepRounding) * any);
}

bool DeformingPair::meet(std::uint32_t triangle_a, std::uint32_t slot, double time) const {
    Triangle a;
    for (std::size_t i = 0; i < 3; ++i)
        a[i] = place(a_.vertices[a_.triangles[triangle_a][i]], time);
    const Triangle b =
        b_.surface.data().world_slot(slot, compose(moving_.at(time), b_.body_from_surface));
    if (b_.radius == 0)
        return triangle_triangle_intersect(a, b) != TriangleContact::none;
    return std::sqrt(triangle_triangle_distance(a, b).distance_sq) <= b_.radius;
}

std::uint32_t DeformingPair::number_b(std::uint32_t slot) const {
    return is_model_ ? b_.surface.data().triangle_at(slot) : 0;
}

} // namespace abut
