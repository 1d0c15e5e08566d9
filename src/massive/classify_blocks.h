#pragma once

#include "massive/classify_pair.h"

#include <optional>

namespace abut {

/// classify_pair where at least one part is in blocks: block against block, with few of them in
/// memory at a time.
///
/// Accuracy    kind, distance, contacts and their number: as of whole models, to the last bit. The
///             depth of a `hard` clash: found block by block, so that it is that of whole models within
///             the accuracy of both.
/// Cost        contacts: 12 to 28 bytes each, in memory together.
std::optional<Clash> classify_blocks(const ClashPart& a, const ClashPart& b, double clearance,
                                     double touch);

} // namespace abut
