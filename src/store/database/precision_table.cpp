#include "store/database/precision_table.h"

#include <abut/error.h>

#include "store/database/optional_table.h"
#include "store/database/row_hash.h"

#include <string>

namespace abut {

namespace {

constexpr OptionalTable kPrecisionTable{"model_precision", R"(CREATE TABLE model_precision(
  model INTEGER PRIMARY KEY,
  stated REAL NOT NULL,
  single_meshes INTEGER NOT NULL,
  single_transforms INTEGER NOT NULL,
  checksum INTEGER NOT NULL))"};

std::uint64_t checksum_of(std::int64_t model, const ModelPrecision& precision) {
    return RowHash()
        .add(model)
        .add(precision.stated + 0.0)
        .add(precision.single_meshes)
        .add(precision.single_transforms)
        .value();
}

} // namespace

ModelPrecision read_precision(Database& database, std::int64_t model) {
    if (!kPrecisionTable.exists(database))
        return {};
    Statement find(database, "SELECT stated, single_meshes, single_transforms, checksum "
                             "FROM model_precision WHERE model = ?");
    find.bind(model);
    if (!find.step())
        return {};
    const ModelPrecision precision{find.real(0), find.integer(1) != 0, find.integer(2) != 0};
    if (checksum_of(model, precision) != static_cast<std::uint64_t>(find.integer(3)))
        throw Error(ErrorCode::malformed, database.path(),
                    "is damaged: the precision of model " + std::to_string(model) +
                        " does not match its checksum");
    return precision;
}

void write_precision(Database& database, std::int64_t model, const ModelPrecision& precision) {
    if (!kPrecisionTable.create(database))
        return;
    Statement(database, "INSERT OR REPLACE INTO model_precision VALUES (?,?,?,?,?)")
        .bind(model, precision.stated, precision.single_meshes ? 1 : 0,
              precision.single_transforms ? 1 : 0, checksum_of(model, precision))
        .run();
}

void remove_lost_precisions(Database& database) {
    if (kPrecisionTable.exists(database))
        database.run("DELETE FROM model_precision WHERE model NOT IN (SELECT model FROM model)");
}

} // namespace abut
