#pragma once

#include <abut/scene.h>

#include "io/fault.h"
#include "io/part_spool.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace abut {

/// Takes a mesh as its file has it: all vertices, then all triangles, in pieces of any size.
class MeshSink {
public:
    virtual ~MeshSink() = default;
    virtual void vertices(std::span<const Vec3> positions) = 0;
    virtual void triangles(std::span<const std::array<std::uint32_t, 3>> indices) = 0;
};

/// A model file that is read in pieces: parts from a temporary file, geometry mesh by mesh. It is
/// the scene that read_scene gives, but for vertices at equal positions, which are not joined yet.
class SceneSource {
public:
    virtual ~SceneSource() = default;
    SceneSource(const SceneSource&) = delete;
    SceneSource& operator=(const SceneSource&) = delete;

    /// As in Scene::parts: ids are unique, names filled, the unit applied.
    [[nodiscard]] const PartSpool& parts() const noexcept { return parts_; }

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
    explicit SceneSource(const std::string& folder) : folder_(folder), parts_(folder) {}
    std::string folder_; // NOLINT: read by those who know the format
    PartSpool parts_;    // NOLINT: filled by them
};

struct SourceOptions {
    double unit = 0;          ///< as ReadOptions::unit
    std::string folder;       ///< for temporary files
    std::uint64_t memory = 0; ///< bytes that a reader of its own may use, roughly
    Progress progress{};
};

/// Opens a model by a streaming reader of our own, where there is one for what the file holds; else
/// by read_scene, and then the whole model is in memory.
///
/// Errors      Error as read_scene.
std::unique_ptr<SceneSource> open_scene_source(const std::string& path,
                                               const SourceOptions& options);

/// Thrown for a file that holds what the streaming readers leave to the isolated one, which also
/// finds the words for what is wrong. Past the opening it can only mean what its text says.
struct NotStreamable : Fault {
    NotStreamable() : Fault(ErrorCode::unreadable, "has changed while it was read") {}
};

/// The streaming readers. Null: the file has something that only the isolated reader knows, or
/// judges.
///
/// Errors      Fault.
std::unique_ptr<SceneSource> open_glb_source(const std::string& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_obj_source(const std::string& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_ply_source(const std::string& path, const SourceOptions& options);
std::unique_ptr<SceneSource> open_stl_source(const std::string& path, const SourceOptions& options);

} // namespace abut
