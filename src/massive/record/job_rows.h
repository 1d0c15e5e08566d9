#pragma once

#include <abut/clash.h>

#include "core/hash.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

/// Questions and jobs as store rows, each with a checksum. The caller of a function that writes
/// holds a transaction.
///
/// Errors      of all functions that read: Error{malformed}, naming the store, if a row does not
///             match its checksum.
namespace abut {

/// A question: the options of a job, whichever parts it is about.
struct QuestionRow {
    std::int64_t question = 0;
    Hash128 hash; ///< of the options
    double clearance = 0;
    double stored_touch = 0; ///< the touch tolerance, or kTouchOfFiles
    bool self = false;
    std::uint64_t rules = 0; ///< number of rules

    /// Stands in the column for the tolerance that the files of each pair give.
    static constexpr double kTouchOfFiles = -1;
    /// As ClashOptions::touch_tolerance.
    [[nodiscard]] std::optional<double> touch_tolerance() const {
        return stored_touch == kTouchOfFiles ? std::nullopt : std::optional(stored_touch);
    }
    [[nodiscard]] std::uint64_t checksum() const;
};
std::vector<QuestionRow> read_questions(Database& database);
/// Returns the number of a question in the store; none if it was never asked.
std::optional<std::int64_t> find_question(Database& database, const ClashOptions& options);
/// Adds a question that the store does not have yet, and returns its number.
std::int64_t add_question(Database& database, const ClashOptions& options);
/// Returns a hash of all options that make up the question. It does not depend on the parts.
Hash128 question_hash(const ClashOptions& options);

/// A job: a question about the parts that the store had, and how far its answer has come.
struct JobRow {
    std::int64_t job = 0, question = 0;
    Hash128 key; ///< hash of the question, the parts and the version of the answers
    std::uint64_t generation = 0; ///< of the youngest part; changed parts have a later one
    bool within = false;          ///< pairs within one model file were tested too
    /// The number of each model and the hash of its file name.
    std::vector<std::pair<std::int64_t, std::uint64_t>> models;
    std::uint64_t candidates = 0;
    std::int64_t run = 0; ///< how often the job was begun or resumed
    bool planned = false;
    std::int64_t finished = 0; ///< end of the job, in seconds since 1970; 0 if it has not ended
    std::int64_t answers = 0;  ///< their version (kAnswersVersion)

    [[nodiscard]] std::uint64_t checksum() const;
};
/// Returns all jobs, sorted by number. There are at most two for each question.
std::vector<JobRow> read_jobs(Database& database);
std::optional<JobRow> find_job(Database& database, const Hash128& key);
/// Returns the last finished job of a question, if there is one.
std::optional<JobRow> find_finished_job(Database& database, std::int64_t question);
/// Returns the last other job of the same question and version of answers that has a plan and may thus
/// have answers.
std::optional<JobRow> find_earlier_job(Database& database, const JobRow& job);
/// Adds a job, or replaces its row. A new job (number 0) gets its number.
void put_job(Database& database, JobRow& job);
/// Removes the row of a job; its clashes and units stay.
void remove_job(Database& database, std::int64_t job);
/// Removes all other jobs of the job's question, with their clashes and units. Finished jobs are
/// removed only if `finished_too`.
void remove_other_jobs(Database& database, const JobRow& job, bool finished_too);

} // namespace abut
