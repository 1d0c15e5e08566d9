#pragma once

#include <abut/elementary_impact.h>

#include <optional>

namespace abut {

/// `elementary_impact` in double precision: every time at which the four vertices may lie in one
/// plane is enclosed in an interval, and where the features meet during it is decided with bounds of
/// all rounding. Nothing where that decides nothing.
///
/// In          finite coordinates of any size. delta: as ElementaryOptions; 0 leaves near pairs
///             undecided.
/// Accuracy    certified: a result is right, its time never later than the first impact and less
///             than 1e-9 before it (where its status is exact).
/// Cost        some 250 ns.
/// Source      see docs/elementary-tests.md.
std::optional<ElementaryImpact> elementary_impact_interval(const ElementaryPair& pair,
                                                           double delta);

} // namespace abut
