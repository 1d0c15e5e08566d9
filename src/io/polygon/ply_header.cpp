#include "io/polygon/ply_header.h"

#include "io/file/fault.h"
#include "io/file/text_scan.h"

#include <map>

namespace abut {

namespace {

PlyType type_named(std::string_view name, const LineScan& lines) {
    static const std::map<std::string_view, PlyType> types{{"char", {1, true}},
                                                           {"int8", {1, true}},
                                                           {"uchar", {1}},
                                                           {"uint8", {1}},
                                                           {"short", {2, true}},
                                                           {"int16", {2, true}},
                                                           {"ushort", {2}},
                                                           {"uint16", {2}},
                                                           {"int", {4, true}},
                                                           {"int32", {4, true}},
                                                           {"uint", {4}},
                                                           {"uint32", {4}},
                                                           {"float", {4, true, true}},
                                                           {"float32", {4, true, true}},
                                                           {"double", {8, true, true}},
                                                           {"float64", {8, true, true}}};
    const auto found = types.find(name);
    if (found == types.end())
        malformed(lines.place() + ": unknown type " + std::string(name));
    return found->second;
}

PlyEncoding encoding_named(std::string_view name, const LineScan& lines) {
    if (name == "ascii")
        return PlyEncoding::text;
    if (name == "binary_little_endian")
        return PlyEncoding::little_endian;
    if (name == "binary_big_endian")
        return PlyEncoding::big_endian;
    malformed(lines.place() + ": unknown format " + std::string(name));
}

PlyElement read_element(std::string_view rest, const LineScan& lines) {
    PlyElement element;
    element.name = take_word(rest);
    const auto count = to_number<std::uint64_t>(take_word(rest));
    if (!count)
        malformed(lines.place() + ": an element lacks its count");
    element.count = *count;
    return element;
}

PlyProperty read_property(std::string_view rest, const LineScan& lines) {
    PlyProperty property;
    std::string_view word = take_word(rest);
    if (word == "list") {
        property.is_list = true;
        property.length = type_named(take_word(rest), lines);
        word = take_word(rest);
    }
    property.value = type_named(word, lines);
    property.name = take_word(rest);
    return property;
}

} // namespace

std::uint64_t PlyHeader::vertices() const {
    std::uint64_t count = 0;
    for (const PlyElement& element : elements)
        if (element.name == "vertex")
            count = element.count;
    return count;
}

PlyHeader read_ply_header(ByteStream& content) {
    LineScan lines(content);
    std::string_view line;
    PlyHeader header;
    if (!lines.next(line) || line.substr(0, 3) != "ply")
        malformed("is not a PLY file");
    bool has_format = false;
    while (lines.next(line)) {
        std::string_view rest = line;
        const std::string_view word = take_word(rest);
        if (word == "end_header") {
            if (!has_format)
                malformed("its header names no format");
            return header;
        }
        if (word == "format") {
            header.encoding = encoding_named(take_word(rest), lines);
            has_format = true;
        } else if (word == "element") {
            header.elements.push_back(read_element(rest, lines));
        } else if (word == "property") {
            if (header.elements.empty())
                malformed(lines.place() + ": a property before any element");
            header.elements.back().properties.push_back(read_property(rest, lines));
        }
    }
    malformed("is truncated: its header has no end");
}

} // namespace abut
