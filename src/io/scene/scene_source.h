#pragma once

#include <abut/scene.h>

#include "io/file/fault.h"
#include "io/scene/model_frame.h"
#include "io/scene/part_spool.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut {

class ReadWatch;

/// The largest number of vertices, and of triangles, of one mesh.
inline constexpr std::uint64_t kLargestMesh = std::numeric_limits<std::uint32_t>::max() - 1;

/// Receives a mesh as its file stores it: all vertices, then all triangles, in portions of any
/// size.
class MeshSink {
public:
    virtual ~MeshSink() = default;
    virtual void vertices(std::span<const Vec3> positions) = 0;
    virtual void triangles(std::span<const std::array<std::uint32_t, 3>> indices) = 0;
};

struct SourceOptions {
    ReadOptions read{};            ///< its limits apply to processes that read or decode
    std::optional<UpAxis> world{}; ///< up axis of the parts' world; none: the file's own
    std::string folder;            ///< for temporary files, or kInMemory
    std::uint64_t memory = 0;      ///< approximate bytes that a streaming reader may use
    /// Checked while a file is read, now and by SceneSource::read; may be null.
    std::shared_ptr<const ReadWatch> watch = nullptr;
};

/// A model file that is read step by step: parts from a temporary file, geometry mesh by mesh. The
/// scene equals that of read_scene, except that vertices at equal positions are not yet joined.
class SceneSource {
public:
    virtual ~SceneSource() = default;
    SceneSource(const SceneSource&) = delete;
    SceneSource& operator=(const SceneSource&) = delete;

    /// As Scene::parts: ids are unique, names are filled in, and the unit is applied. The parts lie
    /// in the world of SourceOptions::world.
    [[nodiscard]] const PartSpool& parts() const noexcept { return parts_; }
    /// The unit and up axis that are used for the file.
    [[nodiscard]] const ModelFrame& frame() const noexcept { return frame_; }
    /// As Scene::notes.
    [[nodiscard]] const std::vector<SceneNote>& notes() const noexcept { return notes_; }
    /// As the members of Scene.
    struct Facts {
        std::vector<PartRelation> relations;
        std::string project;
        Transform map_from_project;
        ModelPrecision precision;
    };
    [[nodiscard]] const Facts& facts() const noexcept { return facts_; }
    /// Reads the properties of parts in ascending or nearly ascending order. For one thread.
    class PropertyCursor {
    public:
        explicit PropertyCursor(const SceneSource& source)
            : table_(source.property_table()), spool_(source.parts()) {}
        /// Returns a part's properties by ascending name; each pair once.
        [[nodiscard]] std::vector<PartProperty> of(std::uint64_t part);

    private:
        const Properties* table_;
        PartSpool::Cursor spool_;
    };

    struct Size {
        std::uint64_t vertices = 0; ///< before they are joined
        std::uint64_t triangles = 0;
    };
    /// The folder of temporary files.
    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }

    [[nodiscard]] virtual std::uint32_t meshes() const = 0;
    /// The size of a mesh. Both numbers are below 2^32 - 1.
    [[nodiscard]] virtual Size size(std::uint32_t mesh) const = 0;
    /// Sends a mesh to the sink. May be called from any thread.
    ///
    /// Errors      Fault: bad_mesh for an index out of range; malformed, unreadable. Coordinates
    ///             are not checked.
    virtual void read(std::uint32_t mesh, MeshSink& sink) const = 0;
    /// Returns whether geometry stays in the file until it is read.
    [[nodiscard]] virtual bool streams() const { return true; }

protected:
    /// For a reader that hands on coordinates in single precision, as all of Abut's own do.
    SceneSource(const FormatFrame& format, const ModelPath& path, const SourceOptions& options)
        : SceneSource(model_frame(format, path, options.read), options) {
        factor_ = scale_of(format, format.unit, frame_);
        facts_.precision.single_meshes = true;
    }
    /// For a scene whose parts are already in metres.
    SceneSource(const ModelFrame& frame, const SourceOptions& options)
        : folder_(options.folder), frame_(frame), world_(options.world.value_or(frame.up)),
          parts_(options.folder) {}

    /// In          part: as the file stores it, in the file's unit and axes.
    void append(Part part, std::span<const PartProperty> properties = {}) {
        scale(part.world_from_mesh, factor_);
        part.world_from_mesh = turned(part.world_from_mesh, frame_.up, world_);
        parts_.append(part, properties);
    }
    void finish() { parts_.finish(); }

    /// The properties of all parts if they are in memory; null if they are with the parts.
    [[nodiscard]] virtual const Properties* property_table() const { return nullptr; }

    std::vector<SceneNote> notes_; // NOLINT: filled by the format's reader
    Facts facts_;                  // NOLINT: filled by the format's reader

private:
    std::string folder_;
    ModelFrame frame_;
    UpAxis world_;
    double factor_ = 1;
    PartSpool parts_;
};

/// Opens a model with a streaming reader if one supports the file's content. Otherwise read_scene
/// reads the whole model into memory.
///
/// Errors      Error as read_scene.
std::unique_ptr<SceneSource> open_scene_source(const ModelPath& path, const SourceOptions& options);

/// Opens a model with the streaming reader for its extension. Null: there is none, or the reader
/// does not support the content.
///
/// Errors      Fault; Error of the watch.
std::unique_ptr<SceneSource> open_own_source(const ModelPath& path, const SourceOptions& options);

/// Thrown for a file whose content the streaming readers leave to the isolated reader, which also
/// describes what is wrong with it. After the file has been opened, it can only mean what its text
/// says.
struct NotStreamable : Fault {
    NotStreamable() : Fault(ErrorCode::unreadable, "changed while it was read") {}
};

/// Open a file with a streaming reader. Null: the file has content that only the isolated reader
/// supports or checks.
///
/// Errors      Fault.
std::unique_ptr<SceneSource> open_glb_source(const ModelPath& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_obj_source(const ModelPath& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_ply_source(const ModelPath& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_stl_source(const ModelPath& path, const SourceOptions& options);

} // namespace abut
