#pragma once

#include "math/vector.h"

#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

class ModelData;

/// The boxes of a model's tree in double precision, along the axes of the tree's frame. The tree's own
/// boxes are wider by 1e-6 of the tree. That hides which one is nearer to a point that is so far away
/// that its distances from them differ by less. They are made on first use; safe for concurrent use.
class LazyTreeBoxes {
public:
    /// The boxes of children, by name (child_name).
    ///
    /// In          model: the same in all calls; its tree is not empty.
    /// Accuracy    to the rounding of positions that are turned.
    /// Cost        the first call: some 20 ns a triangle, and 48 bytes for each child of a node.
    [[nodiscard]] const std::vector<Box3>& of(const ModelData& model) const;

private:
    mutable std::once_flag once_;
    mutable std::vector<Box3> boxes_;
};

} // namespace abut
