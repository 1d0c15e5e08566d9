#pragma once

#include "math/vector.h"
#include "mesh/surface_features.h"
#include "pieces/decomposition/exact_plane.h"
#include "pieces/decomposition/growing_hull.h"
#include "rigid/model/placed_model.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// The convex hull of a patch of a surface, which grows by one triangle at a time: a flat polygon
/// at first, then a body with a volume.
///
/// A triangle joins in three steps. `lies_behind` checks that its plane has the patch behind it.
/// `propose` adds its new vertex, if it has one, and checks that the patch's planes have it behind
/// them. `cover` completes the step; `take_back` undoes `propose`.
///
/// A vertex is the number of a position; equal positions have one number. All decisions are exact.
class PatchHull {
public:
    /// Refers to both arguments. `planes`: of all triangles of the surface.
    PatchHull(std::span<const Vec3> positions, std::span<const ExactPlane> planes)
        : positions_(positions), planes_(planes), solid_(positions) {}

    /// Begins with a triangle that has an area.
    void begin(const IndexTriangle& triangle, std::uint32_t number);

    /// Returns whether no vertex of the patch is in front of a triangle's plane. A triangle that is
    /// coplanar with a flat patch must also face the same way. A triangle without area has no
    /// front.
    [[nodiscard]] bool lies_behind(const IndexTriangle& triangle, std::uint32_t number,
                                   bool has_area) const;

    /// Adds a new vertex of such a triangle to the hull. Returns false, and changes nothing, if the
    /// vertex is in front of a plane of the patch.
    bool propose(std::uint32_t vertex, const IndexTriangle& triangle, bool has_area);
    void take_back();
    /// Whether the proposed vertex has enlarged the hull, and the box of what the hull gained.
    [[nodiscard]] bool grows() const { return grows_; }
    [[nodiscard]] const Box3& gained() const { return gained_; }

    using HalfSpace = PlacedModel::HalfSpace;
    /// Looks for a proof that a triangle of the surface does not enter the inside of the hull: a
    /// plane with the hull on one side and the triangle on the other. Returns the half-space beyond
    /// that plane. The inside of a flat hull is the thin layer just below it.
    ///
    /// Accuracy    proven by exact signs. The planes tried are those of the triangle and of the
    ///             hull's faces, and those through an edge of one and a vertex of the other; for a
    ///             triangle with a corner of the hull, those through that corner.
    [[nodiscard]] std::optional<HalfSpace> outside(const IndexTriangle& triangle,
                                                   std::uint32_t number);

    /// Records that the triangle belongs to the patch.
    void cover(const IndexTriangle& triangle, std::uint32_t number, bool has_area);

private:
    [[nodiscard]] const Vec3& at(std::uint32_t v) const { return positions_[v]; }
    [[nodiscard]] bool is_flat() const { return solid_.empty(); }
    [[nodiscard]] Triangle corners(const IndexTriangle& t) const {
        return {at(t[0]), at(t[1]), at(t[2])};
    }
    [[nodiscard]] std::uint32_t common_corner(const IndexTriangle& t) const;
    [[nodiscard]] bool faces_alike(const Triangle& triangle) const;
    void propose_in_plane(std::uint32_t vertex);
    [[nodiscard]] std::optional<HalfSpace> outside_layer(const Triangle& t,
                                                         const ExactPlane& plane) const;
    [[nodiscard]] std::optional<HalfSpace>
    outside_cone(std::uint32_t corner, const IndexTriangle& t, const ExactPlane& plane) const;
    [[nodiscard]] std::optional<HalfSpace> outside_solid(const Triangle& t,
                                                         const ExactPlane& plane);

    std::span<const Vec3> positions_;
    std::span<const ExactPlane> planes_;
    ExactPlane front_;        ///< plane of the first triangle: the side that a flat patch faces
    int axis_ = 0, turn_ = 1; ///< the triangle's orientation as seen along the axis
    std::vector<std::uint32_t> polygon_, polygon_before_; ///< of a flat hull, counter-clockwise
    GrowingHull solid_;
    std::uint32_t last_face_ = 0; ///< the last face that had a triangle in front of it
    enum class Step : std::uint8_t { none, in_plane, first_solid, solid } step_ = Step::none;
    bool grows_ = false;
    Box3 gained_;
};

} // namespace abut
