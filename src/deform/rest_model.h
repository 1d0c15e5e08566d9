#pragma once

#include <abut/model.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>

namespace abut {

class DeformableData;
struct ModelOutline;

/// A deformable surface at the start of its step as a model. It is made when it is asked for. The
/// model of a later step keeps the topology of the first one's hierarchy.
///
/// All nodes have the tree's axes. Finding axes of their own would take a third of the time of a
/// refit, and save at most a third of that of a query.
class RestModel {
public:
    /// The model of the surface as it is now. May be called from any thread while the surface does
    /// not change.
    [[nodiscard]] Model of(const DeformableData& surface) const;
    /// The surface has other positions.
    void move_on() { model_.reset(); }
    /// The surface has other triangles, or its hierarchies are to be built anew.
    void forget() {
        model_.reset();
        outline_.reset();
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    mutable std::mutex mutex_;
    mutable std::optional<Model> model_;
    mutable std::shared_ptr<const ModelOutline> outline_; ///< of the first model
};

} // namespace abut
