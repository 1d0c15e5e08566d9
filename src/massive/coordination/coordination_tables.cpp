#include "massive/coordination/coordination_tables.h"

#include "massive/record/job_tables.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

constexpr std::array kCoordinationTables{
    StoreTable{"clash_group", R"(CREATE TABLE clash_group(
  question INTEGER NOT NULL REFERENCES question,
  grouping TEXT NOT NULL,
  id TEXT NOT NULL,
  parent TEXT NOT NULL,
  path TEXT NOT NULL,
  name TEXT NOT NULL,
  what TEXT NOT NULL,
  kind TEXT NOT NULL,
  key TEXT NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  size INTEGER NOT NULL,
  appeared INTEGER NOT NULL,
  reopened INTEGER NOT NULL,
  moved INTEGER NOT NULL,
  resolved INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(question, grouping, id)) WITHOUT ROWID)"},
    StoreTable{"clash_group_member", R"(CREATE TABLE clash_group_member(
  question INTEGER NOT NULL REFERENCES question,
  grouping TEXT NOT NULL,
  clash TEXT NOT NULL,
  id TEXT NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  gone INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(question, grouping, clash)) WITHOUT ROWID)"},
    StoreTable{"clash_grouping", R"(CREATE TABLE clash_grouping(
  question INTEGER NOT NULL REFERENCES question,
  grouping TEXT NOT NULL,
  job INTEGER NOT NULL,
  finished INTEGER NOT NULL,
  new INTEGER NOT NULL,
  active INTEGER NOT NULL,
  moved INTEGER NOT NULL,
  reopened INTEGER NOT NULL,
  resolved INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(question, grouping, job)) WITHOUT ROWID)"},
    StoreTable{"topic", R"(CREATE TABLE topic(
  guid TEXT PRIMARY KEY,
  title TEXT NOT NULL,
  description TEXT NOT NULL,
  status TEXT NOT NULL,
  type TEXT NOT NULL,
  priority TEXT NOT NULL,
  stage TEXT NOT NULL,
  assignee TEXT NOT NULL,
  due TEXT NOT NULL,
  labels TEXT NOT NULL,
  reference_links TEXT NOT NULL,
  clash_group TEXT NOT NULL,
  clashes TEXT NOT NULL,
  created INTEGER NOT NULL,
  created_by TEXT NOT NULL,
  modified INTEGER NOT NULL,
  modified_by TEXT NOT NULL,
  revision INTEGER NOT NULL,
  checksum INTEGER NOT NULL) WITHOUT ROWID)"},
    StoreTable{"topic_comment", R"(CREATE TABLE topic_comment(
  topic TEXT NOT NULL REFERENCES topic,
  guid TEXT NOT NULL,
  author TEXT NOT NULL,
  text TEXT NOT NULL,
  time INTEGER NOT NULL,
  viewpoint TEXT NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(topic, guid)) WITHOUT ROWID)"},
    StoreTable{"topic_revision", R"(CREATE TABLE topic_revision(
  revision INTEGER NOT NULL,
  guid TEXT NOT NULL,
  document TEXT NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY(guid, revision)) WITHOUT ROWID)"},
};

} // namespace

void prepare_coordination_tables(Database& database) {
    prepare_job_tables(database);
    for (const StoreTable& table : kCoordinationTables)
        if (!has_table(database, table))
            database.run(table.sql);
}

bool has_coordination_tables(Database& database) {
    return has_job_tables(database) &&
           std::ranges::all_of(kCoordinationTables,
                               [&](const StoreTable& table) { return has_table(database, table); });
}

} // namespace abut
