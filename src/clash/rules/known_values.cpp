#include "clash/rules/known_values.h"

#include <abut/error.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace abut {

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Returns the number of bytes to insert, remove or replace, of the first `kLongest` of each text.
///
/// Source      [Wagner, Fischer 1974]
std::size_t edit_distance(std::string_view a, std::string_view b) {
    constexpr std::size_t kLongest = 64;
    a = a.substr(0, kLongest), b = b.substr(0, kLongest);
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t k = 0; k < b.size(); ++k) {
            const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[k]) ? 0 : 1);
            diagonal = row[k + 1];
            row[k + 1] = std::min({replaced, diagonal + 1, row[k] + 1});
        }
    }
    return row[b.size()];
}

bool is_glob(const std::string& text) {
    return text.find_first_of("*?") != std::string::npos;
}

[[noreturn]] void fail(const std::string& where, const std::string& text,
                       const NearestTexts& nearest) {
    throw Error(ErrorCode::bad_argument, where + ": " + text + nearest.in_words());
}

/// The values that a name of a clash can have. None if they cannot be listed, or if the name is not
/// one of a clash.
std::optional<std::vector<std::string>> values_of_clash(const std::string& name,
                                                        const ClashOptions& options) {
    std::vector<std::string> values;
    const auto add_words = [&](const auto& list) {
        for (const auto element : list)
            values.emplace_back(to_string(element));
    };
    const auto add_rules = [&](std::string ClashRule::*member) {
        for (const ClashRule& rule : options.rules)
            values.push_back(rule.*member);
        for (const ClashMatrix::Cell& cell : options.matrix.cells)
            values.push_back(cell.terms.*member);
    };
    if (name == "kind")
        add_words(kClashKinds);
    else if (name == "status")
        add_words(kClashStatuses);
    else if (name == "neighbours")
        add_words(kNeighbours);
    else if (name == "severity")
        add_rules(&ClashRule::severity);
    else if (name == "rule")
        add_rules(&ClashRule::name);
    else
        return std::nullopt;
    return values;
}

/// Whether a name is one of a clash, its groups or topics, and not of its parts.
bool is_of_clash(const std::string& name) {
    constexpr std::array<std::string_view, 10> kNames{"kind",       "status", "severity", "rule",
                                                      "neighbours", "note",   "distance", "depth",
                                                      "gap",        "volume"};
    return std::ranges::find(kNames, name) != kNames.end() || name == "group" ||
           name.starts_with("group.") || name.starts_with("topic.");
}

} // namespace

void NearestTexts::add(std::string_view candidate) {
    if (candidate.empty() ||
        std::ranges::any_of(best_, [&](const auto& known) { return known.second == candidate; }))
        return;
    const std::size_t distance = edit_distance(text_, candidate);
    if (best_.size() == kMost && best_.back().first <= distance)
        return;
    if (best_.size() == kMost)
        best_.pop_back();
    const auto at = std::ranges::upper_bound(best_, distance, {},
                                             [](const auto& known) { return known.first; });
    best_.insert(at, {distance, std::string(candidate)});
}

std::string NearestTexts::in_words() const {
    std::string text;
    for (const auto& [distance, known] : best_)
        text +=
            (text.empty() ? best_.size() == 1 ? "; the nearest is " : "; the nearest are " : ", ") +
            known;
    return text;
}

void KnownValues::want(const Condition& comparison, const std::string& name,
                       const std::string& where) {
    const auto add = [&](std::vector<ConditionValue> values) {
        NearestTexts nearest(values.front().text);
        wanted_.push_back({name, where, comparison.op, std::move(values), std::move(nearest)});
        ++missing_;
    };
    const bool is_text_part =
        comparison.op == Condition::Operator::holds || comparison.op == Condition::Operator::lacks;
    bool all_globs = true;
    for (const ConditionValue& value : comparison.values)
        if (!is_text_part && !is_glob(value.text)) {
            add({value});
            all_globs = false;
        }
    if (all_globs)
        add(comparison.values);
}

