#pragma once

#include "math/vector.h"
#include "rigid/model/placed_model.h"
#include "rigid/model/solid.h"

#include <array>
#include <cstdint>

namespace abut {

/// One of the two models whose manifolds are computed.
///
/// Frame       the world, with an origin near the contacts.
class ManifoldSide {
public:
    /// In          a transform with an inverse.
    ManifoldSide(const Model& model, const Transform& world_from_model, const Vec3& origin);

    [[nodiscard]] const PlacedModel& model() const { return model_; }
    [[nodiscard]] Triangle triangle(std::uint32_t index) const {
        return model_.world_triangle(index);
    }
    /// The merged vertices of a triangle.
    [[nodiscard]] std::array<std::uint32_t, 3> vertices(std::uint32_t triangle) const {
        const auto& t = model_.data().mesh().triangles[triangle];
        const auto& vertex_of = solid_.topology.vertex_of;
        return {vertex_of[t[0]], vertex_of[t[1]], vertex_of[t[2]]};
    }
    /// Whether normals tell the inside from the outside.
    [[nodiscard]] bool is_oriented() const { return facing_ != 0; }
    /// -1 if the triangles' normals point in; else +1.
    [[nodiscard]] double facing() const { return facing_ < 0 ? -1 : 1; }

    /// A point where a line leaves or enters the model.
    struct LineHit {
        bool found = false;
        double height = 0; ///< along the direction, from the line's start
        std::uint32_t triangle = 0;
    };
    /// Returns the height, along a direction, at which the part of the model around or below a
    /// point ends: the first surface ahead if the point lies inside, else the first one behind. A
    /// triangle that is parallel to the direction to 2^-20 counts as missed.
    ///
    /// In          direction: a unit vector.
    [[nodiscard]] LineHit top_along(const Vec3& point, const Vec3& direction) const;

    /// A triangle that a ray meets.
    struct SurfaceHit {
        bool found = false;
        double height = 0;
        bool leaves = false; ///< the ray passes from the inside to the outside
        std::uint32_t slot = 0;
    };
    /// Replaces a hit by that of the triangle at a slot, as it lies in the world, if the ray meets that
    /// earlier. Returns whether it did.
    bool take_earlier(std::uint32_t slot, const Triangle& triangle, const Vec3& point,
                      const Vec3& direction, SurfaceHit& hit) const;
    /// As `top_along`, where first_hit(point, direction) finds the first hit of a ray.
    template <typename FirstHit>
    [[nodiscard]] LineHit top_along(const Vec3& point, const Vec3& direction,
                                    const FirstHit& first_hit) const {
        const SurfaceHit ahead = first_hit(point, direction);
        if (ahead.found && ahead.leaves)
            return {true, ahead.height, model_.data().triangle_at(ahead.slot)};
        const SurfaceHit behind = first_hit(point, -direction);
        if (behind.found && (!behind.leaves || !is_oriented()))
            return {true, -behind.height, model_.data().triangle_at(behind.slot)};
        return {};
    }

private:
    [[nodiscard]] SurfaceHit first_hit(const Vec3& point, const Vec3& direction) const;

    PlacedModel model_;
    const Solid& solid_;
    int facing_ = 0;
};

} // namespace abut
