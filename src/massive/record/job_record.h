#pragma once

#include <abut/broad_phase.h>
#include <abut/clash.h>
#include <abut/scene.h>

#include "massive/record/job_rows.h"
#include "massive/record/work_rows.h"
#include "massive/work/stored_parts.h"
#include "massive/work/work_units.h"
#include "store/database/hierarchy_table.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// Returns whether a store can be written to.
bool is_writable_store(const std::string& store);

/// Numbers of a question and of a finished job of it; 0: the store has none.
struct RecordedJob {
    std::int64_t question = 0, job = 0;
};

/// The progress of a job, recorded in its store: the pairs that are left and the clashes of the
/// others. Each work unit is recorded entirely or not at all, so that a killed job can be resumed.
/// A new job takes over the answers of an earlier job of the same question for parts that have not
/// changed since.
///
/// If two processes work on one job, the later one takes over, and the next commit of the other one
/// fails. A commit also fails if an import has changed the store's parts meanwhile.
///
/// In          stored: the parts of the job, the same for all members.
/// Errors      of all members: Error, naming the store, as Database; malformed if a row does not
///             match its checksum; unreadable if another process has taken over or an import has
///             changed the parts.
class JobRecord {
public:
    /// Opens the record of a job and creates it if it does not exist. Returns null if the store
    /// cannot be written to.
    static std::unique_ptr<JobRecord> open(const std::string& store, const StoredParts& stored,
                                           const ClashOptions& options, std::uint64_t candidates);

    /// Returns the candidate pairs whose answer is not known. It returns none if the job has
    /// finished.
    /// In          candidates: all candidate pairs, sorted.
    std::vector<IndexPair> pairs_left(const StoredParts& stored, std::vector<IndexPair> candidates);

    /// Replaces the recorded work units by these. Does nothing if the job has finished.
    void plan(const StoredParts& stored, const std::vector<WorkUnit>& units);
    /// Returns the clashes that are known, with parts as indices in StoredParts and without models.
    /// Call it after plan().
    std::vector<FoundClash> found(const StoredParts& stored);
    /// Records that a unit of the plan is done, with its clashes and the hierarchies that were
    /// built. The parts of the clashes are indices in StoredParts.
    void commit(const StoredParts& stored, std::size_t unit, std::span<const FoundClash> clashes,
                const std::vector<HierarchyRow>& hierarchies);
    /// Opens an outer transaction. Units that are committed while it is open reach the disk when it
    /// is committed, at the cost of one wait.
    [[nodiscard]] Transaction together() { return Transaction(database_); }
    /// Records that the job has finished, gives the clashes of the report their statuses, and
    /// removes the other jobs of the same question.
    void finish(ClashReport& report, const std::vector<Scene>& models);

    [[nodiscard]] RecordedJob job() const { return {job_.question, job_.job}; }

private:
    JobRecord(const std::string& store, const StoredParts& stored, const ClashOptions& options,
              std::uint64_t candidates);

    void require_ours();

    Database database_;
    Hash128 parts_; ///< parts_key when the job was opened
    JobRow job_;
    std::vector<ClashRow> taken_over_; ///< clashes of an earlier job, until the plan is recorded
};

/// Gives the clashes of a report their statuses when the job is not recorded. Returns the finished
/// job of the same question about the same parts.
RecordedJob tell_statuses(Database& database, const StoredParts& stored,
                          const ClashOptions& options, ClashReport& report);

} // namespace abut
