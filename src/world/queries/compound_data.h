#pragma once

#include <abut/compound.h>

#include "world/narrow_phase/body.h"

#include <vector>

namespace abut {

/// The pieces of a compound, all in its frame.
class CompoundData {
public:
    std::vector<BodyShape> pieces;
};

} // namespace abut
