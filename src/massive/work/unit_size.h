#pragma once

#include <abut/broad_phase.h>

#include "massive/work/stored_parts.h"
#include "massive/work/work_units.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The size of work units. Several workers need many units, so that all have work to the end. One
/// worker is served best by the largest units that fit into the memory.

/// Returns how many bytes a unit may have: `most`, or less if several workers need dozens of units
/// each. Two meshes that are compared still fit if they fit into `most`.
std::uint64_t unit_budget(const StoredParts& stored, std::span<const IndexPair> pairs,
                          std::uint64_t most, std::size_t workers);

/// Cuts units that have many pairs on few meshes, such as those of a model in which many parts
/// share a mesh. The order of the units stays.
std::vector<WorkUnit> split_long_units(std::vector<WorkUnit> units, const StoredParts& stored,
                                       std::size_t workers);

} // namespace abut
