#pragma once

#include <abut/elementary_impact.h>

#include <optional>

namespace abut {

/// `elementary_impact` in double precision. Every time at which the four vertices may be coplanar
/// is enclosed in an interval. Whether the features meet during it is decided with bounds on all
/// rounding. Returns nothing if these bounds do not decide.
///
/// In          finite coordinates of any size. absolute_error: as in ElementaryOptions; 0 leaves near pairs
///             undecided.
/// Accuracy    certified: a result is right. Its time is never later than the first impact and, if
///             its status is exact, less than 1e-9 before it.
/// Cost        some 250 ns.
/// Source      see docs/elementary-tests.md.
std::optional<ElementaryImpact> elementary_impact_interval(const ElementaryPair& pair,
                                                           double absolute_error);

} // namespace abut
