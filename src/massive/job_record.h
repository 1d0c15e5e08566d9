#pragma once

#include <abut/broad_phase.h>
#include <abut/clash.h>

#include "core/hash.h"
#include "massive/work_units.h"
#include "store/sqlite.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut {

/// A clash that a job has found, by the parts' indices in StoredParts.
struct FoundClash {
    IndexPair pair;
    Clash clash; ///< without model and part
};

/// The same for the same question, of whatever parts.
Hash128 question_hash(const ClashOptions& options);

/// What a job has done, kept in its store: which pairs are left, and what the others gave. Each piece
/// of work is recorded as a whole or not at all, so a job that is killed goes on where it was.
///
/// Of two processes that work on one job, the later takes over: the other's next piece is refused.
///
/// Errors      of all members: Error, naming the store: as Database; malformed if a row is not what
///             its checksum says; unreadable if another process has taken over.
class JobRecord {
public:
    /// What was asked of which parts: of the same question about the same parts there is one record.
    struct Question {
        Hash128 key;
        const ClashOptions& options;
        std::uint64_t candidates = 0;
    };

    /// Null if the store cannot be written to.
    static std::unique_ptr<JobRecord> open(const std::string& store, const Question& question);

    /// The pairs that are left; none if the job is new. Empty: it has ended, and nothing is written
    /// any more.
    [[nodiscard]] std::optional<std::vector<IndexPair>> pairs_left();
    /// The clashes of the pieces that are done.
    [[nodiscard]] std::vector<FoundClash> found();

    /// The pieces of work from now on, in place of those that were left.
    void plan(const std::vector<WorkUnit>& units);
    /// Piece `unit` of the plan is done. rows: of the store, of the parts of each clash.
    void commit(std::size_t unit, const std::vector<FoundClash>& clashes,
                const std::vector<std::pair<std::int64_t, std::int64_t>>& rows);
    /// Pieces that are committed while it is open are committed with it: the disk is waited for once.
    [[nodiscard]] Transaction together() { return Transaction(database_); }
    /// The job has ended: records of the same question about earlier parts go.
    void finish();

private:
    JobRecord(const std::string& store, const Question& question);

    /// Whether there is such a job; its state.
    bool find(const Question& question);
    void require_ours();

    Database database_;
    std::int64_t job_ = 0;
    std::int64_t run_ = 0; ///< counts how often the job was begun or gone on with
    bool planned_ = false, finished_ = false;
};

} // namespace abut
