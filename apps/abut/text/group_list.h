#pragma once

#include <abut/clash_review.h>

#include <string>

namespace abut::command {

/// Returns what has become of the groups of a store as text for the terminal: numbers, then a line
/// for each group, with its topic if there is one.
std::string group_list(const GroupReview& review);

} // namespace abut::command
