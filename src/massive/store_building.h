#pragma once

#include <abut/store_clash.h>

#include "clash/building/building_source.h"
#include "store/database/store_file.h"

#include <vector>

namespace abut {

/// The geometry of a job's models in a store. Meshes are read block by block; of the parts, only
/// boxes and numbers are in memory.
class StoreBuilding final : public BuildingSource {
public:
    /// In          found: a report about this store. Both must outlive the source.
    /// Errors      those of the store; Error{unreadable} if a part of the report is missing.
    StoreBuilding(const StoreClashReport& found, StoreFile& store);

    [[nodiscard]] std::uint32_t part_of_report(std::uint32_t model,
                                               std::uint32_t part) const override;
    [[nodiscard]] Transform world_from_mesh(std::uint32_t part) const override;
    void for_each_piece(std::uint32_t mesh,
                        const std::function<void(const Mesh&)>& take) const override;

private:
    void gather_meshes();
    void gather_parts_of(std::uint32_t model, const ModelRow& row,
                         const std::vector<Part>& clashing);

    StoreFile& store_;
    std::vector<std::int64_t> mesh_rows_;               ///< by mesh, ascending
    std::vector<std::int64_t> part_rows_;               ///< by part
    std::vector<std::vector<std::uint32_t>> of_report_; ///< by model and part of the report
};

} // namespace abut
