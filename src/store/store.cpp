#include <abut/error.h>
#include <abut/store.h>

#include "core/progress.h"
#include "math/vector.h"
#include "store/codec/hierarchy_codec.h"
#include "store/database/level_table.h"
#include "store/database/precision_table.h"
#include "store/database/property_table.h"
#include "store/database/store_file.h"
#include "store/import/mesh_draft.h"
#include "store/import/note_text.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <unordered_map>

namespace abut {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "SQLite format 3\0"sv;

/// Runs SQLite's own checks of pages and indices.
void check_pages(StoreFile& file) {
    file.with_connection([&](Database& database) {
        Statement check(database, "PRAGMA integrity_check(1)");
        if (check.step() && check.text(0) != "ok")
            throw Error(ErrorCode::malformed, file.path(),
                        "is damaged: " + one_line(check.text(0)));
        Statement boxes(database, "SELECT rtreecheck('part_box')");
        if (boxes.step() && boxes.text(0) != "ok")
            throw Error(ErrorCode::malformed, file.path(),
                        "is damaged: " + one_line(boxes.text(0)));
    });
}

/// Reads a mesh and compares it with the hash in its row.
void check_mesh(StoreFile& file, const MeshRow& row) {
    const Mesh mesh = file.read_mesh(row.mesh);
    const Hash128 hash = mesh_hash(
        mesh.positions.size(), hash_128(std::as_bytes(std::span<const Vec3>(mesh.positions))),
        mesh.triangles.size(),
        hash_128(std::as_bytes(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles))));
    if (hash != Hash128{row.hash_low, row.hash_high})
        throw Error(ErrorCode::malformed, file.path(),
                    "is damaged: mesh " + std::to_string(row.mesh) + " does not match its hash");
}

/// Checks that each hierarchy of the current format can be decoded and fits its block. Jobs rebuild
/// damaged ones.
void check_hierarchies(StoreFile& file) {
    std::vector<std::int64_t> blocks;
    file.with_connection([&](Database& database) {
        if (!has_hierarchies(database))
            return;
        Statement rows(database, "SELECT block FROM hierarchy JOIN block USING (block) "
                                 "WHERE format = ? AND block_checksum = data_checksum");
        rows.bind(TreeOutline::kFormat);
        while (rows.step())
            blocks.push_back(rows.integer(0));
    });
    for (const std::int64_t block : blocks) {
        StoredBlockData read = file.read_block_and_row(block);
        const auto kept = file.find_hierarchy(read.row);
        if (!kept || !decode_hierarchy(kept->data, read.row.triangles))
            throw Error(ErrorCode::malformed, file.path(),
                        "is damaged: the hierarchy of block " + std::to_string(block) +
                            " does not match its checksum");
    }
}

/// Checks that the boxes in the index enclose those of the parts.
void check_boxes(StoreFile& file) {
    file.with_connection([&](Database& database) {
        const std::int64_t wrong = database.number(
            "SELECT count(*) FROM part LEFT JOIN part_box AS b USING (part) "
            "WHERE part.x0 <= part.x1 AND NOT coalesce("
            "b.x0 <= part.x0 AND b.x1 >= part.x1 AND b.y0 <= part.y0 AND b.y1 >= part.y1 AND "
            "b.z0 <= part.z0 AND b.z1 >= part.z1, 0)");
        if (wrong != 0)
            throw Error(ErrorCode::malformed, file.path(),
                        "is damaged: the index of boxes misses " + std::to_string(wrong) +
                            " parts");
    });
}

/// Counts what the parts have. Texts are not compared with their checksums here.
void add_properties(Database& database, StoreSummary& summary) {
    Statement rows(database, "SELECT text, count(DISTINCT part), count(DISTINCT value) "
                             "FROM part_property JOIN property_name USING (name) "
                             "GROUP BY name ORDER BY text");
    while (rows.step())
        summary.properties.push_back({rows.text(0), static_cast<std::uint64_t>(rows.integer(1)),
                                      static_cast<std::uint64_t>(rows.integer(2))});
    summary.relations =
        static_cast<std::uint64_t>(database.number("SELECT count(*) FROM part_relation"));
}

[[noreturn]] void throw_unreadable(const std::string& path, int error) {
    if (error == ENOENT || error == ENOTDIR)
        throw Error(ErrorCode::file_not_found, path, "no such file");
    throw Error(ErrorCode::unreadable, path,
                std::string("cannot be read: ") + std::strerror(error));
}

/// Refuses whatever is not a readable, regular file, without opening it. Only SQLite may open a
/// store: closing another descriptor of the file would release the locks that other connections of
/// this process hold (POSIX, fcntl).
void require_regular_file(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0)
        throw_unreadable(path, errno);
    if (S_ISDIR(status.st_mode))
        throw Error(ErrorCode::unreadable, path, "is a folder");
    if (!S_ISREG(status.st_mode))
        throw Error(ErrorCode::unreadable, path, "is not a regular file");
    if (status.st_size == 0)
        throw Error(ErrorCode::malformed, path, kEmptyStore);
    if (access(path.c_str(), R_OK) != 0) // also if another process has just removed it
        throw_unreadable(path, errno);
}

} // namespace

