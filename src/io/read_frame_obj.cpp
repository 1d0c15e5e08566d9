#include "io/fault.h"
#include "io/frame_formats.h"
#include "io/obj_scan.h"

namespace abut {

namespace {

double take_number(std::string_view& rest, const LineScan& lines) {
    const auto number = to_number<double>(take_word(rest));
    if (!number)
        malformed(lines.place() + ": a vertex needs three numbers");
    return *number;
}

} // namespace

Mesh read_obj_frame(ByteStream& content) {
    Mesh mesh;
    const auto take_vertex = [&](std::string_view rest, const LineScan& lines) {
        const double x = take_number(rest, lines), y = take_number(rest, lines),
                     z = take_number(rest, lines);
        mesh.positions.push_back({x, y, z});
    };
    scan_obj(content, take_vertex, [&](auto corners) { append_fan(corners, mesh.triangles); });
    return mesh;
}

} // namespace abut
