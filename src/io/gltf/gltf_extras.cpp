#include "io/gltf/gltf_extras.h"

#include <algorithm>
#include <string>

namespace abut {

using nlohmann::json;

namespace {

/// Deeper values are left out.
constexpr int kDeepest = 8;

/// Adds the values of an object, a list or a single value.
void add_values(const json& value, const std::string& name, int depth,
                std::vector<PartProperty>& properties) {
    if (depth > kDeepest || value.is_null() || value.is_binary())
        return;
    if (value.is_object()) {
        const std::string prefix = name.empty() ? name : name + ".";
        for (const auto& [key, inner] : value.items())
            add_values(inner, prefix + key, depth + 1, properties);
    } else if (value.is_array()) {
        for (const json& inner : value)
            add_values(inner, name, depth + 1, properties);
    } else if (!name.empty()) {
        properties.push_back({name, value.is_string() ? value.get<std::string>() : value.dump()});
    }
}

/// Sorts by name, keeps the order of values of one name, and removes repeated pairs.
void sort_pairs(std::vector<PartProperty>& properties) {
    std::ranges::stable_sort(properties, {}, &PartProperty::name);
    std::vector<PartProperty> distinct;
    distinct.reserve(properties.size());
    std::size_t of_name = 0;
    for (PartProperty& property : properties) {
        if (!distinct.empty() && distinct.back().name != property.name)
            of_name = distinct.size();
        const auto begin = distinct.begin() + static_cast<std::ptrdiff_t>(of_name);
        if (std::find(begin, distinct.end(), property) == distinct.end())
            distinct.push_back(std::move(property));
    }
    properties = std::move(distinct);
}

} // namespace

std::vector<PartProperty> properties_of_extras(const json& extras) {
    std::vector<PartProperty> properties;
    if (!extras.is_object())
        return properties;
    for (const auto& [key, value] : extras.items()) {
        if (key == "properties" && value.is_object())
            add_values(value, "", 0, properties);
        else if ((key != "name" && key != "type") || !value.is_string())
            add_values(value, "extras." + key, 0, properties);
    }
    sort_pairs(properties);
    return properties;
}

json json_of_properties(const Properties& properties, std::uint32_t part) {
    json result;
    for (const auto& [name, value] : properties.of(part)) {
        json& member = result[properties.names[name]];
        if (member.is_null())
            member = properties.values[value];
        else if (member.is_array())
            member.push_back(properties.values[value]);
        else
            member = {member, properties.values[value]};
    }
    return result;
}

} // namespace abut
