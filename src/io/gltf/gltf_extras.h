#pragma once

#include "io/scene/part_spool.h"

#include <nlohmann/json.hpp>
#include <vector>

namespace abut {

/// The properties in a node's `extras`, by ascending name; each pair once.
///
/// Values of `extras.properties` have their names there, values elsewhere in `extras` the names
/// "extras.NAME". An object in an object adds its key and a dot. The values of a list are several
/// values of one name. `name` and `type` of `extras` are members of the Part.
std::vector<PartProperty> properties_of_extras(const nlohmann::json& extras);

/// The properties of a part as `extras.properties`: {"NAME": "value", "NAME": ["value", "value"]}.
/// Null if it has none.
nlohmann::json json_of_properties(const Properties& properties, std::uint32_t part);

} // namespace abut
