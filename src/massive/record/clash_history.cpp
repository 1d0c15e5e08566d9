#include "massive/record/clash_history.h"

#include "clash/report/clash_text.h"
#include "massive/record/job_tables.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <ctime>
#include <utility>

namespace abut {

namespace {

constexpr const char* kColumns =
    "id, kind, a, b, a_name, b_name, a_type, b_type, a_file, b_file, distance, appeared, returned, "
    "resolved, checksum";

std::string list_of(std::int64_t question) {
    return "clash_history " + std::to_string(question);
}

HistoryRow read_row(Database& database, const Statement& row, std::int64_t question) {
    HistoryRow result;
    result.question = question;
    ListedClash& clash = result.clash;
    const auto id = parse_clash_id(row.text(0));
    const auto kind = clash_kind_of(row.text(1));
    clash.id = id.value_or(0);
    clash.kind = kind.value_or(ClashKind::hard);
    clash.part = {row.text(2), row.text(3)};
    clash.name = {row.text(4), row.text(5)};
    clash.type = {row.text(6), row.text(7)};
    clash.file = {row.text(8), row.text(9)};
    clash.distance = row.real(10);
    result.appeared = row.integer(11);
    result.returned = row.integer(12);
    clash.resolved = row.integer(13);
    if (!id || !kind || result.checksum() != static_cast<std::uint64_t>(row.integer(14)))
        damaged_job(database,
                    "the history of clash " + row.text(0) + " does not match its checksum");
    return result;
}

/// Writes rows of one question. finish() writes their tally.
class HistoryWriter {
public:
    HistoryWriter(Database& database, std::int64_t question)
        : database_(database), list_(list_of(question)), tally_(read_tally(database, list_)),
          put_(database,
               "INSERT OR REPLACE INTO clash_history VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)") {}