bool is_store(const std::string& path) {
    return first_bytes(path, kMagic.size()) == kMagic;
}

Store open_store(const std::string& path, const StoreOptions& options) {
    require_regular_file(path);
    return Store(std::make_shared<StoreFile>(path, options.read_only));
}

StoreSummary summary(const Store& store) {
    StoreFile& file = store.file();
    StoreSummary result;
    result.path = file.path();
    result.version = kStoreVersion;
    result.complete = true;
    const std::vector<ModelRow> models = file.models();
    for (const ModelRow& model : models) {
        result.models.push_back({model.file, !model.importing, model.parts, model.triangles,
                                 model.generation, model.unit, model.up,
                                 parse_notes(model.notes, file.path()), model.project,
                                 model.map_from_project});
        result.up = model.world_up;
        result.complete = result.complete && !model.importing;
        result.generation = std::max(result.generation, model.generation);
        result.parts += model.parts;
        result.triangles += model.triangles;
    }
    file.for_each_part([&](const PartRow& part) {
        result.bounds.lower = min(result.bounds.lower, part.box.lower);
        result.bounds.upper = max(result.bounds.upper, part.box.upper);
    });
    file.for_each_mesh([&](const MeshRow& mesh) {
        ++result.meshes;
        result.stored_triangles += mesh.triangles;
        result.blocks += mesh.blocks;
        result.raw_bytes += mesh.raw_bytes;
        result.stored_bytes += mesh.stored_bytes;
    });
    file.with_connection([&](Database& database) {
        if (has_hierarchies(database)) {
            const auto number = [&](const char* sql) {
                return static_cast<std::uint64_t>(database.number(sql));
            };
            result.hierarchies = number("SELECT count(*) FROM hierarchy");
            result.hierarchy_bytes = number("SELECT sum(length(data)) FROM hierarchy");
        }
        if (has_level_tables(database)) {
            const auto number = [&](const char* sql) {
                return static_cast<std::uint64_t>(database.number(sql));
            };
            result.levels = level_tree_content(database) == level_content(models);
            result.level_chunks = number("SELECT count(*) FROM level_chunk");
            result.level_bytes = number("SELECT sum(bytes) FROM level_chunk");
        }
        add_properties(database, result);
        const auto page = static_cast<std::uint64_t>(database.number("PRAGMA page_size"));
        result.file_bytes = page * static_cast<std::uint64_t>(database.number("PRAGMA page_count"));
        result.unused_bytes =
            page * static_cast<std::uint64_t>(database.number("PRAGMA freelist_count"));
    });
    return result;
}

Scene read_parts(const Store& store, std::size_t model) {
    StoreFile& file = store.file();
    const std::vector<ModelRow> models = file.models();
    if (model >= models.size())
        throw Error(ErrorCode::bad_argument, file.path(), "has no model " + std::to_string(model));
    const ModelRow& row = models[model];
    Scene scene;
    scene.file = row.file;
    scene.unit = row.unit;
    scene.up = row.world_up;
    scene.notes = parse_notes(row.notes, file.path());
    scene.project = row.project;
    scene.map_from_project = row.map_from_project;
    scene.precision = file.precision(row.model);
    std::vector<std::int64_t> parts;
    file.for_each_part(row, [&](const PartRow& part) {
        parts.push_back(part.part);
        scene.parts.push_back(
            {part.id, part.name, part.type, 0, part.world_from_mesh, part.colour});
    });
    scene.properties = file.properties(parts);
    scene.relations = file.relations(parts);
    return scene;
}

void verify(const Store& store, const Progress& progress) {
    StoreFile& file = store.file();
    std::vector<MeshRow> meshes;
    file.for_each_mesh([&](const MeshRow& mesh) { meshes.push_back(mesh); });
    ProgressMeter meter(progress, "verify", meshes.size() + 6);
    check_pages(file);
    meter.advance();
    std::unordered_map<std::int64_t, bool> known;
    for (const MeshRow& mesh : meshes) {
        check_mesh(file, mesh);
        known[mesh.mesh] = true;
        meter.advance();
    }
    for (const ModelRow& model : file.models())
        (void)file.precision(model.model);
    file.for_each_part([&](const PartRow& part) {
        if (!known.contains(part.mesh))
            throw Error(ErrorCode::malformed, file.path(),
                        "is damaged: part " + part.id + " refers to a mesh that is missing");
    });
    meter.advance();
    check_boxes(file);
    meter.advance();
    file.with_connection(check_properties);
    meter.advance();
    check_hierarchies(file);
    meter.advance();
    file.with_connection(check_level_chunks);
    meter.advance();
}

} // namespace abut
