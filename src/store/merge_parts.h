#pragma once

#include "io/scene_source.h"
#include "store/import_geometry.h"
#include "store/schema.h"

#include <cstdint>

namespace abut {

/// How the parts of a model differ from those that the store had.
struct PartChanges {
    std::uint64_t added = 0, changed = 0, removed = 0;
    [[nodiscard]] bool any() const { return added + changed + removed > 0; }
};

/// Makes the parts of a model those of a source, and its row say so, in one transaction: whoever
/// opens the store sees the model as it was or as it is now.
///
/// A part is known by its id. One whose mesh, place, box, name or type differs gets the generation
/// of this import; the others keep theirs.
///
/// In/out      model: its row with all that is known of the file; parts, triangles, parts_sum and
///             importing are filled here, generation if anything changed.
PartChanges merge_parts(const SceneSource& source, const ImportedGeometry& geometry,
                        std::uint64_t generation, const Progress& progress, ModelRow& model,
                        Database& database);

/// Writes the row, of a new model or one that is there.
void put_model(const ModelRow& model, Database& database);

} // namespace abut
