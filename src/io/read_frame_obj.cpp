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

void read_obj_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces) {
    const auto take_vertex = [&](std::string_view rest, const LineScan& lines) {
        const double x = take_number(rest, lines), y = take_number(rest, lines),
                     z = take_number(rest, lines);
        positions.push_back({x, y, z});
    };
    scan_obj(content, take_vertex, [&](auto corners) { faces.take(corners); });
}

} // namespace abut
