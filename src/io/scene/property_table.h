#pragma once

#include <abut/properties.h>

#include <cstddef>
#include <vector>

namespace abut {

/// Sorts the names, each part's entries by name, and removes repeated pairs. The values of one name
/// keep their order.
///
/// In          properties with valid indices; names and values distinct
void sort_properties(Properties& properties);

/// Returns whether all indices are valid for this many parts, and the names and values distinct.
/// Their order is not checked.
[[nodiscard]] bool is_consistent(const Properties& properties, std::size_t parts);

/// Sorts relations and removes those that are repeated. A connection gets a < b; relations of a
/// part with itself are removed.
void sort_relations(std::vector<PartRelation>& relations);

} // namespace abut
