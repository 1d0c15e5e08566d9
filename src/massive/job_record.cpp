#include "massive/job_record.h"

#include <abut/error.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace abut {

namespace {

/// docs/massive.md says what columns mean.
constexpr const char* kTables = R"(
CREATE TABLE IF NOT EXISTS job(
  job INTEGER PRIMARY KEY AUTOINCREMENT,
  key BLOB NOT NULL UNIQUE,
  question BLOB NOT NULL,
  clearance REAL NOT NULL,
  touch REAL NOT NULL,
  self INTEGER NOT NULL,
  rules INTEGER NOT NULL,
  candidates INTEGER NOT NULL,
  run INTEGER NOT NULL,
  planned INTEGER NOT NULL,
  finished INTEGER NOT NULL);
CREATE TABLE IF NOT EXISTS job_unit(
  job INTEGER NOT NULL REFERENCES job,
  unit INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  pairs BLOB NOT NULL,
  PRIMARY KEY(job, unit));
CREATE TABLE IF NOT EXISTS clash(
  clash INTEGER PRIMARY KEY,
  job INTEGER NOT NULL REFERENCES job,
  id TEXT NOT NULL,
  kind TEXT NOT NULL,
  part_a INTEGER NOT NULL REFERENCES part,
  part_b INTEGER NOT NULL REFERENCES part,
  distance REAL NOT NULL,
  ax REAL NOT NULL, ay REAL NOT NULL, az REAL NOT NULL,
  bx REAL NOT NULL, by REAL NOT NULL, bz REAL NOT NULL,
  triangle_pairs INTEGER NOT NULL,
  rule TEXT NOT NULL,
  exact BLOB NOT NULL,
  checksum INTEGER NOT NULL);
CREATE INDEX IF NOT EXISTS clash_by_job ON clash(job);
)";

std::span<const std::byte> bytes_of(const Hash128& hash) {
    return std::as_bytes(std::span(&hash, 1));
}

/// SQLite keeps no sign of zero, and no infinity is a NOT NULL.
struct ExactClash {
    std::uint64_t pair = 0, id = 0, kind = 0, triangle_pairs = 0;
    std::array<double, 10> numbers{}; ///< distance, point a, point b, direction
};

ExactClash pack(const FoundClash& found) {
    const Clash& c = found.clash;
    return {found.pair.key(),
            c.id,
            static_cast<std::uint64_t>(c.kind),
            c.triangle_pairs,
            {c.distance, c.point_a.x, c.point_a.y, c.point_a.z, c.point_b.x, c.point_b.y,
             c.point_b.z, c.direction.x, c.direction.y, c.direction.z}};
}

FoundClash unpack(const ExactClash& exact, std::string rule) {
    const auto& n = exact.numbers;
    FoundClash found;
    found.pair = {static_cast<std::uint32_t>(exact.pair >> 32),
                  static_cast<std::uint32_t>(exact.pair)};
    found.clash.id = exact.id;
    found.clash.kind = static_cast<ClashKind>(exact.kind);
    found.clash.triangle_pairs = exact.triangle_pairs;
    found.clash.distance = n[0];
    found.clash.point_a = {n[1], n[2], n[3]};
    found.clash.point_b = {n[4], n[5], n[6]};
    found.clash.direction = {n[7], n[8], n[9]};
    found.clash.rule = std::move(rule);
    return found;
}

std::uint64_t checksum(const ExactClash& exact, const std::string& rule) {
    Hasher hasher;
    hasher.add_value(exact);
    hasher.add(std::as_bytes(std::span(rule)));
    return hasher.value_64();
}

[[noreturn]] void damaged(const Database& database, const char* what) {
    throw Error(ErrorCode::malformed, database.path(),
                std::string("is damaged: ") + what + " of a job is not what its checksum says");
}

bool is_writable(const std::string& store) {
    const std::filesystem::path folder = std::filesystem::absolute(store).parent_path();
    return access(store.c_str(), W_OK) == 0 && access(folder.c_str(), W_OK) == 0;
}

} // namespace

Hash128 question_hash(const ClashOptions& options) {
    Hasher hasher;
    const auto add_text = [&](const std::string& text) {
        hasher.add_value(std::uint64_t{text.size()});
        hasher.add(std::as_bytes(std::span(text)));
    };
    const auto add_texts = [&](const std::vector<std::string>& texts) {
        hasher.add_value(std::uint64_t{texts.size()});
        for (const std::string& text : texts)
            add_text(text);
    };
    hasher.add_value(options.clearance);
    hasher.add_value(options.touch);
    hasher.add_value(options.self);
    for (const ClashRule& rule : options.rules) {
        add_text(rule.name);
        for (const PartSelector* side : {&rule.a, &rule.b}) {
            add_texts(side->file);
            add_texts(side->name);
            add_texts(side->type);
        }
        for (const std::optional<double>& length : {rule.clearance, rule.touch}) {
            hasher.add_value(length.has_value());
            hasher.add_value(length.value_or(0));
        }
        hasher.add_value(rule.ignore.same_file);
        hasher.add_value(rule.ignore.same_type);
        hasher.add_value(std::uint64_t{rule.ignore.same_name_prefix});
    }
    return hasher.value();
}

std::unique_ptr<JobRecord> JobRecord::open(const std::string& store, const Question& question) {
    if (!is_writable(store))
        return nullptr;
    return std::unique_ptr<JobRecord>(new JobRecord(store, question));
}

