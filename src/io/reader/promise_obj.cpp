#include "io/reader/fault.h"
#include "io/reader/promise.h"
#include "io/reader/text_scan.h"

namespace abut {

namespace {

/// A line with those that its final backslash joins to it.
bool next_logical(LineScan& lines, std::string_view& line, std::string& joined) {
    if (!lines.next(line))
        return false;
    if (line.empty() || line.back() != '\\')
        return true;
    joined.clear();
    do {
        joined.append(line.substr(0, line.size() - 1)).push_back(' ');
    } while (lines.next(line) && !line.empty() && line.back() == '\\');
    joined.append(line);
    line = joined;
    return true;
}

} // namespace

std::optional<std::uint64_t> promised_by_obj(std::string_view content) {
    LineScan lines(content);
    std::string_view line;
    std::string joined;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::uint64_t largest = 0;
    std::uint64_t largest_line = 0;
    while (next_logical(lines, line, joined)) {
        std::string_view rest = line;
        const std::string_view word = take_word(rest);
        if (word == "v") {
            for (int i = 0; i < 3; ++i)
                if (!looks_like_number(take_word(rest)))
                    malformed(lines.place() + ": a vertex needs three numbers");
            ++vertices;
        } else if (word == "f") {
            std::uint64_t corners = 0;
            for (std::string_view corner = take_word(rest); !corner.empty() && corner[0] != '#';
                 corner = take_word(rest), ++corners) {
                const auto index = to_number<std::int64_t>(corner.substr(0, corner.find('/')));
                if (!index)
                    malformed(lines.place() + ": a face has the corner " + std::string(corner));
                const auto back = static_cast<std::uint64_t>(-*index);
                if (*index == 0 || (*index < 0 && back > vertices))
                    throw Fault(ErrorCode::bad_mesh, lines.place() + ": a face refers to vertex " +
                                                         std::to_string(*index) +
                                                         ", which does not exist");
                if (*index > 0 && static_cast<std::uint64_t>(*index) > largest) {
                    largest = static_cast<std::uint64_t>(*index);
                    largest_line = lines.number();
                }
            }
            if (corners < 3)
                malformed(lines.place() + ": a face needs three corners");
            triangles += corners - 2;
        }
    }
    if (largest > vertices)
        throw Fault(ErrorCode::bad_mesh,
                    "line " + std::to_string(largest_line) + ": a face refers to vertex " +
                        std::to_string(largest) + " of " + std::to_string(vertices));
    return triangles;
}

} // namespace abut
