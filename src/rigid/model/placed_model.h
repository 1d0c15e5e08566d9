#pragma once

#include <abut/model.h>

#include "math/rounding.h"
#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "tree/traverse_one.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace abut {

/// The part of a segment of the world that lies near a model.
struct ClippedSegment {
    TreeSegment segment;
    double begin, end; ///< where it begins and ends: fractions of the whole
};

/// One model under its transform, ready for questions with points, segments and boxes of the world.
/// Immutable: any number of threads may ask.
///
/// It may be seen from an `origin`, which is taken off all of its world positions: in what follows
/// "the world" then has its zero there. If models, origin and all are moved together, and no position
/// is rounded by that, every answer is the same to the last bit.
class PlacedModel {
public:
    /// A transform without an inverse (a flattened part) is applied to a copy of the mesh first.
    ///
    /// Errors      Error{bad_argument} if the transform is not finite; Error{bad_mesh} if such a
    ///             copy has positions out of range.
    PlacedModel(const Model& model, const Transform& world_from_model,
                const std::optional<Vec3>& origin = {});

    /// The model that the tree is of, under world(): the one given, or its transformed copy. Both
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
    /// No vector of the tree's frame becomes longer than this times its length.
    [[nodiscard]] double most_stretch() const { return most_stretch_; }
    /// No point of the model is farther than reach() from here.
    [[nodiscard]] Vec3 middle() const {
        return {world_from_tree_.m[9], world_from_tree_.m[10], world_from_tree_.m[11]};
    }
    [[nodiscard]] double reach() const { return reach_; }

    /// The part of a segment that may meet the model, in the tree's frame; nothing if none may.
    /// `error`: how far either end may be off, world units.
    [[nodiscard]] std::optional<ClippedSegment> tree_segment(const Vec3& from, const Vec3& to,
                                                             double error = 0) const;

    /// Calls visit(slot) for every triangle that may meet a box of the world.
    template <typename Visit>
    void for_each_overlap(const Box3& box, const Visit& visit) const;

    /// What is in front of a plane through a point. One without a normal holds nothing.
    struct HalfSpace {
        Vec3 point, normal;
    };
    /// Calls visit(slot) for triangles that may meet a box of the world. It returns a half-space: many
    /// of the triangles there are left out from then on.
    template <typename Visit>
    void for_each_overlap_outside(const Box3& box, const Visit& visit) const;

    /// Calls visit(slot) for every triangle that may meet a segment.
    template <typename Visit>
    void for_each_on_segment(const Vec3& from, const Vec3& to, const Visit& visit) const;

    /// Calls visit(slot) for triangles, nearest box to the point first; visit returns the squared
    /// distance beyond which nothing matters any more; a negative one ends it.
    template <typename Visit>
    void for_each_near(const Vec3& point, double bound_sq, const Visit& visit) const;

    /// The triangle of least index that the point lies on. Exact.
    [[nodiscard]] std::optional<std::uint32_t> triangle_at(const Vec3& point) const;
    /// Whether the point lies on the surface. Exact.
    [[nodiscard]] bool on_surface(const Vec3& point) const {
        return triangle_at(point).has_value();
    }

private:
    /// Prepares the tree's frame; false if the transform leaves none to work in.
    bool make_frame(bool has_origin);
    void move_to_origin();
    [[nodiscard]] Aabb tree_box(const Box3& box) const;
    [[nodiscard]] TreeHalfSpace tree_half_space(const HalfSpace& space) const;
    /// What a world point near the model may be off by in the tree's frame in single precision;
    /// `size`: of the world coordinates that it was computed from.
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
    double half_ = 0;          ///< largest coordinate of the tree's box
    double reach_ = 0;         ///< no point of the model is farther from the tree's origin
    double world_extent_ = 0;  ///< bounds the model's world coordinates
    double origin_margin_ = 0; ///< the part of the margin for the rounding of positions that the
                               ///< origin was taken off; in the tree's frame
};

inline double magnitude(const Vec3& p) {
    return std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
}

template <typename Visit>
void PlacedModel::for_each_overlap(const Box3& box, const Visit& visit) const {
    abut::for_each_overlap(data().tree(), tree_box(box), visit);
}

template <typename Visit>
void PlacedModel::for_each_overlap_outside(const Box3& box, const Visit& visit) const {
    TreeHalfSpaces outside;
    std::size_t latest = 0;
    abut::for_each_overlap(data().tree(), tree_box(box), outside, [&](std::uint32_t slot) {
        const HalfSpace space = visit(slot);
        if (space.normal == Vec3{})
            return;
        // The latest ones replace the oldest.
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
void PlacedModel::for_each_near(const Vec3& point, double bound_sq, const Visit& visit) const {
    const auto tree_bound_sq = [&](double world_sq) {
        if (world_sq < 0)
            return -1.0F;
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
