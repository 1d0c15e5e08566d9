#pragma once

#include <abut/clash.h>
#include <abut/crew.h>
#include <abut/scene.h>
#include <abut/store.h>

#include <cstdint>
#include <string>
#include <vector>

/// Clash detection on a store: models of any size in little memory. docs/massive.md explains it.
namespace abut {

/// The order in which a job works on pairs.
enum class WorkOrder : std::uint8_t {
    partition, ///< cuts the overlap graph into subgraphs that fit the memory
    random,    ///< any order; shows what the partition saves
};

struct OutOfCoreOptions {
    /// Bytes for geometry, hierarchies and the tables of parts and pairs. The program and its
    /// libraries need about 64 MiB more.
    std::uint64_t memory = std::uint64_t{512} << 20;
    WorkOrder order = WorkOrder::partition;
    /// Whether finished work is kept in the store, if the store can be written to. A killed job
    /// then continues where it was, and a finished job is not repeated while its parts remain the
    /// same.
    bool keep = true;
    /// Whether the hierarchies that were built are kept in the store, too: one to two bytes a
    /// triangle, which later jobs and walks read instead of building them. A crew keeps none.
    /// Hierarchies in the store are read in any case.
    bool keep_hierarchies = true;
    /// The processes that do the job together, with this one as leader; null: this process alone.
    /// `memory` applies to each process. The result does not depend on their number.
    Crew* crew = nullptr;
};

/// The work of an out-of-core job.
struct OutOfCoreCounters {
    std::uint64_t units = 0;      ///< work units, each of which fits into the memory
    std::uint64_t meshes = 0;     ///< needed by a candidate pair; large ones are not counted
    std::uint64_t mesh_loads = 0; ///< times that a mesh was read
    /// Blocks of large meshes that were needed, summed over the processes. A large mesh is never
    /// completely in memory.
    std::uint64_t blocks = 0;
    std::uint64_t block_loads = 0;  ///< times that a mesh block was read
    std::uint64_t bytes_needed = 0; ///< of those meshes and blocks in the store, each once
    std::uint64_t bytes_read = 0;   ///< of mesh blocks and hierarchies, from the store
    /// Loads whose hierarchy was in the store. For the other loads it was built.
    std::uint64_t hierarchies_found = 0;
    std::uint64_t hierarchies_kept = 0; ///< hierarchies that were built and then stored
    std::uint64_t peak_bytes = 0;       ///< of models in memory at once
    bool kept = false;                  ///< the result is in the store
    std::uint64_t recalled_pairs = 0;   ///< finished by an earlier job, complete or not

    /// The work of one process. The counters above hold the sums, or the maxima for peaks.
    struct Worker {
        std::uint64_t units = 0, pairs = 0;
        std::uint64_t mesh_loads = 0;
        std::uint64_t blocks = 0, block_loads = 0, block_bytes_needed = 0;
        std::uint64_t hierarchies_found = 0;
        std::uint64_t bytes_read = 0, peak_bytes = 0;
        double processor_seconds = 0; ///< of all threads, since the process began
        double waiting_seconds = 0;   ///< without work, waiting for a work unit
        double peak_rss_mib = 0;      ///< as peak_resident_mib
    };
    std::vector<Worker> workers; ///< in the order of ranks
};

struct StoreClashReport {
    ClashReport report;
    /// The models for report writers: only the parts that clash, without meshes. The clashes of the
    /// report refer to parts by their index here.
    std::vector<Scene> models;
    OutOfCoreCounters counters;
    /// The numbers of the question and of its finished job in the store; 0: the store has none.
    std::int64_t question = 0, job = 0;
};

/// Returns one JSON object: that of the report, with a last member `out_of_core` for the counters
/// (docs/massive.md).
std::string to_json(const StoreClashReport& found);

/// Finds the same clashes, to the last bit, as find_clashes of the models in memory, in the order
/// in which they were first imported.
///
/// Errors      as find_clashes and open_store; Error{bad_argument} if an import into the store has
///             not finished, or if `memory` does not hold the tables, or two meshes that are
///             compared, or (for large meshes) the few blocks that are compared at a time.
/// Cost        each mesh is read about once if `memory` holds most of what neighbouring parts need.
///             While one work unit is processed, the meshes of the next are read.
StoreClashReport find_clashes(const Store& store, const ClashOptions& options,
                              const OutOfCoreOptions& out_of_core = {});

/// Groups the clashes of a report with the groups that the store remembers: clashes stay in their
/// groups, and groups keep their ids and names. Sets `grouping`, `groups`, `history`, `topics` and
/// `topics_revision` of the report. The groups are recorded once for each job, if the report is
/// that of the last finished job and the store can be written to. `options.earlier` is ignored.
///
/// Errors      as group_clashes of a report, and those of the store.
void group_clashes(const Store& store, StoreClashReport& found, const GroupOptions& options = {});

/// Writes the page of a job on a store, as write_clash_html of models does. Its 3D view is made
/// from the geometry in the store, mesh by mesh.
///
/// Errors      as write_clash_html; those of the store; Error{unreadable} if an import has changed
///             the store since the job.
void write_clash_html(const StoreClashReport& found, const Store& store, const std::string& path,
                      const ClashPageOptions& options = {});

/// Takes part in a job whose leader calls find_clashes with the crew; each helper calls this.
/// Returns when the leader has left the crew. Also returns after an error here, which the leader
/// then throws.
///
/// In          store: path of the leader's store, on a shared file system, or of a copy of it. It
///             is read without locks.
void help_find_clashes(const std::string& store, Crew& crew, const Progress& progress = {});

/// The overlap graph of a store's parts. An edge joins parts whose boxes are at most the clearance
/// apart.
struct GraphReport {
    std::uint64_t nodes = 0; ///< parts
    std::uint64_t edges = 0;
    std::uint64_t components = 0; ///< of the parts that have an edge
    std::uint64_t isolated = 0;   ///< parts without an edge
    std::uint64_t largest_component = 0, highest_valence = 0;
    double mean_valence = 0; ///< of the parts that have an edge
    std::uint64_t bytes = 0; ///< of the models that an edge needs, each once
    /// The large ones among these meshes, and the bytes of all their blocks. Only a few blocks are
    /// in memory at a time.
    std::uint64_t large_meshes = 0, large_bytes = 0;
    struct Unit {
        std::uint64_t parts = 0, edges = 0;
        std::uint64_t meshes = 0, bytes = 0; ///< in memory together; large meshes are not counted
        Box3 bounds;                         ///< of the centres of its parts' boxes
        Vec3 middle;                         ///< mean of these centres
    };
    std::vector<Unit> units;     ///< in the order of work
    std::uint64_t cut_edges = 0; ///< edges between parts in different units
    struct Line {
        Vec3 a, b; ///< centres of both parts' boxes
        std::uint32_t unit = 0;
    };
    std::vector<Line> lines; ///< some of the edges, for drawing
    double seconds = 0;
};

/// Computes the overlap graph and its partition.
///
/// In          lines: the approximate number of edges to return as lines, evenly chosen. keep:
///             stores the edges and units for SQL, in place of earlier ones (docs/massive.md).
/// Errors      as find_clashes of a store; Error{cannot_write} if `keep` is set and the store
///             cannot be written to.
GraphReport overlap_graph(const Store& store, const ClashOptions& options,
                          const OutOfCoreOptions& out_of_core = {}, std::uint64_t lines = 0,
                          bool keep = false);

} // namespace abut
