#include "io/reader/promise.h"

#include "io/fault.h"
#include "io/input_file.h"
#include "io/text_scan.h"

#include <cstring>

namespace abut {

namespace {

constexpr std::size_t kStlHeaderBytes = 84;
constexpr std::size_t kStlTriangleBytes = 50;

std::uint64_t promised_by_text_stl(std::string_view content) {
    ByteStream text(content);
    LineScan lines(text);
    std::string_view line;
    std::uint64_t facets = 0;
    std::uint64_t vertices = 0;
    bool open_solid = false;
    while (lines.next(line)) {
        std::string_view rest = line;
        const std::string_view word = take_word(rest);
        if (word == "solid") {
            open_solid = true;
        } else if (word == "endsolid") {
            open_solid = false;
        } else if (word == "facet") {
            ++facets;
        } else if (word == "vertex") {
            ++vertices;
            for (int i = 0; i < 3; ++i)
                if (!looks_like_number(take_word(rest)))
                    malformed(lines.place() + ": a vertex needs three numbers");
        } else if (word == "endfacet" && vertices != 3 * facets) {
            malformed(lines.place() + ": a facet needs three vertices");
        }
    }
    if (open_solid || vertices != 3 * facets)
        malformed("is truncated: its solid is not closed by endsolid");
    return facets;
}

} // namespace

std::optional<std::uint64_t> promised_by_stl(std::string_view content) {
    std::uint32_t triangles = 0;
    if (content.size() >= kStlHeaderBytes) {
        std::memcpy(&triangles, content.data() + kStlHeaderBytes - sizeof triangles,
                    sizeof triangles);
        if (content.size() == kStlHeaderBytes + std::uint64_t{triangles} * kStlTriangleBytes)
            return triangles;
    }
    // Text has no byte 0; the count and the flags of a binary file have many.
    const bool is_text = content.substr(0, content.find_first_of(" \t\r\n")) == "solid" &&
                         content.find('\0') == std::string_view::npos;
    if (is_text)
        return promised_by_text_stl(content);
    if (content.size() < kStlHeaderBytes)
        malformed("is truncated: too short for an STL file");
    malformed("is truncated: its header promises " + std::to_string(triangles) +
              " triangles, its size is " + std::to_string(content.size()) + " bytes");
}

std::optional<std::uint64_t> promised_triangles(const std::string& file,
                                                const std::string& extension) {
    if (extension == ".stl")
        return promised_by_stl(read_file(file));
    const auto promised = extension == ".obj"   ? promised_by_obj
                          : extension == ".off" ? promised_by_off
                          : extension == ".ply" ? promised_by_ply
                                                : nullptr;
    if (promised == nullptr)
        return std::nullopt;
    ByteStream content = ByteStream::open(file);
    return promised(content);
}

} // namespace abut
