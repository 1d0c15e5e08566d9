#pragma once

#include <abut/types.h>

#include "math/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// In place of the part, in a mesh that several parts share.
inline constexpr std::int64_t kSharedMesh = 0;

/// A unit normal as an octahedral map, each coordinate in [-127, 127].
using PackedNormal = std::array<std::int8_t, 2>;

struct SurfaceVertex {
    Vec3 position; ///< in the frame of the surface: world minus the origin, or an instanced mesh's
    PackedNormal normal{};
    std::uint32_t part = 0; ///< index in LevelSurface::parts
};

/// Triangles of several parts, on their way into a chunk or out of one.
struct LevelSurface {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::int64_t> parts; ///< rows of the table `part`, ascending; or kSharedMesh
    /// By part: no point of its triangles is farther than this from its full geometry, and the
    /// other way round, except for pieces that were left out.
    std::vector<double> errors;
    /// No point of a piece that was left out because another one is near all of it is farther than
    /// this from the surface.
    double resting = 0;

    [[nodiscard]] Triangle corners(const std::array<std::uint32_t, 3>& t) const {
        return {vertices[t[0]].position, vertices[t[1]].position, vertices[t[2]].position};
    }
};

} // namespace abut
