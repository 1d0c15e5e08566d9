#include "massive/record/job_tables.h"

#include <abut/error.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <span>
#include <string_view>

namespace abut {

namespace {

/// The tables whose contents no job can find again. SQLite stores these texts verbatim; comparing
/// them tells whether this version made a table.
constexpr std::array kOfPeople{
    StoreTable{"question", R"(CREATE TABLE question(
  question INTEGER PRIMARY KEY AUTOINCREMENT,
  hash BLOB NOT NULL,
  clearance REAL NOT NULL,
  touch REAL NOT NULL,
  self INTEGER NOT NULL,
  rules INTEGER NOT NULL,
  checksum INTEGER NOT NULL))"},
    StoreTable{"clash_history", R"(CREATE TABLE clash_history(
  question INTEGER NOT NULL REFERENCES question,
  id TEXT NOT NULL,
  kind TEXT NOT NULL,
  a TEXT NOT NULL, b TEXT NOT NULL,
  a_name TEXT NOT NULL, b_name TEXT NOT NULL,
  a_type TEXT NOT NULL, b_type TEXT NOT NULL,
  a_file TEXT NOT NULL, b_file TEXT NOT NULL,
  distance REAL NOT NULL,
  appeared INTEGER NOT NULL,
  returned INTEGER NOT NULL,
  resolved INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(question, id)) WITHOUT ROWID)"},
    StoreTable{"clash_mark", R"(CREATE TABLE clash_mark(
  serial INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE,
  mark TEXT NOT NULL,
  note TEXT NOT NULL,
  marked INTEGER NOT NULL,
  checksum INTEGER NOT NULL))"},
    StoreTable{"job_counts", R"(CREATE TABLE job_counts(
  question INTEGER NOT NULL REFERENCES question,
  job INTEGER NOT NULL,
  finished INTEGER NOT NULL,
  hard INTEGER NOT NULL,
  touch INTEGER NOT NULL,
  contained INTEGER NOT NULL,
  duplicate INTEGER NOT NULL,
  clearance INTEGER NOT NULL,
  new INTEGER NOT NULL,
  active INTEGER NOT NULL,
  reviewed INTEGER NOT NULL,
  approved INTEGER NOT NULL,
  resolved INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(question, job)) WITHOUT ROWID)"},
    // The table of counts has no column for clashes of kind `undecided`: jobs that have some have a row.
    StoreTable{"job_undecided", R"(CREATE TABLE job_undecided(
  question INTEGER NOT NULL,
  job INTEGER NOT NULL,
  number INTEGER NOT NULL,
  PRIMARY KEY(question, job)) WITHOUT ROWID)"},
    StoreTable{"row_tally", R"(CREATE TABLE row_tally(
  list TEXT PRIMARY KEY,
  rows INTEGER NOT NULL,
  sum INTEGER NOT NULL) WITHOUT ROWID)"},
};
constexpr std::array kOfJobs{
    StoreTable{"job", R"(CREATE TABLE job(
  job INTEGER PRIMARY KEY AUTOINCREMENT,
  question INTEGER NOT NULL REFERENCES question,
  key BLOB NOT NULL,
  generation INTEGER NOT NULL,
  within INTEGER NOT NULL,
  models BLOB NOT NULL,
  candidates INTEGER NOT NULL,
  run INTEGER NOT NULL,
  planned INTEGER NOT NULL,
  finished INTEGER NOT NULL,
  answers INTEGER NOT NULL,
  checksum INTEGER NOT NULL))"},
    StoreTable{"job_unit", R"(CREATE TABLE job_unit(
  job INTEGER NOT NULL REFERENCES job,
  unit INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  pairs BLOB NOT NULL,
  PRIMARY KEY(job, unit)))"},
    StoreTable{"clash", R"(CREATE TABLE clash(
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
  severity TEXT NOT NULL,
  volume REAL NOT NULL,
  neighbours TEXT NOT NULL,
  left_out TEXT NOT NULL,
  exact BLOB NOT NULL,
  checksum INTEGER NOT NULL))"},
};

