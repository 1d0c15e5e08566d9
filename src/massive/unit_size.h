#pragma once

#include <abut/broad_phase.h>

#include "massive/stored_parts.h"
#include "massive/work_units.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Several workers need many units, so that all have work to the end; one worker is served best by
/// the largest that fit.

/// How many bytes a unit may have: `most`, or less, so that each worker gets some dozens of units.
/// Two meshes that are compared fit if they fit into `most`.
std::uint64_t unit_budget(const StoredParts& stored, std::span<const IndexPair> pairs,
                          std::uint64_t most, std::size_t workers);

/// Units of many pairs on few meshes, as of a model of instances, are cut likewise. The order stays.
std::vector<WorkUnit> split_long_units(std::vector<WorkUnit> units, const StoredParts& stored,
                                       std::size_t workers);

} // namespace abut
