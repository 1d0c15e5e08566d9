#pragma once

#include <abut/broad_phase.h>

#include "massive/job_rows.h"
#include "massive/stored_parts.h"
#include "massive/work_rows.h"
#include "store/sqlite.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace abut {

/// The models by their numbers, with the hashes of their files' names, as JobRow keeps them.
std::vector<std::pair<std::int64_t, std::uint64_t>>
models_with_files(const std::vector<ModelRow>& models);
/// Of the youngest part.
std::uint64_t youngest_generation(const std::vector<ModelRow>& models);

/// What an earlier job of the same question knows of the pairs of now: the answers of those whose
/// parts both are as they were then, as far as it came. A part that an import has brought or changed
/// since has a later generation; numbers of parts and generations are never used again.
class EarlierAnswers {
public:
    /// All three must outlive this.
    EarlierAnswers(Database& database, const JobRow& earlier, const StoredParts& stored);

    /// In          pair: a candidate of now.
    [[nodiscard]] bool knows(const IndexPair& pair) const;
    /// The clashes of the pairs that it knows, with a and b in the order of now.
    /// In          candidates: of now, sorted.
    [[nodiscard]] std::vector<ClashRow> clashes(const std::vector<IndexPair>& candidates) const;

private:
    Database& database_;
    const JobRow& earlier_;
    const StoredParts& stored_;
    PartsByRow by_row_;
    std::vector<bool> is_unchanged_; ///< by part
    std::vector<IndexPair> left_;    ///< that it did not come to, sorted
};

} // namespace abut
