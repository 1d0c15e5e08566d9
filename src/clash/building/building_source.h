#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace abut {

/// A part of the models that a page may show.
struct BuildingPart {
    Box3 box; ///< in the world of the report; may be larger than the part
    std::uint32_t model = 0;
    std::uint32_t mesh = 0; ///< index in BuildingSource::meshes()
};

struct BuildingMesh {
    std::uint64_t triangles = 0;
    Box3 box; ///< in the mesh's coordinates
};

/// The geometry of a report's models, in memory or in a store.
class BuildingSource {
public:
    BuildingSource() = default;
    virtual ~BuildingSource() = default;
    BuildingSource(const BuildingSource&) = delete;
    BuildingSource& operator=(const BuildingSource&) = delete;

    [[nodiscard]] const std::vector<BuildingPart>& parts() const { return parts_; }
    [[nodiscard]] const std::vector<BuildingMesh>& meshes() const { return meshes_; }

    /// Returns the index in parts() of a part of a clash.
    [[nodiscard]] virtual std::uint32_t part_of_report(std::uint32_t model,
                                                       std::uint32_t part) const = 0;
    /// The map from the mesh's coordinates to the world of the report. From any thread.
    [[nodiscard]] virtual Transform world_from_mesh(std::uint32_t part) const = 0;
    /// Visits a mesh in pieces that fit into memory. From any thread.
    virtual void for_each_piece(std::uint32_t mesh,
                                const std::function<void(const Mesh&)>& take) const = 0;

protected:
    std::vector<BuildingPart> parts_;
    std::vector<BuildingMesh> meshes_;
};

} // namespace abut