JobRecord::JobRecord(const std::string& store, const Question& question)
    : database_(store, OpenMode::read_write) {
    // Others may read the store between two pieces of work.
    database_.run("PRAGMA busy_timeout = 10000; PRAGMA synchronous = FULL");
    if (find(question) && finished_)
        return;
    Transaction transaction(database_);
    database_.run(kTables);
    if (!find(question)) {
        const Hash128 asked = question_hash(question.options);
        Statement add(database_, "INSERT INTO job VALUES (NULL,?,?,?,?,?,?,?,0,0,0)");
        add.bind(bytes_of(question.key), bytes_of(asked), question.options.clearance,
                 question.options.touch, question.options.self ? 1 : 0,
                 std::uint64_t{question.options.rules.size()}, question.candidates)
            .run();
        job_ = database_.last_row();
    }
    Statement(database_, "UPDATE job SET run = ? WHERE job = ?").bind(++run_, job_).run();
    transaction.commit();
}

bool JobRecord::find(const Question& question) {
    if (database_.number("SELECT count(*) FROM sqlite_schema WHERE name = 'job'") == 0)
        return false;
    Statement job(database_, "SELECT job, run, planned, finished FROM job WHERE key = ?");
    job.bind(bytes_of(question.key));
    if (!job.step())
        return false;
    job_ = job.integer(0);
    run_ = job.integer(1);
    planned_ = job.integer(2) != 0;
    finished_ = job.integer(3) != 0;
    return true;
}

void JobRecord::require_ours() {
    Statement run(database_, "SELECT run FROM job WHERE job = ?");
    if (!run.bind(job_).step() || run.integer(0) != run_)
        throw Error(ErrorCode::unreadable, database_.path(),
                    "is worked on by another process, which has taken over this job");
}

std::optional<std::vector<IndexPair>> JobRecord::pairs_left() {
    if (!planned_)
        return std::nullopt;
    std::vector<IndexPair> pairs;
    Statement units(database_, "SELECT pairs, checksum FROM job_unit WHERE job = ? ORDER BY unit");
    units.bind(job_);
    while (units.step()) {
        const std::span<const std::byte> bytes = units.bytes(0);
        if (bytes.size() % sizeof(std::uint64_t) != 0 ||
            hash_64(bytes) != static_cast<std::uint64_t>(units.integer(1)))
            damaged(database_, "a piece of work");
        for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
            std::uint64_t key = 0;
            std::memcpy(&key, bytes.data() + at, sizeof key);
            pairs.emplace_back(static_cast<std::uint32_t>(key >> 32),
                               static_cast<std::uint32_t>(key));
        }
    }
    return pairs;
}

std::vector<FoundClash> JobRecord::found() {
    std::vector<FoundClash> result;
    Statement rows(database_, "SELECT exact, rule, checksum FROM clash WHERE job = ?");
    rows.bind(job_);
    while (rows.step()) {
        ExactClash exact;
        const std::span<const std::byte> bytes = rows.bytes(0);
        if (bytes.size() != sizeof exact)
            damaged(database_, "a clash");
        std::memcpy(&exact, bytes.data(), sizeof exact);
        const std::string rule = rows.text(1);
        if (checksum(exact, rule) != static_cast<std::uint64_t>(rows.integer(2)) ||
            exact.kind >= kClashKinds.size())
            damaged(database_, "a clash");
        result.push_back(unpack(exact, rule));
    }
    return result;
}

void JobRecord::plan(const std::vector<WorkUnit>& units) {
    if (finished_)
        return;
    Transaction transaction(database_);
    require_ours();
    Statement(database_, "DELETE FROM job_unit WHERE job = ?").bind(job_).run();
    Statement add(database_, "INSERT INTO job_unit VALUES (?,?,?,?)");
    std::vector<std::uint64_t> keys;
    for (std::size_t u = 0; u < units.size(); ++u) {
        keys.clear();
        for (const IndexPair& pair : units[u].pairs)
            keys.push_back(pair.key());
        const auto bytes = std::as_bytes(std::span(keys));
        add.bind(job_, std::uint64_t{u}, hash_64(bytes), bytes).run();
    }
    Statement(database_, "UPDATE job SET planned = 1 WHERE job = ?").bind(job_).run();
    transaction.commit();
}

void JobRecord::commit(std::size_t unit, const std::vector<FoundClash>& clashes,
                       const std::vector<std::pair<std::int64_t, std::int64_t>>& rows) {
    Transaction transaction(database_);
    require_ours();
    Statement add(database_, "INSERT INTO clash VALUES (NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
    for (std::size_t i = 0; i < clashes.size(); ++i) {
        const Clash& c = clashes[i].clash;
        const ExactClash exact = pack(clashes[i]);
        const std::string id = fmt::format("{:016x}", c.id);
        add.bind(job_, id, std::string_view(to_string(c.kind)), rows[i].first, rows[i].second,
                 c.distance, c.point_a.x, c.point_a.y, c.point_a.z, c.point_b.x, c.point_b.y,
                 c.point_b.z, c.triangle_pairs, c.rule, std::as_bytes(std::span(&exact, 1)),
                 checksum(exact, c.rule))
            .run();
    }
    Statement(database_, "DELETE FROM job_unit WHERE job = ? AND unit = ?")
        .bind(job_, std::uint64_t{unit})
        .run();
    transaction.commit();
}

void JobRecord::finish() {
    if (finished_)
        return;
    Transaction transaction(database_);
    require_ours();
    Statement(database_, "UPDATE job SET finished = 1 WHERE job = ?").bind(job_).run();
    constexpr const char* kEarlier = "(SELECT job FROM job WHERE job <> ?1 AND question = (SELECT "
                                     "question FROM job WHERE job = ?1))";
    for (const char* const table : {"clash", "job_unit", "job"})
        Statement(database_, fmt::format("DELETE FROM {} WHERE job IN {}", table, kEarlier))
            .bind(job_)
            .run();
    transaction.commit();
}

} // namespace abut
