#include "massive/record/job_counts.h"

#include "massive/record/job_tables.h"
#include "store/database/row_hash.h"

#include <array>
#include <string>

namespace abut {

namespace {

/// The kinds that have a column in the table of counts. The last kind has a table of its own.
constexpr std::size_t kKindColumns = 5, kUndecided = 5;

std::string counts_list(std::int64_t question) {
    return "counts " + std::to_string(question);
}

std::uint64_t counts_checksum(std::int64_t question, std::int64_t job, const JobCounts& counts) {
    RowHash hash;
    hash.add(question).add(job).add(counts.finished);
    for (std::size_t i = 0; i < kKindColumns; ++i)
        hash.add(counts.kinds.at(i));
    for (const std::uint64_t number : counts.statuses)
        hash.add(number);
    if (counts.kinds.at(kUndecided) > 0)
        hash.add(counts.kinds.at(kUndecided));
    return hash.value();
}

} // namespace

void record_counts(Database& database, const JobRow& job, const ClashReport& report) {
    JobCounts counts;
    counts.finished = job.finished;
    counts.kinds = report.counts;
    if (report.statuses)
        counts.statuses = *report.statuses;
    const std::uint64_t checksum = counts_checksum(job.question, job.job, counts);
    const auto& k = counts.kinds;
    const auto& s = counts.statuses;
    Statement(database, "INSERT INTO job_counts VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
        .bind(job.question, job.job, counts.finished, k[0], k[1], k[2], k[3], k[4], s[0], s[1],
              s[2], s[3], s[4], checksum)
        .run();
    if (k[kUndecided] > 0)
        Statement(database, "INSERT INTO job_undecided VALUES (?,?,?)")
            .bind(job.question, job.job, k[kUndecided])
            .run();
    RowTally tally = read_tally(database, counts_list(job.question));
    tally.add(checksum);
    write_tally(database, counts_list(job.question), tally);
}

std::map<std::int64_t, JobCounts> read_counts(Database& database, std::int64_t question) {
    constexpr int kFirstKind = 2, kFirstStatus = 7, kChecksum = 12, kNumber = 13;
    std::map<std::int64_t, JobCounts> result;
    RowTally tally;
    Statement rows(database,
                   "SELECT job, finished, hard, touch, contained, duplicate, clearance, new, "
                   "active, reviewed, approved, resolved, checksum, coalesce(number, 0) "
                   "FROM job_counts LEFT JOIN job_undecided USING (question, job) "
                   "WHERE question = ? ORDER BY job");
    rows.bind(question);
    while (rows.step()) {
        JobCounts counts;
        counts.finished = rows.integer(1);
        for (std::size_t i = 0; i < kKindColumns; ++i) {
            const int column = static_cast<int>(i);
            counts.kinds.at(i) = static_cast<std::uint64_t>(rows.integer(kFirstKind + column));
            counts.statuses.at(i) = static_cast<std::uint64_t>(rows.integer(kFirstStatus + column));
        }
        counts.kinds.at(kUndecided) = static_cast<std::uint64_t>(rows.integer(kNumber));
        const auto checksum = static_cast<std::uint64_t>(rows.integer(kChecksum));
        if (counts_checksum(question, rows.integer(0), counts) != checksum)
            damaged_job(database,
                        "the counts of job " + rows.text(0) + " do not match their checksum");
        tally.add(checksum);
        result.emplace(rows.integer(0), counts);
    }
    require_tally(database, counts_list(question), tally);
    return result;
}

} // namespace abut
