#include "massive/record/clash_marks.h"

#include "massive/record/job_tables.h"
#include "store/database/row_hash.h"

namespace abut {

namespace {

constexpr const char* kList = "clash_mark";

} // namespace

std::uint64_t MarkRow::checksum() const {
    return RowHash().add(serial).add(id).add(mark).add(note).add(marked).value();
}

std::int64_t last_mark(Database& database) {
    return database.number("SELECT seq FROM sqlite_sequence WHERE name = 'clash_mark'");
}

Marks read_marks(Database& database) {
    Marks marks;
    RowTally tally;
    Statement rows(database, "SELECT serial, id, mark, note, marked, checksum FROM clash_mark");
    while (rows.step()) {
        const auto id = parse_clash_id(rows.text(1));
        const std::string mark = rows.text(2);
        MarkRow row{rows.integer(0), id.value_or(0),
                    mark == to_string(ClashStatus::approved) ? ClashStatus::approved
                                                             : ClashStatus::reviewed,
                    rows.text(3), rows.integer(4)};
        if (!id || mark != to_string(row.mark) ||
            row.checksum() != static_cast<std::uint64_t>(rows.integer(5)))
            damaged_job(database,
                        "the mark of clash " + rows.text(1) + " does not match its checksum");
        tally.add(row.checksum());
        marks.emplace(*id, std::move(row));
    }
    require_tally(database, kList, tally);
    return marks;
}

void put_mark(Database& database, Marks& marks, MarkRow row) {
    row.serial = last_mark(database) + 1;
    remove_mark(database, marks, row.id);
    RowTally tally = read_tally(database, kList);
    const std::string id = clash_id_text(row.id);
    Statement(database, "INSERT INTO clash_mark VALUES (?,?,?,?,?,?)")
        .bind(row.serial, id, std::string_view(to_string(row.mark)), row.note, row.marked,
              row.checksum())
        .run();
    tally.add(row.checksum());
    write_tally(database, kList, tally);
    marks.emplace(row.id, std::move(row));
}

void remove_mark(Database& database, Marks& marks, std::uint64_t id) {
    const auto found = marks.find(id);
    if (found == marks.end())
        return;
    RowTally tally = read_tally(database, kList);
    tally.remove(found->second.checksum());
    write_tally(database, kList, tally);
    Statement(database, "DELETE FROM clash_mark WHERE id = ?").bind(clash_id_text(id)).run();
    marks.erase(found);
}

} // namespace abut
