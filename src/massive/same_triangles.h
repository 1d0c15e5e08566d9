#pragma once

#include "massive/classify_pair.h"

namespace abut {

/// Whether two parts are the same triangles at the same place, in whatever order and however their
/// corners are numbered.
///
/// Accuracy    by 128 bits of hashes where boxes and numbers of triangles are the same: an error is
///             not to be expected.
/// Cost        one pass over both parts where they are the same for all that boxes tell.
bool same_triangles(const ClashPart& a, const ClashPart& b);

} // namespace abut
