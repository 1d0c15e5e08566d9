#include "io/frames/frame_formats.h"
#include "io/polygon/ply_body.h"

namespace abut {

void read_ply_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces) {
    const PlyHeader header = read_ply_header(content);
    PlyBody body(header, content);
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") {
            positions.reserve(positions.size() + body.most(element));
            take_ply_vertices(body, element,
                              [&](const Vec3& position) { positions.push_back(position); });
        } else if (element.name == "face") {
            faces.expect(body.most(element));
            take_ply_faces(body, element, header.vertices(),
                           [&](auto corners) { faces.take(corners); });
        } else if (element.name == "tristrips") {
            throw Fault(ErrorCode::unsupported, "holds triangle strips");
        } else {
            skip_ply_elements(body, element);
        }
    }
    // Only this reveals a header that contradicts its data: bytes of any type are valid numbers.
    if (!body.at_end())
        malformed("goes on after its last element");
}

} // namespace abut
