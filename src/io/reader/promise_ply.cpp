#include "io/reader/fault.h"
#include "io/reader/promise.h"
#include "io/reader/text_scan.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <vector>

namespace abut {

namespace {

enum class Encoding : std::uint8_t { text, little_endian, big_endian };

struct Type {
    std::size_t bytes = 0;
    bool is_signed = false;
    bool is_real = false;
};

struct Property {
    std::string name;
    bool is_list = false;
    Type length; ///< of a list
    Type value;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Encoding encoding = Encoding::text;
    std::vector<Element> elements;
    std::string_view body;
};

Type type_named(std::string_view name, const LineScan& lines) {
    static const std::map<std::string_view, Type> types{{"char", {1, true}},
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

Property read_property(std::string_view rest, const LineScan& lines) {
    Property property;
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

Header read_header(std::string_view content) {
    LineScan lines(content);
    std::string_view line;
    Header header;
    if (!lines.next(line) || line.substr(0, 3) != "ply")
        malformed("is no PLY file");
    bool has_format = false;
    while (lines.next(line)) {
        std::string_view rest = line;
        const std::string_view word = take_word(rest);
        if (word == "end_header") {
            if (!has_format)
                malformed("its header names no format");
            header.body = lines.rest();
            return header;
        }
        if (word == "format") {
            const std::string_view format = take_word(rest);
            has_format = true;
            if (format == "binary_little_endian")
                header.encoding = Encoding::little_endian;
            else if (format == "binary_big_endian")
                header.encoding = Encoding::big_endian;
            else if (format != "ascii")
                malformed(lines.place() + ": unknown format " + std::string(format));
        } else if (word == "element") {
            Element& element = header.elements.emplace_back();
            element.name = take_word(rest);
            const auto count = to_number<std::uint64_t>(take_word(rest));
            if (!count)
                malformed(lines.place() + ": an element lacks its count");
            element.count = *count;
        } else if (word == "property") {
            if (header.elements.empty())
                malformed(lines.place() + ": a property before any element");
            header.elements.back().properties.push_back(read_property(rest, lines));
        }
    }
    malformed("is truncated: its header has no end");
}

/// Takes values off the body one by one, text or binary.
class Body {
public:
    Body(std::string_view rest, Encoding encoding) : rest_(rest), encoding_(encoding) {}

    /// False at the end of the file.
    bool skip(const Type& type, std::uint64_t count) {
        if (encoding_ == Encoding::text) {
            for (; count > 0; --count) {
                const std::string_view word = take_word(rest_);
                if (word.empty())
                    return false;
                if (!looks_like_number(word))
                    malformed("has " + std::string(word.substr(0, 40)) + " for a number");
            }
            return true;
        }
        if (count > rest_.size() / type.bytes)
            return false;
        rest_.remove_prefix(count * type.bytes);
        return true;
    }

    /// Integers only: lengths of lists and indices. False at the end of the file.
    bool take(const Type& type, std::int64_t& value) {
        if (type.is_real)
            throw Fault(ErrorCode::unsupported, "counts with real numbers");
        if (encoding_ == Encoding::text) {
            const std::string_view word = take_word(rest_);
            const auto number = to_number<std::int64_t>(word);
            if (!word.empty() && !number)
                malformed("has " + std::string(word.substr(0, 40)) + " for an integer");
            value = number.value_or(0);
            return number.has_value();
        }
        if (rest_.size() < type.bytes)
            return false;
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t at = encoding_ == Encoding::big_endian ? i : type.bytes - 1 - i;
            bits = bits << 8 | static_cast<unsigned char>(rest_[at]);
        }
        const std::size_t unused = 64 - 8 * type.bytes;
        // Shifted to the top and back, arithmetically where the sign is to be kept.
        value = type.is_signed ? static_cast<std::int64_t>(bits << unused) >> unused
                               : static_cast<std::int64_t>(bits);
        rest_.remove_prefix(type.bytes);
        return true;
    }

    [[nodiscard]] Encoding encoding() const noexcept { return encoding_; }

private:
    std::string_view rest_;
    Encoding encoding_;
};

[[noreturn]] void truncated(const Element& element, std::uint64_t read) {
    malformed("is truncated: " + std::to_string(read) + " of " + std::to_string(element.count) +
              " elements " + element.name);
}

bool is_face_list(const Element& element, const Property& property) {
    return element.name == "face" &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// One list of a face: the triangles of its fan. False at the end of the file.
bool take_face(Body& body, const Property& property, std::int64_t corners, std::uint64_t vertices,
               std::uint64_t& triangles) {
    for (std::int64_t i = 0; i < corners; ++i) {
        std::int64_t index = 0;
        if (!body.take(property.value, index))
            return false;
        if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
            throw Fault(ErrorCode::bad_mesh, "a face refers to vertex " + std::to_string(index) +
                                                 " of " + std::to_string(vertices));
    }
    triangles += corners < 3 ? 0 : static_cast<std::uint64_t>(corners - 2);
    return true;
}

/// One element's properties. False at the end of the file.
bool take_element(Body& body, const Element& element, std::uint64_t vertices,
                  std::uint64_t& triangles) {
    for (const Property& property : element.properties) {
        if (!property.is_list) {
            if (!body.skip(property.value, 1))
                return false;
            continue;
        }
        std::int64_t length = 0;
        if (!body.take(property.length, length))
            return false;
        if (length < 0)
            malformed("has a list of negative length");
        const bool whole = is_face_list(element, property)
                               ? take_face(body, property, length, vertices, triangles)
                               : body.skip(property.value, static_cast<std::uint64_t>(length));
        if (!whole)
            return false;
    }
    return true;
}

} // namespace

std::optional<std::uint64_t> promised_by_ply(std::string_view content) {
    const Header header = read_header(content);
    std::uint64_t vertices = 0;
    for (const Element& element : header.elements)
        if (element.name == "vertex")
            vertices = element.count;
    Body body(header.body, header.encoding);
    std::uint64_t triangles = 0;
    bool all_counted = true;
    for (const Element& element : header.elements) {
        all_counted = all_counted && element.name != "tristrips";
        if (element.properties.empty())
            continue;
        for (std::uint64_t i = 0; i < element.count; ++i)
            if (!take_element(body, element, vertices, triangles))
                truncated(element, i);
    }
    return all_counted ? std::optional(triangles) : std::nullopt;
}

} // namespace abut
