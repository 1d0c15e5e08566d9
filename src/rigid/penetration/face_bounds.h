#pragma once

#include "rigid/solid/world_solid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// The faces of a solid that were nearest to the last samples of a piece of another surface and of
/// pieces that enclose it, and the distances of the piece's corners from them. A distance is computed
/// when a bound first needs it, and passed on to the pieces that the corner also belongs to.
class FaceBounds {
public:
    static constexpr std::size_t kMostFaces = 4, kMostCorners = 8;

    /// Starts a piece with the faces of one that encloses it. No distance of its `corners` is known.
    void begin(const FaceBounds& enclosing, std::size_t corners);
    /// Takes the known distances of a corner that is corner j of a piece with the same faces.
    void take_corner(std::size_t i, const FaceBounds& other, std::size_t j);
    /// Puts the slot of a face first; drops the last one if there are too many.
    void remember(std::uint32_t slot);

    /// The least bound of the depth of the piece's points that a pair of its faces gives; any bound
    /// up to `wanted` will do. It is tight if the piece lies halfway between two faces.
    ///
    /// Source      the distance to a convex set is convex: at a mean of the corners it is at most
    ///             the mean of their distances.
    [[nodiscard]] double least(const WorldSolid& solid, std::span<const Vec3> corners,
                               double wanted);

private:
    using CornerDistances = std::array<double, kMostCorners>;
    static constexpr double kUnknown = -1;

    std::array<std::uint32_t, kMostFaces> slots_{};
    std::uint8_t faces_ = 0, corners_ = 0;
    std::array<CornerDistances, kMostFaces> distances_{}; ///< by face, of faces_ x corners_
};

} // namespace abut
