#pragma once

#include <abut/clash.h>

#include <string>

namespace abut::command {

/// Returns "1,771 clashes in 43 groups" and the largest groups as text for the terminal; nothing if
/// the report is not grouped.
std::string group_summary(const ClashReport& report);

} // namespace abut::command
