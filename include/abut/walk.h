#pragma once

#include <abut/convex.h>
#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/shapes.h>
#include <abut/store.h>
#include <abut/types.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

/// Walking through a store that does not fit into the memory: what is near, what is touched, frame by
/// frame. docs/walk.md tells how.
namespace abut {

/// A part of the store, by its row in the table `part`; or one that was added, by a negative number.
struct WalkPart {
    std::int64_t number = 0;
    friend bool operator==(const WalkPart&, const WalkPart&) = default;
    friend bool operator<(const WalkPart& a, const WalkPart& b) { return a.number < b.number; }
};

struct WalkOptions {
    /// Bytes for the tables of parts, for geometry and hierarchies: never more. The program and its
    /// libraries come on top, some 64 MiB.
    std::uint64_t memory = std::uint64_t{512} << 20;
    /// Seconds of the predicted path along which parts are read ahead.
    double look_ahead = 3;
    /// Whether a second thread reads ahead. Without, a query reads what it needs.
    bool prefetch = true;
};

/// What a query does about a part that it needs and that is not in memory.
enum class MissingParts : std::uint8_t {
    wait, ///< reads it: the answer is exact
    skip, ///< leaves it out, and says so; it is read in the background, before all else
};

class ProbeData;

/// What is moved about in a walk: a model, or a convex body, sphere, capsule or box, in a frame of its
/// own. A model is its surface; the others are solid. Cheap to copy; make it once, not in each frame.
class Probe {
public:
    /// Errors      Error{bad_argument} if a value is not finite or a coordinate beyond 1e18, a radius is
    ///             negative, or a box is empty.
    /// Cost        of a model linear in its triangles, otherwise small.
    Probe(const Model& model); // NOLINT: a model is a probe; the conversion is meant to be silent.
    Probe(const Convex& convex);   // NOLINT
    Probe(const Sphere& sphere);   // NOLINT
    Probe(const Capsule& capsule); // NOLINT
    Probe(const Box3& box);        // NOLINT

    [[nodiscard]] const ProbeData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const ProbeData> data_;
};

struct WalkQuery {
    MissingParts missing = MissingParts::wait;
    /// Of `distance`: parts that are not nearer than this do not matter.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// This part is left out: the one that the probe is a copy of, say. 0: none.
    WalkPart except{};
    /// Of `collide`: all parts that are touched, or some one of them.
    ContactMode mode = ContactMode::all;
};

/// How a part and the probe lie to each other, world frame.
struct WalkGap {
    WalkPart part;
    /// 0 if they touch; of a sphere or a capsule also negative: how far its surface goes beyond the part's.
    double distance = std::numeric_limits<double>::infinity();
    Vec3 point_part, point_probe; ///< that far apart
    Vec3 normal; ///< unit vector from the part to the probe; zero where none is known
    std::uint32_t triangle_part = 0, triangle_probe = 0; ///< of meshes; else 0
    /// exact: to rounding. bound_only: bodies that meet go at least so deep into each other.
    Status status = Status::exact;
};

/// What all answers have.
struct WalkAnswer {
    /// False if parts that may matter were skipped since they are not in memory.
    bool complete = true;
    std::uint64_t candidates = 0; ///< parts, or pieces of parts, whose boxes were in reach
    std::uint64_t misses = 0;     ///< of these, those that were not in memory
};

struct NearestPart : WalkAnswer {
    bool found = false; ///< else no part is nearer than the bound, and `gap` is not set
    WalkGap gap;
    double at_least =
        0; ///< no part is nearer, to rounding; the distance itself if the answer is complete
};
struct NearParts : WalkAnswer {
    std::vector<WalkGap> parts; ///< sorted by part
};
struct TouchedParts : WalkAnswer {
    std::vector<WalkPart> parts; ///< sorted
};

/// What is known of a part by name.
struct WalkPartName {
    std::string file; ///< empty for a part that was added
    std::string id, name, type;
};

/// Since the walk began.
struct WalkStatistics {
    std::uint64_t lookups = 0; ///< parts (or pieces) of the store that queries needed
    std::uint64_t misses = 0;  ///< of these, those that were not in memory
    double seconds_waited = 0; ///< for these
    std::uint64_t read_ahead = 0, read_in_query = 0; ///< parts (or pieces) brought into memory
    std::uint64_t evicted = 0;
    std::uint64_t parts_in_memory = 0;
    std::uint64_t table_bytes = 0; ///< of the boxes of all parts, and what belongs to them
    std::uint64_t bytes = 0, peak_bytes = 0; ///< of everything: at most WalkOptions::memory
};

class WalkData;

/// A region of interest that moves through a store, and queries about what is there.
///
/// The answers are those that all parts in memory would give: which parts are in memory decides how long
/// a query takes. Parts count as surfaces, as in abut/rigid.h. The store must not be written to
/// meanwhile.
///
/// One thread at a time may use a walk.
///
/// Errors      of all queries: Error{bad_argument} if a transform is not finite, or is no rotation
///             and translation for a probe that is not a model, or a bound is negative or NaN;
///             those of the store.
class Walk {
public:
    /// Cost        one pass over the parts of the store, some microseconds for each.
    /// Errors      as open_store; Error{bad_argument}: an import into the store has not ended; the
    ///             memory does not hold the tables and the largest mesh (or the largest block of one that
    ///             is cut), or look_ahead is negative or not finite.
    explicit Walk(const Store& store, const WalkOptions& options = {});
    ~Walk();
    Walk(Walk&&) noexcept;
    Walk& operator=(Walk&&) noexcept;

