#pragma once

#include <abut/topics.h>

#include "store/database/sqlite.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Topics as store rows, each with a checksum. Every change of topics is a revision; each topic is
/// kept as every revision left it, so that edits of an older state can be merged.
namespace abut {

/// Returns the number of the last revision; 0 if there is none.
std::int64_t last_revision(Database& database);

/// Returns the topics: those with the earliest due date first, those without one last; then by
/// creation.
///
/// Errors      Error{malformed}, naming the store, if a row does not match its checksum or is
///             missing.
std::vector<Topic> read_topic_rows(Database& database);

/// Returns a topic as it was after a revision; none if the store did not have it yet.
/// Errors      as read_topic_rows.
std::optional<Topic> topic_at_revision(Database& database, const std::string& guid,
                                       std::int64_t revision);

/// Writes a topic as a revision leaves it. The caller holds a transaction.
///
/// In          before: the topic as the store has it; null if it does not.
void write_topic(Database& database, const Topic* before, const Topic& topic,
                 std::int64_t revision);

/// Checks all rows.
/// Errors      as read_topic_rows.
void verify_topics(Database& database);

} // namespace abut
