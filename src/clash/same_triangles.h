#pragma once

#include "clash/classify_pair.h"

namespace abut {

/// Whether two parts consist of the same triangles at the same place. The order of the triangles
/// and of their corners does not matter.
///
/// Accuracy    compares boxes and numbers of triangles, then hashes of 128 bits. An accidental
///             match is not to be expected.
/// Cost        one pass over both parts, only if their boxes and numbers of triangles are equal.
bool same_triangles(const ClashPart& a, const ClashPart& b);

} // namespace abut
