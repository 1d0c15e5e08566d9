#pragma once

#include <abut/topics.h>

#include <string>
#include <vector>

namespace abut {

/// Merges the edits between `base` and `edited` into `stored`, as merge_topics says. Appends the
/// conflicts. Comments of a conflict are not added here.
Topic merge_topic(const Topic& base, const Topic& stored, const Topic& edited,
                  std::vector<TopicConflict>& conflicts);

} // namespace abut
