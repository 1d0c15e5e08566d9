#include "io/fault.h"
#include "io/reader/promise.h"
#include "io/text_scan.h"

#include <array>

namespace abut {

namespace {

/// The next line with content, without its comment.
bool next_content(LineScan& lines, std::string_view& rest) {
    while (lines.next(rest)) {
        rest = rest.substr(0, rest.find('#'));
        std::string_view copy = rest;
        if (!take_word(copy).empty())
            return true;
    }
    return false;
}

/// Corners of a face line, all of them in range.
std::uint64_t face_corners(std::string_view rest, std::uint64_t vertices, const LineScan& lines) {
    const auto corners = to_number<std::uint64_t>(take_word(rest));
    if (!corners)
        malformed(lines.place() + ": a face does not begin with the number of its corners");
    for (std::uint64_t i = 0; i < *corners; ++i) {
        const std::string_view word = take_word(rest);
        const auto index = to_number<std::int64_t>(word);
        if (!index)
            malformed(lines.place() + ": a face has " + std::to_string(i) + " of " +
                      std::to_string(*corners) + " corners");
        if (*index < 0 || static_cast<std::uint64_t>(*index) >= vertices)
            throw Fault(ErrorCode::bad_mesh, lines.place() + ": a face refers to vertex " +
                                                 std::string(word) + " of " +
                                                 std::to_string(vertices));
    }
    return *corners;
}

} // namespace

std::optional<std::uint64_t> promised_by_off(ByteStream& content) {
    LineScan lines(content);
    std::string_view rest;
    if (!next_content(lines, rest))
        malformed("is no OFF file");
    const std::string_view keyword = take_word(rest);
    if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF")
        malformed("is no OFF file");
    std::string_view copy = rest;
    if (take_word(copy) == "BINARY")
        throw Fault(ErrorCode::unsupported, "is a binary OFF file");

    std::array<std::uint64_t, 2> counts{}; // vertices, faces
    for (std::uint64_t& count : counts) {
        std::string_view word = take_word(rest);
        if (word.empty() && next_content(lines, rest))
            word = take_word(rest);
        const auto value = to_number<std::uint64_t>(word);
        if (!value)
            malformed("its header lacks the numbers of vertices and faces");
        count = *value;
    }
    for (std::uint64_t i = 0; i < counts[0]; ++i) {
        if (!next_content(lines, rest))
            malformed("is truncated: " + std::to_string(i) + " of " + std::to_string(counts[0]) +
                      " vertices");
        for (int k = 0; k < 3; ++k)
            if (!looks_like_number(take_word(rest)))
                malformed(lines.place() + ": a vertex needs three numbers");
    }
    std::uint64_t triangles = 0;
    for (std::uint64_t i = 0; i < counts[1]; ++i) {
        if (!next_content(lines, rest))
            malformed("is truncated: " + std::to_string(i) + " of " + std::to_string(counts[1]) +
                      " faces");
        const std::uint64_t corners = face_corners(rest, counts[0], lines);
        triangles += corners < 3 ? 0 : corners - 2;
    }
    return triangles;
}

} // namespace abut
