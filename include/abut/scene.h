#pragma once

#include <abut/helper_programs.h>
#include <abut/mesh.h>
#include <abut/progress.h>
#include <abut/properties.h>
#include <abut/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// A colour as displays take it: sRGB, alpha not multiplied in. 0 is transparent.
struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
    friend bool operator==(const Colour&, const Colour&) = default;
};
/// "#rrggbb"; "#rrggbbaa" if it is not opaque.
std::string to_string(const Colour& colour);

/// One node of a model file that has geometry.
struct Part {
    std::string id; ///< the node's name (glTF of a building: the GlobalId); unique within its scene
    std::string name;       ///< `extras.name`; if missing, the id
    std::string type;       ///< `extras.type`; if missing, empty
    std::uint32_t mesh = 0; ///< index in Scene::meshes
    Transform world_from_mesh;
    /// The colour of the material that covers the most of its triangles. None if the file states
    /// none there, or if the material has a texture, because textures are not read.
    std::optional<Colour> colour{};
};

/// The axis of a right-handed frame that points up. Frames with different up axes differ by quarter
/// turns, as in COLLADA. y up: x points right and z towards the viewer. z up: x points right and y
/// away from the viewer. x up: y points left and z towards the viewer.
enum class UpAxis : std::uint8_t { x, y, z };
/// "x", "y", "z".
const char* to_string(UpAxis up);

/// The kind of a note about something that the scene lacks or holds differently from its file.
enum class NoteKind : std::uint8_t {
    space,     ///< a space or a zone: a volume without material; see ReadOptions::spaces
    cut_away,  ///< its openings remove all of it
    not_built, ///< its shape, or one of its shapes, could not be built
    open,      ///< its shape is a solid, but the part's surface is not closed
};
/// "space", "cut_away", "not_built", "open".
const char* to_string(NoteKind kind);

struct SceneNote {
    NoteKind kind = NoteKind::not_built;
    std::string id;   ///< the part's id, or the id that it would have (IFC: the GlobalId)
    std::string name; ///< if the file has none, the id
    std::string type; ///< may be empty
    std::string text; ///< one line
};

/// What a model tells apart. The clash job takes its touch tolerance from it (docs/clash.md).
///
/// Of a scene that a program makes, nothing is known: its coordinates count as exact.
struct ModelPrecision {
    /// Metres: points that are nearer to each other are one point for the program that wrote the
    /// file. IFC states it, and quantised positions of glTF imply it. 0: the file states none.
    double stated = 0;
    /// Whether the file or its reader has rounded the coordinates of the meshes to single precision.
    bool single_meshes = false;
    /// Whether it has rounded the transforms of the parts, too.
    bool single_transforms = false;
    friend bool operator==(const ModelPrecision&, const ModelPrecision&) = default;
};

/// The parts of a model file. Instances share a mesh. The world is in metres.
struct Scene {
    std::string file; ///< path as given
    std::vector<Mesh> meshes;
    std::vector<Part> parts;
    double unit = 1;       ///< metres per unit of the file; already applied
    UpAxis up = UpAxis::y; ///< up axis of the world
    std::vector<SceneNote> notes{};
    Properties properties{};               ///< of the parts (docs/properties.md)
    std::vector<PartRelation> relations{}; ///< of the parts; ascending, each one once
    std::string project{};                 ///< the GlobalId of an IFC file's project; else empty
    /// From the coordinates of an IFC project to those of the map that its file names, both in
    /// metres with z up, whatever the axes of this scene; the identity if it names none.
    /// ReadOptions::map says whether the parts lie on the map already.
    Transform map_from_project{};
    ModelPrecision precision{};
};

/// Turns the world of a scene by quarter turns, so that this axis points up. Exact: only the order
/// and the signs of coordinates change.
void turn_up(Scene& scene, UpAxis up);

/// Turns all scenes to the axes of the first.
void into_one_frame(std::vector<Scene>& scenes);

/// A model file, with the unit and up axis of its coordinates. Give them where the file's format
/// does not state them, or where the file states them wrongly.
struct ModelPath {
    std::string path;
    double unit = 0;            ///< metres per unit of the file; 0: as the format defines
    std::optional<UpAxis> up{}; ///< none: as the format defines
};

