#pragma once

#include <abut/clash.h>

#include <optional>
#include <string>
#include <vector>

namespace abut::command {

/// The reports that --fail-on is about.
struct FailOnScope {
    bool from_store = false; ///< clashes have statuses; groups have changes and topics
    bool grouped = true;     ///< clashes are in groups
};

/// The value of abut clash --fail-on: the clashes that are a problem. It is a list of kinds and
/// statuses, or a condition on clashes (ClashQuery). If a list names no kind, all kinds count. If
/// no status is named, all except `approved` count.
class FailOn {
public:
    /// In          words: comma-separated, or a condition; if empty, no clash is a problem.
    /// Errors      Error{bad_argument}, naming the option.
    FailOn(const std::string& words, const FailOnScope& scope);

    /// Returns whether no clash is a problem.
    [[nodiscard]] bool empty() const { return !query_ && kinds_.empty(); }

    /// Returns the indices of the clashes that are a problem, ascending.
    ///
    /// In          models: those that the report refers to.
    [[nodiscard]] std::vector<std::uint32_t> problems(const ClashReport& report,
                                                      const std::vector<Scene>& models) const;

    /// The condition; without one if the value is a list of words.
    [[nodiscard]] ClashQuery query() const { return query_.value_or(ClashQuery()); }

private:
    void parse_list(const std::string& words, const std::vector<std::string>& known,
                    bool from_store);
    void parse_condition(const std::string& text, const FailOnScope& scope);
    [[nodiscard]] bool is_listed(const Clash& clash) const;

    std::optional<ClashQuery> query_;
    std::vector<ClashKind> kinds_;
    std::vector<ClashStatus> statuses_;
};

} // namespace abut::command
