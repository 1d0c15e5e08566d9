#pragma once

#include <abut/scene.h>

#include <cstdint>
#include <map>
#include <utility>

/// Distances between parts by brute force, sharing no code with the library: what proves that a
/// plant holds its planted clashes and no other.
namespace abut::reference {

struct Nearness {
    double distance = 0; ///< of the surfaces; 0 if they meet
    bool contained =
        false; ///< the surfaces do not meet, and one part lies inside the other, closed one
};

/// All pairs of parts whose surfaces are at most `limit` apart, or one of which lies in the other.
///
/// In/out      `closed` tells of each mesh whether it is a solid. Keys: indices of parts, smaller
/// first.
///             `examined` receives the number of pairs whose boxes are within the limit.
/// Cost        quadratic in the triangles of a pair; for scenes of some ten thousand triangles.
std::map<std::pair<std::uint32_t, std::uint32_t>, Nearness>
near_pairs(const Scene& scene, const std::vector<bool>& closed, double limit,
           std::uint64_t& examined);

} // namespace abut::reference
