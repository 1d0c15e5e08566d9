#pragma once

#include <abut/scene.h>

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace abut::command {

/// The properties of a part: {"storey": "L1", "system": ["S1", "S2"]}.
nlohmann::ordered_json properties_json(const Scene& scene, std::uint32_t part);

/// The relations of a scene: [{"kind": "fills", "a": id, "b": id}].
nlohmann::ordered_json relations_json(const Scene& scene);

/// The properties that parts of some scenes have: the common ones first, then by name.
struct PropertyUse {
    std::string name;
    std::uint64_t parts = 0;           ///< that have it
    std::uint64_t values = 0;          ///< different ones
    std::vector<std::string> examples; ///< the most frequent values, at most five
};
std::vector<PropertyUse> property_uses(std::span<const Scene> scenes);

/// [{"name": "storey", "parts": 5, "values": 2, "examples": ["L1", "L2"]}].
nlohmann::ordered_json to_json(const std::vector<PropertyUse>& uses);
/// A table with a line for each property, as wide as the terminal.
std::string table(const std::vector<PropertyUse>& uses);

} // namespace abut::command
