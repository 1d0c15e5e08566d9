#pragma once

#include <abut/scene.h>

#include "clash/building/building_source.h"

#include <vector>

namespace abut {

/// The geometry of models in memory, which must outlive the source.
class ScenesSource final : public BuildingSource {
public:
    /// In          up: the axis that points up in the report.
    /// Cost        one pass over the vertices.
    ScenesSource(const std::vector<Scene>& models, UpAxis up);

    [[nodiscard]] std::uint32_t part_of_report(std::uint32_t model,
                                               std::uint32_t part) const override;
    [[nodiscard]] Transform world_from_mesh(std::uint32_t part) const override;
    void for_each_piece(std::uint32_t mesh,
                        const std::function<void(const Mesh&)>& take) const override;

private:
    const std::vector<Scene>& models_;
    UpAxis up_;
    std::vector<std::uint32_t> first_part_; ///< by model: its first part in parts()
    std::vector<const Mesh*> mesh_order_;
};

} // namespace abut
