#include "clash/groups/group_facts.h"

#include "clash/report/clash_text.h"
#include "math/vector.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace abut {

namespace {

/// The name of each model's file without folders. Files of equal names get "#2", "#3", ….
std::vector<std::string> distinct_file_names(const std::vector<Scene>& models) {
    std::unordered_map<std::string, int> seen;
    std::vector<std::string> names;
    for (const Scene& model : models) {
        std::string name = model.file.substr(model.file.find_last_of('/') + 1);
        const int count = ++seen[name];
        names.push_back(count == 1 ? name : name + "#" + std::to_string(count));
    }
    return names;
}

std::uint64_t place_of(const Clash& clash, std::size_t side) {
    return std::uint64_t{clash.model.at(side)} << 32 | clash.part.at(side);
}

std::string first_of_both(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty())
        return a.empty() ? b : a;
    return natural_less(b, a) ? b : a;
}

std::string pair_of(std::string a, std::string b) {
    if (natural_less(b, a))
        std::swap(a, b);
    if (a.empty() || a == b)
        return b;
    return a + " \u00D7 " + b;
}

/// The part's own discipline; else the name of its file without the extension.
std::string discipline_of(const GroupFacts& facts, std::uint32_t part) {
    const GroupPart& p = facts.parts[part];
    std::string value = group_property(facts.models[p.model], p.part, "discipline");
    if (!value.empty())
        return value;
    const std::string file = p.key.substr(0, p.key.find('/'));
    return file.substr(0, file.find_last_of('.'));
}

bool is_decimal(char c) {
    return c >= '0' && c <= '9';
}

/// Removes the digits at the beginning of a text and returns them without leading zeros.
std::string_view take_digits(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
    std::string_view digits = text.substr(0, end);
    text.remove_prefix(end);
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

} // namespace

GroupFacts gather_facts(const ClashReport& report, const std::vector<Scene>& models) {
    GroupFacts facts{report, models, {}, {}, {}, {}};
    const std::vector<std::string> files = distinct_file_names(models);
    std::unordered_map<std::uint64_t, std::uint32_t> index;
    for (const Clash& clash : report.clashes)
        for (std::size_t side = 0; side < 2; ++side) {
            const Part& part = part_of(clash, static_cast<int>(side), models);
            if (index.try_emplace(place_of(clash, side), 0).second)
                facts.parts.push_back({files[clash.model.at(side)] + "/" + part.id,
                                       clash.model.at(side), clash.part.at(side)});
        }
    std::ranges::sort(facts.parts, {}, &GroupPart::key);
    for (std::uint32_t i = 0; i < facts.parts.size(); ++i)
        index[std::uint64_t{facts.parts[i].model} << 32 | facts.parts[i].part] = i;
    for (const Clash& clash : report.clashes) {
        std::uint32_t a = index[place_of(clash, 0)], b = index[place_of(clash, 1)];
        facts.clashes.push_back(
            {{std::min(a, b), std::max(a, b)}, 0.5 * (clash.point_a + clash.point_b)});
    }
    facts.order.resize(report.clashes.size());
    std::iota(facts.order.begin(), facts.order.end(), 0U);
    std::ranges::sort(facts.order, {}, [&](std::uint32_t i) {
        return std::tuple(report.clashes[i].id, facts.clashes[i].part);
    });
    facts.rank.resize(facts.order.size());
    for (std::uint32_t i = 0; i < facts.order.size(); ++i)
        facts.rank[facts.order[i]] = i;
    return facts;
}

std::string group_property(const Scene& model, std::uint32_t part, std::string_view name) {
    return std::string(model.properties.value(part, name));
}

std::string property_of_clash(const GroupFacts& facts, std::uint32_t clash, GroupBy by) {
    const auto [a, b] = facts.clashes[clash].part;
    const auto value = [&](std::uint32_t i, std::string_view name) {
        return group_property(facts.models[facts.parts[i].model], facts.parts[i].part, name);
    };
    if (by == GroupBy::storey)
        return first_of_both(value(a, "storey"), value(b, "storey"));
    if (by == GroupBy::system)
        return pair_of(value(a, "system"), value(b, "system"));
    if (by == GroupBy::types)
        return pair_of(facts.part(a).type, facts.part(b).type);
    return pair_of(discipline_of(facts, a), discipline_of(facts, b));
}

bool natural_less(std::string_view a, std::string_view b) {
    const std::string_view whole_a = a, whole_b = b;
    while (!a.empty() && !b.empty()) {
        if (is_decimal(a.front()) && is_decimal(b.front())) {
            const std::string_view m = take_digits(a), n = take_digits(b);
            if (m != n)
                return m.size() != n.size() ? m.size() < n.size() : m < n;
            continue;
        }
        const auto c = static_cast<unsigned char>(a.front()),
                   d = static_cast<unsigned char>(b.front());
        if (c != d)
            return c < d;
        a.remove_prefix(1), b.remove_prefix(1);
    }
    return a.empty() != b.empty() ? a.empty() : whole_a < whole_b;
}

double symmetric_distance_sq(const Vec3& a, const Vec3& b) {
    const Vec3 d = a - b;
    std::array<double, 3> squares{d.x * d.x, d.y * d.y, d.z * d.z};
    std::ranges::sort(squares);
    return squares[0] + squares[1] + squares[2];
}

} // namespace abut
