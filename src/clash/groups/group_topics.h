#pragma once

#include <abut/topics.h>

#include <string_view>

namespace abut {

/// Returns the topic of a group of which nobody has said anything yet, without clashes.
Topic fresh_topic(std::string_view group, std::string_view name, std::string_view what);

} // namespace abut