/// Parses a path that may be followed by a unit (um, mm, cm, dm, m, km, in, ft, yd, or metres per
/// unit as a number) and an up axis (x-up, y-up, z-up): "pump.stl", "pump.stl:mm",
/// "part.obj:mm:y-up", "scan.ply:0.3048". If the whole text names an existing file, it is only a
/// path.
///
/// Errors      Error{bad_argument}, naming the file, if the text before a colon names an existing
///             file, but the text after it is not a unit or an axis, or gives one of them twice.
ModelPath parse_model_path(const std::string& text);

struct ReadOptions {
    /// Metres per unit of a file whose format defines no unit (OBJ, OFF, PLY, STL). 0: 1.
    double unit = 0;
    /// Up axis of a file whose format defines none (OBJ, OFF, PLY, STL).
    UpAxis up = UpAxis::z;
    /// Whether the spaces and zones of IFC become parts. They are volumes that contain other parts
    /// and would collide with all of them.
    bool spaces = false;
    /// Whether the parts of an IFC file are placed on the map that the file names
    /// (IfcMapConversion): x is the easting, y the northing, z the height. Otherwise the project's
    /// coordinates are used.
    bool map = true;
    /// Seconds after which a reader is stopped. 0: no limit.
    double time_limit = 600;
    /// Bytes of memory that a reader may use. 0: no limit.
    std::uint64_t memory_limit = 0;
    /// Whether a model may refer to files outside its own folder: buffers of glTF, and material
    /// libraries of OBJ.
    bool allow_outside_files = false;
    /// Reports the fraction of the bytes that have been read; stops the readers on request.
    Progress progress{};
};

/// Reads a model file: glTF/GLB, OBJ, PLY, STL, OFF, FBX, COLLADA, 3MF; also IFC 2x3 and 4 and
/// ifcZIP if Node.js is installed.
///
/// Vertices of a mesh at equal positions (-0 equals 0) are joined, in the order of their first
/// occurrence. A vertex that no triangle uses is kept. All triangles are kept, in the file's order.
/// Polygons are triangulated.
///
/// A part's colour comes from the materials of its triangles. Textures and colours of vertices are
/// not read. What a material states wrongly is no error; values outside of [0, 1] are clamped.
///
/// The world has the file's own axes, in metres. glTF is in metres with y up. COLLADA, FBX, 3MF and
/// IFC state their unit and axes; 3MF and IFC are z up. For all others, `options` apply. A unit or
/// axis in ModelPath overrides all of these.
///
/// Third-party readers run in a separate process (see helper_programs.h); Abut's own run in this
/// one.
///
/// Errors      Error, naming the file: file_not_found, unreadable, malformed, unsupported, bad_mesh
///             (an index out of range, a coordinate that is not finite, no triangle or only
///             degenerate ones), reader_failed; Error{interrupted}.
Scene read_scene(const ModelPath& path, const ReadOptions& options = {});
Scene read_scene(const std::string& path, const ReadOptions& options = {});

/// Reads several files in parallel, each in its own frame. Errors as `read_scene`; if several files
/// fail, the error of the first.
std::vector<Scene> read_scenes(const std::vector<ModelPath>& paths,
                               const ReadOptions& options = {});
std::vector<Scene> read_scenes(const std::vector<std::string>& paths,
                               const ReadOptions& options = {});

/// Returns all parts of a scene as one mesh in world coordinates.
///
/// Errors      Error{bad_mesh}, naming the file, if the mesh would have too many vertices.
Mesh to_mesh(const Scene& scene);

/// Reads all parts of a file as one mesh in world coordinates. Errors as `read_scene`.
Mesh read_mesh(const std::string& path, const ReadOptions& options = {});

/// Writes a scene as binary glTF, atomically. Positions become floats, `id` the node name, `name`,
/// `type` and the properties extras, each distinct colour a material; instances stay shared. A
/// world with another up axis is turned y up, as glTF requires. If it is read again and turned
/// back, it has the transforms, colours and properties that were written, but no relations.
///
/// Errors      Error{cannot_write}, naming the file.
void write_glb(const Scene& scene, const std::string& path);

} // namespace abut
