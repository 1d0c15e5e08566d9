#pragma once

#include <abut/model_contacts.h>

#include "world/contacts/convex_faces.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Where a solid and a surface are nearest to each other, in the solid's frame.
struct SolidPlace {
    Vec3 on_surface, on_solid;
    Vec3 up; ///< unit vector from the surface to the solid; zero where none is known
    double distance = 0;
};

/// Finds the nearest places of a pair, where the faces of the solid and of the triangles do not tell them.
class NearestOfPair {
public:
    virtual ~NearestOfPair() = default;
    /// Returns what World::within tells of the pair. Its distance is infinite if the pair is farther apart
    /// than the margin.
    [[nodiscard]] virtual SolidPlace of_pair() const = 0;
    /// Returns the nearest place of a triangle of the surface, in the solid's frame. Its distance is the
    /// bound if the triangle is not nearer.
    [[nodiscard]] virtual SolidPlace of_triangle(const Triangle& triangle, double bound) const = 0;

protected:
    NearestOfPair() = default;
    NearestOfPair(const NearestOfPair&) = default;
    NearestOfPair& operator=(const NearestOfPair&) = default;
};

/// Finds the contacts of a convex solid and a surface: a manifold for each region of the surface that
/// is at most the margin away from the solid.
///
/// In          solid_is_a: normals point from a to b. last: the names of the last step.
/// Out         a bound of the rounding of depths. None, and no manifold is added, where what touches
///             does not tell a normal: then surface_manifolds has to look at pairs of triangles.
/// Cost        that of clipping each triangle near the solid by its faces.
std::optional<double> add_solid_on_surface(const ConvexFaces& solid, const Model& surface,
                                           const Transform& world_from_surface, bool solid_is_a,
                                           double margin, std::span<const std::uint64_t> last,
                                           const NearestOfPair& nearest,
                                           std::vector<ModelManifold>& manifolds);

} // namespace abut
