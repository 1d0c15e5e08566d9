#pragma once

#include "io/file/text_scan.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Reads the vertices, faces and names of an OBJ file, in order. Everything else is ignored, also
/// the weight and the colour of a vertex.
///
/// In          face: receives at least three corners, as indices from 0 of `v` lines. They are
///             checked only when the scan returns, because a face may precede its vertices.
///             name: receives `o`, `g`, `mtllib` or `usemtl` and the rest of the line; may be
///             empty.
/// Errors      Fault malformed for a face of fewer than three corners or a word that is not a
///             number, bad_mesh for a corner without a vertex; any exception that the functions
///             throw.
void scan_obj(
    ByteStream& content, const std::function<void(const Vec3&)>& vertex,
    const std::function<void(std::span<const std::uint64_t> corners)>& face,
    const std::function<void(std::string_view statement, std::string_view name)>& name = {});

/// Finds the part that each face of an OBJ file belongs to.
///
/// Each `o` starts an object. Within an object, each group (`g`) is a separate part, and continues
/// if it is named again. Faces outside any group, or in the group `default`, belong to the object.
/// A part is named after its group, else after its object, else "defaultobject".
class ObjParts {
public:
    /// In          as scan_obj passes it. A statement that does not name a part has no effect.
    void name(std::string_view statement, std::string_view name);

    /// Returns the part number of the next face, counted from 0 in the order of the first faces.
    std::size_t of_face();

    [[nodiscard]] const std::vector<std::string>& ids() const noexcept { return ids_; }

private:
    std::string object_, group_;
    std::map<std::string, std::size_t> part_of_group_; ///< of the current object
    std::optional<std::size_t> current_;
    std::vector<std::string> ids_;
};

} // namespace abut
