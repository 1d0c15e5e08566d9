#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include "massive/clash_marks.h"
#include "massive/job_rows.h"
#include "store/sqlite.h"

#include <cstdint>
#include <functional>
#include <vector>

/// What has become of the clashes of a question from job to job. docs/clash-status.md tells the rules.
namespace abut {

/// A clash that some job of a question found. A row of a store, with a checksum.
struct HistoryRow {
    std::int64_t question = 0;
    ListedClash clash;         ///< without status and note
    std::int64_t appeared = 0; ///< job that found it first, or first again
    /// It had been resolved before that: the last mark that was set until then; else 0.
    std::int64_t returned = 0;

    [[nodiscard]] std::uint64_t checksum() const;
    /// In          mark: null if there is none; job: the last one of the question that has ended.
    [[nodiscard]] ClashStatus status(const MarkRow* mark, std::int64_t job) const;
};

/// In the order of ids.
/// Errors      Error{malformed}, naming the store, if a row is not what its checksum says, or missing.
void for_each_in_history(Database& database, std::int64_t question,
                         const std::function<void(HistoryRow&&)>& take);

/// Brings the history of a job's question up to date with what it found. Within a transaction.
void record_history(Database& database, const JobRow& job, const ClashReport& report,
                    const std::vector<Scene>& models);

/// Removes what is resolved; returns the ids. Within a transaction.
std::vector<std::uint64_t> forget_resolved(Database& database, std::int64_t question);

/// Fills in what the report says of statuses.
///
/// In          question: 0 if it was never asked; job: the one that the report is of, if the history has
///             it, else a number beyond all.
void tell_statuses(Database& database, std::int64_t question, std::int64_t job,
                   ClashReport& report);

} // namespace abut
