#include "articulated/xml_file.h"

#include <abut/error.h>

#include "io/file/fault.h"
#include "io/file/input_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace abut {

namespace {

constexpr std::uint64_t kLargestXmlFile = std::uint64_t{64} << 20;

bool is_xml_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

} // namespace

std::optional<std::vector<double>> parse_number_list(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        at = std::find_if_not(at, end, is_xml_blank);
        if (at == end)
            return numbers;
        if (*at == '+')
            ++at;
        double value = 0;
        const auto [next, failure] = std::from_chars(at, end, value);
        if (failure != std::errc{} || !std::isfinite(value) ||
            (next != end && !is_xml_blank(*next)))
            return std::nullopt;
        numbers.push_back(value);
        at = next;
    }
}

XmlFile::XmlFile(const std::string& path) : path_(path) {
    try {
        if (readable_size(path) > kLargestXmlFile)
            malformed("is larger than 64 MiB");
        text_ = read_file(path);
    } catch (const Fault& fault) {
        throw Error(fault.code(), path, fault.what());
    }
    const pugi::xml_parse_result result = document_.load_buffer(
        text_.data(), text_.size(), pugi::parse_default | pugi::parse_comments);
    if (!result)
        throw Error(ErrorCode::malformed, path,
                    "line " + std::to_string(line_at(result.offset)) + ": " + result.description());
    if (!root())
        throw Error(ErrorCode::malformed, path, "has no XML element");
}

std::size_t XmlFile::line_at(std::ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(
                                         offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

void XmlFile::fail(pugi::xml_node node, const std::string& what) const {
    throw Error(ErrorCode::malformed, path_,
                "line " + std::to_string(line_at(node.offset_debug())) + ": " + what);
}

std::string XmlFile::text(pugi::xml_node node, const char* attribute) const {
    std::string value = node.attribute(attribute).as_string();
    if (value.empty())
        fail(node, std::string("<") + node.name() + "> needs the attribute '" + attribute + "'");
    return value;
}

std::vector<double> XmlFile::numbers(pugi::xml_node node, const char* attribute,
                                     std::size_t count) const {
    std::optional<std::vector<double>> values = parse_number_list(text(node, attribute));
    if (!values || values->size() != count)
        fail(node,
             std::string("the attribute '") + attribute + "' of <" + node.name() + "> is not " +
                 (count == 1 ? "a finite number" : std::to_string(count) + " finite numbers"));
    return *values;
}

Vec3 XmlFile::vector(pugi::xml_node node, const char* attribute, const Vec3& missing) const {
    if (node.attribute(attribute).empty())
        return missing;
    const std::vector<double> v = numbers(node, attribute, 3);
    return {v[0], v[1], v[2]};
}

} // namespace abut
