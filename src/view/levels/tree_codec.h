#pragma once

#include "view/levels/level_tree.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// Packs a tree as the bytes of its lists, in a zstd frame.
std::vector<std::byte> encode_tree(const LevelTree& tree);

/// Errors      Fault malformed if the bytes are not those of a tree; the numbers in a returned tree
///             are all in range.
LevelTree decode_tree(std::span<const std::byte> data);

} // namespace abut
