#include "io/fault.h"
#include "io/obj_scan.h"
#include "io/reader/promise.h"

namespace abut {

std::optional<std::uint64_t> promised_by_obj(ByteStream& content) {
    std::uint64_t triangles = 0;
    const auto check_vertex = [](std::string_view rest, const LineScan& lines) {
        for (int i = 0; i < 3; ++i)
            if (!looks_like_number(take_word(rest)))
                malformed(lines.place() + ": a vertex needs three numbers");
    };
    scan_obj(content, check_vertex, [&](auto corners) { triangles += corners.size() - 2; });
    return triangles;
}

} // namespace abut
