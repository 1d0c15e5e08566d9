#pragma once

#include <abut/convex.h>
#include <abut/model.h>
#include <abut/motion.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/shape_queries.h>
#include <abut/shapes.h>
#include <abut/store.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Queries while moving through a store that does not fit into memory: what is near and what is
/// touched, in every tick. docs/walk.md explains them.
namespace abut {

/// A part of a walk: its row in the store's table `part`, or a negative number if it was added.
struct WalkPart {
    std::int64_t number = 0;
    friend bool operator==(const WalkPart&, const WalkPart&) = default;
    friend bool operator<(const WalkPart& a, const WalkPart& b) { return a.number < b.number; }
};

struct WalkOptions {
    /// Bytes for the tables of parts, geometry and hierarchies; never exceeded. The program and its
    /// libraries need about 64 MiB more.
    std::uint64_t memory = std::uint64_t{512} << 20;
    /// Seconds of the predicted path for which parts are read ahead.
    double look_ahead = 3;
    /// Whether a second thread reads ahead. Otherwise a query reads what it needs.
    bool prefetch = true;
};

/// What a query does if it needs a part that is not in memory.
enum class MissingParts : std::uint8_t {
    wait, ///< reads the part: the answer is exact
    /// Leaves the part out and reports it; it is read in the background with priority. `distance`,
    /// `within`, `collide` and `penetration` end after the nearest 1,024 parts (or mesh blocks) that
    /// are not in memory, and then ignore all that are farther.
    skip,
};

class ProbeData;

/// The object that is moved in a walk: a model, convex body, sphere, capsule or box in its own
/// frame. A model is a surface; the others are solid. Cheap to copy. Make it once, not in every
/// tick.
class Probe {
public:
    /// Errors      Error{bad_argument} if a value is not finite or a coordinate beyond 1e18, a
    ///             radius is negative, or a box is empty.
    /// Cost        for a model linear in its triangles, otherwise small.
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
    /// For `distance`: parts that are not nearer than this are ignored.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// A part to leave out, for example the one that the probe is a copy of. 0: none.
    WalkPart except{};
    /// For `collide`: all touched parts, or any one of them.
    ContactMode mode = ContactMode::all;
    /// For `sweep` and the times of impact: see ImpactOptions.
    std::optional<double> absolute_error{};
    /// For `penetration` of a model: most steps of all depths together, as
    /// DistanceOptions::max_steps counts them. A depth that needs more is bound_only: the part is at
    /// least so deep, or touched where it is 0.
    std::optional<std::uint64_t> max_steps{};
    /// Its stop flag ends a query. Queries report nothing.
    Progress progress{};
};

/// The distance of a part and the probe, world frame.
struct WalkGap {
    WalkPart part;
    /// 0 if they touch. For a sphere or a capsule it may be negative: minus the distance by which
    /// its surface reaches beyond the part's.
    double distance = std::numeric_limits<double>::infinity();
    Vec3 point_part, point_probe; ///< witness points, that far apart
    Vec3 normal; ///< unit vector from the part to the probe; zero where none is known
    std::uint32_t triangle_part = 0, triangle_probe = 0; ///< of meshes; else 0
    /// As BodyGap::status (abut/world.h). Always bound_only for models that are deep in each other.
    Status status = Status::exact;
};

/// The members that all answers share.
struct WalkAnswer {
    /// False if parts that may matter were skipped because they are not in memory.
    bool complete = true;
    std::uint64_t candidates = 0; ///< parts or mesh blocks whose boxes were in reach
    std::uint64_t misses = 0;     ///< candidates that were not in memory
};

struct NearestPart : WalkAnswer {
    bool found = false; ///< if false, no part is nearer than the bound, and `gap` is not set
    WalkGap gap;
    double at_least =
        0; ///< lower bound of the distance, to rounding; equal to it if the answer is complete
};
struct NearParts : WalkAnswer {
    std::vector<WalkGap> parts; ///< sorted by part
};
struct TouchedParts : WalkAnswer {
    std::vector<WalkPart> parts; ///< sorted
};

/// The first part that a ray meets. The members beside `part` and `at_least` are those of RayHit.
struct HitPart : WalkAnswer {
    bool meet = false; ///< if false, only `at_least` is set
    WalkPart part;
    double t = std::numeric_limits<double>::infinity();
    Vec3 point;
    std::uint32_t triangle = 0;
    std::array<double, 3> barycentric{};
    HitSide side = HitSide::front;
    /// No part is met at a smaller parameter, whether it is in memory or not; equal to `t` if the
    /// answer is complete, and infinite if nothing is met.
    double at_least = std::numeric_limits<double>::infinity();
};

/// The first contact of a moving probe with one part. The members are those of Impact, with the
/// part as `a` and the probe as `b`.
struct PartImpact {
    WalkPart part;
    double time = 1; ///< never later than the contact with this part
    double contact_time = std::numeric_limits<double>::infinity();
    double gap = std::numeric_limits<double>::infinity();
    Vec3 point_part, point_probe; ///< at `time`
    Vec3
        normal; ///< from the part to the probe; zero where they meet at the start and none is known
    std::uint32_t triangle_part = 0, triangle_probe = 0;
    Status status = Status::exact;
};

/// The first contact of a moving probe.
struct FirstContact : WalkAnswer {
    bool meet = false; ///< if false, `impact` is not set
    PartImpact impact;
    /// In [0, 1]. The motion is proven to be free of contacts up to this time, also with parts that
    /// are not in memory. 1 if nothing is met.
    double time_free = 1;
};
/// All parts that a moving probe meets.
struct PartsInWay : WalkAnswer {
    std::vector<PartImpact> parts; ///< sorted by time, then by part
    double time_free = 1;          ///< see FirstContact
};

/// The names of a part.
struct WalkPartName {
    std::string file; ///< empty for a part that was added
    std::string id, name, type;
};

/// Statistics since the walk began.
struct WalkStatistics {
    std::uint64_t lookups = 0; ///< parts (or mesh blocks) of the store that queries needed
    std::uint64_t misses = 0;  ///< lookups of what was not in memory
    double seconds_waited = 0; ///< for misses
    std::uint64_t read_ahead = 0, read_in_query = 0; ///< parts (or mesh blocks) read into memory
    std::uint64_t evicted = 0;
    std::uint64_t parts_in_memory = 0;
    std::uint64_t table_bytes = 0;           ///< of the table of all parts and their boxes
    std::uint64_t bytes = 0, peak_bytes = 0; ///< total memory; at most WalkOptions::memory
};

class WalkData;

/// A region of interest that moves through a store, and queries about the parts in it.
///
/// The answers equal those with all parts in memory; which parts are in memory only affects how
/// long a query takes. Parts count as surfaces, as in abut/rigid.h. The store must not be written
/// to during the walk.
///
/// Only one thread at a time may use a walk.
///
/// Errors      of all queries: Error{bad_argument} if a transform is not finite, or is not a
///             rotation and translation for a probe other than a model, or if a bound is negative
///             or NaN; Error{interrupted} if the stop flag is set; those of the store.
class Walk {
public:
    /// Errors      as open_store; Error{bad_argument} if an import into the store has not finished,
    ///             if the memory does not hold the tables and the largest mesh (or the largest
    ///             block of a mesh that is cut into blocks), or if look_ahead is negative or not
    ///             finite.
    /// Cost        one pass over the parts of the store, some microseconds for each.
    explicit Walk(const Store& store, const WalkOptions& options = {});
    ~Walk();
    Walk(Walk&&) noexcept;
    Walk& operator=(Walk&&) noexcept;

