#include "arguments/fail_on.h"

#include <abut/error.h>

#include "arguments/common.h"

#include <algorithm>

namespace abut::command {

FailOn::FailOn(const std::string& words, bool from_store) {
    if (words.empty())
        return;
    std::vector<std::string> known{"any"};
    for (const ClashKind kind : kClashKinds)
        known.emplace_back(abut::to_string(kind));
    for (const ClashStatus status : kClashStatuses)
        if (status != ClashStatus::resolved)
            known.emplace_back(abut::to_string(status));
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
    if (kinds_.empty())
        kinds_.assign(kClashKinds.begin(), kClashKinds.end());
    if (statuses_.empty())
        statuses_ = {ClashStatus::fresh, ClashStatus::active, ClashStatus::reviewed};
}

bool FailOn::is_problem(const ClashReport& report) const {
    return std::any_of(report.clashes.begin(), report.clashes.end(), [&](const Clash& clash) {
        return std::find(kinds_.begin(), kinds_.end(), clash.kind) != kinds_.end() &&
               (!clash.status ||
                std::find(statuses_.begin(), statuses_.end(), *clash.status) != statuses_.end());
    });
}

} // namespace abut::command
