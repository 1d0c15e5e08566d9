#pragma once

#include <abut/model.h>

#include "massive/stored_parts.h"
#include "massive/work_units.h"
#include "store/store_file.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// Models of a store's meshes, as many as a number of bytes allows. The order of work is known, so
/// what is used again the latest goes first.
///
/// Source      [Belady 1966].
class ModelCache {
public:
    /// In          units: in the order of work; must outlive the cache, as the others.
    ModelCache(StoreFile& store, std::span<const StoredMesh> meshes,
               std::span<const WorkUnit> units, std::uint64_t budget);

    /// Brings all models of a unit into memory, in parallel, and keeps those of the unit before: its
    /// pairs may be tested meanwhile, unless either is `alone`. Units come one after the other.
    ///
    /// Errors      those of the store.
    void load(std::size_t unit);

    [[nodiscard]] const Model& model(std::uint32_t mesh) const { return *models_[mesh]; }

    [[nodiscard]] std::uint64_t loads() const { return loads_; }
    [[nodiscard]] std::uint64_t peak_bytes() const { return peak_bytes_; }

private:
    void make_room(std::size_t unit, std::uint64_t bytes);
    /// The first unit from `from` on that uses a mesh; the number of units if there is none.
    [[nodiscard]] std::uint32_t next_use(std::uint32_t mesh, std::size_t from) const;

    StoreFile& store_;
    std::span<const StoredMesh> meshes_;
    std::span<const WorkUnit> units_;
    std::uint64_t budget_;
    std::vector<std::optional<Model>> models_; ///< by mesh
    std::vector<std::uint32_t> first_use_;     ///< by mesh, in uses_
    std::vector<std::uint32_t> uses_;          ///< units, ascending
    std::vector<std::uint32_t> resident_;      ///< meshes
    std::uint64_t bytes_ = 0, peak_bytes_ = 0, loads_ = 0;
};

} // namespace abut
