#pragma once

#include "io/part_spool.h"
#include "io/random_access_file.h"
#include "io/scene_source.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// What the JSON of a GLB file says, in a few bytes an element: nodes lie on the disk.
struct GlbDocument {
    struct View {
        std::uint64_t offset = 0, bytes = 0;
        std::uint32_t stride = 0; ///< 0: none given
        bool is_plain = false;    ///< in the file's binary chunk
    };
    struct Accessor {
        std::uint64_t offset = 0, count = 0;
        std::uint32_t view = kNone;
        std::uint16_t component = 0;
        bool is_vector = false, is_scalar = false;
    };
    struct Primitive {
        std::uint32_t position = kNone, indices = kNone;
    };
    static constexpr std::uint32_t kNone = 0xffffffff;

    explicit GlbDocument(const std::string& folder) : nodes(folder) {}

    std::uint64_t binary_at = 0, binary_bytes = 0; ///< of the binary chunk in the file
    std::vector<View> views;
    std::vector<Accessor> accessors;
    std::vector<Primitive> primitives;
    std::vector<std::uint64_t> first_primitive{0}; ///< by mesh, and one past the last
    /// A node's name, extras and mesh (kNone: none) as those of a part; its transform is
    /// parent_from_node.
    PartSpool nodes;
    std::vector<std::uint32_t> children;
    std::vector<std::uint64_t> first_child{0}; ///< by node, and one past the last
    std::vector<std::uint32_t> roots;

    [[nodiscard]] std::uint32_t meshes() const {
        return static_cast<std::uint32_t>(first_primitive.size() - 1);
    }
};

/// Errors      NotStreamable; Fault malformed for a file that is cut short.
/// Cost        one pass over the JSON, of which one element at a time is in memory.
void read_glb_document(const RandomAccessFile& file, GlbDocument& document);

} // namespace abut
