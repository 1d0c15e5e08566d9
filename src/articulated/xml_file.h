#pragma once

#include "math/vector.h"

#include <initializer_list>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace abut {

/// An XML file in memory, with the numbers of its lines.
class XmlFile {
public:
    /// Errors      Error, naming the file, and the line of a syntax error: file_not_found,
    ///             unreadable, malformed (also a file of more than 64 MiB).
    explicit XmlFile(const std::string& path);

    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
    [[nodiscard]] const std::string& path() const { return path_; }

    /// Throws Error{malformed}: "FILE: line N: WHAT".
    [[noreturn]] void fail(pugi::xml_node node, const std::string& what) const;

    /// Returns an attribute's text. Throws as `fail` if it is missing or empty.
    [[nodiscard]] std::string text(pugi::xml_node node, const char* attribute) const;
    /// Returns an attribute's numbers. Throws as `fail` if it is missing, or is not `count` finite
    /// numbers.
    [[nodiscard]] std::vector<double> numbers(pugi::xml_node node, const char* attribute,
                                              std::size_t count) const;
    [[nodiscard]] double number(pugi::xml_node node, const char* attribute) const {
        return numbers(node, attribute, 1)[0];
    }
    /// As above; `missing` if the attribute is missing.
    [[nodiscard]] double number(pugi::xml_node node, const char* attribute, double missing) const {
        return node.attribute(attribute).empty() ? missing : number(node, attribute);
    }
    [[nodiscard]] Vec3 vector(pugi::xml_node node, const char* attribute,
                              const Vec3& missing) const;

private:
    [[nodiscard]] std::size_t line_at(std::ptrdiff_t offset) const;

    std::string path_, text_;
    pugi::xml_document document_;
};

/// Parses finite numbers that white space separates, in any locale. None if the text is anything
/// else.
std::optional<std::vector<double>> parse_number_list(const std::string& text);

} // namespace abut
