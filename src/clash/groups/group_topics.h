#pragma once

#include <abut/topics.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace abut {

/// Returns the topic of a group of which nobody has said anything yet, without clashes.
Topic fresh_topic(std::string_view group, std::string_view name, std::string_view what);

/// Returns the topic of a clash of which nobody has said anything yet.
///
/// In          a, b: names of the parts.
Topic fresh_topic_of_clash(std::uint64_t clash, const std::string& a, const std::string& b);

} // namespace abut
