#pragma once

#include <abut/broad_phase.h>
#include <abut/clash.h>
#include <abut/scene.h>

#include "massive/job_rows.h"
#include "massive/stored_parts.h"
#include "massive/work_rows.h"
#include "massive/work_units.h"
#include "store/hierarchy_table.h"
#include "store/sqlite.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abut {

/// What a job has done, kept in its store: which pairs are left, and what the others gave. Each piece
/// of work is recorded as a whole or not at all, so a job that is killed goes on where it was. A new
/// job takes over what an earlier one of the same question knows of parts that have not changed since.
///
/// Of two processes that work on one job, the later takes over: the other's next piece is refused. So
/// is that of a job whose parts an import has changed meanwhile.
///
/// In          stored: of all members the same, which the job is about.
/// Errors      of all members: Error, naming the store: as Database; malformed if a row is not what
///             its checksum says; unreadable if another process has taken over.
class JobRecord {
public:
    /// Null if the store cannot be written to.
    static std::unique_ptr<JobRecord> open(const std::string& store, const StoredParts& stored,
                                           const ClashOptions& options, std::uint64_t candidates);

    /// Of all candidates, sorted, those whose answer is not known. None: nothing has to be written any
    /// more if the job has ended.
    std::vector<IndexPair> pairs_left(const StoredParts& stored, std::vector<IndexPair> candidates);

    /// The pieces of work from now on, in place of those that were left.
    void plan(const StoredParts& stored, const std::vector<WorkUnit>& units);
    /// The clashes that are known, without models; their parts are indices in StoredParts. After
    /// plan().
    std::vector<Clash> found(const StoredParts& stored);
    /// Piece `unit` of the plan is done, and found some clashes, whose parts are indices in
    /// StoredParts; hierarchies that were built are kept with it.
    void commit(const StoredParts& stored, std::size_t unit, std::span<const Clash> clashes,
                const std::vector<HierarchyRow>& hierarchies);
    /// Pieces that are committed while it is open are committed with it: the disk is waited for once.
    [[nodiscard]] Transaction together() { return Transaction(database_); }
    /// The job has ended: the clashes of the report get their statuses, and earlier jobs of the same
    /// question go.
    void finish(ClashReport& report, const std::vector<Scene>& models);

private:
    JobRecord(const std::string& store, const StoredParts& stored, const ClashOptions& options,
              std::uint64_t candidates);

    void require_ours();

    Database database_;
    Hash128 parts_; ///< as they were when the job was opened
    JobRow job_;
    std::vector<ClashRow> taken_over_; ///< from an earlier job, until the plan is recorded
};

/// The same statuses where nothing is to be recorded, or nothing can be.
void tell_statuses(Database& database, const StoredParts& stored, const ClashOptions& options,
                   ClashReport& report);

} // namespace abut
