#include "arguments/fail_on.h"

#include <abut/error.h>

#include "arguments/common.h"

#include <algorithm>
#include <string_view>

namespace abut::command {

namespace {

/// Returns whether a text can only be a condition: no list of words has these characters.
bool looks_like_condition(const std::string& text) {
    return text.find_first_of(" =~<>()\"") != std::string::npos;
}

/// Returns whether a name of a condition is about groups or topics.
bool is_of_groups(const std::string& name) {
    return name == "group" || name.starts_with("group.") || name.starts_with("topic.");
}

/// Refuses names that no clash of the report can have a value of.
void require_values(const std::vector<std::string>& names, const FailOnScope& scope) {
    for (const std::string& name : names) {
        if (!is_of_groups(name))
            continue;
        if (!scope.from_store && (name == "group.change" || name.starts_with("topic.")))
            throw Error(ErrorCode::bad_argument, "--fail-on",
                        "'" + name +
                            "' applies only to a store: models have no earlier job and no "
                            "topics");
        if (!scope.grouped)
            throw Error(ErrorCode::bad_argument, "--fail-on",
                        "'" + name + "' needs groups, but --group none makes none");
    }
}

} // namespace

FailOn::FailOn(const std::string& words, const FailOnScope& scope) {
    if (words.empty())
        return;
    if (looks_like_condition(words)) {
        parse_condition(words, scope);
        return;
    }
    std::vector<std::string> known{"any"};
    for (const ClashKind kind : kClashKinds)
        known.emplace_back(abut::to_string(kind));
    for (const ClashStatus status : kClashStatuses)
        if (status != ClashStatus::resolved)
            known.emplace_back(abut::to_string(status));
    parse_list(words, known, scope.from_store);
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

void FailOn::parse_condition(const std::string& text, const FailOnScope& scope) {
    try {
        query_ = ClashQuery::parse(text);
    } catch (const Error& error) {
        throw Error(ErrorCode::bad_argument, "--fail-on", error.what());
    }
    if (query_->asks_status() && !scope.from_store)
        throw Error(ErrorCode::bad_argument, "--fail-on",
                    "a status applies only to a store: models have no earlier job");
    require_values(query_->names(), scope);
}

bool FailOn::is_listed(const Clash& clash) const {
    const auto lists = [&](ClashKind kind) {
        return std::ranges::find(kinds_, kind) != kinds_.end();
    };
    // An undecided clash may be of either kind.
    const bool may_be_listed =
        clash.kind == ClashKind::undecided && (lists(ClashKind::hard) || lists(ClashKind::touch));
    return (lists(clash.kind) || may_be_listed) &&
           (!clash.status || std::ranges::find(statuses_, *clash.status) != statuses_.end());
}

std::vector<std::uint32_t> FailOn::problems(const ClashReport& report,
                                            const std::vector<Scene>& models) const {
    std::vector<std::uint32_t> result;
    if (query_) {
        result = query_->find(report, models);
        if (!query_->asks_status())
            std::erase_if(result, [&](std::uint32_t i) {
                return report.clashes[i].status == ClashStatus::approved;
            });
        return result;
    }
    for (std::uint32_t i = 0; i < report.clashes.size(); ++i)
        if (is_listed(report.clashes[i]))
            result.push_back(i);
    return result;
}

} // namespace abut::command
