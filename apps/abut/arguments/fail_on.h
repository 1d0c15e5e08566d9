#pragma once

#include <abut/clash.h>

#include <string>
#include <vector>

namespace abut::command {

/// The value of abut clash --fail-on: kinds and statuses of clashes that are a problem. If no kind
/// is named, all kinds count. If no status is named, all except `approved` count.
class FailOn {
public:
    /// In          words: comma-separated; if empty, no clash is a problem. from_store: whether
    ///             clashes have statuses.
    /// Errors      Error{bad_argument}, naming the option.
    FailOn(const std::string& words, bool from_store);

    [[nodiscard]] bool is_problem(const ClashReport& report) const;

private:
    std::vector<ClashKind> kinds_;
    std::vector<ClashStatus> statuses_;
};

} // namespace abut::command
