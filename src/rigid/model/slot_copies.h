#pragma once

#include <mutex>
#include <vector>

namespace abut {

class ModelData;

/// The triangles of a model that are copies of others. They are found on first use; safe for concurrent
/// use.
class LazySlotCopies {
public:
    /// Tells by slot whether the triangle has the same corners, in the same order, as one of a lower
    /// index. Empty if there are no copies.
    ///
    /// In          model: the same in all calls.
    /// Cost        the first call: a sort of the triangles.
    [[nodiscard]] const std::vector<bool>& of(const ModelData& model) const;

private:
    mutable std::once_flag once_;
    mutable std::vector<bool> copies_;
};

} // namespace abut
