#pragma once

#include "rigid/placed_model.h"
#include "rigid/solid.h"

#include <cstdint>
#include <limits>

namespace abut {

/// A placed model that may bound a solid: what is inside, what is nearest. The solid must outlive
/// it.
class PlacedSolid : public PlacedModel {
public:
    /// Errors      as PlacedModel.
    PlacedSolid(const Model& model, const Solid& solid, const Transform& world_from_model);

    /// The transform with a translation added.
    [[nodiscard]] Transform world_moved(const Vec3& shift) const {
        Transform moved = world();
        moved.m[9] += shift.x, moved.m[10] += shift.y, moved.m[11] += shift.z;
        return moved;
    }
    [[nodiscard]] const Solid& solid() const { return solid_; }
    /// Whether world() turns left hands into right ones.
    [[nodiscard]] bool mirrored() const { return mirrored_; }
    /// solid().outward as seen in the world: a mirroring transform turns it round.
    [[nodiscard]] int outward() const { return mirrored_ ? -solid_.outward : solid_.outward; }

    /// Whether the point lies strictly inside, by the parity of crossings of a ray.
    ///
    /// Accuracy    exact for a closed mesh; with T-junctions, the majority of three rays. False on
    ///             the surface.
    [[nodiscard]] bool contains(const Vec3& point) const {
        return !on_surface(point) && contains_off_surface(point);
    }
    /// The same for a point that is known not to lie on the surface.
    [[nodiscard]] bool contains_off_surface(const Vec3& point) const;
    /// The same, where it is known of another point off the surface; fast where that is near.
    [[nodiscard]] bool contains_off_surface(const Vec3& point, const Vec3& known,
                                            bool inside) const;

    /// A part inside the other: for a mesh that is not closed the winding number decides (1 to
    /// rounding).
    [[nodiscard]] bool winds_around(const Vec3& point) const;

    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        Vec3 point;
        std::uint32_t slot = 0;
    };
    struct NearestSearch {
        double bound = std::numeric_limits<double>::infinity(); ///< nothing farther matters
        double enough = 0;                   ///< a point no farther than this ends the search
        double slack = 0;                    ///< the distance may be this much too large, relative
        const std::uint32_t* seed = nullptr; ///< a slot that is likely near
    };
    /// The surface's nearest point, if it is nearer than the bound.
    [[nodiscard]] Nearest nearest(const Vec3& point, const NearestSearch& search) const;
    [[nodiscard]] Nearest nearest(const Vec3& point, double bound) const {
        return nearest(point, NearestSearch{.bound = bound});
    }

private:
    /// Parity of the crossings; false in `clear` if the ray meets an edge or a vertex and the count
    /// says nothing.
    [[nodiscard]] bool odd_crossings(const Vec3& from, const Vec3& to, bool& clear) const;

    const Solid& solid_;
    bool mirrored_;
};

} // namespace abut
