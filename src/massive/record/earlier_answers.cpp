#include "massive/record/earlier_answers.h"

#include "clash/classify_pair.h"

#include <algorithm>
#include <span>

namespace abut {

std::vector<std::pair<std::int64_t, std::uint64_t>>
models_with_files(const std::vector<ModelRow>& models) {
    std::vector<std::pair<std::int64_t, std::uint64_t>> result;
    result.reserve(models.size());
    for (const ModelRow& model : models)
        result.emplace_back(model.model, hash_64(std::as_bytes(std::span(model.file))));
    return result;
}

std::uint64_t youngest_generation(const std::vector<ModelRow>& models) {
    std::uint64_t last = 0;
    for (const ModelRow& model : models)
        last = std::max(last, model.generation);
    return last;
}

EarlierAnswers::EarlierAnswers(Database& database, const JobRow& earlier, const StoredParts& stored)
    : database_(database), earlier_(earlier), stored_(stored), by_row_(stored),
      is_unchanged_(stored.parts.size()) {
    // Rules and clash ids depend on file names too, so an answer holds only if the name is the
    // same.
    std::vector<bool> same_file;
    for (const auto& model : models_with_files(stored.models))
        same_file.push_back(std::ranges::find(earlier.models, model) != earlier.models.end());
    for (std::size_t i = 0; i < stored.parts.size(); ++i) {
        const StoredPart& part = stored.parts[i];
        is_unchanged_[i] = same_file[part.model] && part.generation != kLastGeneration &&
                           part.generation <= earlier.generation;
    }
    for_each_pair_left(database, earlier.job, [&](const RowPair& rows) {
        const auto a = by_row_.find(rows.first), b = by_row_.find(rows.second);
        if (a && b)
            left_.emplace_back(*a, *b);
    });
    std::sort(left_.begin(), left_.end());
}

bool EarlierAnswers::knows(const IndexPair& pair) const {
    return is_unchanged_[pair.a()] && is_unchanged_[pair.b()] &&
           (earlier_.within || stored_.parts[pair.a()].model != stored_.parts[pair.b()].model) &&
           !std::binary_search(left_.begin(), left_.end(), pair);
}

std::vector<ClashRow> EarlierAnswers::clashes(const std::vector<IndexPair>& candidates) const {
    std::vector<ClashRow> result;
    for_each_clash(database_, earlier_.job, [&](ClashRow&& row) {
        const auto a = by_row_.find(row.parts.first), b = by_row_.find(row.parts.second);
        if (!a || !b)
            return;
        const IndexPair pair(*a, *b);
        if (!knows(pair) || !std::binary_search(candidates.begin(), candidates.end(), pair))
            return;
        if (*b < *a) { // the order of the file's parts has changed since
            std::swap(row.parts.first, row.parts.second);
            exchange_sides(row.clash);
        }
        result.push_back(std::move(row));
    });
    return result;
}

} // namespace abut
