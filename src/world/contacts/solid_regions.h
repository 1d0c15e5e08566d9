#pragma once

#include <abut/model_contacts.h>

#include "world/contacts/convex_faces.h"
#include "world/narrow_phase/narrow_phase.h"
#include "world/narrow_phase/offset_surface.h"

#include <optional>
#include <vector>

namespace abut {

inline bool is_surface(const BodyShape& shape) {
    return std::holds_alternative<Model>(shape) || is_deformable(shape);
}

/// The faces of a body as triangles. None of a ball, a capsule, a box without area, a curved shape or
/// a half-space.
std::optional<OffsetSurface> triangles_of(const BodyShape& shape);

/// The convex solid of a pair whose other body is a surface.
// NOLINTNEXTLINE(bugprone-exception-escape): its move fails only for lack of memory
struct SolidOfPair {
    std::optional<ConvexFaces> faces;
    bool is_a = false;
};
/// Returns the convex solid. If both bodies are one, the smaller; if they are as large, a.
SolidOfPair solid_of(const PlacedBody& a, const PlacedBody& b);

/// Adds the manifolds of a convex solid and a surface. Returns a bound of the rounding of their depths;
/// none, and adds nothing, if pairs of triangles have to tell them.
///
/// In          a solid with faces.
std::optional<double> add_solid_regions(const PlacedBody& a, const PlacedBody& b,
                                        const SolidOfPair& solid, double margin,
                                        PairWarmStart& warm_start,
                                        std::vector<ModelManifold>& regions);

/// Adds the manifolds of a cylinder, a cone or an ellipsoid and a surface. Returns as add_solid_regions.
std::optional<double> add_curved_regions(const PlacedBody& a, const PlacedBody& b, double margin,
                                         PairWarmStart& warm_start,
                                         std::vector<ModelManifold>& regions);

} // namespace abut
