#include "io/ply_body.h"
#include "io/reader/promise.h"

namespace abut {

std::optional<std::uint64_t> promised_by_ply(ByteStream& content) {
    const PlyHeader header = read_ply_header(content);
    PlyBody body(header, content);
    std::uint64_t triangles = 0;
    bool all_counted = true;
    for (const PlyElement& element : header.elements) {
        all_counted = all_counted && element.name != "tristrips";
        if (element.name == "face")
            take_ply_faces(body, element, header.vertices(), [&](auto corners) {
                triangles += corners.size() < 3 ? 0 : corners.size() - 2;
            });
        else
            skip_ply_elements(body, element);
    }
    return all_counted ? std::optional(triangles) : std::nullopt;
}

} // namespace abut
