#pragma once

#include <abut/bcf.h>

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace abut {

/// Returns a text as XML may hold it: what XML does not allow becomes U+FFFD.
std::string xml_escaped(std::string_view text);

/// Appends an element with all that is in it, on one line.
void append_xml(std::string& text, pugi::xml_node element);

/// Returns whether XML Schema's NonEmptyOrBlankString refuses a text.
bool is_blank(std::string_view text);

/// XML that is being written, indented by two spaces.
class XmlText {
public:
    /// Begins the document with its outermost element.
    explicit XmlText(const char* root);

    /// Opens an element; `attribute` may follow, before anything else is written.
    void open(const char* name);
    void attribute(const char* name, std::string_view value);
    void attribute(const char* name, std::optional<bool> value);
    void close();

    /// An element that holds a text.
    void leaf(const char* name, std::string_view text);
    void leaf(const char* name, double value);
    void leaf(const char* name, const Vec3& value);
    /// As leaf, unless the text is empty or consists of blanks.
    void optional_leaf(const char* name, std::string_view text);
    void optional_leaf(const char* name, std::optional<int> value);

    void unknown_attributes(const BcfUnknown& unknown);
    void unknown_elements(const BcfUnknown& unknown);

    /// Closes all elements and returns the document.
    std::string finish();

private:
    void begin_line();
    void end_tag();

    std::string text_;
    std::vector<std::string> open_;
    bool in_tag_ = false; ///< the last opening tag is not finished
};

} // namespace abut