    /// Says where the region of interest is: in every frame, or whenever it has moved. Never waits for
    /// the disk.
    ///
    /// In          velocity: units a second; if it is not given, how the position has changed since
    ///             the last call tells.
    /// Errors      Error{bad_argument} if a coordinate is not finite or beyond 1e18.
    void move_to(const Vec3& position);
    void move_to(const Vec3& position, const Vec3& velocity);
    /// Waits until what is near and ahead is in memory, or memory is full: behind a loading screen.
    void wait();

    /// The part nearest to the probe; of several at the same distance, the one of least number.
    NearestPart distance(const Probe& probe, const Transform& world_from_probe,
                         const WalkQuery& query = {});
    /// All parts at most `tolerance` away, and how far.
    NearParts within(const Probe& probe, const Transform& world_from_probe, double tolerance,
                     const WalkQuery& query = {});
    /// The parts that share a point with the probe.
    ///
    /// Accuracy    of a model, a box or a convex body: exact; of a sphere or a capsule: to rounding.
    TouchedParts collide(const Probe& probe, const Transform& world_from_probe,
                         const WalkQuery& query = {});
    /// The same, with how deep they go into each other, and where.
    ///
    /// Accuracy    as `World::penetration`. Of a part whose mesh is cut into blocks, the block's surface
    ///             counts (bound_only): a depth of 0 for models, boxes and convex bodies.
    NearParts penetration(const Probe& probe, const Transform& world_from_probe,
                          const WalkQuery& query = {});

    /// Brings in a part that is not in the store. The model is the caller's: its memory does not count.
    ///
    /// Errors      Error{bad_argument} if the transform is not finite, or the memory of the walk does
    ///             not hold the table of one more part.
    WalkPart add(const Model& model, const Transform& world_from_part);
    /// Puts a part elsewhere, for this walk: the store stays as it is.
    ///
    /// Errors      as `add`; Error{bad_argument} if there is no such part; those of the store.
    void move(WalkPart part, const Transform& world_from_part);
    /// Takes a part out, for this walk. Errors as `move`.
    void remove(WalkPart part);

    /// Errors, of all: as `move`.
    [[nodiscard]] WalkPartName name(WalkPart part);
    [[nodiscard]] Transform world_from_part(WalkPart part);
    /// The whole model of a part, as a copy that is the caller's: to move it as a probe, say.
    [[nodiscard]] Model model(WalkPart part);

    [[nodiscard]] WalkStatistics statistics() const;

private:
    std::unique_ptr<WalkData> data_;
};

} // namespace abut
