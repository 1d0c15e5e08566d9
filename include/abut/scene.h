#pragma once

#include <abut/mesh.h>
#include <abut/progress.h>
#include <abut/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// One node with geometry.
struct Part {
    std::string
        id; ///< the node's name (glTF from a building: the GlobalId); unique within its scene
    std::string name;       ///< `extras.name`, else the same as `id`
    std::string type;       ///< `extras.type`, else empty
    std::uint32_t mesh = 0; ///< index in Scene::meshes
    Transform world_from_mesh;
};

/// A file's parts. Instances share a mesh.
struct Scene {
    std::string file; ///< path as given
    std::vector<Mesh> meshes;
    std::vector<Part> parts;
};

struct ReadOptions {
    /// Metres per unit of the file. 0: what the format says (glTF and IFC), else 1.
    double unit = 0;
    /// Seconds after which a reader is stopped. 0: no limit.
    double time_limit = 600;
    /// Bytes of memory that a reader may use. 0: no limit.
    std::uint64_t memory_limit = 0;
    /// Reports the share of the bytes that is read; stops the readers on request.
    Progress progress{};
};

/// Reads a model: glTF/GLB, OBJ, PLY, STL, OFF, FBX, COLLADA; IFC 2x3 and 4 where Node.js is
/// installed.
///
/// Vertices of a mesh at equal positions (-0 equals 0) are joined and come in the order of
/// their first occurrence; one that no triangle uses is kept. Triangles are kept
/// all, in the file's order; polygons are cut.
///
/// Third-party readers run in a process of their own, so that a crash in one is an Error here.
///
/// Errors      Error, naming the file: file_not_found, unreadable, malformed, unsupported, bad_mesh
///             (an index out of range, a coordinate that is not finite, no triangle or only
///             degenerate ones), reader_failed; Error{interrupted}.
Scene read_scene(const std::string& path, const ReadOptions& options = {});

/// Several files at once, in parallel. Errors as read_scene; of several, the first file's.
std::vector<Scene> read_scenes(const std::vector<std::string>& paths,
                               const ReadOptions& options = {});

/// All parts of a file as one mesh in world coordinates. Errors as read_scene.
Mesh read_mesh(const std::string& path, const ReadOptions& options = {});

/// Writes a scene as binary glTF, atomically: positions as floats, `id` as node name, `name` and
/// `type` as extras, instances shared.
///
/// Errors      Error{cannot_write}, naming the file.
void write_glb(const Scene& scene, const std::string& path);

} // namespace abut
