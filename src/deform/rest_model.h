#pragma once

#include <abut/model.h>

#include <cstddef>
#include <mutex>
#include <optional>

namespace abut {

class DeformableData;

/// A deformable surface at the start of its step as a model. It is made when it is asked for. A
/// model of a later step takes over the topology of the last one's hierarchy.
class RestModel {
public:
    /// The model of the surface as it is now. May be called from any thread while the surface does
    /// not change.
    [[nodiscard]] Model of(const DeformableData& surface) const;
    /// The surface has other positions.
    void move_on() { is_current_ = false; }
    /// The surface has other triangles, or its hierarchies are to be built anew.
    void forget() { last_.reset(); }
    [[nodiscard]] std::size_t bytes() const;

private:
    mutable std::mutex mutex_;
    mutable std::optional<Model> last_;
    mutable bool is_current_ = false; ///< whether `last_` has the surface's positions
};

} // namespace abut
