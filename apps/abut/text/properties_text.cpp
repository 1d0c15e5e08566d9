#include "text/properties_text.h"

#include "arguments/common.h"
#include "text/screen.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <unordered_map>

namespace abut::command {

namespace {

constexpr std::size_t kExamples = 5;
constexpr std::size_t kLongestExample = 40;
constexpr std::size_t kWidestName = 56; // longer names push the other columns aside

/// Counts how many parts have each value of one property.
using ValueCounts = std::unordered_map<std::string, std::uint64_t>;

std::vector<std::string> most_frequent(const ValueCounts& counts) {
    std::vector<std::pair<std::uint64_t, std::string>> order;
    order.reserve(counts.size());
    for (const auto& [value, count] : counts)
        order.emplace_back(count, value);
    const std::size_t kept = std::min(kExamples, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                      [](const auto& a, const auto& b) {
                          return a.first != b.first ? a.first > b.first : a.second < b.second;
                      });
    std::vector<std::string> values;
    for (std::size_t i = 0; i < kept; ++i)
        values.push_back(order[i].second);
    return values;
}

/// Places the common properties first, in their own order.
std::size_t rank_of(const std::string& name) {
    return static_cast<std::size_t>(
        std::find(kCommonProperties.begin(), kCommonProperties.end(), name) -
        kCommonProperties.begin());
}

std::string short_example(const std::string& value) {
    std::string text = shown(value);
    if (text.size() <= kLongestExample)
        return text;
    std::size_t end = kLongestExample - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U)
        --end; // not within a character of several bytes
    return text.substr(0, end) + "…";
}

} // namespace

nlohmann::ordered_json properties_json(const Scene& scene, std::uint32_t part) {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scene.properties.of(part)) {
        nlohmann::ordered_json& member = result[scene.properties.names[name]];
        const std::string& text = scene.properties.values[value];
        if (member.is_null())
            member = text;
        else if (member.is_array())
            member.push_back(text);
        else
            member = nlohmann::ordered_json::array({member, text});
    }
    return result;
}

nlohmann::ordered_json relations_json(const Scene& scene) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& [a, b, kind] : scene.relations)
        rows.push_back(
            {{"kind", abut::to_string(kind)}, {"a", scene.parts[a].id}, {"b", scene.parts[b].id}});
    return rows;
}

std::vector<PropertyUse> property_uses(std::span<const Scene> scenes) {
    struct Count {
        std::uint64_t parts = 0;
        ValueCounts values;
    };
    std::map<std::string, Count> counts;
    for (const Scene& scene : scenes)
        for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
            std::uint32_t before = 0xffffffff;
            for (const auto& [name, value] : scene.properties.of(part)) {
                Count& count = counts[scene.properties.names[name]];
                count.parts += name == before ? 0 : 1;
                ++count.values[scene.properties.values[value]];
                before = name;
            }
        }
    std::vector<PropertyUse> uses;
    uses.reserve(counts.size());
    for (const auto& [name, count] : counts)
        uses.push_back({name, count.parts, count.values.size(), most_frequent(count.values)});
    std::ranges::stable_sort(uses, {}, [](const PropertyUse& use) { return rank_of(use.name); });
    return uses;
}

nlohmann::ordered_json to_json(const std::vector<PropertyUse>& uses) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const PropertyUse& use : uses)
        rows.push_back({{"name", use.name},
                        {"parts", use.parts},
                        {"values", use.values},
                        {"examples", use.examples}});
    return rows;
}

std::string table(const std::vector<PropertyUse>& uses) {
    if (uses.empty())
        return "\n  no part has properties\n";
    std::size_t width = 8;
    for (const PropertyUse& use : uses)
        width = std::max(width, std::min(shown(use.name).size(), kWidestName));
    std::string text = fmt::format("\n  {:<{}} {:>9} {:>9}  most frequent values\n", "property",
                                   width, "parts", "values");
    const auto columns = static_cast<std::size_t>(columns_of(stdout));
    for (const PropertyUse& use : uses) {
        std::string line = fmt::format("  {:<{}} {:>9} {:>9}  ", shown(use.name), width,
                                       grouped(use.parts), grouped(use.values));
        std::string examples;
        for (const std::string& example : use.examples) {
            const std::string next = (examples.empty() ? "" : " | ") + short_example(example);
            if (columns > 0 && line.size() + examples.size() + next.size() > columns)
                break;
            examples += next;
        }
        text += line + examples + "\n";
    }
    return text;
}

} // namespace abut::command
