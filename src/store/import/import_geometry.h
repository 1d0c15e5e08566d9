#pragma once

#include <abut/progress.h>

#include "core/temporary_file.h"
#include "io/scene/scene_source.h"
#include "store/import/store_writer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// The meshes of a model file as they are in the store, and the boxes of its parts, in a temporary
/// file.
class ImportedGeometry {
public:
    explicit ImportedGeometry(const std::string& folder) : boxes_(folder) {}

    std::vector<std::int64_t> meshes;     ///< each mesh's number in the store, by its number in the
                                          ///< file
    std::vector<std::uint32_t> triangles; ///< of each mesh

    /// May be called from any thread.
    void set_box(std::uint64_t part, const Box3& box) {
        boxes_.write(part * sizeof box, std::as_bytes(std::span(&box, 1)));
    }
    /// Reads the boxes of parts, fastest in ascending order.
    class BoxCursor {
    public:
        explicit BoxCursor(const ImportedGeometry& geometry) : reader_(geometry.boxes_) {}
        [[nodiscard]] Box3 box(std::uint64_t part) {
            Box3 box;
            reader_.read(part * sizeof box, std::as_writable_bytes(std::span(&box, 1)));
            return box;
        }

    private:
        TemporaryReader reader_;
    };

private:
    TemporaryFile boxes_;
};

/// Imports all meshes of a model file into the store, each once, and computes the boxes of its
/// parts.
///
/// In/out      memory: bytes that may be used; file: named in errors.
/// Errors      Error, naming the file and the part: bad_mesh as read_scene, and for coordinates
///             beyond 1e18; those of the store; Error{interrupted}.
void import_geometry(const SceneSource& source, const std::string& file, std::uint64_t memory,
                     const Progress& progress, StoreWriter& writer, ImportedGeometry& result);

} // namespace abut
