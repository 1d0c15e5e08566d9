#include <abut/error.h>
#include <abut/store.h>

#include "core/progress.h"
#include "core/stop_watch.h"
#include "io/file/input_file.h"
#include "io/scene/scene_source.h"
#include "store/database/generation.h"
#include "store/database/property_table.h"
#include "store/database/schema.h"
#include "store/import/import_geometry.h"
#include "store/import/merge_parts.h"
#include "store/import/model_file.h"
#include "store/import/note_text.h"
#include "store/import/store_writer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace abut {

namespace {

constexpr std::uint64_t kLeastMemory = std::uint64_t{16} << 20;

std::string folder_of(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

/// Returns whether the model file refers to other files. Its own size and time then do not tell
/// whether it has changed.
bool refers_to_files(const std::string& file) {
    return lower_extension(file) == ".gltf";
}

/// Checks all that can be refused before the store is touched.
std::vector<ModelFile> check_files(const std::vector<ModelPath>& files, const std::string& store) {
    std::error_code missing;
    std::vector<ModelFile> found;
    for (const auto& [file, unit, up] : files) {
        if (!std::isfinite(unit) || unit < 0)
            throw Error(ErrorCode::bad_argument, file, "unit must be a positive number of metres");
        if (std::filesystem::equivalent(file, store, missing) || is_store(file))
            throw Error(ErrorCode::bad_argument, file,
                        "is a store: models are imported from their files");
        found.push_back(look_at(file));
        for (std::size_t i = 0; i + 1 < found.size(); ++i)
            if (found[i].path == found.back().path)
                throw Error(ErrorCode::bad_argument, file, "is given twice");
    }
    return found;
}

/// The options that decide how a file is read, as text.
std::string asked_of(const ModelPath& path, const ImportOptions& options) {
    const auto up = [](const std::optional<UpAxis>& axis) {
        return axis ? std::string(to_string(*axis)) + "-up" : "-";
    };
    return fmt::format("{}:{}, else {}:{}{}{}", path.unit, up(path.up), options.unit,
                       up(options.up), options.spaces ? ", spaces" : "",
                       options.map ? ", map" : "");
}

class StoreImport {
public:
    StoreImport(const std::string& store, const ImportOptions& options)
        : store_(store), options_(options),
          writer_(store, page_cache(options.memory), ExclusiveStore::IfMissing::create) {}

    ImportReport run(const std::vector<ModelPath>& files, const std::vector<ModelFile>& found) {
        const StopWatch watch;
        ImportReport report;
        generation_ = last_generation(writer_.database()) + 1;
        for (std::size_t i = 0; i < files.size(); ++i)
            report.models.push_back(import(files[i], found[i]));
        // While an interrupted import can still be resumed, meshes without parts must stay: they
        // are what it has stored so far.
        const bool is_complete =
            writer_.database().number("SELECT count(*) FROM model WHERE importing") == 0;
        if (is_complete && may_have_unused_) {
            report.removed_meshes = writer_.remove_unused_meshes();
            remove_unused_texts(writer_.database());
        }
        report.new_meshes = writer_.new_meshes();
        report.seconds = watch.seconds();
        return report;
    }

    /// How many model files have been imported.
    [[nodiscard]] std::size_t complete() const noexcept { return complete_; }

    /// As StoreWriter::undo_creation.
    void undo_creation() noexcept { writer_.undo_creation(); }

private:
    /// SQLite's share of the memory.
    static std::uint64_t page_cache(std::uint64_t memory) {
        return std::clamp<std::uint64_t>(memory / 8, std::uint64_t{2} << 20,
                                         std::uint64_t{64} << 20);
    }

    std::optional<ModelRow> known_model(const std::string& path) {
        Statement find(writer_.database(),
                       std::string("SELECT ") + kModelColumns + " FROM model WHERE path = ?");
        find.bind(path);
        if (!find.step())
            return std::nullopt;
        return read_model_row(find, store_);
    }

    /// The up axis of the world; none if the store has no parts.
    std::optional<UpAxis> world_up() {
        Statement first(writer_.database(), std::string("SELECT ") + kModelColumns +
                                                " FROM model WHERE parts > 0 LIMIT 1");
        if (!first.step())
            return std::nullopt;
        return read_model_row(first, store_).world_up;
    }

    ImportedModel import(const ModelPath& path, const ModelFile& found) {
        const StopWatch watch;
        const std::string& file = path.path;
        ImportedModel result;
        result.file = file;
        result.bytes = found.bytes;
        const std::optional<ModelRow> known = known_model(found.path);
        const bool was_complete = known && !known->importing;
        const bool as_before =
            was_complete && known->asked == asked_of(path, options_) && !refers_to_files(file);
        ModelRow model = known.value_or(ModelRow());
        may_have_unused_ = may_have_unused_ || (known && known->importing);
        if (as_before && known->bytes == found.bytes && known->modified == found.modified) {
            finish_unchanged(*known, result, watch);
            return result;
        }
        const Hash128 hash = content_hash(file, options_.progress);
        const bool same_content = as_before && known->hash_low == hash.low &&
                                  known->hash_high == hash.high && known->bytes == found.bytes;
        model.modified = found.modified;
        if (same_content) {
            put_model(model, writer_.database());
            finish_unchanged(model, result, watch);
            return result;
        }
        model.file = file;
        model.path = found.path;
        model.bytes = found.bytes;
        model.hash_low = hash.low;
        model.hash_high = hash.high;
        model.asked = asked_of(path, options_);
        mark_as_importing(known, model);
        PartChanges changes;
        try {
            changes = import_content(path, model, result);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::interrupted)
                take_mark_back(known, model);
            throw;
        }
        ++complete_;
        result.outcome = !was_complete   ? ImportOutcome::added
                         : changes.any() ? ImportOutcome::changed
                                         : ImportOutcome::unchanged;
        result.added = changes.added;
        result.changed = changes.changed;
        result.removed = changes.removed;
        tell(model, result);
        result.seconds = watch.seconds();
        return result;
    }

    void tell(const ModelRow& model, ImportedModel& result) const {
        result.parts = model.parts;
        result.triangles = model.triangles;
        result.unit = model.unit;
        result.up = model.up;
        result.notes = parse_notes(model.notes, store_);
    }

    void finish_unchanged(const ModelRow& known, ImportedModel& result,
                          const StopWatch& watch) const {
        tell(known, result);
        result.seconds = watch.seconds();
    }

    /// Marks a model as being imported. Its parts stay as they were until the new ones are merged.
    void mark_as_importing(const std::optional<ModelRow>& known, ModelRow& model) {
        ModelRow row = known.value_or(model);
        if (!known)
            row.model = model.model = writer_.database().number("SELECT max(model) FROM model") + 1;
        row.importing = true;
        put_model(row, writer_.database());
    }

    /// Clears the mark after an error of the file or the disk: the next import has nothing to
    /// resume.
    void take_mark_back(const std::optional<ModelRow>& known, const ModelRow& model) {
        try {
            writer_.commit();
            if (known) {
                put_model(*known, writer_.database());
            } else {
                Statement remove(writer_.database(), "DELETE FROM model WHERE model = ?");
                remove.bind(model.model).run();
                (void)writer_.remove_unused_meshes();
            }
        } catch (const Error&) { // NOLINT: the first error is told; the store says "incomplete"
        }
    }

    PartChanges import_content(const ModelPath& path, ModelRow& model, ImportedModel& result) {
        const std::string& file = path.path;
        const std::string folder = folder_of(store_);
        const std::uint64_t memory = options_.memory - page_cache(options_.memory);
        SourceOptions from;
        from.read.unit = options_.unit;
        from.read.up = options_.up;
        from.read.spaces = options_.spaces;
        from.read.map = options_.map;
        from.read.allow_outside_files = options_.allow_outside_files;
        from.read.progress = options_.progress;
        from.world = world_up();
        from.folder = folder;
        from.memory = memory / 8;
        const auto source = open_scene_source(path, from);
        model.unit = source->frame().unit;
        model.up = source->frame().up;
        model.world_up = from.world.value_or(model.up);
        model.notes = note_text(source->notes());
        model.project = source->facts().project;
        model.map_from_project = source->facts().map_from_project;
        result.streamed = source->streams();
        ImportedGeometry geometry(folder);
        import_geometry(*source, file, memory * 3 / 4, options_.progress, writer_, geometry);
        const ModelFile after = look_at(file);
        if (after.bytes != model.bytes || after.modified != model.modified)
            throw Error(ErrorCode::unreadable, file, "changed while it was read");
        const PartChanges changes = merge_parts(*source, geometry, generation_, options_.progress,
                                                model, writer_.database());
        may_have_unused_ = may_have_unused_ || changes.changed + changes.removed > 0;
        return changes;
    }

    const std::string& store_;
    const ImportOptions& options_;
    StoreWriter writer_;
    std::size_t complete_ = 0;
    std::uint64_t generation_ = 0;
    bool may_have_unused_ = false;
};

} // namespace

const char* to_string(ImportOutcome outcome) {
    switch (outcome) {
    case ImportOutcome::added:
        return "added";
    case ImportOutcome::changed:
        return "changed";
    case ImportOutcome::unchanged:
        break;
    }
    return "unchanged";
}

ImportReport import_models(const std::vector<std::string>& files, const std::string& store,
                           const ImportOptions& options) {
    std::vector<ModelPath> paths;
    paths.reserve(files.size());
    for (const std::string& file : files)
        paths.push_back({file});
    return import_models(paths, store, options);
}

ImportReport import_models(const std::vector<ModelPath>& files, const std::string& store,
                           const ImportOptions& options) {
    if (options.memory < kLeastMemory)
        throw Error(ErrorCode::bad_argument, "an import needs at least 16 MiB of memory");
    const std::vector<ModelFile> found = check_files(files, store);
    StoreImport import(store, options);
    try {
        return import.run(files, found);
    } catch (const Error& error) {
        // No model was imported and there is nothing to resume: remove the store if it is new.
        if (import.complete() == 0 && error.code() != ErrorCode::interrupted)
            import.undo_creation();
        throw;
    }
}

} // namespace abut
