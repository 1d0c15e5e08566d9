#include <abut/clash.h>
#include <abut/error.h>
#include <abut/part_query.h>

#include "clash/query/clash_context.h"
#include "clash/query/condition.h"
#include "clash/query/part_facts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace abut {

namespace {

/// Formats a number so that it reads back as the same double.
std::string exact_text(double number) {
    std::array<char, 32> text{};
    const auto [end, fault] = std::to_chars(text.data(), text.data() + text.size(), number);
    return fault == std::errc() ? std::string(text.data(), end) : std::string();
}

const std::vector<std::string>& clash_words() {
    static const std::vector<std::string> words = [] {
        std::vector<std::string> list{"any"};
        for (const ClashKind kind : kClashKinds)
            list.emplace_back(to_string(kind));
        for (const ClashStatus status : kClashStatuses)
            list.emplace_back(to_string(status));
        return list;
    }();
    return words;
}

bool is_status(std::string_view word) {
    return std::ranges::any_of(kClashStatuses,
                               [&](ClashStatus status) { return word == to_string(status); });
}

/// A clash as the subject of a condition.
class ClashSubject final : public ConditionSubject {
public:
    /// In          context: of the report that the clash is in; null: none.
    ClashSubject(const Clash& clash, const std::vector<Scene>& models, const ClashContext* context,
                 std::uint32_t index)
        : clash_(clash), models_(models), context_(context), index_(index) {}

    [[nodiscard]] bool is(std::string_view word) const override {
        return word == "any" || word == to_string(clash_.kind) ||
               (clash_.status && word == to_string(*clash_.status));
    }

    [[nodiscard]] bool any_value(std::string_view name,
                                 const std::function<bool(std::string_view)>& take) const override {
        if (name.starts_with("a.") || name.starts_with("b."))
            return of_part(name.front() == 'a' ? 0 : 1, name.substr(2), take);
        if (is_of_context(name))
            return context_ != nullptr && context_->any_value(index_, name, take);
        if (name == "kind")
            return take(to_string(clash_.kind));
        if (name == "status")
            return clash_.status && take(to_string(*clash_.status));
        if (name == "neighbours")
            return clash_.neighbours && take(to_string(*clash_.neighbours));
        if (name == "severity" || name == "rule" || name == "note") {
            const std::string& text = name == "severity" ? clash_.severity
                                      : name == "rule"   ? clash_.rule
                                                         : clash_.note;
            return !text.empty() && take(text);
        }
        if (name == "distance" || name == "depth" || name == "gap" || name == "volume") {
            const std::optional<double> value = length_of(name);
            return value && take(exact_text(*value));
        }
        return of_part(0, name, take) || of_part(1, name, take);
    }

private:
    [[nodiscard]] std::optional<double> length_of(std::string_view name) const {
        if (name == "distance")
            return clash_.distance;
        if (name == "volume")
            return clash_.volume;
        const bool apart = clash_.kind == ClashKind::clearance || clash_.distance > 0;
        if (clash_.kind == ClashKind::duplicate || apart != (name == "gap"))
            return std::nullopt;
        return std::abs(clash_.distance);
    }
    [[nodiscard]] bool of_part(std::size_t side, std::string_view name,
                               const std::function<bool(std::string_view)>& take) const {
        const std::uint32_t model = clash_.model.at(side), part = clash_.part.at(side);
        if (model >= models_.size() || part >= models_[model].parts.size())
            throw Error(ErrorCode::bad_argument, "a clash names a part that does not exist");
        const PartFacts facts = facts_of(models_[model], part);
        return PartSubject(facts).any_value(name, take);
    }

    const Clash& clash_;
    const std::vector<Scene>& models_;
    const ClashContext* context_;
    std::uint32_t index_;
};

} // namespace

ClashQuery ClashQuery::parse(std::string_view text) {
    ClashQuery query;
    query.condition_ = std::make_shared<const Condition>(parse_condition(text, clash_words()));
    query.text_ = to_text(*query.condition_);
    for_each_name(*query.condition_, [](const std::string& name) { require_known_context(name); });
    return query;
}

bool ClashQuery::matches(const Clash& clash, const std::vector<Scene>& models) const {
    return condition_ == nullptr || is_true(*condition_, ClashSubject(clash, models, nullptr, 0));
}

std::vector<std::uint32_t> ClashQuery::find(const ClashReport& report,
                                            const std::vector<Scene>& models) const {
    const ClashContext context(report);
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < report.clashes.size(); ++i)
        if (condition_ == nullptr ||
            is_true(*condition_, ClashSubject(report.clashes[i], models, &context, i)))
            found.push_back(i);
    return found;
}

std::vector<std::string> ClashQuery::names() const {
    return names_of(condition_.get());
}

bool ClashQuery::asks_status() const {
    bool asks = false;
    if (condition_ != nullptr) {
        for_each_name(*condition_, [&](const std::string& name) { asks |= name == "status"; });
        for_each_word(*condition_, [&](const std::string& word) { asks |= is_status(word); });
    }
    return asks;
}

} // namespace abut
