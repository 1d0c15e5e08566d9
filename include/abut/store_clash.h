#pragma once

#include <abut/clash.h>
#include <abut/crew.h>
#include <abut/scene.h>
#include <abut/store.h>

#include <cstdint>
#include <string>
#include <vector>

/// The clash job on a store: models of any size in little memory. docs/massive.md tells how.
namespace abut {

/// How the work is put into an order.
enum class WorkOrder : std::uint8_t {
    partition, ///< the overlap graph is cut into subgraphs that fit the memory
    random,    ///< to show what the partition saves
};

struct OutOfCoreOptions {
    /// Bytes for geometry, hierarchies and the tables of parts and pairs. The program and its
    /// libraries come on top, some 64 MiB.
    std::uint64_t memory = std::uint64_t{512} << 20;
    WorkOrder order = WorkOrder::partition;
    /// What is done is kept in the store, if it can be written to: a job that is killed goes on where
    /// it was, and one that has ended is not done again as long as its parts are the same.
    bool keep = true;
    /// With what is done, the hierarchies that were built are kept in the store: one to two bytes a
    /// triangle, for later jobs and walks to read instead of building them. Not by a crew. What is kept
    /// there is read in any case.
    bool keep_hierarchies = true;
    /// Processes that do the job together, this one the leader; null: this process alone. `memory` is
    /// that of each. The result does not depend on how many they are.
    Crew* crew = nullptr;
};

/// What a job out of core did.
struct OutOfCoreCounters {
    std::uint64_t units = 0;      ///< pieces of work that fit into the memory
    std::uint64_t meshes = 0;     ///< that a candidate needs, large ones left out
    std::uint64_t mesh_loads = 0; ///< each time that one was read
    /// Of large meshes, which are never whole in memory: needed. Of several processes, the sum.
    std::uint64_t blocks = 0;
    std::uint64_t block_loads = 0;  ///< each time that one was read
    std::uint64_t bytes_needed = 0; ///< of those meshes and blocks in the store, each once
    std::uint64_t bytes_read = 0;   ///< of the store's blocks and hierarchies
    /// Of these loads, those whose hierarchy was in the store; the others built it.
    std::uint64_t hierarchies_found = 0;
    std::uint64_t hierarchies_kept = 0; ///< in the store, of those that were built
    std::uint64_t peak_bytes = 0;       ///< of models in memory at once
    bool kept = false;                  ///< in the store
    std::uint64_t recalled_pairs = 0;   ///< done before, by a job that was stopped or has ended

    /// What one process did; sums and the largest of these are above.
    struct Worker {
        std::uint64_t units = 0, pairs = 0;
        std::uint64_t mesh_loads = 0;
        std::uint64_t blocks = 0, block_loads = 0, block_bytes_needed = 0;
        std::uint64_t hierarchies_found = 0;
        std::uint64_t bytes_read = 0, peak_bytes = 0;
        double processor_seconds = 0; ///< since it began, of all its threads
        double waiting_seconds = 0;   ///< for pieces of work, with nothing to do
        double peak_rss_mib = 0;      ///< as peak_resident_mib
    };
    std::vector<Worker> workers; ///< by rank
};

struct StoreClashReport {
    ClashReport report;
    /// For the writers of reports: the store's models, with the parts that clash alone; the clashes
    /// of the report name parts by their index here. No meshes.
    std::vector<Scene> models;
    OutOfCoreCounters counters;
};

/// One JSON object: that of the report, with a last member `out_of_core` of the counters
/// (docs/massive.md).
std::string to_json(const StoreClashReport& found);

/// As find_clashes of the models in memory, in the order in which they were first imported: the same
/// clashes, to the last bit.
///
/// Errors      as find_clashes and open_store; Error{bad_argument}: an import into the store has
///             not ended, or `memory` does not hold the tables, or two meshes that are to be compared,
///             or, of large meshes, the few blocks that are compared at a time.
/// Cost        each mesh is read about once if `memory` holds a fair share of what a neighbourhood
///             needs; while one piece of work is done, the next one's meshes are read.
StoreClashReport find_clashes(const Store& store, const ClashOptions& options,
                              const OutOfCoreOptions& out_of_core = {});

/// The helpers' half of a job whose leader calls find_clashes with the crew. Returns when the leader
/// has left the crew, or if something went wrong here, which the leader then throws.
///
/// In          store: path of the leader's store, on a file system of both, or of a copy of it. It is
///             read without locks.
void help_find_clashes(const std::string& store, Crew& crew, const Progress& progress = {});

/// The graph of a store's parts: an edge where boxes are at most the clearance apart.
struct GraphReport {
    std::uint64_t nodes = 0; ///< parts
    std::uint64_t edges = 0;
    std::uint64_t components = 0; ///< of parts that have an edge
    std::uint64_t isolated = 0;   ///< parts without an edge
    std::uint64_t largest_component = 0, highest_valence = 0;
    double mean_valence = 0; ///< of parts that have an edge
    std::uint64_t bytes = 0; ///< of the models that an edge needs, each once
    /// Of these, those of large meshes: of all their blocks, of which few are in memory at a time.
    std::uint64_t large_meshes = 0, large_bytes = 0;
    struct Unit {
        std::uint64_t parts = 0, edges = 0;
        std::uint64_t meshes = 0, bytes = 0; ///< that must be in memory together: no large ones
        Box3 bounds;                         ///< of its parts' middles
        Vec3 middle;                         ///< their mean
    };
    std::vector<Unit> units;     ///< in the order of work
    std::uint64_t cut_edges = 0; ///< between parts that a partition put apart
    struct Line {
        Vec3 a, b; ///< middles of both parts' boxes
        std::uint32_t unit = 0;
    };
    std::vector<Line> lines; ///< some of the edges, to draw
    double seconds = 0;
};

/// In          lines: of about how many edges, evenly chosen, the ends are wanted; keep: edges and
///             pieces are kept in the store for SQL, in place of those that were kept before
///             (docs/massive.md).
/// Errors      as find_clashes of a store; Error{cannot_write} if it is to be kept and cannot be.
GraphReport overlap_graph(const Store& store, const ClashOptions& options,
                          const OutOfCoreOptions& out_of_core = {}, std::uint64_t lines = 0,
                          bool keep = false);

} // namespace abut
