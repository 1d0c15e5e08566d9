#include "clash/groups/group_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <unordered_map>
#include <utility>

namespace abut {

namespace {

/// [Fowler, Noll, Vo], FNV-1a, 64 bits.
std::uint64_t add_text(std::uint64_t hash, std::string_view text) {
    constexpr std::uint64_t kPrime = 0x100000001b3U;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
    return (hash ^ 0xffU) * kPrime; // 0xff occurs in no UTF-8 text
}

/// The name of a part, with which its key ends if it has none.
std::string name_of_part(const GroupFacts& facts, const std::string& key) {
    const auto found = std::ranges::lower_bound(facts.parts, key, {}, &GroupPart::key);
    if (found == facts.parts.end() || found->key != key)
        return key.substr(key.find('/') + 1);
    const Part& part = facts.models[found->model].parts[found->part];
    return part.name.empty() ? part.id : part.name;
}

/// Horizontal coordinates and height, whichever axis points up.
std::string place_text(const Vec3& p, UpAxis up) {
    const auto text = [](double x, double y, double z) {
        // Adding zero removes the sign of a rounded zero.
        const auto tenth = [](double v) { return std::round(v * 10) / 10 + 0.0; };
        return fmt::format("{:.1f}, {:.1f}, height {:.1f} m", tenth(x), tenth(y), tenth(z));
    };
    switch (up) {
    case UpAxis::x:
        return text(-p.y, p.z, p.x);
    case UpAxis::y:
        return text(p.x, -p.z, p.y);
    case UpAxis::z:
        break;
    }
    return text(p.x, p.y, p.z);
}

const char* word_for_none(GroupKind kind) {
    switch (kind) {
    case GroupKind::storey:
        return "no storey";
    case GroupKind::system:
        return "no system";
    case GroupKind::types:
        return "no types";
    default:
        return "no discipline";
    }
}

std::string most_frequent(const std::map<std::string, std::size_t>& counts, std::size_t most) {
    std::vector<std::pair<std::string, std::size_t>> rows(counts.begin(), counts.end());
    std::ranges::stable_sort(rows, std::ranges::greater{},
                             &std::pair<std::string, std::size_t>::second);
    std::string text;
    for (std::size_t i = 0; i < std::min(most, rows.size()); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", rows[i].second, rows[i].first);
    if (rows.size() > most)
        text +=
            fmt::format(" and {} other{}", rows.size() - most, rows.size() - most == 1 ? "" : "s");
    return text;
}

} // namespace

std::string group_id(std::string_view parent, GroupKind kind, std::string_view key,
                     std::uint32_t salt) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    hash = add_text(hash, parent);
    hash = add_text(hash, to_string(kind));
    hash = add_text(hash, key);
    if (salt > 0)
        hash = add_text(hash, std::to_string(salt));
    return clash_id_text(hash);
}

std::string group_name(const GroupFacts& facts, const ClashGroup& group) {
    switch (group.kind) {
    case GroupKind::part:
        return name_of_part(facts, group.key);
    case GroupKind::copies:
        return "copies of " + name_of_part(facts, group.key);
    case GroupKind::place: {
        std::map<std::string, std::size_t> counts;
        for (const std::uint32_t clash : group.clashes)
            ++counts[property_of_clash(facts, clash, GroupBy::types)];
        const auto most = std::ranges::max_element(counts, {}, [](const auto& row) {
            return row.second; // the first of equals
        });
        const std::string where = place_text(group.centre, facts.report.frame.up);
        return most->first.empty() ? "near " + where : most->first + " near " + where;
    }
    default:
        return group.key.empty() ? word_for_none(group.kind) : group.key;
    }
}

void distinguish_names(std::vector<ClashGroup>& groups, const std::vector<bool>& is_new) {
    std::unordered_map<std::string, int> uses;
    for (const ClashGroup& group : groups)
        ++uses[group.name];
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::string& key = groups[i].key;
        if (is_new[i] && uses[groups[i].name] > 1)
            groups[i].name += " [" + key.substr(key.find('/') + 1) + "]";
    }
}

std::string types_in_group(const GroupFacts& facts, const ClashGroup& group, std::uint32_t part) {
    constexpr std::size_t kMostTypes = 3;
    std::map<std::string, std::size_t> counts;
    for (const std::uint32_t clash : group.clashes) {
        const auto [a, b] = facts.clashes[clash].part;
        std::string type = a == part || b == part ? facts.part(a == part ? b : a).type
                                                  : property_of_clash(facts, clash, GroupBy::types);
        ++counts[type.empty() ? "untyped" : type];
    }
    return most_frequent(counts, kMostTypes);
}

} // namespace abut
