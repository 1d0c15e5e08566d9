#include "massive/record/job_record.h"

#include <abut/error.h>

#include "clash/classify_pair.h"
#include "massive/record/clash_history.h"
#include "massive/record/earlier_answers.h"
#include "massive/record/job_counts.h"
#include "massive/record/job_tables.h"
#include "massive/record/question_terms.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <limits>
#include <unistd.h>

namespace abut {

namespace {

/// Returns a key that is equal for jobs of the same question about the same parts, if their answers are
/// of this version.
Hash128 job_key(const Hash128& parts, std::int64_t question) {
    return RowHash().add(parts).add(question).add(kAnswersVersion).value_128();
}

} // namespace

bool is_writable_store(const std::string& store) {
    const std::filesystem::path folder = std::filesystem::absolute(store).parent_path();
    return access(store.c_str(), W_OK) == 0 && access(folder.c_str(), W_OK) == 0;
}

std::unique_ptr<JobRecord> JobRecord::open(const std::string& store, const StoredParts& stored,
                                           const ClashOptions& options, std::uint64_t candidates) {
    if (!is_writable_store(store))
        return nullptr;
    return std::unique_ptr<JobRecord>(new JobRecord(store, stored, options, candidates));
}

JobRecord::JobRecord(const std::string& store, const StoredParts& stored,
                     const ClashOptions& options, std::uint64_t candidates)
    : database_(store, OpenMode::read_write), parts_(parts_key(stored.models)) {
    // Other processes may read the store between two commits.
    database_.run("PRAGMA busy_timeout = 10000; PRAGMA synchronous = FULL");
    const auto find = [&] {
        const auto question = find_question(database_, options);
        const auto job = question ? find_job(database_, job_key(parts_, *question)) : std::nullopt;
        job_ = job.value_or(JobRow{});
        job_.question = question.value_or(0);
    };
    if (has_job_tables(database_)) {
        find();
        if (job_.finished != 0)
            return;
    }
    Transaction transaction(database_);
    prepare_job_tables(database_);
    find(); // again: another process may have created the job meanwhile
    if (job_.question == 0)
        job_.question = add_question(database_, options);
    keep_terms(database_, job_.question, options);
    if (job_.job == 0) {
        job_.key = job_key(parts_, job_.question);
        job_.answers = kAnswersVersion;
        job_.generation = youngest_generation(stored.models);
        job_.within = stored.models.size() <= 1 || options.self;
        job_.models = models_with_files(stored.models);
        job_.candidates = candidates;
    }
    ++job_.run;
    put_job(database_, job_);
    transaction.commit();
}

/// Throws if another process has taken over this job or an import has changed the parts. The caller
/// holds a transaction.
void JobRecord::require_ours() {
    const auto there = find_job(database_, job_.key);
    if (!there || there->run != job_.run)
        throw Error(ErrorCode::unreadable, database_.path(),
                    "is worked on by another process, which has taken over this job");
    std::vector<ModelRow> models;
    Statement rows(database_,
                   std::string("SELECT ") + kModelColumns + " FROM model ORDER BY model");
    while (rows.step())
        models.push_back(read_model_row(rows, database_.path()));
    require_parts(models, parts_, database_.path());
}

std::vector<IndexPair> JobRecord::pairs_left(const StoredParts& stored,
                                             std::vector<IndexPair> candidates) {
    if (job_.planned) {
        const PartsByRow by_row(stored);
        std::vector<IndexPair> left;
        for_each_pair_left(database_, job_.job, [&](const RowPair& rows) {
            const auto a = by_row.find(rows.first), b = by_row.find(rows.second);
            if (!a || !b)
                damaged_job(database_, "a job has parts that are not there");
            left.emplace_back(*a, *b);
        });
        return left;
    }
    if (const auto earlier = find_earlier_job(database_, job_)) {
        const EarlierAnswers answers(database_, *earlier, stored);
        taken_over_ = answers.clashes(candidates);
        std::erase_if(candidates, [&](const IndexPair& pair) { return answers.knows(pair); });
    }
    return candidates;
}

void JobRecord::plan(const StoredParts& stored, const std::vector<WorkUnit>& units) {
    if (job_.finished != 0)
        return;
    Transaction transaction(database_);
    require_ours();
    remove_units(database_, job_.job);
    std::vector<std::vector<RowPair>> pairs;
    for (const WorkUnit& unit : units) {
        pairs.emplace_back();
        for (const IndexPair& pair : unit.pairs)
            pairs.back().emplace_back(stored.parts[pair.a()].row, stored.parts[pair.b()].row);
    }
    add_units(database_, job_.job, pairs);
    add_clashes(database_, job_.job, taken_over_);
    taken_over_.clear();
    JobRow planned = job_;
    planned.planned = true;
    put_job(database_, planned);
    // Answers of unfinished jobs were taken over above. Finished jobs stay until this one finishes.
    remove_other_jobs(database_, job_, false);
    transaction.commit();
    job_ = planned;
}

std::vector<FoundClash> JobRecord::found(const StoredParts& stored) {
    const PartsByRow by_row(stored);
    std::vector<FoundClash> result;
    for_each_clash(database_, job_.job, [&](ClashRow&& row) {
        const auto a = by_row.find(row.parts.first), b = by_row.find(row.parts.second);
        if (!a || !b)
            damaged_job(database_, "a clash of a job names parts that are not there");
        row.clash.part = {*a, *b};
        result.push_back({std::move(row.clash), row.left_out});
    });
    return result;
}

void JobRecord::commit(const StoredParts& stored, std::size_t unit,
                       std::span<const FoundClash> clashes,
                       const std::vector<HierarchyRow>& hierarchies) {
    std::vector<ClashRow> rows;
    rows.reserve(clashes.size());
    for (const auto& [clash, left_out] : clashes)
        rows.push_back(
            {{stored.parts[clash.part[0]].row, stored.parts[clash.part[1]].row}, clash, left_out});
    Transaction transaction(database_);
    require_ours();
    add_clashes(database_, job_.job, rows);
    remove_unit(database_, job_.job, unit);
    keep_hierarchies(database_, hierarchies);
    transaction.commit();
}

void JobRecord::finish(ClashReport& report, const std::vector<Scene>& models) {
    if (job_.finished != 0)
        return tell_statuses(database_, job_.question, job_.job, report);
    Transaction transaction(database_);
    require_ours();
    JobRow finished = job_;
    finished.finished = now();
    record_history(database_, finished, report, models);
    put_job(database_, finished);
    remove_other_jobs(database_, finished, true);
    tell_statuses(database_, finished.question, finished.job, report);
    record_counts(database_, finished, report);
    transaction.commit();
    job_ = finished;
}

RecordedJob tell_statuses(Database& database, const StoredParts& stored,
                          const ClashOptions& options, ClashReport& report) {
    // A job that the history does not have gets a number larger than any other.
    constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
    std::int64_t question = 0, job = kNone;
    if (has_job_tables(database))
        question = find_question(database, options).value_or(0);
    if (question != 0)
        if (const auto known = find_job(database, job_key(parts_key(stored.models), question));
            known && known->finished != 0)
            job = known->job;
    tell_statuses(database, question, job, report);
    return {question, job == kNone ? 0 : job};
}

} // namespace abut
