#include <abut/error.h>
#include <abut/store.h>

#include "store/database/generation.h"
#include "store/database/precision_table.h"
#include "store/database/property_table.h"
#include "store/database/schema.h"
#include "store/import/model_file.h"
#include "store/import/store_writer.h"

#include <algorithm>

namespace abut {

namespace {

constexpr std::uint64_t kPageCache = std::uint64_t{8} << 20;

/// The models of a store that belong to these files.
std::vector<ModelRow> find_models(Database& database, const std::vector<std::string>& files) {
    std::vector<ModelRow> found;
    for (const std::string& file : files) {
        Statement find(database, std::string("SELECT ") + kModelColumns +
                                     " FROM model WHERE path = ? OR file = ?");
        const std::string path = absolute_path(file);
        find.bind(path, file);
        if (!find.step())
            throw Error(ErrorCode::bad_argument, file, "is not a model of " + database.path());
        found.push_back(read_model_row(find, database.path()));
        if (find.step())
            throw Error(ErrorCode::bad_argument, file,
                        "names two models of " + database.path() + ": give its whole path");
        if (std::ranges::count(found, found.back().model, &ModelRow::model) > 1)
            throw Error(ErrorCode::bad_argument, file, "is given twice");
    }
    return found;
}

} // namespace

RemovalReport remove_models(const std::vector<std::string>& files, const std::string& store) {
    (void)open_store(store); // throws if the file does not exist or is no store
    StoreWriter writer(store, kPageCache, ExclusiveStore::IfMissing::fail);
    Database& database = writer.database();
    RemovalReport report;
    {
        Transaction transaction(database);
        keep_generation(database);
        for (const ModelRow& model : find_models(database, files)) {
            remove_relations(database, model.model);
            for (const char* const sql :
                 {"DELETE FROM part_property WHERE part IN (SELECT part FROM part WHERE model = ?)",
                  "DELETE FROM part_box WHERE part IN (SELECT part FROM part WHERE model = ?)",
                  "DELETE FROM part WHERE model = ?", "DELETE FROM model WHERE model = ?"})
                Statement(database, sql).bind(model.model).run();
            report.models.push_back({model.file, model.parts});
        }
        remove_lost_precisions(database);
        remove_unused_texts(database);
        transaction.commit();
    }
    // While an interrupted import can still be resumed, meshes without parts must stay: they are
    // what it has stored so far.
    if (database.number("SELECT count(*) FROM model WHERE importing") == 0)
        report.removed_meshes = writer.remove_unused_meshes();
    return report;
}

} // namespace abut
