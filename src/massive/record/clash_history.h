#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include "massive/record/clash_marks.h"
#include "massive/record/job_rows.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <functional>
#include <vector>

/// The clash history of a store: which clashes of a question appeared, stayed or were resolved from
/// job to job. A question is a set of clash options, whichever parts they are applied to
/// (QuestionRow). docs/clash-status.md states the rules.
namespace abut {

/// A clash that at least one job of a question found. It is a store row with a checksum.
struct HistoryRow {
    std::int64_t question = 0;
    ListedClash clash;         ///< without status and note
    std::int64_t appeared = 0; ///< job that found it first, or first after it was resolved
    /// If it was resolved before `appeared`: the serial number of the last mark set until then,
    /// which makes older marks void. Else 0.
    std::int64_t returned = 0;

    [[nodiscard]] std::uint64_t checksum() const;
    /// In          mark: null if the clash has none; job: the last finished job of the question.
    [[nodiscard]] ClashStatus status(const MarkRow* mark, std::int64_t job) const;
};

/// Calls take(row) for each row of a question, sorted by clash id.
/// Errors      Error{malformed}, naming the store, if a row does not match its checksum or is
///             missing.
void for_each_in_history(Database& database, std::int64_t question,
                         const std::function<void(HistoryRow&&)>& take);

/// Updates the history of a job's question with the clashes that the job found. The caller holds a
/// transaction.
void record_history(Database& database, const JobRow& job, const ClashReport& report,
                    const std::vector<Scene>& models);

/// Removes the resolved clashes and returns their ids. The caller holds a transaction.
std::vector<std::uint64_t> forget_resolved(Database& database, std::int64_t question);

/// Fills in the report's statuses, notes and resolved clashes.
///
/// In          question: 0 if it was never asked; job: the job of the report if it is recorded in
///             the history, else a number larger than that of any job.
void tell_statuses(Database& database, std::int64_t question, std::int64_t job,
                   ClashReport& report);

} // namespace abut
