#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace abut {

/// Reads a settings file as one JSON value. Files whose name ends in .toml are TOML, others JSON.
///
/// Errors      Error, naming the file: file_not_found, unreadable, malformed.
nlohmann::json read_settings(const std::string& path);

/// Parses TOML. Dates and times become texts.
///
/// Errors      Error{malformed}, naming the file.
nlohmann::json parse_toml(std::string_view text, const std::string& file);

} // namespace abut
