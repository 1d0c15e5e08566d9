#include "io/polygon/off_scan.h"

#include "io/file/fault.h"
#include "io/file/text_scan.h"

#include <array>
#include <vector>

namespace abut {

namespace {

/// Takes the next line with content, without its comment.
bool next_content(LineScan& lines, std::string_view& rest) {
    while (lines.next(rest)) {
        rest = rest.substr(0, rest.find('#'));
        std::string_view copy = rest;
        if (!take_word(copy).empty())
            return true;
    }
    return false;
}

/// Reads the numbers of vertices and faces.
std::array<std::uint64_t, 2> read_header(LineScan& lines) {
    std::string_view rest;
    if (!next_content(lines, rest))
        malformed("is not an OFF file");
    const std::string keyword(take_word(rest));
    if (!keyword.ends_with("OFF"))
        malformed("is not an OFF file");
    if (keyword.find_first_of("4n") != std::string::npos)
        throw Fault(ErrorCode::unsupported, "is an OFF file that is not three-dimensional");
    std::string_view copy = rest;
    if (take_word(copy) == "BINARY")
        throw Fault(ErrorCode::unsupported, "is a binary OFF file");
    std::array<std::uint64_t, 2> counts{};
    for (std::uint64_t& count : counts) {
        std::string_view word = take_word(rest);
        if (word.empty() && next_content(lines, rest))
            word = take_word(rest);
        const auto value = to_number<std::uint64_t>(word);
        if (!value)
            malformed("its header lacks the numbers of vertices and faces");
        count = *value;
    }
    return counts;
}

/// In          rest: a face's line. Out corners: indices, all in range.
void read_corners(std::string_view rest, std::uint64_t vertices, const LineScan& lines,
                  std::vector<std::uint64_t>& corners) {
    const auto count = to_number<std::uint64_t>(take_word(rest));
    if (!count)
        malformed(lines.place() + ": a face does not begin with the number of its corners");
    corners.clear();
    for (std::uint64_t i = 0; i < *count; ++i) {
        const std::string_view word = take_word(rest);
        const auto index = to_number<std::int64_t>(word);
        if (!index)
            malformed(lines.place() + ": a face has " + std::to_string(i) + " of " +
                      std::to_string(*count) + " corners");
        if (*index < 0 || static_cast<std::uint64_t>(*index) >= vertices)
            throw Fault(ErrorCode::bad_mesh, lines.place() + ": a face refers to vertex " +
                                                 std::string(word) + " of " +
                                                 std::to_string(vertices));
        corners.push_back(static_cast<std::uint64_t>(*index));
    }
}

} // namespace

void scan_off(ByteStream& content, const std::function<void(const Vec3&)>& vertex,
              const std::function<void(std::span<const std::uint64_t> corners)>& face) {
    LineScan lines(content);
    const auto [vertices, faces] = read_header(lines);
    std::string_view rest;
    const auto next = [&](std::uint64_t done, std::uint64_t all, const char* what) {
        if (!next_content(lines, rest))
            malformed("is truncated: " + std::to_string(done) + " of " + std::to_string(all) +
                      what);
    };
    for (std::uint64_t i = 0; i < vertices; ++i) {
        next(i, vertices, " vertices");
        vertex(take_position(rest, lines));
    }
    std::vector<std::uint64_t> corners;
    for (std::uint64_t i = 0; i < faces; ++i) {
        next(i, faces, " faces");
        read_corners(rest, vertices, lines, corners);
        face(corners);
    }
}

} // namespace abut
