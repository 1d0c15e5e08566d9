#pragma once

#include <abut/helper_programs.h>
#include <abut/mesh.h>
#include <abut/progress.h>
#include <abut/types.h>

#include <cstdint>
#include <optional>
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

/// The axis of a right-handed frame that points up. A frame with another one is this frame after
/// quarter turns: as COLLADA has it, y up is x right and z towards the viewer, z up is x right and y
/// away from the viewer, x up is y to the left and z towards the viewer.
enum class UpAxis : std::uint8_t { x, y, z };
/// "x", "y", "z".
const char* to_string(UpAxis up);

/// What became of something that a file has and that its scene does not have as the file means it.
enum class NoteKind : std::uint8_t {
    space,     ///< a space or a zone: a volume, but nothing that is built; ReadOptions::spaces
    cut_away,  ///< its openings leave nothing of it
    not_built, ///< its shape could not be built, or some of its shapes
    open,      ///< its shape is a solid; the surface of its part is not closed
};
/// "space", "cut_away", "not_built", "open".
const char* to_string(NoteKind kind);

struct SceneNote {
    NoteKind kind = NoteKind::not_built;
    std::string id;   ///< of the part, or what its id would be (IFC: the GlobalId)
    std::string name; ///< else the same as `id`
    std::string type; ///< may be empty
    std::string text; ///< one line
};

/// A file's parts. Instances share a mesh. The world is in metres.
struct Scene {
    std::string file; ///< path as given
    std::vector<Mesh> meshes;
    std::vector<Part> parts;
    double unit = 1;       ///< metres per unit of the file; applied already
    UpAxis up = UpAxis::y; ///< of the world
    std::vector<SceneNote> notes{};
};

/// Turns the world of a scene by quarter turns, so that this axis points up. Exact: coordinates
/// change places and signs.
void turn_up(Scene& scene, UpAxis up);

/// Turns all scenes into the frame of the first.
void into_one_frame(std::vector<Scene>& scenes);

/// A model file, and the unit and axes of its coordinates where its format does not say them, or
/// says what is wrong.
struct ModelPath {
    std::string path;
    double unit = 0;            ///< metres per unit of the file; 0: as the format says
    std::optional<UpAxis> up{}; ///< none: as the format says
};

/// "pump.stl", "pump.stl:mm", "part.obj:mm:y-up", "scan.ply:0.3048": a path, then perhaps a unit
/// (um, mm, cm, dm, m, km, in, ft, yd, or metres per unit as a number) and an axis (x-up, y-up, z-up).
/// The text of a file that is there is a path, whatever it ends with.
///
/// Errors      Error{bad_argument}, naming the file, if what stands before a colon is a file that is
///             there and what follows is no unit and no axis, or one of them twice.
ModelPath parse_model_path(const std::string& text);

struct ReadOptions {
    /// Metres per unit of a file whose format has no unit of its own (OBJ, OFF, PLY, STL). 0: 1.
    double unit = 0;
    /// What points up in a file whose format does not say it (OBJ, OFF, PLY, STL).
    UpAxis up = UpAxis::z;
    /// Whether IFC's spaces and zones become parts. They are volumes in which things are, and meet
    /// all of them.
    bool spaces = false;
    /// Whether the parts of an IFC file lie on the map that it names (IfcMapConversion): x is the
    /// easting, y the northing, z the height. Else they lie in the coordinates of the project.
    bool map = true;
    /// Seconds after which a reader is stopped. 0: no limit.
    double time_limit = 600;
    /// Bytes of memory that a reader may use. 0: no limit.
    std::uint64_t memory_limit = 0;
    /// Whether a model may refer to files outside of its own folder: buffers of glTF, and material
    /// libraries of OBJ, which are refused though they are never opened.
    bool allow_outside_files = false;
    /// Reports the share of the bytes that is read; stops the readers on request.
    Progress progress{};
};

/// Reads a model: glTF/GLB, OBJ, PLY, STL, OFF, FBX, COLLADA, 3MF; IFC 2x3 and 4, also as ifcZIP,
/// where Node.js is installed.
///
/// Vertices of a mesh at equal positions (-0 equals 0) are joined and come in the order of
/// their first occurrence; one that no triangle uses is kept. Triangles are kept
/// all, in the file's order; polygons are cut.
///
/// The world has the file's own axes, in metres: glTF is in metres and y up; COLLADA, FBX, 3MF and
/// IFC (the last two z up) say their unit and axes; for others `options` hold. ModelPath overrules
/// all of them.
///
/// Third-party readers run in a process of their own (see helper_programs.h), our own in this one.
///
/// Errors      Error, naming the file: file_not_found, unreadable, malformed, unsupported, bad_mesh
///             (an index out of range, a coordinate that is not finite, no triangle or only
///             degenerate ones), reader_failed; Error{interrupted}.
Scene read_scene(const ModelPath& path, const ReadOptions& options = {});
Scene read_scene(const std::string& path, const ReadOptions& options = {});

/// Several files at once, in parallel, each in its own frame. Errors as read_scene; of several, the
/// first file's.
std::vector<Scene> read_scenes(const std::vector<ModelPath>& paths,
                               const ReadOptions& options = {});
std::vector<Scene> read_scenes(const std::vector<std::string>& paths,
                               const ReadOptions& options = {});

/// All parts of a scene as one mesh in world coordinates.
///
/// Errors      Error{bad_mesh}, naming the file, if a mesh cannot have so many vertices.
Mesh to_mesh(const Scene& scene);

/// All parts of a file as one mesh in world coordinates. Errors as read_scene.
Mesh read_mesh(const std::string& path, const ReadOptions& options = {});

/// Writes a scene as binary glTF, atomically: positions as floats, `id` as node name, `name` and
/// `type` as extras, instances shared. A world of other axes is turned y up, as glTF has it: what is
/// read back and turned again has the transforms that were written.
///
/// Errors      Error{cannot_write}, naming the file.
void write_glb(const Scene& scene, const std::string& path);

} // namespace abut
