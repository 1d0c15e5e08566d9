#include "massive/record/job_rows.h"

#include "massive/record/job_tables.h"
#include "massive/record/work_rows.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <array>
#include <span>

namespace abut {

namespace {

std::span<const std::byte> bytes_of(const Hash128& hash) {
    return std::as_bytes(std::span(&hash, 1));
}

constexpr const char* kJobList = "job";

JobRow read_job(Database& database, const Statement& row) {
    JobRow job;
    job.job = row.integer(0);
    job.question = row.integer(1);
    const auto key = blob_elements<std::uint64_t>(row.bytes(2));
    if (key.size() == 2)
        job.key = {key[0], key[1]};
    job.generation = static_cast<std::uint64_t>(row.integer(3));
    job.within = row.integer(4) != 0;
    for (const auto& [model, file] : blob_elements<std::array<std::uint64_t, 2>>(row.bytes(5)))
        job.models.emplace_back(static_cast<std::int64_t>(model), file);
    job.candidates = static_cast<std::uint64_t>(row.integer(6));
    job.run = row.integer(7);
    job.planned = row.integer(8) != 0;
    job.finished = row.integer(9);
    job.answers = row.integer(10);
    if (job.checksum() != static_cast<std::uint64_t>(row.integer(11)))
        damaged_job(database, "job " + std::to_string(job.job) + " does not match its checksum");
    return job;
}

/// Returns the last job for which wanted(job) is true.
template <typename Wanted>
std::optional<JobRow> find_last(Database& database, const Wanted& wanted) {
    std::optional<JobRow> found;
    for (JobRow& job : read_jobs(database))
        if (wanted(job))
            found = std::move(job);
    return found;
}

} // namespace

Hash128 question_hash(const ClashOptions& options) {
    RowHash hash;
    const auto add_texts = [&](const std::vector<std::string>& texts) {
        hash.add(std::uint64_t{texts.size()});
        for (const std::string& text : texts)
            hash.add(text);
    };
    // No length is negative, so the hash tells "as the files" from every tolerance.
    hash.add(options.clearance)
        .add(options.touch_tolerance.value_or(QuestionRow::kTouchOfFiles))
        .add(options.self);
    const auto add_list = [&](const auto& list) {
        hash.add(std::uint64_t{list.size()});
        for (const auto element : list)
            hash.add(static_cast<std::uint64_t>(element));
    };
    const auto add_rule = [&](const ClashRule& rule) {
        hash.add(rule.name);
        for (const PartSelector* side : {&rule.a, &rule.b}) {
            add_texts(side->file);
            add_texts(side->name);
            add_texts(side->type);
            hash.add(side->query.text());
        }
        for (const std::optional<double>& length :
             {rule.clearance, rule.touch_tolerance, rule.tolerated_depth})
            hash.add(length.has_value()).add(length.value_or(0));
        hash.add(rule.ignore.same_file)
            .add(rule.ignore.same_type)
            .add(std::uint64_t{rule.ignore.same_name_prefix});
        add_list(rule.ignore.neighbours);
        add_list(rule.kinds);
        hash.add(rule.severity);
    };
    hash.add(std::uint64_t{options.rules.size()});
    std::ranges::for_each(options.rules, add_rule);
    hash.add(options.only.text()).add(options.a.text()).add(options.b.text());
    add_list(options.leave_out);
    hash.add(std::uint64_t{options.matrix.groups.size()});
    for (const ClashMatrix::Group& group : options.matrix.groups)
        hash.add(group.name).add(group.select.text());
    for (const ClashMatrix::Cell& cell : options.matrix.cells) {
        hash.add(std::uint64_t{cell.a}).add(std::uint64_t{cell.b}).add(cell.examined);
        add_rule(cell.terms);
    }
    return hash.value_128();
}

std::optional<std::int64_t> find_question(Database& database, const ClashOptions& options) {
    const Hash128 hash = question_hash(options);
    for (const QuestionRow& row : read_questions(database))
        if (row.hash == hash)
            return row.question;
    return std::nullopt;
}

std::int64_t add_question(Database& database, const ClashOptions& options) {
    const Hash128 hash = question_hash(options);
    const std::int64_t question =
        database.number("SELECT seq FROM sqlite_sequence WHERE name = 'question'") + 1;
    QuestionRow row{question,          hash,
                    options.clearance, options.touch_tolerance.value_or(QuestionRow::kTouchOfFiles),
                    options.self,      options.rules.size()};
    Statement(database, "INSERT INTO question VALUES (?,?,?,?,?,?,?)")
        .bind(row.question, bytes_of(row.hash), row.clearance, row.stored_touch, row.self ? 1 : 0,
              row.rules, row.checksum())
        .run();
    return question;
}

std::uint64_t QuestionRow::checksum() const {
    return RowHash()
        .add(question)
        .add(hash)
        .add(clearance + 0.0)
        .add(stored_touch + 0.0)
        .add(self)
        .add(rules)
        .value();
}

std::vector<QuestionRow> read_questions(Database& database) {
    std::vector<QuestionRow> result;
    Statement rows(database, "SELECT question, hash, clearance, touch, self, rules, checksum "
                             "FROM question ORDER BY question");
    while (rows.step()) {
        QuestionRow row;
        row.question = rows.integer(0);
        const auto hash = blob_elements<std::uint64_t>(rows.bytes(1));
        if (hash.size() == 2)
            row.hash = {hash[0], hash[1]};
        row.clearance = rows.real(2);
        row.stored_touch = rows.real(3);
        row.self = rows.integer(4) != 0;
        row.rules = static_cast<std::uint64_t>(rows.integer(5));
        if (row.checksum() != static_cast<std::uint64_t>(rows.integer(6)))
            damaged_job(database, "question " + std::to_string(row.question) +
                                      " does not match its checksum");
        result.push_back(row);
        // Questions are never removed, so their numbers have no gaps.
        if (row.question != static_cast<std::int64_t>(result.size()))
            damaged_job(database, "a question is missing");
    }
    return result;
}

std::uint64_t JobRow::checksum() const {
    RowHash hash;
    hash.add(job).add(question).add(key).add(generation).add(within);
    for (const auto& [model, file] : models)
        hash.add(model).add(file);
    return hash.add(candidates).add(run).add(planned).add(finished).add(answers).value();
}

std::vector<JobRow> read_jobs(Database& database) {
    std::vector<JobRow> jobs;
    RowTally tally;
    Statement rows(database, "SELECT job, question, key, generation, within, models, candidates, "
                             "run, planned, finished, answers, checksum FROM job ORDER BY job");
    while (rows.step()) {
        jobs.push_back(read_job(database, rows));
        tally.add(jobs.back().checksum());
    }
    require_tally(database, kJobList, tally);
    return jobs;
}

std::optional<JobRow> find_job(Database& database, const Hash128& key) {
    return find_last(database, [&](const JobRow& job) { return job.key == key; });
}

std::optional<JobRow> find_finished_job(Database& database, std::int64_t question) {
    return find_last(
        database, [&](const JobRow& job) { return job.question == question && job.finished != 0; });
}

std::optional<JobRow> find_earlier_job(Database& database, const JobRow& job) {
    return find_last(database, [&](const JobRow& other) {
        return other.question == job.question && other.answers == job.answers &&
               other.job != job.job && other.planned;
    });
}

void put_job(Database& database, JobRow& job) {
    if (job.job == 0)
        job.job = database.number("SELECT seq FROM sqlite_sequence WHERE name = 'job'") + 1;
    else
        remove_job(database, job.job);
    std::vector<std::array<std::uint64_t, 2>> models;
    for (const auto& [model, file] : job.models)
        models.push_back({static_cast<std::uint64_t>(model), file});
    Statement(database, "INSERT INTO job VALUES (?,?,?,?,?,?,?,?,?,?,?,?)")
        .bind(job.job, job.question, bytes_of(job.key), job.generation, job.within ? 1 : 0,
              std::as_bytes(std::span<const std::array<std::uint64_t, 2>>(models)), job.candidates,
              job.run, job.planned ? 1 : 0, job.finished, job.answers, job.checksum())
        .run();
    RowTally tally = read_tally(database, kJobList);
    tally.add(job.checksum());
    write_tally(database, kJobList, tally);
}

void remove_job(Database& database, std::int64_t job) {
    RowTally tally = read_tally(database, kJobList);
    for (const JobRow& row : read_jobs(database))
        if (row.job == job)
            tally.remove(row.checksum());
    Statement(database, "DELETE FROM job WHERE job = ?").bind(job).run();
    write_tally(database, kJobList, tally);
}

void remove_other_jobs(Database& database, const JobRow& job, bool finished_too) {
    for (const JobRow& other : read_jobs(database)) {
        if (other.question != job.question || other.job == job.job ||
            (other.finished != 0 && !finished_too))
            continue;
        remove_work(database, other.job);
        remove_job(database, other.job);
    }
}

} // namespace abut
