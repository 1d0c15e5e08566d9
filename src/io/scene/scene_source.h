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

/// The most vertices, and the most triangles, of one mesh.
inline constexpr std::uint64_t kLargestMesh = std::numeric_limits<std::uint32_t>::max() - 1;

/// Takes a mesh as its file has it: all vertices, then all triangles, in pieces of any size.
class MeshSink {
public:
    virtual ~MeshSink() = default;
    virtual void vertices(std::span<const Vec3> positions) = 0;
    virtual void triangles(std::span<const std::array<std::uint32_t, 3>> indices) = 0;
};

struct SourceOptions {
    ReadOptions read{};            ///< its limits are for processes that read or decode
    std::optional<UpAxis> world{}; ///< of the parts' world; none: the file's own
    std::string folder;            ///< for temporary files, or kInMemory
    std::uint64_t memory = 0;      ///< bytes that a reader of its own may use, roughly
    /// Is asked while a file is read, now and by SceneSource::read; null: nobody is.
    std::shared_ptr<const ReadWatch> watch = nullptr;
};

/// A model file that is read in pieces: parts from a temporary file, geometry mesh by mesh. It is
/// the scene that read_scene gives, but for vertices at equal positions, which are not joined yet.
class SceneSource {
public:
    virtual ~SceneSource() = default;
    SceneSource(const SceneSource&) = delete;
    SceneSource& operator=(const SceneSource&) = delete;

    /// As in Scene::parts: ids are unique, names filled, the unit applied. They lie in the world that
    /// SourceOptions::world asks for.
    [[nodiscard]] const PartSpool& parts() const noexcept { return parts_; }
    /// The unit and axes that the file is taken in.
    [[nodiscard]] const ModelFrame& frame() const noexcept { return frame_; }
    /// As Scene::notes.
    [[nodiscard]] const std::vector<SceneNote>& notes() const noexcept { return notes_; }

    struct Size {
        std::uint64_t vertices = 0; ///< before they are joined
        std::uint64_t triangles = 0;
    };
    /// Of temporary files.
    [[nodiscard]] const std::string& folder() const noexcept { return folder_; }

    [[nodiscard]] virtual std::uint32_t meshes() const = 0;
    /// Both are below 2^32 - 1.
    [[nodiscard]] virtual Size size(std::uint32_t mesh) const = 0;
    /// From any thread.
    ///
    /// Errors      Fault: bad_mesh for an index out of range; malformed, unreadable. Coordinates are
    ///             not checked.
    virtual void read(std::uint32_t mesh, MeshSink& sink) const = 0;
    /// Whether geometry stays in the file until it is asked for.
    [[nodiscard]] virtual bool streams() const { return true; }

protected:
    SceneSource(const FormatFrame& format, const ModelPath& path, const SourceOptions& options)
        : SceneSource(model_frame(format, path, options.read), options) {
        factor_ = scale_of(format, format.unit, frame_);
    }
    /// Of a scene whose parts are in metres already.
    SceneSource(const ModelFrame& frame, const SourceOptions& options)
        : folder_(options.folder), frame_(frame), world_(options.world.value_or(frame.up)),
          parts_(options.folder) {}

    /// In          a part as the file has it, in the file's unit and axes.
    void append(Part part) {
        scale(part.world_from_mesh, factor_);
        part.world_from_mesh = turned(part.world_from_mesh, frame_.up, world_);
        parts_.append(part);
    }
    void finish() { parts_.finish(); }

    std::vector<SceneNote> notes_; // NOLINT: filled by those who know the format

private:
    std::string folder_;
    ModelFrame frame_;
    UpAxis world_;
    double factor_ = 1;
    PartSpool parts_;
};

/// Opens a model by a streaming reader of our own, where there is one for what the file holds; else
/// by read_scene, and then the whole model is in memory.
///
/// Errors      Error as read_scene.
std::unique_ptr<SceneSource> open_scene_source(const ModelPath& path, const SourceOptions& options);

/// The streaming readers by the path's extension; null: none of them, or not for what it holds.
///
/// Errors      Fault; Error of the watch.
std::unique_ptr<SceneSource> open_own_source(const ModelPath& path, const SourceOptions& options);

/// Thrown for a file that holds what the streaming readers leave to the isolated one, which also
/// finds the words for what is wrong. Past the opening it can only mean what its text says.
struct NotStreamable : Fault {
    NotStreamable() : Fault(ErrorCode::unreadable, "has changed while it was read") {}
};

/// The streaming readers. Null: the file has something that only the isolated reader knows, or
/// judges.
///
/// Errors      Fault.
std::unique_ptr<SceneSource> open_glb_source(const ModelPath& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_obj_source(const ModelPath& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_ply_source(const ModelPath& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_stl_source(const ModelPath& path, const SourceOptions& options);

} // namespace abut
