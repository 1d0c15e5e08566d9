#pragma once

#include <abut/clash.h>

#include "core/hash.h"
#include "store/sqlite.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

/// Questions and jobs: rows of a store, each with its checksum. What writes is called within a
/// transaction.
///
/// Errors      of all readers: Error{malformed}, naming the store, if a row is not what its checksum
///             says.
namespace abut {

/// What jobs are asked, of whatever parts.
struct QuestionRow {
    std::int64_t question = 0;
    Hash128 hash; ///< of the options
    double clearance = 0, touch = 0;
    bool self = false;
    std::uint64_t rules = 0; ///< how many

    [[nodiscard]] std::uint64_t checksum() const;
};
std::vector<QuestionRow> read_questions(Database& database);
/// The number of a question in the store; none if it was never asked.
std::optional<std::int64_t> find_question(Database& database, const ClashOptions& options);
/// A question that the store does not have yet.
std::int64_t add_question(Database& database, const ClashOptions& options);

/// What was asked of which parts, and how far the answer has come.
struct JobRow {
    std::int64_t job = 0, question = 0;
    Hash128 key;                  ///< of the question and the parts
    std::uint64_t generation = 0; ///< of the youngest part: a part of a later one has changed since
    bool within = false;          ///< pairs within a model were of interest too
    /// The models by their numbers, with the hashes of their files' names.
    std::vector<std::pair<std::int64_t, std::uint64_t>> models;
    std::uint64_t candidates = 0;
    std::int64_t run = 0; ///< counts how often the job was begun or gone on with
    bool planned = false;
    std::int64_t finished = 0; ///< when it ended, in seconds since 1970; 0: it has not

    [[nodiscard]] std::uint64_t checksum() const;
};
/// All, in the order of their numbers. There are few: two of each question at most.
std::vector<JobRow> read_jobs(Database& database);
std::optional<JobRow> find_job(Database& database, const Hash128& key);
/// Of the question, the last that ended, or else null.
std::optional<JobRow> find_finished_job(Database& database, std::int64_t question);
/// Of the question, the last other one that knows something.
std::optional<JobRow> find_earlier_job(Database& database, const JobRow& job);
/// A new job gets its number.
void put_job(Database& database, JobRow& job);
/// The row alone.
void remove_job(Database& database, std::int64_t job);
/// Removes jobs of the question but this one, with their clashes: all, or those that have not ended.
void remove_other_jobs(Database& database, const JobRow& job, bool finished_too);

} // namespace abut