    void replace(const HistoryRow& before, const HistoryRow& after) {
        tally_.remove(before.checksum());
        add(after);
    }
    void add(const HistoryRow& row) {
        const ListedClash& c = row.clash;
        const std::string id = clash_id_text(c.id);
        const std::uint64_t checksum = row.checksum();
        put_.bind(row.question, id, std::string_view(to_string(c.kind)), c.part[0], c.part[1],
                  c.name[0], c.name[1], c.type[0], c.type[1], c.file[0], c.file[1], c.distance,
                  row.appeared, row.returned, c.resolved, checksum)
            .run();
        tally_.add(checksum);
    }
    void finish() { write_tally(database_, list_, tally_); }

private:
    Database& database_;
    std::string list_;
    RowTally tally_;
    Statement put_;
};

/// Finds the clashes of a report by id. Several clashes may have one id.
class ById {
public:
    explicit ById(const ClashReport& report) {
        for (std::size_t i = 0; i < report.clashes.size(); ++i)
            places_.emplace_back(report.clashes[i].id, i);
        std::ranges::sort(places_);
    }
    /// Calls take(index) for each clash with this id; returns false if there is none.
    template <typename Take>
    bool for_each(std::uint64_t id, const Take& take) const {
        const auto first = std::ranges::lower_bound(places_, id, {}, &Place::first);
        auto at = first;
        for (; at != places_.end() && at->first == id; ++at)
            take(at->second);
        return at != first;
    }

private:
    using Place = std::pair<std::uint64_t, std::size_t>;
    std::vector<Place> places_;
};

HistoryRow row_of(const Clash& clash, const std::vector<Scene>& models) {
    HistoryRow row;
    row.clash.id = clash.id;
    row.clash.kind = clash.kind;
    for (std::size_t side = 0; side < 2; ++side) {
        const Part& part = part_of(clash, static_cast<int>(side), models);
        row.clash.part.at(side) = part.id;
        row.clash.name.at(side) = part.name;
        row.clash.type.at(side) = part.type;
        row.clash.file.at(side) = models[clash.model.at(side)].file;
    }
    row.clash.distance = told_distance(clash);
    return row;
}

} // namespace

std::uint64_t HistoryRow::checksum() const {
    RowHash hash;
    hash.add(question).add(clash.id).add(clash.kind);
    for (const auto* texts : {&clash.part, &clash.name, &clash.type, &clash.file})
        hash.add((*texts)[0]).add((*texts)[1]);
    return hash
        .add(clash.distance + 0.0) // SQLite keeps no sign of zero
        .add(appeared)
        .add(returned)
        .add(clash.resolved)
        .value();
}

ClashStatus HistoryRow::status(const MarkRow* mark, std::int64_t job) const {
    if (clash.resolved != 0)
        return ClashStatus::resolved;
    // A mark does not apply to a clash that was resolved after it and came back.
    if (mark != nullptr && mark->serial > returned)
        return mark->mark;
    return appeared == job ? ClashStatus::fresh : ClashStatus::active;
}

void for_each_in_history(Database& database, std::int64_t question,
                         const std::function<void(HistoryRow&&)>& take) {
    RowTally tally;
    Statement rows(database, std::string("SELECT ") + kColumns +
                                 " FROM clash_history WHERE question = ? ORDER BY id");
    rows.bind(question);
    while (rows.step()) {
        HistoryRow row = read_row(database, rows, question);
        tally.add(row.checksum());
        take(std::move(row));
    }
    require_tally(database, list_of(question), tally);
}

void record_history(Database& database, const JobRow& job, const ClashReport& report,
                    const std::vector<Scene>& models) {
    const ById by_id(report);
    std::vector<bool> is_known(report.clashes.size());
    std::vector<std::pair<HistoryRow, HistoryRow>> changed; ///< before, after
    for_each_in_history(database, job.question, [&](HistoryRow&& before) {
        HistoryRow after = before;
        std::size_t first = report.clashes.size();
        const bool is_there = by_id.for_each(before.clash.id, [&](std::size_t place) {
            is_known[place] = true;
            first = std::min(first, place);
        });
        if (is_there) {
            after.clash = row_of(report.clashes[first], models).clash;
            if (before.clash.resolved != 0) {
                after.appeared = job.job;
                after.returned = last_mark(database);
            }
        } else if (before.clash.resolved == 0) {
            after.clash.resolved = job.finished;
        }
        if (after.checksum() != before.checksum())
            changed.emplace_back(std::move(before), std::move(after));
    });
    HistoryWriter writer(database, job.question);
    for (const auto& [before, after] : changed)
        writer.replace(before, after);
    for (std::size_t i = 0; i < report.clashes.size(); ++i) {
        if (is_known[i])
            continue;
        by_id.for_each(report.clashes[i].id, [&](std::size_t place) { is_known[place] = true; });
        HistoryRow row = row_of(report.clashes[i], models);
        row.question = job.question;
        row.appeared = job.job;
        writer.add(row);
    }
    writer.finish();
}

std::vector<std::uint64_t> forget_resolved(Database& database, std::int64_t question) {
    std::vector<std::uint64_t> ids;
    RowTally tally = read_tally(database, list_of(question));
    for_each_in_history(database, question, [&](const HistoryRow& row) {
        if (row.clash.resolved == 0)
            return;
        ids.push_back(row.clash.id);
        tally.remove(row.checksum());
    });
    Statement(database, "DELETE FROM clash_history WHERE question = ? AND resolved > 0")
        .bind(question)
        .run();
    write_tally(database, list_of(question), tally);
    return ids;
}

void tell_statuses(Database& database, std::int64_t question, std::int64_t job,
                   ClashReport& report) {
    const Marks marks = has_job_tables(database) ? read_marks(database) : Marks();
    const auto mark_of = [&](std::uint64_t id) {
        const auto found = marks.find(id);
        return found == marks.end() ? nullptr : &found->second;
    };
    const auto set = [](auto& clash, ClashStatus status, const MarkRow* mark) {
        clash.status = status;
        if (mark != nullptr && status == mark->mark)
            clash.note = mark->note;
    };
    for (Clash& clash : report.clashes) {
        const MarkRow* mark = mark_of(clash.id);
        set(clash, mark != nullptr ? mark->mark : ClashStatus::fresh, mark);
    }
    if (question != 0) {
        const ById by_id(report);
        for_each_in_history(database, question, [&](HistoryRow&& row) {
            const MarkRow* mark = mark_of(row.clash.id);
            const bool is_there = by_id.for_each(row.clash.id, [&](std::size_t place) {
                Clash& clash = report.clashes[place];
                clash.note.clear();
                // A job that is not recorded may find a clash again that the history lists as
                // resolved.
                set(clash, row.clash.resolved != 0 ? ClashStatus::fresh : row.status(mark, job),
                    mark);
            });
            if (is_there)
                return;
            if (row.clash.resolved == 0)
                row.clash.resolved = now();
            row.clash.status = ClashStatus::resolved;
            report.resolved.push_back(std::move(row.clash));
        });
    }
    report.statuses.emplace();
    for (const Clash& clash : report.clashes)
        ++report.statuses->at(static_cast<std::size_t>(*clash.status));
    report.statuses->at(static_cast<std::size_t>(ClashStatus::resolved)) = report.resolved.size();
    std::ranges::stable_sort(report.resolved, std::ranges::greater{}, &ListedClash::resolved);
}

} // namespace abut
