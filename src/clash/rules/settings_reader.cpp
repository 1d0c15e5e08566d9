#include "clash/rules/settings_reader.h"

#include <abut/error.h>

#include <algorithm>
#include <cmath>

namespace abut {

void SettingsReader::fail(const std::string& where, const std::string& fault) const {
    throw Error(ErrorCode::malformed, file_, where + " " + fault);
}

void SettingsReader::require_keys(const Json& value, const std::string& where,
                                  std::initializer_list<std::string_view> known) const {
    if (!value.is_object())
        fail(where, "must be an object");
    for (const auto& [key, unused] : value.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            fail(where, "has an unknown key \"" + key + "\"");
}

const SettingsReader::Json& SettingsReader::read_list(const Json& object, const char* key,
                                                      const std::string& what) const {
    if (!object.contains(key) || !object[key].is_array() || object[key].empty())
        fail(key, "must be a list of at least one " + what);
    return object[key];
}

std::string SettingsReader::read_text(const Json& object, const char* key,
                                      const std::string& where) const {
    if (!object.contains(key) || !object[key].is_string())
        fail(where + "." + key, "must be a text");
    return object[key].get<std::string>();
}

std::vector<std::string> SettingsReader::read_texts(const Json& value, const std::string& where,
                                                    const char* what) const {
    if (value.is_string())
        return {value.get<std::string>()};
    const auto is_text = [](const Json& v) { return v.is_string(); };
    if (!value.is_array() || value.empty() || !std::all_of(value.begin(), value.end(), is_text))
        fail(where, std::string("must be a ") + what + " or a list of " + what + "s");
    return value.get<std::vector<std::string>>();
}

bool SettingsReader::read_flag(const Json& object, const char* key, bool otherwise,
                               const std::string& where) const {
    if (!object.contains(key))
        return otherwise;
    if (!object[key].is_boolean())
        fail(where + "." + key, "must be true or false");
    return object[key].get<bool>();
}

PartQuery SettingsReader::read_query(const Json& value, const std::string& where) const {
    try {
        return PartQuery::parse(value.get<std::string>());
    } catch (const Error& error) {
        fail(where, error.what());
    }
}

std::optional<double> SettingsReader::read_length(const Json& object, const char* key,
                                                  const std::string& where) const {
    if (!object.contains(key))
        return std::nullopt;
    if (!object[key].is_number() || !(object[key].get<double>() >= 0) ||
        !std::isfinite(object[key].get<double>()))
        fail(where + "." + key, "must be a length in metres, not negative");
    return object[key].get<double>();
}

std::vector<Neighbours> SettingsReader::read_neighbours(const Json& value,
                                                        const std::string& where) const {
    if (value.is_boolean())
        return value.get<bool>() ? std::vector<Neighbours>(kNeighbours.begin(), kNeighbours.end())
                                 : std::vector<Neighbours>();
    std::vector<Neighbours> result;
    for (const std::string& word : read_texts(value, where, "word")) {
        const auto found = std::ranges::find_if(
            kNeighbours, [&](Neighbours neighbours) { return word == to_string(neighbours); });
        if (found == kNeighbours.end())
            fail(where,
                 "must be true, false or of fills, connected, covers, same_assembly, not \"" +
                     word + "\"");
        result.push_back(*found);
    }
    return result;
}

IgnoreRule SettingsReader::read_ignore(const Json& value, const std::string& where) const {
    require_keys(value, where, {"same_file", "same_type", "same_name_prefix", "neighbours"});
    IgnoreRule ignore;
    ignore.same_file = read_flag(value, "same_file", false, where);
    ignore.same_type = read_flag(value, "same_type", false, where);
    if (value.contains("same_name_prefix")) {
        if (!value["same_name_prefix"].is_number_unsigned())
            fail(where + ".same_name_prefix", "must be a number of characters");
        ignore.same_name_prefix = value["same_name_prefix"].get<std::size_t>();
    }
    if (value.contains("neighbours"))
        ignore.neighbours = read_neighbours(value["neighbours"], where + ".neighbours");
    return ignore;
}

void SettingsReader::read_terms(const Json& object, ClashRule& rule,
                                const std::string& where) const {
    rule.clearance = read_length(object, "clearance", where);
    rule.touch_tolerance = read_length(object, "touch", where);
    rule.tolerated_depth = read_length(object, "tolerate", where);
    if (object.contains("severity"))
        rule.severity = read_text(object, "severity", where);
    if (object.contains("kinds"))
        for (const std::string& word :
             read_texts(object["kinds"], where + ".kinds", "kind of clash")) {
            const auto found = std::ranges::find_if(
                kClashKinds, [&](ClashKind kind) { return word == to_string(kind); });
            if (found == kClashKinds.end())
                fail(where + ".kinds", "has an unknown kind \"" + word + "\"");
            rule.kinds.push_back(*found);
        }
    if (object.contains("ignore"))
        rule.ignore = read_ignore(object["ignore"], where + ".ignore");
}

} // namespace abut
