#include "io/frames/frame_formats.h"
#include "io/polygon/obj_scan.h"

namespace abut {

void read_obj_frame(ByteStream& content, std::vector<Vec3>& positions, FrameFaces& faces) {
    scan_obj(
        content, [&](const Vec3& position) { positions.push_back(position); },
        [&](auto corners) { faces.take(corners); });
}

} // namespace abut
