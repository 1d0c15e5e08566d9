#pragma once

#include <abut/types.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace abut {

class ModelData;

/// The surface of a convex solid: its planes and corners, in the mesh's frame.
struct ConvexSurface {
    struct Plane {
        Vec3 normal;       ///< outward, of unit length
        double offset = 0; ///< the largest of dot(normal, corner)
    };
    std::vector<Plane> planes;
    std::vector<Vec3> corners;
    std::vector<std::uint32_t> vertices; ///< the merged vertex at each corner
    Vec3 middle;                         ///< the mean of the corners
    double reach = 0;                    ///< no corner is farther from `middle`
};

/// Tells whether a model is the whole surface of a convex solid. It is examined on first use; safe for
/// concurrent use.
class LazyConvexSurface {
public:
    /// Returns the surface; null if the model bounds no convex solid, is thin, or has very many faces.
    /// Faces may bend by rounding: no corner lies beyond a plane by more than 2^-40 of the size.
    ///
    /// In          model: the same in all calls.
    /// Cost        the first call: planes times corners, both of which are limited.
    [[nodiscard]] const ConvexSurface* of(const ModelData& model) const;

private:
    mutable std::once_flag once_;
    mutable std::optional<ConvexSurface> surface_;
};

} // namespace abut
