#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// A procedural power plant in the spirit of the UNC power plant model, with planted clashes that
/// are known exactly. scenes/README.md describes it.
namespace abut {

struct PlantOptions {
    /// Instanced triangles. The number is met within 5 % from 10,000 on, unless the planted parts
    /// (some 60 triangles a pair) need more.
    std::uint64_t triangles = 200'000;
    int clashes = 50; ///< planted pairs, of each kind in turn
    std::uint64_t seed = 1;
    /// Metres, in [0, 0.25]. Up to this clearance, only planted pairs are found. Below 1/64, no
    /// pair of kind `clearance` is planted: there would be no room for its gap.
    double clearance = 0.05;
    /// Gives every part a mesh of its own, with the same triangles in an order of its own.
    /// Resembles a model with little instancing, for jobs on models larger than memory.
    bool distinct = false;
};

/// A pair of parts that a clash job must report. It must report no other pairs.
struct PlantedClash {
    ClashKind kind = ClashKind::hard;
    std::string a, b; ///< ids of the parts
    std::optional<double>
        distance;     ///< signed, as Clash::distance; empty if it is not known exactly
    std::string what; ///< "pipe through the web of a beam"
};

struct Plant {
    Scene scene;
    std::vector<bool>
        mesh_closed; ///< for each mesh: whether it is a watertight solid facing outward; else it is
                     ///< an open shell
    std::vector<PlantedClash> truth;
    PlantOptions options;
    std::uint64_t triangles = 0; ///< each instance counted
    double separation = 0; ///< metres; all pairs except the planted ones are at least this far
                           ///< apart
};

/// Builds a plant.
///
/// In/out      the same options give the same plant on every machine.
/// Units       metres, y up; vertex positions are exact as floats, transforms are rigid.
/// Errors      Error{bad_argument} if an option is outside its domain.
/// Cost        linear in the parts: about a second for ten million triangles.
Plant make_plant(const PlantOptions& options = {});

/// The JSON file that accompanies a plant: its options, its size and the planted clashes.
std::string plant_truth_json(const Plant& plant);

} // namespace abut
