#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut::bench {

/// The boxes whose overlap makes two instances a candidate pair.
enum class CandidateBoxes : std::uint8_t {
    any_rotation, ///< cubes that hold the part in any rotation, as in FCL's own broad phase
    tight,        ///< boxes of the placed vertices, as in the clash job
};

struct ClashSceneOptions {
    std::size_t instances = 2000;
    double spacing = 0.268; ///< of the grid, in diagonals of the part
    double bend = 1.6;      ///< of the part, in radians
    double tube = 0.23;     ///< mean radius of the part's tube, in radii of the bend
    CandidateBoxes boxes = CandidateBoxes::any_rotation;
    std::uint64_t seed = 1;
};

/// Many instances of one part on a jittered grid, each rotated at random.
struct ClashScene {
    Mesh part;
    std::vector<Transform> placements;
    /// Pairs of instances whose boxes overlap, as the options define them; sorted.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates;
};

/// A closed bent pipe with flanges, ribs and dents: 20,000 triangles, bend of radius 1.
Mesh flanged_elbow(double bend, double tube_radius);

/// Creates a scene. The same options give the same scene on every machine with IEEE arithmetic.
ClashScene make_clash_scene(const ClashSceneOptions& options);
/// Creates a scene with another part, scaled to diagonal 1.
ClashScene make_clash_scene(const ClashSceneOptions& options, Mesh part);

} // namespace abut::bench
