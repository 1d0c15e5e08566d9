#pragma once

#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace abut {

/// The effect of an import on one model file.
enum class ImportOutcome : std::uint8_t {
    added,     ///< the file is new to the store
    changed,   ///< the file's parts differ from those stored
    unchanged, ///< the store remains as it was
};

const char* to_string(ImportOutcome outcome);

struct ImportOptions {
    /// Bytes of memory that the import may use, whatever the size of the models; at least 16 MiB.
    /// The program and its libraries need about 64 MiB more. Formats without a streaming reader
    /// (see docs/store.md) need as much as read_scene, one file at a time.
    std::uint64_t memory = std::uint64_t{512} << 20;
    /// For files whose format does not define them; as in ReadOptions.
    double unit = 0;
    UpAxis up = UpAxis::z;
    bool spaces = false;              ///< as ReadOptions::spaces
    bool map = true;                  ///< as ReadOptions::map
    bool allow_outside_files = false; ///< as ReadOptions::allow_outside_files
    Progress progress{};
};

struct ImportedModel {
    std::string file; ///< as given
    ImportOutcome outcome = ImportOutcome::unchanged;
    bool streamed = false; ///< the reader did not load the whole file
    std::uint64_t bytes = 0;
    std::uint64_t parts = 0;
    std::uint64_t triangles = 0; ///< each instance counted
    /// Differences from what the store had. A part is identified by its id.
    std::uint64_t added = 0, changed = 0, removed = 0;
    double seconds = 0;
    double unit = 1;       ///< metres per unit of the file
    UpAxis up = UpAxis::y; ///< of the file
    std::vector<SceneNote> notes{};
};

struct ImportReport {
    std::vector<ImportedModel> models; ///< in the order of the files
    std::uint64_t new_meshes = 0;      ///< stored by this import; the others existed already
    std::uint64_t removed_meshes = 0;  ///< no longer used by any part
    double seconds = 0;
};

/// Imports model files into a store, which is created if it does not exist. A store is one SQLite
/// file. It holds every distinct mesh once, in compressed blocks with checksums, and the parts with
/// their transforms.
///
/// The world of a store has the axes of the file that was imported first, as long as the store
/// holds a model. Parts of files with other axes are turned.
///
/// A file that has not changed since its last import costs nothing. For a changed file, only the
/// differences are written. Models of the store that are not named remain.
///
/// If an import is killed, the store opens and states that it is incomplete. The next import
/// continues with the meshes that are already stored.
///
/// Errors      Error, naming the file: as read_scene for a model; bad_argument for a store given as
///             a model, a file given twice, or too little memory; as open_store for the store;
///             cannot_write if the disk is full. Error{interrupted}. After an error the store holds
///             each model either as it was before or as it is now.
ImportReport import_models(const std::vector<ModelPath>& files, const std::string& store,
                           const ImportOptions& options = {});
ImportReport import_models(const std::vector<std::string>& files, const std::string& store,
                           const ImportOptions& options = {});

struct RemovedModel {
    std::string file; ///< as given to the import
    std::uint64_t parts = 0;
};

struct RemovalReport {
    std::vector<RemovedModel> models; ///< in the order of the files
    std::uint64_t removed_meshes = 0; ///< no longer used by any part
};

/// Removes models from a store: all of them or, after an error, none. Their files need not exist.
/// The store's file keeps its size; later imports reuse the space.
///
/// Errors      Error, naming the file: bad_argument if a file is not a model of the store, or is
///             given twice; as open_store for the store; cannot_write.
RemovalReport remove_models(const std::vector<std::string>& files, const std::string& store);

struct StoreOptions {
    bool read_only = true;
};

class StoreFile;

/// An open store. Copies are cheap and refer to the same open file.
class Store {
public:
    explicit Store(std::shared_ptr<StoreFile> file) : file_(std::move(file)) {}
    [[nodiscard]] StoreFile& file() const noexcept { return *file_; }

private:
    std::shared_ptr<StoreFile> file_;
};

/// Opens a store.
///
/// Errors      Error, naming the file: file_not_found; malformed if it is not a store or is
///             damaged; unsupported if a newer version wrote it; unreadable if another process is
///             writing it, or if a killed process left it in a state that only a writer can repair.
Store open_store(const std::string& path, const StoreOptions& options = {});

/// Returns whether a file begins like a store. False if the file cannot be read.
bool is_store(const std::string& path);

struct StoreSummary {
    struct Model {
        std::string file;
        bool complete = false; ///< false: its import has not finished
        std::uint64_t parts = 0;
        std::uint64_t triangles = 0; ///< each instance counted
        std::uint64_t generation = 0;
        double unit = 1;       ///< metres per unit of the file
        UpAxis up = UpAxis::y; ///< up axis of the file
        std::vector<SceneNote> notes{};
        std::string project{};        ///< as Scene::project
        Transform map_from_project{}; ///< as Scene::map_from_project
    };
    /// A property that parts of the store have.
    struct Property {
        std::string name;
        std::uint64_t parts = 0;  ///< parts that have it
        std::uint64_t values = 0; ///< different values
    };
    std::string path;
    int version = 0;
    UpAxis up = UpAxis::y;        ///< up axis of the world
    bool complete = false;        ///< all models are complete
    std::uint64_t generation = 0; ///< increases with each import that changes something
    std::vector<Model> models;
    std::uint64_t parts = 0;
    std::uint64_t triangles = 0; ///< each instance counted
    std::uint64_t meshes = 0;
    std::uint64_t stored_triangles = 0; ///< each mesh once
    std::uint64_t blocks = 0;
    std::uint64_t raw_bytes =
        0; ///< of the meshes' coordinates and indices; a coordinate counts as a float if it is one
    std::uint64_t stored_bytes = 0; ///< of the compressed blocks
    std::uint64_t hierarchies = 0;  ///< kept by jobs; at most one for each mesh block
    std::uint64_t hierarchy_bytes = 0;
    bool levels = false; ///< levels of detail of the present parts are there (see levels.h)
    std::uint64_t level_chunks = 0; ///< of them, or of earlier parts, or of a build that goes on
    std::uint64_t level_bytes = 0;
    std::uint64_t file_bytes = 0;
    std::uint64_t unused_bytes = 0;     ///< of the file; later imports reuse them
    Box3 bounds;                        ///< of all parts, in the world
    std::vector<Property> properties{}; ///< by name, ascending
    std::uint64_t relations = 0;        ///< see PartRelation
};

/// Summarises a store.
///
/// Errors      Error{malformed} if a row that it reads is damaged.
/// Cost        one pass over the parts and their properties.
StoreSummary summary(const Store& store);

/// Returns the parts of a model of the store, with their properties and relations but without
/// meshes: each part's `mesh` is 0.
///
/// In          model: index in StoreSummary::models
/// Errors      Error{bad_argument} if there is no such model; Error{malformed} for damage.
/// Cost        memory for the names and properties of all its parts.
Scene read_parts(const Store& store, std::size_t model);

/// Reads a whole store and checks every page, row, property, mesh block, hierarchy and level of
/// detail against its checksum.
///
/// Errors      Error{malformed}, naming the file and the damage; Error{interrupted}.
void verify(const Store& store, const Progress& progress = {});

} // namespace abut
