#pragma once

#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace abut {

/// What an import did to one file.
enum class ImportOutcome : std::uint8_t {
    added,     ///< the store did not have it
    changed,   ///< it has other parts than before
    unchanged, ///< the store is as it was
};

const char* to_string(ImportOutcome outcome);

struct ImportOptions {
    /// Bytes that the import may keep in memory, whatever the size of the models; at least 16 MiB.
    /// What the program and its libraries take comes on top: some 64 MiB. Formats without a
    /// streaming reader (see docs/store.md) need what read_scene needs, one file at a time.
    std::uint64_t memory = std::uint64_t{512} << 20;
    /// For files whose format does not say them; as in ReadOptions.
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
    bool streamed = false; ///< by a reader that does not load the file whole
    std::uint64_t bytes = 0;
    std::uint64_t parts = 0;
    std::uint64_t triangles = 0; ///< each instance counted
    /// Against what the store had; a part is known by its id.
    std::uint64_t added = 0, changed = 0, removed = 0;
    double seconds = 0;
    double unit = 1;       ///< metres per unit of the file
    UpAxis up = UpAxis::y; ///< of the file
    std::vector<SceneNote> notes{};
};

struct ImportReport {
    std::vector<ImportedModel> models; ///< in the order of the files
    std::uint64_t new_meshes = 0;      ///< stored; the others were there already
    std::uint64_t removed_meshes = 0;  ///< that no part uses any more
    double seconds = 0;
};

/// Brings model files into a store, which is made if it is not there: one SQLite file that holds
/// every distinct mesh once, in compressed and checksummed blocks, and the parts with their places.
///
/// The world of a store has the axes of the first file that is imported; it keeps them as long as it
/// holds a model, and the parts of files with other axes are turned.
///
/// A file that the store has and that has not changed costs nothing; of one that has, only what
/// differs is written. Models of the store that are not named stay.
///
/// An import that is killed leaves a store that opens and says that it is incomplete; the next one
/// goes on with the meshes that are there.
///
/// Errors      Error, naming the file: as read_scene for a model; bad_argument for a store given
///             as a model, a file given twice, too little memory; as open_store for the store, and
///             cannot_write if the disk is full. Error{interrupted}. After an error the store holds
///             each model as it was before, or as it is now.
ImportReport import_models(const std::vector<ModelPath>& files, const std::string& store,
                           const ImportOptions& options = {});
ImportReport import_models(const std::vector<std::string>& files, const std::string& store,
                           const ImportOptions& options = {});

struct RemovedModel {
    std::string file; ///< as it was given to the import
    std::uint64_t parts = 0;
};

struct RemovalReport {
    std::vector<RemovedModel> models; ///< in the order of the files
    std::uint64_t removed_meshes = 0; ///< that no part uses any more
};

/// Takes models out of a store, all of them or none. Their files need not be there any more. The file
/// of the store keeps its size: the room is used by what comes.
///
/// Errors      Error, naming the file: bad_argument if a file is no model of the store, or given twice;
///             as open_store for the store, and cannot_write.
RemovalReport remove_models(const std::vector<std::string>& files, const std::string& store);

struct StoreOptions {
    bool read_only = true;
};

class StoreFile;

/// An open store. Cheap to copy; all copies are one.
class Store {
public:
    explicit Store(std::shared_ptr<StoreFile> file) : file_(std::move(file)) {}
    [[nodiscard]] StoreFile& file() const noexcept { return *file_; }

private:
    std::shared_ptr<StoreFile> file_;
};

/// Errors      Error, naming the file: file_not_found; malformed if it is no store or is damaged;
///             unsupported if a newer version wrote it; unreadable if another process is writing
///             it, or if a killed one left it in a state that only a writer may mend.
Store open_store(const std::string& path, const StoreOptions& options = {});

/// Whether a file begins as a store does. False where it cannot be read.
bool is_store(const std::string& path);

struct StoreSummary {
    struct Model {
        std::string file;
        bool complete = false; ///< false: its import has not ended
        std::uint64_t parts = 0;
        std::uint64_t triangles = 0; ///< each instance counted
        std::uint64_t generation = 0;
        double unit = 1;       ///< metres per unit of the file
        UpAxis up = UpAxis::y; ///< of the file
        std::vector<SceneNote> notes{};
    };
    std::string path;
    int version = 0;
    UpAxis up = UpAxis::y;        ///< of the world
    bool complete = false;        ///< all models are
    std::uint64_t generation = 0; ///< grows with each import that changes something
    std::vector<Model> models;
    std::uint64_t parts = 0;
    std::uint64_t triangles = 0; ///< each instance counted
    std::uint64_t meshes = 0;
    std::uint64_t stored_triangles = 0; ///< each mesh once
    std::uint64_t blocks = 0;
    std::uint64_t raw_bytes =
        0; ///< of the meshes' coordinates and indices, as floats where they are
    std::uint64_t stored_bytes = 0; ///< of the compressed blocks
    std::uint64_t hierarchies = 0;  ///< that jobs have kept, one a block at most
    std::uint64_t hierarchy_bytes = 0;
    std::uint64_t file_bytes = 0;
    std::uint64_t unused_bytes = 0; ///< of the file: room for what comes
    Box3 bounds;                    ///< of all parts in the world
};

/// Errors      Error{malformed} if a row that is read is damaged.
/// Cost        one pass over the parts.
StoreSummary summary(const Store& store);

/// Reads all of a store and checks every page, row, block and hierarchy against its checksum.
///
/// Errors      Error{malformed}, naming the file and the damage; Error{interrupted}.
void verify(const Store& store, const Progress& progress = {});

} // namespace abut
