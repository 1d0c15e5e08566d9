#pragma once

#include <array>
#include <cstdint>

namespace abut {

/// The kinds of bounding volume that a model's hierarchy can use.
enum class Volume : std::uint8_t {
    automatic, ///< the fastest in the benchmarks: boxes; a node has its own axes where they fit
               ///< better than the model's
    aabb,      ///< boxes along the model's axes
    sphere,    ///< nearly the smallest enclosing ball
    kdop14,    ///< slabs along the axes and the diagonals of the cube
    kdop18,    ///< slabs along the axes and the diagonals of the cube's faces
    kdop26,    ///< slabs along all of these
    obb,       ///< oriented box, from the statistics of the convex hull
    pss,       ///< point swept by a sphere
    lss,       ///< line segment swept by a sphere
    rss,       ///< rectangle swept by a sphere
    ssv,       ///< hybrid swept sphere volume: a point, line segment or rectangle swept by a
               ///< sphere, whichever bounds its part best for the cost of its tests
};

/// All kinds.
inline constexpr std::array kVolumes{
    Volume::automatic, Volume::aabb, Volume::sphere, Volume::kdop14, Volume::kdop18, Volume::kdop26,
    Volume::obb,       Volume::pss,  Volume::lss,    Volume::rss,    Volume::ssv};
/// The enumerator's name.
const char* to_string(Volume volume);

/// The kind of bounding volume that a query uses for two models of these kinds.
///
/// Two models of the same kind use it. Swept spheres of different kinds (sphere, pss, lss, rss,
/// ssv) are compared as they are, by the tests of `ssv`. All other models of different kinds use
/// the boxes that every model has: `automatic`.
///
/// The boxes also serve where single precision cannot compare the volumes: one model is 2^60 times
/// as large as the other, or as far away, or a transform all but flattens it. Counters::volume
/// tells which kind a query has tested.
Volume common_volume(Volume a, Volume b);

} // namespace abut
