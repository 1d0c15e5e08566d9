#pragma once

#include <abut/broad_phase.h>
#include <abut/convex.h>
#include <abut/deformable.h>
#include <abut/model.h>
#include <abut/motion.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/shapes.h>
#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

/// Many bodies that move: which of them meet, how near they are, when they may meet.
/// docs/world.md tells how; docs/simulation-loop.md, how to use it in a simulator.
namespace abut {

/// A body of a world. Valid until the body is removed, and then never again.
struct BodyId {
    std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t generation = 0; ///< counts the bodies that have had the index
    friend bool operator==(const BodyId&, const BodyId&) = default;
    friend bool operator<(const BodyId& a, const BodyId& b) {
        return a.index != b.index ? a.index < b.index : a.generation < b.generation;
    }
};

/// Two bodies, a.index < b.index.
struct BodyPair {
    BodyId a, b;
    friend bool operator==(const BodyPair&, const BodyPair&) = default;
    friend bool operator<(const BodyPair& p, const BodyPair& q) {
        return p.a == q.a ? p.b < q.b : p.a < q.a;
    }
};

/// Which bodies a body can meet.
struct BodyOptions {
    bool is_static = false;   ///< static bodies do not meet each other
    std::uint32_t groups = 1; ///< bits: the groups it belongs to
    std::uint32_t mask = ~0U; ///< bits: the groups that it meets; both must agree
};

struct WorldOptions {
    BroadPhaseMethod broad_phase = BroadPhaseMethod::automatic;
    /// Pairs that may meet, a.index < b.index; all if empty. Called from any thread. What it says may
    /// change only with `World::refilter`.
    std::function<bool(BodyId a, BodyId b)> filter{};
};

/// How two bodies lie to each other, world frame.
struct BodyGap {
    BodyId a, b;
    /// 0 if they touch; negative where one goes into the other: minus the depth.
    double distance = 0;
    Vec3 point_a, point_b; ///< on the bodies, that far apart
    Vec3 normal;           ///< unit vector from a to b; zero where none is known
    std::uint32_t triangle_a = 0, triangle_b = 0; ///< of models; else 0
    /// exact: to rounding. bound_only: bodies that meet go at least so deep into each other.
    Status status = Status::exact;
};

/// How a body moves in a step, and the pair that first meets.
struct BodyMotion {
    BodyId body;
    Motion motion; ///< while t goes from 0 to 1; its start is where the body is
};
struct BodyImpact {
    BodyId a, b;
    Impact impact; ///< as `time_of_impact`; of bodies without triangles of their own these are 0
};

/// How a body may move from now on: its origin as x + v t + a t^2 / 2, but for another acceleration of
/// at most `acceleration_bound`, and its angular speed at most so large.
struct SpeedBounds {
    Vec3 velocity, acceleration;
    double acceleration_bound = 0;
    double angular_speed = 0; ///< radians per unit of time
};

/// What the schedule of a world has done so far.
struct ScheduleCounters {
    std::uint64_t steps = 0;
    std::uint64_t pairs = 0;            ///< at every step, all that may ever meet; summed
    std::uint64_t distance_queries = 0; ///< of these, those that were due
};

class CollisionSchedule;
class WorldData;

/// Bodies, the pairs of them whose boxes overlap, and exact answers about these.
///
/// A model is its surface; convex bodies, spheres, capsules and boxes are solid. A deformable surface
/// counts as it is at the start of its step. Models and convex bodies share their data with the world;
/// a deformable belongs to the caller, who keeps it until the body is removed.
///
/// Queries that are given a progress report the share of the pairs that are done, and end with
/// Error{interrupted} if its stop flag is set; the world is as it was then. Changes of a world, `update`
/// included, are not stopped.
///
/// One thread at a time may use a world; its own work is done in parallel (`set_threads`). Results
/// come sorted and are the same for any number of threads.
class World {
public:
    explicit World(WorldOptions options = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    /// Adds a body. Shapes are in the body's own frame, which the pose maps to the world.
    ///
    /// Errors      Error{bad_argument} if a value of pose or shape is not finite or a coordinate beyond
    ///             1e18, a quaternion has zero length, a radius is negative, or a box is empty. The
    ///             message begins with the id that the body would have had: "body 12: ".
    BodyId add(const Model& model, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Convex& convex, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Sphere& sphere, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Capsule& capsule, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Box3& box, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Deformable& surface, const BodyOptions& options = {});

    /// Moves a body. Errors as `add`: nothing has changed then; also if the id is not valid, or that of a
    /// deformable, which moves as its own step says.
    void move(BodyId body, const Pose& pose);
    /// Says that a deformable body's surface has another step. Errors, of this and what follows:
    /// Error{bad_argument} if the id is not valid.
    void refresh(BodyId body);
    /// Lists that were returned stay as they are; a query passes over bodies that have been removed.
    void remove(BodyId body);
    /// Cost        the next update finds all pairs anew.
    void set_options(BodyId body, const BodyOptions& options);
    /// What the filter says has changed. Cost as `set_options`.
    void refilter();

    [[nodiscard]] bool is_valid(BodyId body) const noexcept;
    [[nodiscard]] std::size_t size() const noexcept;
    /// Errors, of both: Error{bad_argument} if the id is not valid.
    [[nodiscard]] const Transform& world_from_body(BodyId body) const;
    /// Encloses the body: of a model that of its own box, turned.
    [[nodiscard]] Box3 box(BodyId body) const;

    /// Finds the pairs of bodies whose boxes overlap, and what has begun and ended since the last
    /// update. Every query below does so first if a body has changed since.
    void update();
    [[nodiscard]] std::vector<BodyPair> pairs() const;
    [[nodiscard]] std::vector<BodyPair> begun() const;
    [[nodiscard]] std::vector<BodyPair> ended() const; ///< also of bodies that were removed

    /// All pairs of bodies that share a point.
    ///
    /// Accuracy    of two models, of two convex bodies, and of a model and a box or a convex body,
    ///             exact; of all others, to rounding.
    std::vector<BodyPair> collide(const Progress& progress = {});
    /// The same, with how deep they go into each other, and where.
    ///
    /// Accuracy    whether they meet: as `collide`. How deep: of convex bodies, spheres, capsules and
    ///             boxes, and a model with a sphere: to rounding. Of two models, and a model and a
    ///             box or a convex body: as `penetration` (bound_only). Of a model and a capsule whose axis crosses its surface: at least the
    ///             radius (bound_only).
    std::vector<BodyGap> penetration(const Progress& progress = {});
    /// All pairs of bodies that are at most `distance` apart, and how far: exact as `distance`; 0 for
    /// models that meet, negative for other bodies.
    ///
    /// Errors      Error{bad_argument} if the distance is negative or not finite.
    std::vector<BodyGap> within(double distance, const Progress& progress = {});

    /// When bodies that move in this step first meet, each pair once, sorted. Deformables move as their
    /// steps say, while t goes from 0 to 1 as in the motions; other bodies that are not named stay
    /// where they are, and two such bodies are no pair. What meets at t = 0 has that time and no normal.
    ///
    /// Accuracy    no time is later than the first contact, and no contact is missed: as
    ///             `time_of_impact`. Two deformables: exact, as `time_of_impact`; `contact_time` is less
    ///             than 1e-9 behind the first contact.
    /// Errors      Error{bad_argument} as `time_of_impact`, naming the body; if an id is not valid, comes
    ///             twice, or is that of a deformable.
    /// Cost        of a deformable and another body, that of its triangles near the other's way; of two
    ///             deformables, that of `time_of_impact`, and of making one anew if their schemes differ.
    std::vector<BodyImpact> time_of_impact(const std::vector<BodyMotion>& motions,
                                           const ImpactOptions& options = {});

    /// How a body may move from now on: from where it is, and the time that `advance` has come to; so to
    /// be told before it is moved. At rest if never told. A body that moves otherwise is looked at
    /// anew, and so is one whose new bounds do not follow from the old ones: to say once more what is
    /// known costs nothing.
    ///
    /// Errors      Error{bad_argument} if the id is not valid or a value not finite or a bound
    ///             negative.
    void set_speed(BodyId body, const SpeedBounds& bounds);
    /// Lets time pass, to the places that the bodies have now, and returns all pairs that share a
    /// point there, sorted. Only pairs that may have met by then are looked at.
    ///
    /// Accuracy    as `collide`; deformables are left out.
    /// Errors      Error{bad_argument} if the time is negative or not finite. Error{interrupted} if the
    ///             stop flag is set: the time has passed, and `advance(0)` answers what was asked.
    /// Cost        constant for each body, a distance for each pair that is due; from time to time, a
    ///             broad phase over boxes that enclose where the bodies may go.
    /// Source      a heap of pairs by a lower bound of their time to collision, t = (sqrt(v^2 + 2 a d)
    ///             - v) / a [Lin 1993; Cohen, Lin, Manocha, Ponamgi 1995].
    std::vector<BodyPair> advance(double time, const Progress& progress = {});
    /// For so long from the last `advance` on, no pair that does not touch now can begin to, as long
    /// as the bodies keep to their bounds.
    [[nodiscard]] double next_event() const;
    [[nodiscard]] const ScheduleCounters& schedule_counters() const noexcept;

private:
    std::unique_ptr<WorldData> data_;
    std::unique_ptr<CollisionSchedule> schedule_;
};

} // namespace abut
