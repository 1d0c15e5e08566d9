#pragma once

#include <abut/topics.h>

#include "store/database/sqlite.h"

#include <cstdint>

namespace abut {

/// Marks the clashes of a topic whose status has changed: `approved` approves them; `resolved` and
/// `closed` mark those without a mark as reviewed; another status clears the marks that the topic
/// had set. Clashes that exist no more are left alone. Returns the number of clashes whose mark has
/// changed. The caller holds a transaction.
std::uint64_t mark_by_topic(Database& database, const Topic& before, const Topic& after,
                            std::int64_t now);

} // namespace abut
