#pragma once

#include <abut/clash.h>

#include "massive/record/job_rows.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <map>

namespace abut {

/// Records the numbers of clashes of a finished job. They stay when the job is removed. The caller
/// holds a transaction.
///
/// In          report: with statuses.
void record_counts(Database& database, const JobRow& job, const ClashReport& report);

/// Returns the numbers of all finished jobs of a question by the jobs' numbers, without groups.
///
/// Errors      Error{malformed}, naming the store, if a row does not match its checksum or is
///             missing.
std::map<std::int64_t, JobCounts> read_counts(Database& database, std::int64_t question);

} // namespace abut
