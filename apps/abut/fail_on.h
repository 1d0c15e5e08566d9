#pragma once

#include <abut/clash.h>

#include <string>
#include <vector>

namespace abut::command {

/// What abut clash --fail-on asks for: kinds and statuses, of each all where none is named. An approved
/// clash is no problem unless `approved` is named.
class FailOn {
public:
    /// In          words: comma-separated; empty: nothing is a problem. from_store: statuses are known.
    /// Errors      Error{bad_argument}, naming the option.
    FailOn(const std::string& words, bool from_store);

    [[nodiscard]] bool is_problem(const ClashReport& report) const;

private:
    std::vector<ClashKind> kinds_;
    std::vector<ClashStatus> statuses_;
};

} // namespace abut::command
