#include "arguments/fail_on.h"

#include <abut/error.h>

#include "arguments/common.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace abut::command {

namespace {

/// Returns whether a text can only be a condition: no list of words has these characters.
bool looks_like_condition(const std::string& text) {
    return text.find_first_of(" =~<>()\"") != std::string::npos;
}

} // namespace

FailOn::FailOn(const std::string& words, bool from_store) {
    if (words.empty())
        return;
    if (looks_like_condition(words)) {
        parse_condition(words, from_store);
        return;
    }
    std::vector<std::string> known{"any"};
    for (const ClashKind kind : kClashKinds)
        known.emplace_back(abut::to_string(kind));
    for (const ClashStatus status : kClashStatuses)
        if (status != ClashStatus::resolved)
            known.emplace_back(abut::to_string(status));
    parse_list(words, known, from_store);
    if (kinds_.empty())
        kinds_.assign(kClashKinds.begin(), kClashKinds.end());
    if (statuses_.empty())
        statuses_ = {ClashStatus::fresh, ClashStatus::active, ClashStatus::reviewed};
}

void FailOn::parse_list(const std::string& words, const std::vector<std::string>& known,
                        bool from_store) {
    for (const std::string& word : parse_words("--fail-on", words, known)) {
        for (const ClashKind kind : kClashKinds)
            if (word == abut::to_string(kind))
                kinds_.push_back(kind);
        for (const ClashStatus status : kClashStatuses)
            if (word == abut::to_string(status)) {
                if (!from_store)
                    throw Error(ErrorCode::bad_argument, "--fail-on",
                                "'" + word +
                                    "' applies only to a store: models have no earlier job");
                statuses_.push_back(status);
            }
        if (word == "any")
            kinds_.assign(kClashKinds.begin(), kClashKinds.end());
    }
}

void FailOn::parse_condition(const std::string& text, bool from_store) {
    try {
        query_ = ClashQuery::parse(text);
    } catch (const Error& error) {
        throw Error(ErrorCode::bad_argument, "--fail-on", error.what());
    }
    if (query_->asks_status() && !from_store)
        throw Error(ErrorCode::bad_argument, "--fail-on",
                    "a status applies only to a store: models have no earlier job");
}

bool FailOn::is_problem(const ClashReport& report, const std::vector<Scene>& models) const {
    return std::any_of(report.clashes.begin(), report.clashes.end(), [&](const Clash& clash) {
        if (query_)
            return (clash.status != ClashStatus::approved || query_->asks_status()) &&
                   query_->matches(clash, models);
        return std::find(kinds_.begin(), kinds_.end(), clash.kind) != kinds_.end() &&
               (!clash.status ||
                std::find(statuses_.begin(), statuses_.end(), *clash.status) != statuses_.end());
    });
}

std::vector<std::string> FailOn::warnings(const std::vector<Scene>& models) const {
    constexpr std::array<std::string_view, 14> kAlways{
        "kind",  "status", "severity", "rule", "neighbours", "note", "distance",
        "depth", "gap",    "volume",   "type", "name",       "id",   "file"};
    std::vector<std::string> result;
    for (std::string name : query_ ? query_->names() : std::vector<std::string>()) {
        if (name.starts_with("a.") || name.starts_with("b."))
            name.erase(0, 2);
        if (std::ranges::find(kAlways, name) != kAlways.end() ||
            std::ranges::any_of(models, [&](const Scene& model) {
                return model.properties.find(name).has_value();
            }))
            continue;
        const std::string warning =
            "no part of a clash has the property \"" + name + "\", which --fail-on asks for";
        if (std::ranges::find(result, warning) == result.end())
            result.push_back(warning);
    }
    return result;
}

} // namespace abut::command
