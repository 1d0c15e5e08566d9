#include "clash/query/condition.h"

#include "clash/query/glob.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace abut {

namespace {

/// Returns whether a text must be quoted to be read back as one word.
bool needs_quotes(std::string_view text) {
    constexpr std::array<std::string_view, 6> kKeywords{"and", "or", "not", "AND", "OR", "NOT"};
    return text.empty() ||
           text.find_first_of(" \t\n\r\v\f()=!~<>,\"\\") != std::string_view::npos ||
           std::ranges::find(kKeywords, text) != kKeywords.end();
}

std::string in_quotes(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += '\\';
        result += c;
    }
    return result + '"';
}

std::string word_text(std::string_view text) {
    return needs_quotes(text) ? in_quotes(text) : std::string(text);
}

std::string comparison_text(const Condition& condition) {
    std::string text = word_text(condition.name);
    for (const auto& [symbol, op] : kConditionOperators)
        if (op == condition.op)
            text.append(" ").append(symbol).append(" ");
    for (std::size_t i = 0; i < condition.values.size(); ++i) {
        const ConditionValue& value = condition.values[i];
        text += i > 0 ? ", " : "";
        text += value.quoted ? in_quotes(value.text) : word_text(value.text);
    }
    return text;
}

bool compares(const Condition& condition, const ConditionSubject& subject) {
    const bool found = subject.any_value(condition.name, [&](std::string_view value) {
        return std::ranges::any_of(condition.values, [&](const ConditionValue& wanted) {
            return passes(condition.op, wanted, value);
        });
    });
    return found != (condition.op == Condition::Operator::differs ||
                     condition.op == Condition::Operator::lacks);
}

} // namespace

bool passes(Condition::Operator op, const ConditionValue& wanted, std::string_view value) {
    const auto number = wanted.number ? number_of(value) : std::nullopt;
    if (op == Condition::Operator::equal || op == Condition::Operator::differs)
        return (number && *number == *wanted.number) || glob_match(wanted.text, value);
    if (op == Condition::Operator::holds || op == Condition::Operator::lacks)
        return glob_found(wanted.text, value);
    const auto compare = [&](const auto& a, const auto& b) {
        switch (op) {
        case Condition::Operator::less:
            return a < b;
        case Condition::Operator::at_most:
            return a <= b;
        case Condition::Operator::greater:
            return a > b;
        default:
            return a >= b;
        }
    };
    return number ? compare(*number, *wanted.number)
                  : compare(value, std::string_view(wanted.text));
}

std::optional<double> number_of(std::string_view text) {
    if (text.starts_with('+'))
        text.remove_prefix(1);
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, fault] = std::from_chars(text.data(), end, number);
    if (text.empty() || fault != std::errc() || rest != end || !std::isfinite(number))
        return std::nullopt;
    return number;
}

std::string to_text(const Condition& condition) {
    const auto inner = [](const Condition& part, bool in_all) {
        const bool parentheses =
            part.kind == Condition::Kind::any || (!in_all && part.kind == Condition::Kind::all);
        return parentheses ? "(" + to_text(part) + ")" : to_text(part);
    };
    switch (condition.kind) {
    case Condition::Kind::comparison:
        return comparison_text(condition);
    case Condition::Kind::word:
        return condition.name;
    case Condition::Kind::negation:
        return "not " + inner(condition.parts.front(), false);
    default:
        break;
    }
    const bool all = condition.kind == Condition::Kind::all;
    std::string text;
    for (const Condition& part : condition.parts) {
        text += text.empty() ? "" : all ? " and " : " or ";
        text += all ? inner(part, true) : to_text(part);
    }
    return text;
}

void for_each_name(const Condition& condition,
                   const std::function<void(const std::string&)>& take) {
    if (condition.kind == Condition::Kind::comparison)
        take(condition.name);
    for (const Condition& part : condition.parts)
        for_each_name(part, take);
}

std::vector<std::string> names_of(const Condition* condition) {
    std::vector<std::string> names;
    if (condition != nullptr)
        for_each_name(*condition, [&](const std::string& name) { names.push_back(name); });
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

void for_each_word(const Condition& condition,
                   const std::function<void(const std::string&)>& take) {
    if (condition.kind == Condition::Kind::word)
        take(condition.name);
    for (const Condition& part : condition.parts)
        for_each_word(part, take);
}

bool is_true(const Condition& condition, const ConditionSubject& subject) {
    const auto holds = [&](const Condition& part) { return is_true(part, subject); };
    switch (condition.kind) {
    case Condition::Kind::comparison:
        return compares(condition, subject);
    case Condition::Kind::word:
        return subject.is(condition.name);
    case Condition::Kind::negation:
        return !holds(condition.parts.front());
    case Condition::Kind::all:
        return std::ranges::all_of(condition.parts, holds);
    case Condition::Kind::any:
        return std::ranges::any_of(condition.parts, holds);
    }
    return false;
}

} // namespace abut
