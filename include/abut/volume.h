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
};

/// All kinds.
inline constexpr std::array kVolumes{
    Volume::automatic, Volume::aabb, Volume::sphere, Volume::kdop14, Volume::kdop18,
    Volume::kdop26,    Volume::obb,  Volume::pss,    Volume::lss,    Volume::rss};
/// The enumerator's name.
const char* to_string(Volume volume);

} // namespace abut
