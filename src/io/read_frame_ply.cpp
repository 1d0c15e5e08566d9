#include "io/frame_formats.h"
#include "io/ply_body.h"

#include <algorithm>

namespace abut {

namespace {

using Axes = std::array<const PlyProperty*, 3>;

/// The properties x, y and z.
Axes axes_of(const PlyElement& vertex) {
    Axes axes{};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::string name(1, "xyz"[i]);
        for (const PlyProperty& property : vertex.properties)
            if (property.name == name && !property.is_list)
                axes.at(i) = &property;
        if (axes.at(i) == nullptr)
            malformed("its vertices have no " + name);
    }
    return axes;
}

/// False at the end of the data.
bool take_vertex(PlyBody& body, const PlyElement& element, const Axes& axes, Vec3& position) {
    for (const PlyProperty& property : element.properties) {
        const bool taken = &property == axes[0]   ? body.take(property.value, position.x)
                           : &property == axes[1] ? body.take(property.value, position.y)
                           : &property == axes[2] ? body.take(property.value, position.z)
                                                  : body.skip(property);
        if (!taken)
            return false;
    }
    return true;
}

void take_vertices(PlyBody& body, const PlyElement& element, std::vector<Vec3>& positions) {
    const Axes axes = axes_of(element);
    positions.reserve(positions.size() + body.most(element));
    take_ply_elements(element,
                      [&] { return take_vertex(body, element, axes, positions.emplace_back()); });
}

} // namespace

void read_ply_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces) {
    const PlyHeader header = read_ply_header(content);
    PlyBody body(header, content);
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") {
            take_vertices(body, element, positions);
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
    // A header that contradicts its data shows in nothing else: bytes of any type are numbers.
    if (!body.at_end())
        malformed("goes on after its last element");
}

} // namespace abut
