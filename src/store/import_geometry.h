#pragma once

#include <abut/progress.h>

#include "core/temporary_file.h"
#include "io/scene_source.h"
#include "store/store_writer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// The meshes of a model in the store, and the boxes of its parts on the disk.
class ImportedGeometry {
public:
    explicit ImportedGeometry(const std::string& folder) : boxes_(folder) {}

    std::vector<std::int64_t> meshes; ///< their numbers in the store, by their numbers in the model
    std::vector<std::uint32_t> triangles; ///< of each

    /// From any thread.
    void set_box(std::uint64_t part, const Box3& box) {
        boxes_.write(part * sizeof box, std::as_bytes(std::span(&box, 1)));
    }
    /// The box of a part: of one after the other.
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

/// Brings all meshes of a model into the store, each once, and finds the boxes of its parts.
///
/// In/out      memory: bytes to keep to; file: for errors.
/// Errors      Error, naming the file and the part: bad_mesh as read_scene, and for coordinates
///             beyond 1e18; those of the store; Error{interrupted}.
void import_geometry(const SceneSource& source, const std::string& file, std::uint64_t memory,
                     const Progress& progress, StoreWriter& writer, ImportedGeometry& result);

} // namespace abut
