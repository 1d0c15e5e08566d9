#pragma once

#include <abut/model_contacts.h>

#include <vector>

namespace abut {

/// Names the regions of a pair, and sorts them by name.
///
/// Of the last step's regions whose normal differs by less than 60 degrees, a region gets the name
/// of the one that shares most point names with it; if none does, of the nearest one, unless
/// another region has it. The middle of a region does not count as a shared name, nor does a name
/// that more than 32 regions have. A new region gets the smallest number that is free.
///
/// If more than 2^20 pairs of regions share no name, the nearest ones are not sought.
///
/// In          last: may be null.
void name_regions(std::vector<ModelManifold>& manifolds, const std::vector<ModelManifold>* last);

} // namespace abut
