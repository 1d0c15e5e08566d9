#include "massive/record/work_rows.h"

#include "clash/report/clash_text.h"
#include "massive/record/job_tables.h"
#include "store/database/row_hash.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

namespace abut {

namespace {

/// Distance, point a, point b, direction, volume and its error. They are also stored as bytes,
/// because SQLite does not keep the sign of zero.
using ExactNumbers = std::array<double, 12>;

ExactNumbers pack(const Clash& c) {
    return {c.distance,  c.point_a.x,   c.point_a.y,   c.point_a.z,   c.point_b.x, c.point_b.y,
            c.point_b.z, c.direction.x, c.direction.y, c.direction.z, c.volume,    c.volume_error};
}

void unpack(const ExactNumbers& n, Clash& c) {
    c.distance = n[0];
    c.point_a = {n[1], n[2], n[3]};
    c.point_b = {n[4], n[5], n[6]};
    c.direction = {n[7], n[8], n[9]};
    c.volume = n[10], c.volume_error = n[11];
}

/// Returns the name of a value as a row has it; empty without a value.
template <typename Value>
std::string_view name_of(const std::optional<Value>& value) {
    return value ? to_string(*value) : "";
}

/// Reads a value by its name. Returns false if the name is of none.
template <typename Value, std::size_t count>
bool read_name(const std::string& name, const std::array<Value, count>& values,
               std::optional<Value>& result) {
    const auto at = std::ranges::find_if(values, [&](Value v) { return name == to_string(v); });
    if (at != values.end())
        result = *at;
    return result.has_value() || name.empty();
}

std::uint64_t checksum(std::int64_t job, const ClashRow& row) {
    return RowHash()
        .add(job)
        .add(row.clash.id)
        .add(row.clash.kind)
        .add(row.parts)
        .add(row.clash.triangle_pairs)
        .add(row.clash.rule)
        .add(row.clash.severity)
        .add(name_of(row.clash.neighbours))
        .add(name_of(row.left_out))
        .add(pack(row.clash))
        .value();
}

std::string clash_list(std::int64_t job) {
    return "clash " + std::to_string(job);
}

std::uint64_t unit_checksum(std::int64_t job, std::uint64_t unit,
                            std::span<const std::byte> pairs) {
    return RowHash().add(job).add(unit).add_bytes(pairs).value();
}

std::string unit_list(std::int64_t job) {
    return "job_unit " + std::to_string(job);
}

} // namespace

void add_clashes(Database& database, std::int64_t job, const std::vector<ClashRow>& clashes) {
    RowTally tally = read_tally(database, clash_list(job));
    Statement add(database,
                  "INSERT INTO clash VALUES (NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
    for (const ClashRow& row : clashes) {
        const Clash& c = row.clash;
        const ExactNumbers exact = pack(c);
        const std::string id = clash_id_text(c.id);
        const std::uint64_t sum = checksum(job, row);
        add.bind(job, id, std::string_view(to_string(c.kind)), row.parts.first, row.parts.second,
                 c.distance, c.point_a.x, c.point_a.y, c.point_a.z, c.point_b.x, c.point_b.y,
                 c.point_b.z, c.triangle_pairs, c.rule, c.severity, c.volume, name_of(c.neighbours),
                 name_of(row.left_out), std::as_bytes(std::span(exact)), sum)
            .run();
        tally.add(sum);
    }
    write_tally(database, clash_list(job), tally);
}

void for_each_clash(Database& database, std::int64_t job,
                    const std::function<void(ClashRow&&)>& take) {
    RowTally tally;
    Statement rows(database, "SELECT id, kind, part_a, part_b, triangle_pairs, rule, exact, "
                             "checksum, severity, neighbours, left_out FROM clash WHERE job = ?");
    rows.bind(job);
    while (rows.step()) {
        ClashRow row;
        const auto id = parse_clash_id(rows.text(0));
        const auto kind = clash_kind_of(rows.text(1));
        const auto exact = blob_elements<ExactNumbers>(rows.bytes(6));
        const bool named = read_name(rows.text(9), kNeighbours, row.clash.neighbours) &&
                           read_name(rows.text(10), kLeftOut, row.left_out);
        if (!id || !kind || exact.size() != 1 || !named)
            damaged_job(database, "a clash of a job is none");
        row.clash.id = *id;
        row.clash.kind = *kind;
        row.parts = {rows.integer(2), rows.integer(3)};
        row.clash.triangle_pairs = static_cast<std::uint64_t>(rows.integer(4));
        row.clash.rule = rows.text(5);
        row.clash.severity = rows.text(8);
        unpack(exact.front(), row.clash);
        const std::uint64_t sum = checksum(job, row);
        if (sum != static_cast<std::uint64_t>(rows.integer(7)))
            damaged_job(database, "a clash of a job does not match its checksum");
        tally.add(sum);
        take(std::move(row));
    }
    require_tally(database, clash_list(job), tally);
}

void add_units(Database& database, std::int64_t job,
               const std::vector<std::vector<RowPair>>& units) {
    RowTally tally = read_tally(database, unit_list(job));
    Statement add(database, "INSERT INTO job_unit VALUES (?,?,?,?)");
    for (std::size_t u = 0; u < units.size(); ++u) {
        const auto bytes = std::as_bytes(std::span<const RowPair>(units[u]));
        const std::uint64_t sum = unit_checksum(job, u, bytes);
        add.bind(job, std::uint64_t{u}, sum, bytes).run();
        tally.add(sum);
    }
    write_tally(database, unit_list(job), tally);
}

void remove_unit(Database& database, std::int64_t job, std::uint64_t unit) {
    RowTally tally = read_tally(database, unit_list(job));
    Statement remove(database,
                     "DELETE FROM job_unit WHERE job = ? AND unit = ? RETURNING checksum");
    remove.bind(job, unit);
    while (remove.step())
        tally.remove(static_cast<std::uint64_t>(remove.integer(0)));
    write_tally(database, unit_list(job), tally);
}

void remove_units(Database& database, std::int64_t job) {
    Statement(database, "DELETE FROM job_unit WHERE job = ?").bind(job).run();
    write_tally(database, unit_list(job), {});
}

void remove_work(Database& database, std::int64_t job) {
    remove_units(database, job);
    Statement(database, "DELETE FROM clash WHERE job = ?").bind(job).run();
    write_tally(database, clash_list(job), {});
}

void for_each_pair_left(Database& database, std::int64_t job,
                        const std::function<void(const RowPair&)>& take) {
    RowTally tally;
    Statement units(database,
                    "SELECT unit, checksum, pairs FROM job_unit WHERE job = ? ORDER BY unit");
    units.bind(job);
    while (units.step()) {
        const std::span<const std::byte> bytes = units.bytes(2);
        const std::uint64_t sum =
            unit_checksum(job, static_cast<std::uint64_t>(units.integer(0)), bytes);
        const auto pairs = blob_elements<std::array<std::int64_t, 2>>(bytes);
        if (sum != static_cast<std::uint64_t>(units.integer(1)) || pairs.empty())
            damaged_job(database, "a work unit of a job does not match its checksum");
        tally.add(sum);
        for (const auto& [a, b] : pairs)
            take({a, b});
    }
    require_tally(database, unit_list(job), tally);
}

} // namespace abut
