#pragma once

#include <cstdint>

/// The result that a reader in a separate process returns. `abut-reader` and ifc/convert.mjs write
/// it; decode_scene checks and decodes it. Byte order is the machine's; nothing is aligned or
/// padded.
///
///     header   char[8] magic "abutscn5"
///              u32     status: 0 a scene follows; 1 + ErrorCode: an error follows
///              u32     bytes of the error's text (0 for a scene)
///              u64     meshes
///              u64     parts
///              f64     metres per unit of the file, as its format defines; 0: not defined
///              f64     metres per coordinate as sent, as the format defines
///              u32     up axis: 0 if the format defines none, else 1 + UpAxis
///              u32     notes
///     error    the text: one line without the file's name
///     mesh     u32 vertices | u32 triangles | u32 bytes of a coordinate, 4 or 8
///              f32 or f64 [3 vertices] x y z … | u32[3 triangles] a b c …
///     part     f64[12] world_from_mesh (see Transform) | u32 mesh | u32 id, u32 name, u32 type:
///              bytes | u32 1 if it has a colour, else 0 | u8[4] red, green, blue, alpha (see
///              Colour) | the three texts
///     note     u32 NoteKind | u32 id, u32 name, u32 type, u32 text: bytes | the four texts
///     known    f64[12] map_from_project (see Scene; in metres) | f64 precision as stated, in metres
///              (see ModelPrecision) | u64 rounded to float: 0 nothing, 1 positions, 3 transforms too
///              u32 names | u32 values | u32 relations | u32 project: bytes | u64 entries
///              the text of the project
///              names: u32 bytes, text | … | values: u32 bytes, text | …
///              u32[parts] entries of each part | entries: u32 name, u32 value | …
///              relations: u32 a, u32 b, u32 RelationKind | …   (see PartRelation; in any order)
///     end      char[8] "abut-end", and nothing after it
///
/// All meshes come before all parts, and all parts before all notes. The entries of parts are left
/// out, with their counts, if there is none. Positions are floats, as both
/// readers deliver them, or doubles where the IFC converter joins several geometries.
namespace abut::scene_stream {

inline constexpr char kMagic[8] = {'a', 'b', 'u', 't', 's', 'c', 'n', '5'};
inline constexpr char kEnd[8] = {'a', 'b', 'u', 't', '-', 'e', 'n', 'd'};

struct Header {
    char magic[8];
    std::uint32_t status;
    std::uint32_t text_size;
    std::uint64_t meshes;
    std::uint64_t parts;
    double unit;
    double applied;
    std::uint32_t up;
    std::uint32_t notes;
};
static_assert(sizeof(Header) == 56);

struct Known {
    double map_from_project[12];
    double precision;
    std::uint64_t rounded;
    std::uint32_t names, values, relations, project_size;
    std::uint64_t entries;
};
static_assert(sizeof(Known) == 136);

/// Values of Known::rounded.
inline constexpr std::uint64_t kRoundedPositions = 1, kRoundedAll = 3;

/// Written for an index that its primitive does not contain, so that it is out of range in the
/// whole mesh, too.
inline constexpr std::uint32_t kBadIndex = 0xffffffff;

/// The descriptor that the result is written to.
inline constexpr int kResultFile = 3;

/// Exit status of a reader that ran out of memory. Status 0 means that the stream is complete, with
/// a scene or an error.
inline constexpr int kOutOfMemory = 12;

} // namespace abut::scene_stream
