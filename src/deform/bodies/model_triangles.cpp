#include "deform/bodies/model_triangles.h"

#include "core/stop.h"
#include "geometry/triangle_triangle_distance.h"
#include "math/rounding.h"
#include "math/transform.h"
#include "tree/obb_tree.h"
#include "volume/float_vector.h"

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>

namespace abut {

namespace {

using Lanes = std::array<float, Node::kWidth>;

/// The extent of a triangle along a unit vector.
struct Extent {
    Vec3 direction;
    double least = 0, most = 0;

    Extent() = default;
    Extent(const Vec3& along, const Triangle& t) : direction(along) {
        const auto [low, high] =
            std::minmax({dot(along, t[0]), dot(along, t[1]), dot(along, t[2])});
        least = low, most = high;
    }
    /// How far another triangle lies beyond it, on either side; negative if their extents overlap.
    [[nodiscard]] double gap(const Triangle& other) const {
        const Extent of_other(direction, other);
        return std::max(of_other.least - most, least - of_other.most);
    }
};

Box3 box_of(const Triangle& t) {
    return {min(min(t[0], t[1]), t[2]), max(max(t[0], t[1]), t[2])};
}

/// The squared distance of two boxes.
double gap_sq(const Box3& a, const Box3& b) {
    return length_sq(max(max(a.lower - b.upper, b.lower - a.upper), Vec3{}));
}

/// A triangle in the frame of a model's tree, with what bounds its distance from boxes.
class TriangleInTree {
public:
    /// In          margin: how far a coordinate may be off, in the tree's units.
    TriangleInTree(const Triangle& t, float margin)
        : corners_(t), across_(normalized_or_zero(cross(t[1] - t[0], t[2] - t[0])), t),
          margin_(margin) {}

    /// Another direction along which boxes may be farther away.
    void set_direction(const Vec3& direction) { towards_ = Extent(direction, corners_); }

    /// Lower bounds of the distance from a node's children.
    [[nodiscard]] Lanes distances(const Node& node) const {
        Lanes bounds = box_distances(node);
        raise(bounds, node, across_);
        raise(bounds, node, towards_);
        // A distance in a node's frame may be longer by the rounding of its axes.
        for (float& bound : bounds)
            bound = std::max(0.0F, bound * (1 - 0x1p-18F) - margin_);
        return bounds;
    }

private:
    [[nodiscard]] Lanes box_distances(const Node& node) const {
        Box3 box;
        for (const Vec3& corner : corners_)
            extend(box, node.frame.point_from_tree(corner));
        const std::array<float, 3> low = to_float(box.lower), high = to_float(box.upper);
        Lanes sums{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < Node::kWidth; ++i) {
                const float gap =
                    std::max(0.0F, std::max(node.lower[k][i] - high[k], low[k] - node.upper[k][i]));
                sums[i] += gap * gap;
            }
        for (float& sum : sums)
            sum = std::sqrt(sum);
        return sums;
    }
    /// Raises the bounds to the gaps along a direction.
    static void raise(Lanes& bounds, const Node& node, const Extent& extent) {
        if (extent.direction == Vec3{})
            return;
        const std::array<float, 3> n = node.frame.vector_from_tree(to_float(extent.direction));
        const auto& o = node.frame.origin;
        const double at_origin = dot(extent.direction, Vec3{o[0], o[1], o[2]});
        const float least = to_float(extent.least - at_origin),
                    most = to_float(extent.most - at_origin);
        Lanes low{}, high{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < Node::kWidth; ++i) {
                const float at_lower = n[k] * node.lower[k][i], at_upper = n[k] * node.upper[k][i];
                low[i] += std::min(at_lower, at_upper);
                high[i] += std::max(at_lower, at_upper);
            }
        for (std::size_t i = 0; i < Node::kWidth; ++i)
            bounds[i] = std::max(bounds[i], std::max(low[i] - most, least - high[i]));
    }

    Triangle corners_;
    Extent across_;  ///< along the normal
    Extent towards_; ///< along set_direction; its direction is zero without one
    float margin_;
};

/// The nearest triangle so far, in the world.
class NearestSoFar {
public:
    NearestSoFar(const Triangle& t, double limit)
        : triangle_(t), box_(box_of(t)),
          across_(normalized_or_zero(cross(t[1] - t[0], t[2] - t[0])), t), least_(limit) {}

