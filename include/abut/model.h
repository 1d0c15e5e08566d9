#pragma once

#include <abut/mesh.h>
#include <abut/types.h>
#include <abut/volume.h>

#include <memory>

namespace abut {

class ModelData;

struct ModelOptions {
    /// The bounding volume of the hierarchy. Queries of two models use it where both have the same;
    /// else, and for a single model, the boxes that every model has.
    Volume volume = Volume::automatic;
};

/// A mesh with the bounding-volume hierarchy that queries need. Immutable once built: copies share
/// the data, and any number of threads may query it.
class Model {
public:
    /// Takes the mesh and builds its hierarchy.
    ///
    /// Degenerate  zero-area triangles are kept: they count as the segments or points that they
    ///             are. A mesh without triangles is a valid model that meets nothing.
    /// Errors      Error{bad_mesh} if an index is out of range or a coordinate is not finite or
    ///             beyond 1e18.
    /// Cost        O(n log n); parallel over subtrees.
    explicit Model(Mesh mesh, const ModelOptions& options = {});
    /// For the library itself, which alone can make such data.
    explicit Model(std::shared_ptr<const ModelData> data);

    [[nodiscard]] const Mesh& mesh() const noexcept;
    /// Memory of mesh and hierarchy, in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const ModelData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const ModelData> data_;
};

} // namespace abut
