#pragma once

#include <abut/model.h>

#include "geometry/triangle_triangle_distance.h"
#include "math/transform.h"
#include "rigid/model_data.h"
#include "rigid/solid.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace abut {

/// Questions about single points and one model under its transform. Cheap to make, one a thread.
class PlacedSolid {
public:
    PlacedSolid(const Model& model, const Solid& solid, const Transform& world_from_model);

    [[nodiscard]] const Model& public_model() const { return public_model_; }
    [[nodiscard]] const ModelData& model() const { return model_; }
    [[nodiscard]] const Transform& world() const { return world_; }
    /// The transform with a translation added.
    [[nodiscard]] Transform world_moved(const Vec3& shift) const {
        Transform moved = world_;
        moved.m[9] += shift.x, moved.m[10] += shift.y, moved.m[11] += shift.z;
        return moved;
    }
    /// No two points of the model are farther apart.
    [[nodiscard]] double world_size() const { return 2 * reach_; }
    [[nodiscard]] const Solid& solid() const { return solid_; }
    [[nodiscard]] Vec3 world_vertex(std::uint32_t vertex) const {
        return apply(world_, model_.mesh().positions[vertex]);
    }
    [[nodiscard]] Triangle world_triangle(std::uint32_t triangle) const {
        const auto& t = model_.mesh().triangles[triangle];
        return {world_vertex(t[0]), world_vertex(t[1]), world_vertex(t[2])};
    }
    [[nodiscard]] Triangle world_slot(std::uint32_t slot) const {
        return model_.world_triangle(slot, world_);
    }
    [[nodiscard]] const Transform& world_from_tree() const { return world_from_tree_; }
    [[nodiscard]] const Transform& tree_from_world() const { return tree_from_world_; }
    /// No vector of the tree's frame becomes longer than this times its length.
    [[nodiscard]] double most_stretch() const { return most_stretch_; }
    /// solid().outward as seen in the world: a mirroring transform turns it round.
    [[nodiscard]] int outward() const { return mirrored_ ? -solid_.outward : solid_.outward; }

    /// Whether the point lies on the surface. Exact.
    [[nodiscard]] bool on_surface(const Vec3& point) const;

    /// Whether the point lies strictly inside, by the parity of crossings of a ray.
    ///
    /// Accuracy    exact for a closed mesh; with T-junctions, the majority of three rays. False on
    ///             the surface.
    [[nodiscard]] bool contains(const Vec3& point) const {
        return !on_surface(point) && contains_off_surface(point);
    }
    /// The same for a point that is known not to lie on the surface.
    [[nodiscard]] bool contains_off_surface(const Vec3& point) const;

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

    const Model& public_model_;
    const ModelData& model_;
    const Solid& solid_;
    Transform world_;
    Transform world_from_tree_, tree_from_world_;
    double least_stretch_, most_stretch_;
    double margin_;
    double reach_; ///< no point of the model is farther from the tree's origin, world units
    bool mirrored_;
};

} // namespace abut
