#include "clash/rules/settings_file.h"

#include <abut/error.h>

#include "io/file/text_stream.h"

#include <fstream>
#include <sstream>

#define TOML_HEADER_ONLY 1       // NOLINT: the library's own switches
#define TOML_ENABLE_FORMATTERS 1 // NOLINT
#include <toml++/toml.h>

namespace abut {

namespace {

using Json = nlohmann::json;

Json json_of(const toml::node& node);

Json json_of(const toml::table& table) {
    Json result = Json::object();
    for (const auto& [key, value] : table)
        result[std::string(key.str())] = json_of(value);
    return result;
}

Json json_of(const toml::array& array) {
    Json result = Json::array();
    for (const toml::node& element : array)
        result.push_back(json_of(element));
    return result;
}

template <typename Value>
std::string text_of(const Value& value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

Json json_of(const toml::node& node) {
    if (const auto* const table = node.as_table())
        return json_of(*table);
    if (const auto* const array = node.as_array())
        return json_of(*array);
    if (const auto* const text = node.as_string())
        return text->get();
    if (const auto* const integer = node.as_integer())
        // Numbers that are not negative are unsigned, as the parser of JSON gives them.
        return integer->get() < 0 ? Json(integer->get())
                                  : Json(static_cast<std::uint64_t>(integer->get()));
    if (const auto* const number = node.as_floating_point())
        return number->get();
    if (const auto* const flag = node.as_boolean())
        return flag->get();
    if (const auto* const date = node.as_date())
        return text_of(date->get());
    if (const auto* const time = node.as_time())
        return text_of(time->get());
    if (const auto* const both = node.as_date_time())
        return text_of(both->get());
    return nullptr;
}

Json parse_json(const std::string& text, const std::string& file) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        throw Error(ErrorCode::malformed, file,
                    "is not JSON (near byte " + std::to_string(error.byte) + ")");
    } catch (const Json::out_of_range&) {
        throw Error(ErrorCode::malformed, file, "has a number that no double holds");
    }
}

} // namespace

Json parse_toml(std::string_view text, const std::string& file) {
    try {
        return json_of(toml::parse(text));
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        throw Error(ErrorCode::malformed, file,
                    "is not TOML (line " + std::to_string(at.line) + ", column " +
                        std::to_string(at.column) + ": " + std::string(error.description()) + ")");
    }
}

Json read_settings(const std::string& path) {
    std::ifstream in = open_text(path);
    std::ostringstream text;
    text << in.rdbuf();
    if (in.bad())
        throw Error(ErrorCode::unreadable, path, "cannot be read");
    return path.ends_with(".toml") ? parse_toml(text.str(), path) : parse_json(text.str(), path);
}

} // namespace abut
