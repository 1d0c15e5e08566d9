#pragma once

#include <abut/model.h>

#include "geometry/far_view.h"
#include "math/rounding.h"
#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "tree/traverse_one.h"

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace abut {

/// The part of a world segment that lies near a model.
struct ClippedSegment {
    TreeSegment segment;
    double begin, end; ///< as fractions of the whole segment
};

/// One model under its transform, prepared for queries with points, segments and boxes in world
/// coordinates. Immutable and safe for concurrent use.
///
/// With an `origin`, that point is subtracted from all world positions: "the world" below has its
/// zero there. If models and origin are moved together, and no position is rounded by that, every
/// answer is the same to the last bit.
class PlacedModel {
public:
    /// A transform without an inverse (a flattened part) is first applied to a copy of the mesh.
    ///
    /// Errors      Error{bad_argument} if the transform is not finite; Error{bad_mesh} if such a
    ///             copy has positions out of range.
    PlacedModel(const Model& model, const Transform& world_from_model,
                const std::optional<Vec3>& origin = {});

    /// The model that owns the tree, under world(): the given one, or its transformed copy. Both
    /// have the same triangles.
    [[nodiscard]] const Model& model() const { return model_; }
    [[nodiscard]] const ModelData& data() const { return model_.data(); }
    [[nodiscard]] const Transform& world() const { return world_; }
    [[nodiscard]] const Vec3& origin() const { return origin_; }
    [[nodiscard]] Vec3 world_vertex(std::uint32_t vertex) const {
        return apply(world_, data().mesh().positions[vertex]) - origin_;
    }
    [[nodiscard]] Triangle world_triangle(std::uint32_t triangle) const {
        return seen(data().world_triangle(triangle, world_));
    }
    [[nodiscard]] Triangle world_slot(std::uint32_t slot) const {
        return seen(data().world_slot(slot, world_));
    }
    [[nodiscard]] const Transform& world_from_tree() const { return world_from_tree_; }
    [[nodiscard]] const Transform& tree_from_world() const { return tree_from_world_; }
    /// No vector of the tree's frame is stretched by more than this factor.
    [[nodiscard]] double most_stretch() const { return most_stretch_; }
    /// The centre: no point of the model is farther from it than reach().
    [[nodiscard]] Vec3 middle() const {
        return {world_from_tree_.m[9], world_from_tree_.m[10], world_from_tree_.m[11]};
    }
    [[nodiscard]] double reach() const { return reach_; }

    /// The part of a segment that may meet the model, in the tree's frame; none if no part may.
    /// `error`: how far either end may be off, in world units.
    [[nodiscard]] std::optional<ClippedSegment> tree_segment(const Vec3& from, const Vec3& to,
                                                             double error = 0) const;

    /// Calls visit(slot) for every triangle that may meet a world box.
    template <typename Visit>
    void for_each_overlap(const Box3& box, const Visit& visit) const;
    /// Calls visit(slot) for every triangle that may come within `distance` of the convex hull of some
    /// world points. Skips more than with their world box, because faces are often parallel to the
    /// model's axes.
    template <typename Visit>
    void for_each_near_hull(std::span<const Vec3> points, double distance,
                            const Visit& visit) const;

    /// The half-space in front of a plane through a point. Empty if the normal is zero.
    struct HalfSpace {
        Vec3 point, normal;
    };
    /// Calls visit(slot) for triangles that may meet a world box. visit returns a half-space; many
    /// of the triangles inside it are skipped from then on.
    template <typename Visit>
    void for_each_overlap_outside(const Box3& box, const Visit& visit) const;

    /// Calls visit(slot) for every triangle that may meet a segment.
    template <typename Visit>
    void for_each_on_segment(const Vec3& from, const Vec3& to, const Visit& visit) const;

    /// Calls visit(slot) for triangles, the nearest box first. visit returns the squared distance
    /// beyond which triangles do not matter, or kStopTraversal.
    ///
    /// From a point that is 1e5 times as far away as the model is large, triangles that are as near as
    /// the nearest one to the rounding of the coordinates may be left out.
    template <typename Visit>
    void for_each_near(const Vec3& point, double bound_sq, const Visit& visit) const;

    /// The triangle with the smallest index that the point lies on. Exact.
    [[nodiscard]] std::optional<std::uint32_t> triangle_at(const Vec3& point) const;
    /// Returns whether the point lies on the surface. Exact.
    [[nodiscard]] bool on_surface(const Vec3& point) const {
        return triangle_at(point).has_value();
    }

private:
    /// Prepares the tree's frame. Returns false if the transform leaves none that is usable.
    bool make_frame(bool has_origin);
    void move_to_origin();
    [[nodiscard]] Aabb tree_box(const Box3& box) const;
    [[nodiscard]] Aabb tree_box(std::span<const Vec3> points, double distance) const;
    /// Returns whether boxes in single precision, in the tree's frame, do not tell which one is nearer
    /// to a point: it is far away, or at some distance under a transform that stretches one direction more
    /// than another, so that a distance in the tree's frame says little.
    [[nodiscard]] bool is_far(const Vec3& point) const {
        constexpr double kUneven = 1 + 0x1p-10, kFar = 16, kFarUneven = 1;
        const bool is_even = most_stretch_ <= kUneven * least_stretch_;
        return !data().tree().empty() &&
               max_abs(point - middle()) > (is_even ? kFar : kFarUneven) * reach_;
    }
    template <typename Visit>
    void for_each_near_far(const Vec3& point, double bound_sq, const Visit& visit) const;
    [[nodiscard]] TreeHalfSpace tree_half_space(const HalfSpace& space) const;
    /// Bounds the error in single precision, in the tree's frame, of a world point near the model.
    /// `size`: of the world coordinates that the point was computed from.
    [[nodiscard]] double margin(double size) const {
        return 64 * 0x1p-24 * 4 * half_ + 128 * 0x1p-53 * (world_extent_ + size) / least_stretch_ +
               origin_margin_;
    }
    [[nodiscard]] Triangle seen(const Triangle& t) const {
        return {t[0] - origin_, t[1] - origin_, t[2] - origin_};
    }

    Model model_;
    Transform world_;
    Vec3 origin_;
    Transform world_from_tree_, tree_from_world_;
    double least_stretch_ = 0, most_stretch_ = 0;
    double half_ = 0;         ///< largest coordinate of the tree's box
    double reach_ = 0;        ///< the model's largest distance from the tree's origin
    double world_extent_ = 0; ///< bounds the model's world coordinates
    /// The part of the margin for the rounding of positions from which the origin was subtracted,
    /// in the tree's frame.
    double origin_margin_ = 0;
};

inline double magnitude(const Vec3& p) {
    return std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
}

template <typename Visit>
void PlacedModel::for_each_overlap(const Box3& box, const Visit& visit) const {
    abut::for_each_overlap(data().tree(), tree_box(box), visit);
}

template <typename Visit>
void PlacedModel::for_each_near_hull(std::span<const Vec3> points, double distance,
                                     const Visit& visit) const {
    abut::for_each_overlap(data().tree(), tree_box(points, distance), visit);
}

template <typename Visit>
void PlacedModel::for_each_overlap_outside(const Box3& box, const Visit& visit) const {
    TreeHalfSpaces outside;
    std::size_t latest = 0;
    abut::for_each_overlap(data().tree(), tree_box(box), outside, [&](std::uint32_t slot) {
        const HalfSpace space = visit(slot);
        if (space.normal == Vec3{})
            return;
        // The latest half-spaces replace the oldest.
        if (outside.size() < outside.capacity())
            outside.emplace_back();
        outside[latest++ % outside.capacity()] = tree_half_space(space);
    });
}

template <typename Visit>
void PlacedModel::for_each_on_segment(const Vec3& from, const Vec3& to, const Visit& visit) const {
    if (const auto segment = tree_segment(from, to))
        abut::for_each_on_segment(data().tree(), segment->segment, visit);
}

template <typename Visit>
void PlacedModel::for_each_near_far(const Vec3& point, double bound_sq, const Visit& visit) const {
    struct Entry {
        double distance = 0;
        std::uint32_t name = kRootName;
        bool operator<(const Entry& other) const { return distance > other.distance; }
    };
    const FarView view(point, world_from_tree_, world_extent_ + magnitude(point));
    const std::vector<Box3>& boxes = data().tree_boxes();
    const double at_first = std::sqrt(bound_sq);
    double bound = at_first;
    // Before a triangle is found, none within the bound may be left out.
    constexpr double kAllEqual = 1e5;
    const bool leaves_equal_out = max_abs(point - middle()) > kAllEqual * reach_;
    const auto is_beyond = [&](double distance) {
        return leaves_equal_out && bound < at_first ? distance + view.rounding() >= bound
                                                    : distance - view.rounding() > bound;
    };
    boost::container::small_vector<Entry, 128> heap{Entry{}};
    SearchSteps steps;
    while (!heap.empty() && !is_beyond(heap.front().distance)) {
        steps.take();
        std::pop_heap(heap.begin(), heap.end());
        const NodeRef ref = data().tree().named(heap.back().name);
        heap.pop_back();
        for (std::uint32_t i = 0; ref.is_leaf() && i < ref.count(); ++i) {
            const double sq = visit(ref.first() + i);
            if (sq < 0)
                return;
            bound = std::sqrt(sq);
        }
        for (std::uint32_t lane = 0; !ref.is_leaf() && lane < Node::kWidth; ++lane) {
            if (data().tree().nodes[ref.index()].child[lane].is_none())
                break;
            const std::uint32_t name = child_name(ref.index(), lane);
            const double distance = view.distance(boxes[name]);
            if (is_beyond(distance))
                continue;
            heap.push_back({distance, name});
            std::push_heap(heap.begin(), heap.end());
        }
    }
}

template <typename Visit>
void PlacedModel::for_each_near(const Vec3& point, double bound_sq, const Visit& visit) const {
    if (is_far(point))
        return for_each_near_far(point, bound_sq, visit);
    const auto tree_bound_sq = [&](double world_sq) {
        if (world_sq < 0)
            return static_cast<float>(kStopTraversal);
        const double d = std::sqrt(world_sq) / least_stretch_;
        return round_up(d * d * (1 + 0x1p-20));
    };
    const Vec3 p = apply(tree_from_world_, point);
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    // Squares must stay finite in single precision.
    if (!(largest < 1e18)) {
        for (std::uint32_t slot = 0; slot < data().mesh().triangles.size(); ++slot)
            if (visit(slot) < 0)
                return;
        return;
    }
    abut::for_each_near(data().tree(), {to_float(p.x), to_float(p.y), to_float(p.z)},
                        round_up(margin(magnitude(point)) + 16 * 0x1p-24 * largest),
                        tree_bound_sq(bound_sq),
                        [&](std::uint32_t slot) { return tree_bound_sq(visit(slot)); });
}

} // namespace abut