/// The view gives each clash its status. A clash is `new` if the last finished job found it first.
constexpr StoreTable kStatusView{"clash_status", R"(CREATE VIEW clash_status AS
SELECT h.question, h.id, kind, a, b, a_name, b_name, a_type, b_type, a_file, b_file, distance,
  CASE WHEN resolved > 0 THEN 'resolved'
    WHEN serial > returned THEN mark
    WHEN appeared = (SELECT max(job) FROM job WHERE job.question = h.question AND finished > 0)
    THEN 'new' ELSE 'active' END AS status, resolved, note
FROM clash_history AS h LEFT JOIN clash_mark AS m USING (id))"};

/// Returns whether the job table was made by an earlier version, which did not tell the version of a
/// job's answers.
bool is_of_earlier_version(Database& database) {
    return database.number("SELECT count(*) FROM pragma_table_info('job')") > 0 &&
           database.number(
               "SELECT count(*) FROM pragma_table_info('job') WHERE name = 'answers'") == 0;
}

bool are_there(Database& database, std::span<const StoreTable> tables) {
    return std::ranges::all_of(tables,
                               [&](const StoreTable& table) { return has_table(database, table); });
}

bool has_tables_of_jobs(Database& database) {
    return !is_of_earlier_version(database) && are_there(database, kOfJobs) &&
           has_table(database, kStatusView);
}

void make_anew(Database& database) {
    database.run("DROP VIEW IF EXISTS clash_status; DROP TABLE IF EXISTS job_unit; "
                 "DROP TABLE IF EXISTS clash; DROP TABLE IF EXISTS job");
    for (const StoreTable& table : kOfJobs)
        database.run(table.sql);
    database.run("CREATE INDEX clash_by_job ON clash(job)");
    database.run(kStatusView.sql);
    database.run("DELETE FROM row_tally WHERE list GLOB 'job*' OR list GLOB 'clash [0-9]*'");
    // The history refers to job numbers, which must not be used again.
    database.run("INSERT INTO sqlite_sequence(name, seq) "
                 "SELECT 'job', coalesce(max(appeared), 0) FROM clash_history");
}

} // namespace

bool has_table(Database& database, const StoreTable& table) {
    Statement find(database, "SELECT sql = ? FROM sqlite_schema WHERE name = ?");
    find.bind(std::string_view(table.sql), table.name);
    if (!find.step())
        return false;
    if (find.integer(0) == 0)
        damaged_job(database, "table " + std::string(table.name) +
                                  " is not as this version of Abut makes it");
    return true;
}

void prepare_job_tables(Database& database) {
    for (const StoreTable& table : kOfPeople)
        if (!has_table(database, table))
            database.run(table.sql);
    if (!has_tables_of_jobs(database))
        make_anew(database);
}

bool has_job_tables(Database& database) {
    return are_there(database, kOfPeople) && has_tables_of_jobs(database);
}

RowTally read_tally(Database& database, const std::string& list) {
    Statement find(database, "SELECT rows, sum FROM row_tally WHERE list = ?");
    if (!find.bind(list).step())
        return {};
    return {static_cast<std::uint64_t>(find.integer(0)),
            static_cast<std::uint64_t>(find.integer(1))};
}

void write_tally(Database& database, const std::string& list, const RowTally& tally) {
    if (tally.rows == 0)
        Statement(database, "DELETE FROM row_tally WHERE list = ?").bind(list).run();
    else
        Statement(database, "INSERT OR REPLACE INTO row_tally VALUES (?,?,?)")
            .bind(list, tally.rows, tally.sum)
            .run();
}

void require_tally(Database& database, const std::string& list, const RowTally& found) {
    if (found != read_tally(database, list))
        damaged_job(database, "rows of " + list + " are missing");
}

std::int64_t now() {
    return static_cast<std::int64_t>(std::time(nullptr));
}

void damaged_job(const Database& database, const std::string& what) {
    throw Error(ErrorCode::malformed, database.path(), "is damaged: " + what);
}

} // namespace abut
