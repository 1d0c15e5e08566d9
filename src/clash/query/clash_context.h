#pragma once

#include <abut/clash.h>

#include <cstdint>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace abut {

/// Returns whether a name is about a clash's groups or topics: "group", or it begins with "group."
/// or "topic.".
bool is_of_context(std::string_view name);

/// Errors      Error{bad_argument} if a name is about groups or topics, but not a known one.
void require_known_context(std::string_view name);

/// The groups and topics of a report's clashes, as conditions ask for them.
/// include/abut/part_query.h lists the names. The report must outlive it.
class ClashContext {
public:
    explicit ClashContext(const ClashReport& report);

    /// As ConditionSubject::any_value, for a clash of the report.
    [[nodiscard]] bool any_value(std::uint32_t clash, std::string_view name,
                                 const std::function<bool(std::string_view)>& take) const;

private:
    using Take = std::function<bool(std::string_view)>;
    void add(const std::vector<ClashGroup>& groups, const ClashGroup* parent);
    [[nodiscard]] bool of_topics(std::uint32_t clash, std::string_view name,
                                 const Take& take) const;

    const ClashReport& report_;
    std::vector<const ClashGroup*> innermost_; ///< of each clash; may be null
    std::unordered_map<const ClashGroup*, const ClashGroup*> parents_; ///< null: an outermost group
    std::unordered_map<std::string_view, std::vector<const Topic*>> of_group_; ///< by group id
    std::unordered_map<std::uint64_t, std::vector<const Topic*>> of_clash_;    ///< by clash id
};

} // namespace abut