void KnownValues::collect(const Condition& condition, const std::string& where, bool negated,
                          const ClashOptions* clashes) {
    const bool turns = condition.kind == Condition::Kind::negation;
    for (const Condition& part : condition.parts)
        collect(part, where, negated != turns, clashes);
    if (condition.kind != Condition::Kind::comparison)
        return;
    const bool differs =
        condition.op == Condition::Operator::differs || condition.op == Condition::Operator::lacks;
    const bool compares_texts = differs || condition.op == Condition::Operator::equal ||
                                condition.op == Condition::Operator::holds;
    const bool wants_values = compares_texts && differs == negated;
    std::string name = condition.name;
    if (clashes != nullptr && is_of_clash(name)) {
        const auto values = values_of_clash(name, *clashes);
        for (const ConditionValue& wanted : condition.values) {
            const auto fits = [&](const std::string& value) {
                return passes(condition.op, wanted, value);
            };
            if (!wants_values || !values || std::ranges::any_of(*values, fits))
                continue;
            NearestTexts nearest(wanted.text);
            for (const std::string& value : *values)
                nearest.add(value);
            fail(where, "no clash has the " + name + " \"" + wanted.text + "\"", nearest);
        }
        return;
    }
    if (clashes != nullptr && (name.starts_with("a.") || name.starts_with("b.")))
        name.erase(0, 2);
    if (std::ranges::find(names_, name, &Name::name) == names_.end()) {
        names_.push_back({name, where});
        ++missing_;
    }
    if (wants_values)
        want(condition, name, where);
}

void KnownValues::ask(const PartQuery& query, const std::string& where) {
    if (!query.empty())
        collect(*query.condition(), where, false, nullptr);
}

void KnownValues::ask(const ClashQuery& query, const std::string& where,
                      const ClashOptions& options) {
    if (!query.empty())
        collect(*query.condition(), where, false, &options);
}

void KnownValues::add(const PartFacts& part) {
    has_parts_ = true;
    if (missing_ == 0)
        return;
    const PartSubject subject(part);
    const auto note = [&](bool& found) {
        found = true;
        --missing_;
    };
    for (Name& name : names_)
        if (!name.found && subject.any_value(name.name, [](std::string_view) { return true; }))
            note(name.found);
    constexpr std::size_t kWithNearest = 16; // texts are compared for that many values only
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        Wanted& wanted = wanted_[i];
        if (wanted.found)
            continue;
        const bool fits = subject.any_value(wanted.name, [&](std::string_view value) {
            const bool one = std::ranges::any_of(wanted.values, [&](const ConditionValue& text) {
                return passes(wanted.op, text, value);
            });
            if (!one && i < kWithNearest)
                wanted.nearest.add(value);
            return one;
        });
        if (fits)
            note(wanted.found);
    }
}

std::vector<std::string> KnownValues::names() const {
    std::vector<std::string> result;
    for (const Name& name : names_)
        result.push_back(name.name);
    return result;
}

bool KnownValues::misses_names() const {
    return std::ranges::any_of(names_, [](const Name& name) { return !name.found; });
}

void KnownValues::require(const std::vector<std::string>& known) const {
    if (!has_parts_)
        return;
    for (const Name& name : names_)
        if (!name.found) {
            NearestTexts nearest(name.name);
            for (const std::string_view fixed : kFixedNames)
                nearest.add(fixed);
            for (const std::string& property : known)
                nearest.add(property);
            fail(name.where, "no part has the property \"" + name.name + "\"", nearest);
        }
    for (const Wanted& wanted : wanted_)
        if (!wanted.found)
            fail(wanted.where,
                 "no part has the " + wanted.name + " \"" + wanted.values.front().text + "\"",
                 wanted.nearest);
}

} // namespace abut
