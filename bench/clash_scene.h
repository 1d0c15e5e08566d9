#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut::bench {

struct ClashSceneOptions {
    std::size_t instances = 2000;
    double spacing = 0.4; ///< of the grid, in diameters of the part
    double tube = 0.05;   ///< mean radius of the ring's tube, in diameters of the part
    std::uint64_t seed = 1;
};

/// Many instances of one part on a jittered grid, each turned at random.
struct ClashScene {
    Mesh part;
    std::vector<Transform> placements;
    /// Pairs of instances whose boxes overlap (tight boxes of the placed vertices), sorted.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates;
};

/// A closed ring of pipe with ribs and dents, of diameter about 1 and 20,000 triangles.
Mesh ribbed_ring(double tube_radius);

/// The same scene for the same options on every machine with IEEE arithmetic.
ClashScene make_clash_scene(const ClashSceneOptions& options);
/// The same with another part, scaled to a diagonal of 1.
ClashScene make_clash_scene(const ClashSceneOptions& options, Mesh part);

} // namespace abut::bench
