#pragma once

#include <abut/elementary_impact.h>

#include <optional>

namespace abut::bench {

/// Whether this program is built with FCL.
bool has_fcl_elementary();

/// FCL's continuous tests of a vertex and a face, and of two edges: a floating-point solver of the
/// cubic with fixed tolerances. Nothing if it finds no impact.
std::optional<double> fcl_elementary_impact(const ElementaryPair& pair);

} // namespace abut::bench