    /// Sets the position of the region of interest. Call it in every tick, or whenever the position
    /// has changed. It never waits for the disk.
    ///
    /// In          velocity: units a second. If it is not given, it is estimated from the change
    ///             since the last call.
    /// Errors      Error{bad_argument} if a coordinate is not finite or beyond 1e18.
    void move_to(const Vec3& position);
    void move_to(const Vec3& position, const Vec3& velocity);
    /// Waits until the parts near and ahead are in memory, or the memory is full; for example
    /// behind a loading screen.
    void wait();

    /// Finds the part nearest to the probe; of several at the same distance, the one of lowest
    /// number.
    NearestPart distance(const Probe& probe, const Transform& world_from_probe,
                         const WalkQuery& query = {});
    /// Finds all parts at most `tolerance` away, and their distances.
    NearParts within(const Probe& probe, const Transform& world_from_probe, double tolerance,
                     const WalkQuery& query = {});
    /// Finds the parts that share a point with the probe.
    ///
    /// Accuracy    for a model, box or convex body: exact; for a sphere or capsule: to rounding.
    TouchedParts collide(const Probe& probe, const Transform& world_from_probe,
                         const WalkQuery& query = {});
    /// As `collide`, with penetration depths and witness points.
    ///
    /// Accuracy    as `World::penetration`. For a part whose mesh is cut into blocks, each block
    ///             counts as an open surface (bound_only): the depth is 0 for models, boxes and
    ///             convex bodies.
    NearParts penetration(const Probe& probe, const Transform& world_from_probe,
                          const WalkQuery& query = {});

