#include "bcf/xml_text.h"

#include <abut/error.h>

#include "clash/report/clash_text.h"

#include <cmath>
#include <fmt/format.h>

namespace abut {

std::string xml_escaped(std::string_view text) {
    std::string escaped;
    const std::string valid = valid_utf8(text);
    for (std::size_t i = 0; i < valid.size(); ++i) {
        const char c = valid[i];
        const std::string_view rest = std::string_view(valid).substr(i, 3);
        if (c == '&')
            escaped += "&amp;";
        else if (c == '<')
            escaped += "&lt;";
        else if (c == '>')
            escaped += "&gt;";
        else if (c == '"')
            escaped += "&quot;";
        else if (c == '\r')
            escaped += "&#13;";
        else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
            escaped += "\xEF\xBF\xBD";
        else if (rest == "\xEF\xBF\xBE" || rest == "\xEF\xBF\xBF") // U+FFFE, U+FFFF
            escaped += "\xEF\xBF\xBD", i += 2;
        else
            escaped += c;
    }
    return escaped;
}

namespace {

/// As xml_escaped, for attributes, whose line breaks XML readers turn into blanks.
std::string attribute_escaped(std::string_view text) {
    std::string escaped;
    for (const char c : xml_escaped(text))
        if (c == '\n')
            escaped += "&#10;";
        else if (c == '\t')
            escaped += "&#9;";
        else
            escaped += c;
    return escaped;
}

} // namespace

void append_xml(std::string& text, pugi::xml_node element) {
    if (element.type() == pugi::node_pcdata || element.type() == pugi::node_cdata) {
        text += xml_escaped(element.value());
        return;
    }
    if (element.type() != pugi::node_element)
        return;
    text.append("<").append(element.name());
    for (const pugi::xml_attribute attribute : element.attributes())
        text.append(" ")
            .append(attribute.name())
            .append("=\"")
            .append(attribute_escaped(attribute.value()))
            .append("\"");
    if (!element.first_child()) {
        text += "/>";
        return;
    }
    text += ">";
    for (const pugi::xml_node child : element.children()) // at most 64 deep
        append_xml(text, child);
    text.append("</").append(element.name()).append(">");
}

bool is_blank(std::string_view text) {
    return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

XmlText::XmlText(const char* root) : text_("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") {
    open(root);
}

void XmlText::begin_line() {
    end_tag();
    if (text_.back() != '\n')
        text_ += '\n';
    text_.append(2 * open_.size(), ' ');
}

void XmlText::end_tag() {
    if (in_tag_)
        text_ += ">";
    in_tag_ = false;
}

void XmlText::open(const char* name) {
    begin_line();
    text_.append("<").append(name);
    open_.emplace_back(name);
    in_tag_ = true;
}

void XmlText::attribute(const char* name, std::string_view value) {
    text_.append(" ").append(name).append("=\"").append(attribute_escaped(value)).append("\"");
}

void XmlText::attribute(const char* name, std::optional<bool> value) {
    if (value)
        attribute(name, std::string_view(*value ? "true" : "false"));
}

void XmlText::close() {
    const std::string name = open_.back();
    open_.pop_back();
    if (in_tag_) {
        text_ += "/>";
        in_tag_ = false;
    } else {
        if (text_.back() != '\n')
            text_ += '\n';
        text_.append(2 * open_.size(), ' ').append("</").append(name).append(">");
    }
}

void XmlText::leaf(const char* name, std::string_view text) {
    begin_line();
    text_.append("<").append(name).append(">").append(xml_escaped(text));
    text_.append("</").append(name).append(">");
}

void XmlText::leaf(const char* name, double value) {
    if (!std::isfinite(value))
        throw Error(ErrorCode::bad_argument, std::string(name) + " is not a finite number");
    leaf(name, std::string_view(fmt::format("{}", value)));
}

void XmlText::leaf(const char* name, const Vec3& value) {
    open(name);
    leaf("X", value.x);
    leaf("Y", value.y);
    leaf("Z", value.z);
    close();
}

void XmlText::optional_leaf(const char* name, std::string_view text) {
    if (!is_blank(text))
        leaf(name, text);
}

void XmlText::optional_leaf(const char* name, std::optional<int> value) {
    if (value)
        leaf(name, std::string_view(std::to_string(*value)));
}

void XmlText::unknown_attributes(const BcfUnknown& unknown) {
    for (const auto& [name, value] : unknown.attributes)
        attribute(name.c_str(), std::string_view(value));
}

void XmlText::unknown_elements(const BcfUnknown& unknown) {
    if (unknown.elements.empty())
        return;
    begin_line();
    text_ += unknown.elements;
}

std::string XmlText::finish() {
    while (!open_.empty())
        close();
    text_ += '\n';
    return std::move(text_);
}

} // namespace abut