    /// Returns whether the triangle is the nearest one so far.
    bool take(const Triangle& other, std::uint32_t number) {
        // A gap along a direction is off by the rounding of coordinates.
        const double rounding =
            0x1p-48 * (sum_of_sizes(other[0]) + sum_of_sizes(triangle_[0]) + least_);
        const double beyond = least_ + rounding;
        if (gap_sq(box_, box_of(other)) > beyond * beyond || across_.gap(other) > beyond ||
            towards_.gap(other) > beyond)
            return false;
        const ClosestPoints closest = triangle_triangle_distance(triangle_, other);
        const double distance = std::sqrt(closest.distance_sq);
        if (distance > least_ || (found_ && distance == least_ && number > found_->triangle))
            return false;
        least_ = distance;
        found_ = ModelTriangles::Found{closest, number};
        towards_ = Extent(normalized_or_zero(closest.b - closest.a), triangle_);
        return true;
    }
    [[nodiscard]] double least() const { return least_; }
    [[nodiscard]] bool meets() const { return found_ && least_ == 0; }
    [[nodiscard]] const Vec3& towards() const { return towards_.direction; }
    [[nodiscard]] const std::optional<ModelTriangles::Found>& found() const { return found_; }

private:
    const Triangle& triangle_;
    Box3 box_;
    Extent across_, towards_;
    double least_;
    std::optional<ModelTriangles::Found> found_;
};

/// A node or leaf that waits. The nearest comes first; of equally near ones, the one that was added
/// last, so that a triangle which passes through the model comes to a leaf soon.
struct Waiting {
    float bound = 0;
    std::uint32_t serial = 0;
    NodeRef ref;

    bool operator<(const Waiting& other) const {
        return bound > other.bound || (bound == other.bound && serial < other.serial);
    }
};

} // namespace

ModelTriangles::ModelTriangles(const Model& model, const Transform& world_from_model)
    : placed_(model, world_from_model),
      least_stretch_(stretch_of(placed_.world_from_tree()).least) {
    const Aabb& bounds = placed_.data().tree().bounds;
    if (!placed_.data().tree().empty())
        for (std::size_t k = 0; k < 3; ++k)
            half_ = std::max(
                {half_, std::abs(double{bounds.lower[k]}), std::abs(double{bounds.upper[k]})});
}

std::optional<ModelTriangles::Found> ModelTriangles::nearest_to(const Triangle& t, double limit,
                                                                Work* work) const {
    const Tree& tree = placed_.data().tree();
    if (tree.empty())
        return std::nullopt;
    Triangle in_tree;
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        in_tree[i] = apply(placed_.tree_from_world(), t[i]);
        size = std::max(size, sum_of_sizes(t[i]));
    }
    // The rounding of boxes and axes in single precision, and that of world coordinates.
    const double world = sum_of_sizes(placed_.middle()) + placed_.reach() + size;
    TriangleInTree query(in_tree, round_up(0x1p-16 * half_ + 0x1p-45 * world / least_stretch_));
    NearestSoFar nearest(t, limit);
    const auto in_tree_units = [&](double distance) {
        return round_up(distance / least_stretch_ * (1 + 0x1p-40));
    };
    float bound = in_tree_units(limit);
    boost::container::small_vector<Waiting, 128> heap{{0, 0, NodeRef::node(0)}};
    std::uint32_t serial = 0;
    Work done;
    const auto visit_leaf = [&](NodeRef leaf) {
        for (std::uint32_t slot = leaf.first(); slot < leaf.first() + leaf.count(); ++slot) {
            ++done.triangles;
            if (!nearest.take(placed_.world_slot(slot), placed_.data().triangle_at(slot)))
                continue;
            bound = in_tree_units(nearest.least());
            query.set_direction(
                normalized_or_zero(apply_linear(placed_.tree_from_world(), nearest.towards())));
        }
    };
    const auto open = [&](const Node& node) {
        ++done.nodes;
        const Lanes distances = query.distances(node);
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i) {
            if (!(distances[i] <= bound))
                continue;
            heap.push_back({distances[i], ++serial, node.child[i]});
            std::push_heap(heap.begin(), heap.end());
        }
    };
    SearchSteps steps;
    while (!heap.empty() && heap.front().bound <= bound && !nearest.meets()) {
        steps.take();
        std::pop_heap(heap.begin(), heap.end());
        const NodeRef ref = heap.back().ref;
        heap.pop_back();
        if (ref.is_leaf())
            visit_leaf(ref);
        else
            open(tree.nodes[ref.index()]);
    }
    if (work != nullptr)
        work->nodes += done.nodes, work->triangles += done.triangles;
    return nearest.found();
}

} // namespace abut