    /// The queries above for a part at its place, against all other parts.
    ///
    /// Cost        in addition, that of the part's mesh: for repeated queries make a Probe of
    ///             `model` once.
    NearestPart distance(WalkPart part, WalkQuery query = {});
    NearParts within(WalkPart part, double tolerance, WalkQuery query = {});
    TouchedParts collide(WalkPart part, WalkQuery query = {});
    NearParts penetration(WalkPart part, WalkQuery query = {});

    /// Finds the first part that a ray meets; of several at the same t, the one of lowest number.
    ///
    /// Accuracy, Errors as `abut::first_hit` with a single model of all parts.
    HitPart first_hit(const Ray& ray, const WalkQuery& query = {});
    /// Finds the first contact of a probe that moves in a straight line, by `translation` while the
    /// time goes from 0 to 1. No contact is missed, however far the probe moves.
    ///
    /// Degenerate  a probe that touches a part at the start has time 0.
    /// Accuracy    the time is never later than the first contact. Otherwise as
    ///             `abut::time_of_impact`; for a sphere or capsule contacts are found to rounding.
    /// Errors      Error{bad_argument} also if the translation is not finite, or if coordinates
    ///             exceed 1e18.
    FirstContact sweep(const Probe& probe, const Transform& world_from_probe,
                       const Vec3& translation, const WalkQuery& query = {});
    /// As `sweep`, for a motion that may rotate. A probe's motion starts at `motion.start`.
    FirstContact time_of_impact(const Probe& probe, const Motion& motion,
                                const WalkQuery& query = {});
    /// Finds all parts that a moving probe meets, each with the time of its own first contact.
    PartsInWay parts_in_way(const Probe& probe, const Motion& motion, const WalkQuery& query = {});

    /// Adds a part that is not in the store. The model belongs to the caller: its memory does not
    /// count.
    ///
    /// Errors      Error{bad_argument} if the transform is not finite, or if the memory of the walk
    ///             does not hold the table of one more part.
    WalkPart add(const Model& model, const Transform& world_from_part);
    /// Moves a part for this walk only: the store remains as it is.
    ///
    /// Errors      as `add`; Error{bad_argument} if there is no such part; those of the store.
    void move(WalkPart part, const Transform& world_from_part);
    /// Removes a part for this walk only. Errors as `move`.
    void remove(WalkPart part);

    /// Errors      of all three: as `move`.
    [[nodiscard]] WalkPartName name(WalkPart part);
    [[nodiscard]] Transform world_from_part(WalkPart part);
    /// Returns a copy of the whole model of a part; for example, to move it as a probe.
    [[nodiscard]] Model model(WalkPart part);

    [[nodiscard]] WalkStatistics statistics() const;

private:
    std::unique_ptr<WalkData> data_;
};

} // namespace abut
