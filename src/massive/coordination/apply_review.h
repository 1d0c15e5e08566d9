#pragma once

#include <abut/topics.h>

#include <cstdint>
#include <optional>
#include <string>

namespace abut {

/// Returns a topic as a store had it after revision `base` (none: the last one): as stored, or of a
/// group of which nobody had said anything, or empty but for its GUID.
Topic topic_before_edit(const Store& store, const std::string& guid,
                        std::optional<std::int64_t> base);

} // namespace abut
