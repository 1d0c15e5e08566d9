#include "bcf/xml_reader.h"

#include <abut/error.h>

#include "bcf/xml_text.h"
#include "clash/report/clash_text.h"

#include <charconv>
#include <cmath>
#include <cstring>

namespace abut {

namespace {

constexpr int kDeepest = 64;

std::string trimmed(const std::string& text) {
    const char* const blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string::npos
               ? ""
               : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Attributes that every file may state and that mean nothing to a reader.
bool is_schema_attribute(const std::string& name) {
    return name == "xmlns" || name == "xmlns:xsi" || name == "xmlns:xsd" ||
           name.starts_with("xsi:");
}

} // namespace

XmlReader::XmlReader(const std::string& bytes, std::string file, std::string entry,
                     std::initializer_list<const char*> roots, const BcfLimits& limits)
    : file_(std::move(file)), entry_(std::move(entry)) {
    if (bytes.size() > limits.xml_bytes)
        fail("is larger than XML may be");
    constexpr unsigned kOptions =
        pugi::parse_default | pugi::parse_doctype | pugi::parse_ws_pcdata_single;
    const pugi::xml_parse_result parsed =
        document_.load_buffer(bytes.data(), bytes.size(), kOptions);
    if (!parsed)
        fail(std::string(parsed.description()) + " at byte " + std::to_string(parsed.offset));
    for (const pugi::xml_node node : document_.children()) {
        if (node.type() == pugi::node_doctype)
            fail("has a document type declaration");
        if (node.type() == pugi::node_element && root_)
            fail("has two outermost elements");
        if (node.type() == pugi::node_element)
            root_ = node;
    }
    check_nodes();
    for (const char* const name : roots)
        if (std::strcmp(root_.name(), name) == 0)
            return;
    fail(std::string("the outermost element is not ") + *roots.begin());
}

void XmlReader::fail(const std::string& what) const {
    throw Error(ErrorCode::malformed, file_, entry_ + ": " + what);
}

void XmlReader::check_nodes() const {
    int depth = 0;
    for (pugi::xml_node node = root_; node;) {
        if (depth > kDeepest)
            fail("elements are nested too deep");
        if (valid_utf8(node.name()) != node.name() || valid_utf8(node.value()) != node.value())
            fail("has text that is not UTF-8");
        for (const pugi::xml_attribute attribute : node.attributes())
            if (valid_utf8(attribute.name()) != attribute.name() ||
                valid_utf8(attribute.value()) != attribute.value())
                fail("has text that is not UTF-8");
        if (node.first_child()) {
            node = node.first_child();
            ++depth;
            continue;
        }
        while (node && node != root_ && !node.next_sibling()) {
            node = node.parent();
            --depth;
        }
        node = node && node != root_ ? node.next_sibling() : pugi::xml_node();
    }
}

std::string XmlReader::text_of(pugi::xml_node node) const {
    std::string text;
    for (const pugi::xml_node child : node.children())
        if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
            text += child.value();
    return text;
}

double XmlReader::number_of(pugi::xml_node node) const {
    std::string text = trimmed(text_of(node));
    if (text.starts_with('+'))
        text.erase(0, 1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        fail(std::string(node.name()) + " is not a number");
    return value;
}

Vec3 XmlReader::vector_of(pugi::xml_node node) const {
    return {number_of(node.child("X")), number_of(node.child("Y")), number_of(node.child("Z"))};
}

bool XmlReader::truth_of(const std::string& text, const char* name) const {
    const std::string word = trimmed(text);
    if (word == "true" || word == "1" || word == "True")
        return true;
    if (word == "false" || word == "0" || word == "False" || word.empty())
        return false;
    fail(std::string(name) + " is neither true nor false");
}

std::string XmlReader::take_text(pugi::xml_node parent, const char* name) const {
    const pugi::xml_node child = parent.child(name);
    std::string text = text_of(child);
    parent.remove_child(child);
    return text;
}

std::vector<std::string> XmlReader::take_texts(pugi::xml_node parent, const char* name) const {
    std::vector<std::string> texts;
    take_each(parent, name, [&](pugi::xml_node child) { texts.push_back(text_of(child)); });
    return texts;
}

std::optional<int> XmlReader::take_integer(pugi::xml_node parent, const char* name) const {
    const std::string text = trimmed(take_text(parent, name));
    if (text.empty())
        return std::nullopt;
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        fail(std::string(name) + " is not an integer");
    return value;
}

std::optional<std::string> XmlReader::take_attribute(pugi::xml_node node, const char* name,
                                                     const char* other) const {
    std::optional<std::string> value;
    for (const char* const spelling : {name, other}) {
        if (spelling == nullptr)
            continue;
        // All of them are taken: what remains is written again beside the one of the writer.
        while (const pugi::xml_attribute attribute = node.attribute(spelling)) {
            if (!value)
                value = attribute.value();
            node.remove_attribute(attribute);
        }
    }
    return value;
}

std::optional<bool> XmlReader::take_truth(pugi::xml_node node, const char* name,
                                          const char* other) const {
    const std::optional<std::string> value = take_attribute(node, name, other);
    return value ? std::optional(truth_of(*value, name)) : std::nullopt;
}

BcfUnknown XmlReader::take_unknown(pugi::xml_node node) const {
    BcfUnknown unknown;
    for (const pugi::xml_attribute attribute : node.attributes())
        if (!is_schema_attribute(attribute.name()))
            unknown.attributes.emplace_back(attribute.name(), attribute.value());
    for (const pugi::xml_node child : node.children())
        if (child.type() == pugi::node_element)
            append_xml(unknown.elements, child);
    return unknown;
}

} // namespace abut
