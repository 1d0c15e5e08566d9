#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// A procedural power plant in the spirit of the UNC power plant model, with planted clashes whose
/// truth is known. scenes/README.md says what it holds.
namespace abut {

struct PlantOptions {
    /// Each instance counted; hit within 5 % from 10,000 on, where the planted parts (some 60
    /// triangles a pair) leave that much.
    std::uint64_t triangles = 200'000;
    int clashes = 50; ///< planted pairs, the kinds in turn
    std::uint64_t seed = 1;
    /// Metres, in [0, 0.25]: up to this clearance the planted pairs are all that there is. Below
    /// 1/64 no pair of kind `clearance` is planted: it would have no room.
    double clearance = 0.05;
    /// Every part has a mesh of its own: the same triangles, in an order of their own. As a model of
    /// which little is instanced, for jobs that do not fit into the memory.
    bool distinct = false;
};

/// Two parts that a clash job must report, and nothing else.
struct PlantedClash {
    ClashKind kind = ClashKind::hard;
    std::string a, b; ///< ids of the parts
    std::optional<double>
        distance;     ///< signed, as Clash::distance; empty where it is not known exactly
    std::string what; ///< "pipe through the web of a beam"
};

struct Plant {
    Scene scene;
    std::vector<bool>
        mesh_closed; ///< by mesh: a watertight solid, oriented outward; else an open shell
    std::vector<PlantedClash> truth;
    PlantOptions options;
    std::uint64_t triangles = 0; ///< each instance counted
    double separation = 0; ///< metres; all pairs but the planted ones are at least this far apart
};

/// In/out      the same plant for the same options on every machine.
/// Units       metres, y up; vertex positions are exact as floats, transforms rigid.
/// Errors      Error{bad_argument} if an option is outside its domain.
/// Cost        linear in the parts: about a second for ten million triangles.
Plant make_plant(const PlantOptions& options = {});

/// The side file of a plant: its options, its size and the planted clashes, as JSON.
std::string plant_truth_json(const Plant& plant);

} // namespace abut
