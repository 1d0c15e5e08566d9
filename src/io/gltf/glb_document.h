#pragma once

#include "core/temporary_file.h"
#include "io/file/random_access_file.h"
#include "io/scene/part_spool.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// The JSON of a glTF 2 file, GLB or text, in a few bytes an element. The nodes are on disk.
///
/// Indices are those of the file and may be out of range, unless stated otherwise.
struct GlbDocument {
    static constexpr std::uint32_t kNone = 0xffffffff;

    struct Buffer {
        enum class Place : std::uint8_t {
            none,      ///< no content: a compressed form exists for whatever refers to it
            binary,    ///< the GLB file's binary chunk
            data,      ///< a data: URI, decoded into `spool` from position `at`
            companion, ///< a file beside the model: entry `at` of `companions`
        };
        Place place = Place::none;
        std::uint64_t at = 0;
        std::uint64_t bytes = 0; ///< readable bytes; never more than exist
    };
    struct View {
        std::uint32_t buffer = kNone;
        std::uint32_t stride = 0;         ///< 0: not given
        std::uint32_t compressed = kNone; ///< index in `compressed`
        std::uint64_t offset = 0, bytes = 0;
    };
    /// A buffer view compressed by meshoptimizer.
    struct Compressed {
        enum class Mode : std::uint8_t { attributes, triangles, indices };
        enum class Filter : std::uint8_t { none, octahedral, quaternion, exponential, color };
        std::uint32_t buffer = kNone, stride = 0;
        std::uint64_t offset = 0, bytes = 0, count = 0;
        Mode mode = Mode::attributes;
        Filter filter = Filter::none;
    };
    struct Accessor {
        std::uint64_t offset = 0, count = 0;
        std::uint32_t view = kNone;   ///< kNone: all zeros
        std::uint32_t sparse = kNone; ///< index in `sparse`
        std::uint16_t component = 0;  ///< component type, as glTF numbers it: 5126 is float
        std::uint8_t components = 0;  ///< 1 for SCALAR … 4 for VEC4; 0 for any other type
        bool is_normalized = false;
    };
    /// Elements that replace those of an accessor's view.
    struct Sparse {
        std::uint64_t count = 0, index_offset = 0, value_offset = 0;
        std::uint32_t index_view = kNone, value_view = kNone;
        std::uint16_t index_component = 0;
    };
    struct Primitive {
        enum class Mode : std::uint8_t { other, triangles = 4, strip = 5, fan = 6 };
        std::uint32_t position = kNone, indices = kNone;
        std::uint32_t draco = kNone;    ///< index in `draco`
        std::uint32_t material = kNone; ///< index in `materials`
        Mode mode = Mode::triangles;    ///< other: points or lines
    };
    /// A primitive compressed by Draco.
    struct Draco {
        std::uint32_t view = kNone;
        std::uint32_t position = kNone; ///< unique id of the attribute
    };
    /// Accessors that place a node's mesh several times.
    struct Instances {
        std::uint32_t node = kNone;
        std::uint32_t translation = kNone, rotation = kNone, scale = kNone;
    };

    explicit GlbDocument(const std::string& folder) : spool(folder), nodes(folder) {}

    std::uint64_t binary_at = 0, binary_bytes = 0; ///< the binary chunk's place in the file
    TemporaryFile spool;                           ///< decoded contents of data: URIs
    std::uint64_t spooled = 0;
    std::vector<std::string> companions; ///< URIs, decoded
    std::vector<Buffer> buffers;
    std::vector<View> views;
    std::vector<Compressed> compressed;
    std::vector<Accessor> accessors;
    std::vector<Sparse> sparse;
    std::vector<Primitive> primitives;
    std::vector<std::uint64_t> first_primitive{0}; ///< by mesh, with one entry past the last
    std::vector<Draco> draco;
    std::vector<std::optional<Colour>> materials; ///< only their colours
    /// Each node as a part, with the node's name, extras and mesh (kNone: none). The part's
    /// transform is parent_from_node.
    PartSpool nodes;
    std::vector<Instances> instances; ///< by node, ascending
    std::vector<std::uint32_t> children;
    std::vector<std::uint64_t> first_child{0}; ///< by node, with one entry past the last
    std::vector<std::uint32_t> roots;
    bool requires_draco = false, requires_meshopt = false;

    [[nodiscard]] std::uint32_t meshes() const {
        return static_cast<std::uint32_t>(first_primitive.size() - 1);
    }
};

/// Reads the JSON of a GLB file, or of a text file if is_text is set. The lengths of companion
/// files are not known yet.
///
/// Errors      Fault malformed; unsupported for another version of glTF, and for a required
///             extension that may change geometry and is not supported.
/// Cost        one pass over the JSON with one element in memory at a time; a data: URI is one
///             element.
void read_glb_document(const RandomAccessFile& file, bool is_text, GlbDocument& document);

} // namespace abut
