#pragma once

#include "clash/classify_pair.h"

#include <optional>

namespace abut {

/// classify_pair for two parts of which at least one is in mesh blocks. It tests block against
/// block, with few blocks in memory at a time.
///
/// Accuracy    kind, distance, contacts and their number are those of whole models, to the last
///             bit. The depth of a `hard` clash is found block by block; it equals that of whole
///             models within the accuracy of both.
/// Cost        all contacts are in memory together, 12 to 28 bytes each.
std::optional<Clash> classify_blocks(const ClashPart& a, const ClashPart& b, double clearance,
                                     double touch);

} // namespace abut
