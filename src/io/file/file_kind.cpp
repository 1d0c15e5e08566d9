#include "io/file/file_kind.h"

#include "io/file/byte_stream.h"
#include "io/file/fault.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

struct Mark {
    std::string_view bytes;      ///< first bytes of the file
    std::string_view kind;       ///< format name for messages
    std::string_view extensions; ///< allowed extensions of this format, separated by blanks
};

// Rarer marks come first, because a longer mark may begin like a shorter one.
constexpr std::array kMarks{
    Mark{"glTF", "a GLB file", ".glb"},
    Mark{"ply\n", "a PLY file", ".ply"},
    Mark{"ply\r", "a PLY file", ".ply"},
    Mark{"Kaydara FBX Binary", "an FBX file", ".fbx"},
    Mark{"; FBX", "an FBX file", ".fbx"},
    Mark{"ISO-10303-21", "an IFC or STEP file", ".ifc .stp .step"},
    Mark{"OFF\n", "an OFF file", ".off"},
    Mark{"OFF\r", "an OFF file", ".off"},
    Mark{"OFF ", "an OFF file", ".off"},
    Mark{"COFF\n", "an OFF file", ".off"},
    Mark{"PK\x03\x04", "a ZIP archive", ".zip .3mf .ifczip"},
    Mark{"\x1f\x8b", "a gzip archive", ".gz"},
    Mark{"<?xml", "an XML file", ".dae .xml .x3d .ifcxml"},
    Mark{"<!DOCTYPE", "a web page", ".html"},
    Mark{"<html", "a web page", ".html"},
    Mark{"%PDF", "a PDF file", ".pdf"},
    Mark{"\x89PNG", "a PNG image", ".png"},
    Mark{"\xff\xd8\xff", "a JPEG image", ".jpg .jpeg"},
    Mark{"SQLite format 3", "a store or another SQLite file", ".abut .db .sqlite"},
    Mark{"version https://git-lfs", "a pointer to a Git LFS file that was not fetched", ""},
};

const Mark* mark_of(std::string_view bytes) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (bytes.starts_with(kByteOrderMark))
        bytes.remove_prefix(kByteOrderMark.size());
    const auto* const found = std::find_if(kMarks.begin(), kMarks.end(), [&](const Mark& mark) {
        return bytes.starts_with(mark.bytes);
    });
    return found == kMarks.end() ? nullptr : found;
}

bool holds_word(std::string_view words, std::string_view word) {
    for (std::size_t at = words.find(word); at != std::string_view::npos;
         at = words.find(word, at + 1))
        if (at + word.size() == words.size() || words[at + word.size()] == ' ')
            return true;
    return false;
}

bool is_known(std::string_view extension) {
    return holds_word(".glb .gltf .obj .ply .stl .off .fbx .dae .ifc .3mf .ifczip", extension);
}

} // namespace

void check_file_kind(const std::string& path, std::string_view extension) {
    if (!is_known(extension))
        return;
    ByteStream content = ByteStream::open(path);
    (void)content.more();
    const std::string_view bytes = content.ahead();
    const Mark* const mark = mark_of(bytes);
    // The 80 bytes before a binary STL's count may hold any values.
    constexpr std::size_t kStlHeaderBytes = 84, kStlTriangleBytes = 50;
    if (extension == ".stl" && bytes.size() >= kStlHeaderBytes) {
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < 4; ++i)
            count |= std::uint64_t{static_cast<unsigned char>(bytes[80 + i])} << (8 * i);
        if (content.left() == kStlHeaderBytes + count * kStlTriangleBytes)
            return;
    }
    if (mark != nullptr && !holds_word(mark->extensions, extension))
        malformed("is " + std::string(mark->kind) +
                  (mark->extensions.empty()
                       ? std::string()
                       : ", though its name ends in " + std::string(extension) + ": rename it"));
    if (std::all_of(bytes.begin(), bytes.end(), [](char c) { return c == '\0'; }))
        malformed("begins with " + std::to_string(bytes.size()) +
                  " zero bytes: it contains no model");
}

} // namespace abut
