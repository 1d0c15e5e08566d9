#include <abut/properties.h>

#include "io/scene/property_table.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace abut {

namespace {

bool are_distinct(const std::vector<std::string>& texts) {
    std::unordered_set<std::string_view> seen;
    seen.reserve(texts.size());
    return std::all_of(texts.begin(), texts.end(),
                       [&](const std::string& text) { return seen.insert(text).second; });
}

void sort_entries(std::vector<Properties::Entry>& entries) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.name < b.name; });
    // Values of one name are few, so that the search among them is short.
    std::size_t kept = 0, of_name = 0;
    for (const Properties::Entry& entry : entries) {
        if (kept > 0 && entries[kept - 1].name != entry.name)
            of_name = kept;
        const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(of_name);
        const auto end = entries.begin() + static_cast<std::ptrdiff_t>(kept);
        if (std::find(begin, end, entry) == end)
            entries[kept++] = entry;
    }
    entries.resize(kept);
}

} // namespace

std::span<const Properties::Entry> Properties::of(std::uint32_t part) const noexcept {
    if (std::size_t{part} + 1 >= first.size())
        return {};
    return std::span(entries).subspan(first[part], first[part + 1] - first[part]);
}

std::span<const Properties::Entry> Properties::of(std::uint32_t part,
                                                  std::uint32_t name) const noexcept {
    const std::span<const Entry> all = of(part);
    const auto from = std::lower_bound(all.begin(), all.end(), name,
                                       [](const Entry& e, std::uint32_t n) { return e.name < n; });
    const auto to = std::upper_bound(from, all.end(), name,
                                     [](std::uint32_t n, const Entry& e) { return n < e.name; });
    return {from, to};
}

std::optional<std::uint32_t> Properties::find(std::string_view name) const noexcept {
    const auto found = std::lower_bound(names.begin(), names.end(), name);
    if (found == names.end() || *found != name)
        return std::nullopt;
    return static_cast<std::uint32_t>(found - names.begin());
}

std::string_view Properties::value(std::uint32_t part, std::string_view name) const noexcept {
    const auto number = find(name);
    const auto found = number ? of(part, *number) : std::span<const Entry>();
    return found.empty() ? std::string_view() : values[found.front().value];
}

struct PropertiesBuilder::Data {
    /// Distinct texts with numbers in the order of their first use.
    class TextNumbers {
    public:
        std::uint32_t number_of(std::string_view text) {
            const auto found = numbers_.find(text);
            if (found != numbers_.end())
                return found->second;
            const auto number = static_cast<std::uint32_t>(numbers_.size());
            numbers_.emplace(text, number);
            return number;
        }
        std::vector<std::string> take() {
            std::vector<std::string> texts(numbers_.size());
            while (!numbers_.empty()) {
                auto node = numbers_.extract(numbers_.begin());
                texts[node.mapped()] = std::move(node.key());
            }
            return texts;
        }

    private:
        struct Hash {
            using is_transparent = void;
            std::size_t operator()(std::string_view text) const {
                return std::hash<std::string_view>()(text);
            }
        };
        std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>> numbers_;
    };

    TextNumbers names, values;
    Properties made{.names = {}, .values = {}, .first = {0}, .entries = {}};
};

PropertiesBuilder::PropertiesBuilder() : data_(std::make_unique<Data>()) {}
PropertiesBuilder::PropertiesBuilder(PropertiesBuilder&& other) noexcept = default;
PropertiesBuilder& PropertiesBuilder::operator=(PropertiesBuilder&& other) noexcept = default;
PropertiesBuilder::~PropertiesBuilder() = default;

void PropertiesBuilder::add(std::string_view name, std::string_view value) {
    if (!name.empty())
        data_->made.entries.push_back(
            {data_->names.number_of(name), data_->values.number_of(value)});
}

void PropertiesBuilder::next_part() {
    data_->made.first.push_back(data_->made.entries.size());
}

Properties PropertiesBuilder::finish(std::size_t parts) {
    const auto data = std::exchange(data_, std::make_unique<Data>());
    Properties made = std::move(data->made);
    if (made.entries.empty())
        return {};
    made.first.resize(parts + 1, made.entries.size());
    made.first.back() = made.entries.size();
    made.names = data->names.take();
    made.values = data->values.take();
    sort_properties(made);
    return made;
}

void sort_properties(Properties& properties) {
    std::vector<std::uint32_t> order(properties.names.size()), place(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {},
                      [&](std::uint32_t i) -> const std::string& { return properties.names[i]; });
    std::vector<std::string> names;
    names.reserve(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        names.push_back(std::move(properties.names[order[i]]));
        place[order[i]] = i;
    }
    properties.names = std::move(names);
    std::vector<Properties::Entry> of_part;
    std::uint64_t kept = 0;
    for (std::size_t part = 0; part + 1 < properties.first.size(); ++part) {
        const std::uint64_t begin = std::exchange(properties.first[part], kept);
        of_part.assign(properties.entries.begin() + static_cast<std::ptrdiff_t>(begin),
                       properties.entries.begin() +
                           static_cast<std::ptrdiff_t>(properties.first[part + 1]));
        for (Properties::Entry& entry : of_part)
            entry.name = place[entry.name];
        sort_entries(of_part);
        std::ranges::copy(of_part, properties.entries.begin() + static_cast<std::ptrdiff_t>(kept));
        kept += of_part.size();
    }
    if (!properties.first.empty())
        properties.first.back() = kept;
    properties.entries.resize(kept);
}

bool is_consistent(const Properties& properties, std::size_t parts) {
    const auto& [names, values, first, entries] = properties;
    if (first.empty())
        return names.empty() && values.empty() && entries.empty();
    return first.size() == parts + 1 && first.front() == 0 && first.back() == entries.size() &&
           std::is_sorted(first.begin(), first.end()) &&
           std::ranges::all_of(entries,
                               [&](const Properties::Entry& entry) {
                                   return entry.name < properties.names.size() &&
                                          entry.value < properties.values.size();
                               }) &&
           are_distinct(names) && are_distinct(values);
}

const char* to_string(RelationKind kind) {
    switch (kind) {
    case RelationKind::fills:
        return "fills";
    case RelationKind::connected:
        return "connected";
    case RelationKind::covers:
        return "covers";
    case RelationKind::part_of:
        break;
    }
    return "part_of";
}

void sort_relations(std::vector<PartRelation>& relations) {
    for (PartRelation& relation : relations)
        if (relation.kind == RelationKind::connected && relation.a > relation.b)
            std::swap(relation.a, relation.b);
    std::erase_if(relations, [](const PartRelation& relation) { return relation.a == relation.b; });
    std::ranges::sort(relations);
    relations.erase(std::unique(relations.begin(), relations.end()), relations.end());
}

} // namespace abut
