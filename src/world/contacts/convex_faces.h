#pragma once

#include <abut/types.h>

#include "math/vector.h"
#include "rigid/model/convex_surface.h"
#include "world/narrow_phase/body.h"

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <optional>

namespace abut {

/// A convex solid as the common part of half-spaces, in a frame of its own.
// NOLINTNEXTLINE(bugprone-exception-escape): its move fails only for lack of memory
struct ConvexFaces {
    using Plane = ConvexSurface::Plane;
    boost::container::small_vector<Plane, 24> planes;
    boost::container::small_vector<Vec3, 32> vertices;
    boost::container::small_vector<std::uint32_t, 32> numbers; ///< of the vertices in the body
    Vec3 middle;                                               ///< inside
    Transform world_from_solid;
    double reach = 0;        ///< no vertex is farther from `middle`
    bool is_surface = false; ///< a model's, which shares no point with what lies wholly inside
};

/// The faces of a box, a convex body or the model of a convex solid. None if the solid is flat, has a
/// radius, or has very many faces.
///
/// In          world_from_body: a rotation and a translation.
std::optional<ConvexFaces> convex_faces(const BodyShape& shape, const Transform& world_from_body);

} // namespace abut
