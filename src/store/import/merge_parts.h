#pragma once

#include "io/scene/scene_source.h"
#include "store/database/schema.h"
#include "store/import/import_geometry.h"

#include <cstdint>

namespace abut {

/// How the parts of a model differ from those in the store.
struct PartChanges {
    std::uint64_t added = 0, changed = 0, removed = 0;
    [[nodiscard]] bool any() const { return added + changed + removed > 0; }
};

/// Replaces the parts of a model by those of a source, and updates the model's row, in one
/// transaction. Whoever opens the store sees the model either as it was or as it is now.
///
/// A part is identified by its id. A part whose mesh, transform, box, name, type, properties or
/// relations have changed gets the generation of this import; the others keep theirs, unless the
/// precision of the file has changed.
///
/// In/out      model: its row with all that is known of the file. Sets parts, triangles, parts_sum
///             and importing, and generation if anything changed.
PartChanges merge_parts(const SceneSource& source, const ImportedGeometry& geometry,
                        std::uint64_t generation, const Progress& progress, ModelRow& model,
                        Database& database);

/// Writes the row of a model, new or existing.
void put_model(const ModelRow& model, Database& database);

} // namespace abut
