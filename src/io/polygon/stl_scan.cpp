#include "io/polygon/stl_scan.h"

#include "io/file/fault.h"
#include "io/file/text_scan.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace abut {

namespace {

/// Compares without regard to case: keywords are lower case, but some files use capitals.
bool is_keyword(std::string_view word, std::string_view keyword) {
    return word == keyword ||
           std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) == b;
           });
}

} // namespace

bool is_text_stl(const std::string& path) {
    ByteStream content = ByteStream::open(path);
    (void)content.has(kStlHeaderBytes);
    const std::string_view bytes = content.ahead();
    std::uint32_t triangles = 0;
    if (bytes.size() >= kStlHeaderBytes) {
        std::memcpy(&triangles, bytes.data() + kStlHeaderBytes - sizeof triangles,
                    sizeof triangles);
        if (content.left() == kStlHeaderBytes + triangles * kStlTriangleBytes)
            return false;
    }
    // Text contains no zero byte; the count and the flags of a binary file contain many.
    std::string_view text = bytes;
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    const bool is_utf_16 = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
    if (is_utf_16 ||
        (is_keyword(take_word(text), "solid") && bytes.find('\0') == std::string_view::npos))
        return true;
    if (bytes.size() < kStlHeaderBytes)
        malformed("is truncated: too short for an STL file");
    malformed("is not an STL file, or is truncated: its header states " +
              std::to_string(triangles) + " triangles in " +
              std::to_string(kStlHeaderBytes + triangles * kStlTriangleBytes) +
              " bytes, but it has " + std::to_string(content.left()));
}

void scan_text_stl(ByteStream& content, const std::function<void(std::string_view name)>& solid,
                   const std::function<void(const Vec3&)>& vertex) {
    LineScan lines(content);
    std::string_view rest;
    std::uint64_t facets = 0, vertices = 0;
    bool open_solid = false;
    while (lines.next(rest)) {
        // Several statements may share a line, but a name extends to the end of its line.
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            if (is_keyword(word, "vertex")) {
                if (++vertices > 3 * facets)
                    malformed(lines.place() + ": a facet needs three vertices");
                vertex(take_position(rest, lines));
            } else if (is_keyword(word, "facet")) {
                if (!open_solid || vertices != 3 * facets)
                    malformed(lines.place() + (open_solid ? ": a facet needs three vertices"
                                                          : ": a facet lies outside a solid"));
                ++facets;
            } else if (is_keyword(word, "endfacet") && vertices != 3 * facets) {
                malformed(lines.place() + ": a facet needs three vertices");
            } else if (is_keyword(word, "solid")) {
                if (open_solid)
                    malformed(lines.place() + ": a solid begins within another one");
                open_solid = true;
                solid(trimmed(rest));
                break;
            } else if (is_keyword(word, "endsolid")) {
                open_solid = false;
                break;
            }
        }
    }
    if (open_solid || vertices != 3 * facets)
        malformed("is truncated: its solid does not end with endsolid");
}

} // namespace abut
