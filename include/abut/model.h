#pragma once

#include <abut/mesh.h>
#include <abut/progress.h>
#include <abut/types.h>
#include <abut/volume.h>

#include <memory>

namespace abut {

class ModelData;

struct ModelOptions {
    /// The bounding volume of the hierarchy. Searches for contacts and for the distance of two
    /// models use it if both models have it. For models of different kinds, common_volume tells
    /// what is used, and Counters::volume what was. All other searches use the boxes that every
    /// model has.
    Volume volume = Volume::automatic;
    /// For building the hierarchy: only its stop flag is used.
    Progress progress{};
};

/// A mesh with the bounding-volume hierarchy that queries need. Immutable once built: copies share
/// the data, and any number of threads may query it.
class Model {
public:
    /// Takes the mesh and builds its hierarchy.
    ///
    /// Degenerate  zero-area triangles are kept and count as segments or points. A mesh without
    ///             triangles is a valid model that meets nothing.
    /// Errors      Error{bad_mesh} if an index is out of range or a coordinate is not finite or
    ///             beyond 1e18; Error{interrupted}.
    /// Cost        O(n log n); parallel over subtrees.
    explicit Model(Mesh mesh, const ModelOptions& options = {});
    /// For use by the library only.
    explicit Model(std::shared_ptr<const ModelData> data);

    [[nodiscard]] const Mesh& mesh() const noexcept;
    /// Memory of the mesh and its hierarchy, in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const ModelData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const ModelData> data_;
};

} // namespace abut
