#pragma once

#include <abut/broad_phase.h>

#include "massive/record/job_rows.h"
#include "massive/record/work_rows.h"
#include "massive/work/stored_parts.h"
#include "store/database/sqlite.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace abut {

/// Returns the number and the hash of the file name of each model, as JobRow stores them.
std::vector<std::pair<std::int64_t, std::uint64_t>>
models_with_files(const std::vector<ModelRow>& models);
/// Returns the generation of the most recently imported or changed part.
std::uint64_t youngest_generation(const std::vector<ModelRow>& models);

/// The answers of an earlier job of the same question that still hold. An answer holds if the
/// earlier job tested the pair and neither part has changed since. A part that an import has added
/// or changed since has a later generation. Part numbers and generations are never reused.
class EarlierAnswers {
public:
    /// All three arguments must outlive this object.
    EarlierAnswers(Database& database, const JobRow& earlier, const StoredParts& stored);

    /// Whether the earlier job's answer to a pair still holds.
    /// In          pair: a candidate pair of the current job.
    [[nodiscard]] bool knows(const IndexPair& pair) const;
    /// Returns the clashes of the pairs for which knows() is true, with a and b in the current
    /// order of parts.
    /// In          candidates: all candidate pairs of the current job, sorted.
    [[nodiscard]] std::vector<ClashRow> clashes(const std::vector<IndexPair>& candidates) const;

private:
    Database& database_;
    const JobRow& earlier_;
    const StoredParts& stored_;
    PartsByRow by_row_;
    std::vector<bool> is_unchanged_; ///< by part: not changed since the earlier job
    std::vector<IndexPair> left_;    ///< pairs that the earlier job did not test, sorted
};

} // namespace abut
