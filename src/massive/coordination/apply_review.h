#pragma once

#include <abut/topics.h>

#include <cstdint>
#include <string>
#include <vector>

namespace abut {

/// Returns topics as a store had them after revision `base`: each as stored, or of a group of which
/// nobody had said anything, or empty but for its GUID.
std::vector<Topic> topics_before_edit(const Store& store, const std::vector<std::string>& guids,
                                      std::int64_t base);

} // namespace abut
