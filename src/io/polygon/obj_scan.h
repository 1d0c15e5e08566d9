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

/// Goes through the vertices, faces and names of an OBJ file, in its order; all else in it is passed
/// over, a vertex's weight and colour too.
///
/// In          face: is given at least three corners, as indices from 0 of `v` lines. They can be
///             trusted only once the scan has returned, since a face may come before its vertices.
///             name: is given `o`, `g` or `mtllib` and the rest of the line; may be empty.
/// Errors      Fault malformed for a face of less than three corners or a word that is no number,
///             bad_mesh for a corner that no vertex is for; what the functions throw.
void scan_obj(
    ByteStream& content, const std::function<void(const Vec3&)>& vertex,
    const std::function<void(std::span<const std::uint64_t> corners)>& face,
    const std::function<void(std::string_view statement, std::string_view name)>& name = {});

/// Tells which part each face of an OBJ file belongs to.
///
/// Each `o` begins an object. Within one, each group (`g`) is a part of its own, and goes on when it
/// is named again; faces outside of any group, or in the group `default`, are the object's. A part
/// has the name of its group, else that of its object, else "defaultobject".
class ObjParts {
public:
    /// In          as scan_obj gives it; what is no name of a part changes nothing.
    void name(std::string_view statement, std::string_view name);

    /// The number of the part of a face that comes now, from 0 in the order of the first faces.
    std::size_t of_face();

    [[nodiscard]] const std::vector<std::string>& ids() const noexcept { return ids_; }

private:
    std::string object_, group_;
    std::map<std::string, std::size_t> part_of_group_; ///< of the object
    std::optional<std::size_t> current_;
    std::vector<std::string> ids_;
};

/// Refuses material libraries (`mtllib`) outside of the model's folder, though none is ever opened.
///
/// In          libraries: names, separated by blanks. One that holds blanks is judged word by word.
/// Errors      Fault unsupported, as companion_path.
void check_libraries(const std::string& model, std::string_view libraries, bool allow_outside);

} // namespace abut
