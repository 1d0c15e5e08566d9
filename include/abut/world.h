#pragma once

#include <abut/body_id.h>
#include <abut/broad_phase.h>
#include <abut/compound.h>
#include <abut/contacts.h>
#include <abut/convex.h>
#include <abut/curved_shapes.h>
#include <abut/deformable.h>
#include <abut/model.h>
#include <abut/motion.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/rigid_shape.h>
#include <abut/shapes.h>
#include <abut/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

/// Many moving bodies: which of them meet, how near they are, and when they may meet. docs/world.md
/// explains the algorithms; docs/simulation-loop.md explains their use in a simulator.
namespace abut {

/// Decides which bodies a body can meet, and what its contacts carry.
struct BodyOptions {
    bool is_static = false;   ///< static bodies do not meet each other
    std::uint32_t groups = 1; ///< bit set: the groups that the body belongs to
    std::uint32_t mask = ~0U; ///< bit set: the groups that it meets; both bodies must agree
    std::uint64_t user_data =
        0; ///< the caller's, such as the place of a material; contacts carry it
};

struct WorldOptions {
    BroadPhaseMethod broad_phase = BroadPhaseMethod::automatic;
    /// Returns whether a pair may meet, a.index < b.index; if empty, all may. It is called from any
    /// thread. Its answers may change only together with a call of `World::refilter`.
    std::function<bool(BodyId a, BodyId b)> filter{};
};

/// The signed distance of two bodies, world frame. `penetration` and `within` tell the same one of a pair:
///
/// - If the bodies share no point, the distance of their nearest points. A model is its surface
///   here, also around a body that lies inside it.
/// - If they share a point, minus the depth. A closed model is a solid here. The depth of convex
///   bodies is the length of their shortest separating motion. That of a closed model and a ball is
///   the radius and, where the centre lies inside, the centre's distance from the surface. For the
///   other pairs with a model, World::penetration says which bound of that motion it is.
///
/// The first contact point of two convex bodies has this depth and normal too. The contacts of two models,
/// and of a model with a box or a convex body, have depths along the normals of their regions, which are
/// no such bound: where the bodies overlap deeply, they may be larger.
struct BodyGap {
    BodyId a, b;
    double distance = 0; ///< 0 if they touch; a gap below rounding is the least number above 0
    /// Witness points on the bodies: point_b = point_a + distance * normal, to rounding.
    Vec3 point_a, point_b;
    /// Unit vector from a to b. Bodies that penetrate: b moves along it. Zero where none is known:
    /// for models that only touch, and for the depth of open surfaces, whose witness points are one
    /// common point.
    Vec3 normal;
    std::uint32_t triangle_a = 0, triangle_b = 0; ///< of models; else 0
    /// exact: to rounding. bound_only: bodies of which one is a model are at least this deep in
    /// each other. For two solids, for models that coincide, and for motions across a face
    /// (World::penetration), a motion of this length separates them, but no proof excludes a shorter
    /// one. Of compounds with several pieces that meet: this motion separates only the deepest two.
    Status status = Status::exact;
    std::uint32_t piece_a = 0, piece_b = 0; ///< of compounds: the nearest pieces; else 0
};

/// The motion of a body in a step.
struct BodyMotion {
    BodyId body;
    Motion motion; ///< while t goes from 0 to 1; it starts at the body's current place, to rounding
};
/// A pair of bodies that meet in a step.
struct BodyImpact {
    BodyId a, b;
    Impact impact; ///< as `time_of_impact`; triangle numbers are 0 for bodies without triangles
    std::uint32_t piece_a = 0, piece_b = 0; ///< of compounds: the first pieces that meet; else 0
};

/// Bounds on a body's future motion. Its origin moves as x + v t + a t^2 / 2, plus the effect of
/// another acceleration of at most `acceleration_bound`. The body rotates about its origin with
/// `angular_velocity`, plus another angular velocity of at most
/// `angular_speed + angular_acceleration t`. All bounds are 0 if the motion is prescribed.
struct SpeedBounds {
    Vec3 velocity{}, acceleration{};
    double acceleration_bound = 0;
    double angular_speed = 0;        ///< radians per unit of time
    double angular_acceleration = 0; ///< radians per unit of time, squared
    Vec3 angular_velocity{};         ///< world axis, whose length is in radians per unit of time
};

/// The work of a world's collision schedule so far.
struct ScheduleCounters {
    std::uint64_t steps = 0;
    std::uint64_t pairs = 0;            ///< sum over the steps of all pairs that may ever meet
    std::uint64_t estimates = 0;        ///< of those pairs, the ones that were due
    std::uint64_t distance_queries = 0; ///< of those, the ones that boxes and planes did not decide
};

/// Whether a value can be added to a world with a pose.
template <typename Shape>
inline constexpr bool kIsRigidShape =
    std::is_convertible_v<Shape, Model> || std::is_convertible_v<Shape, Convex> ||
    std::is_convertible_v<Shape, Sphere> || std::is_convertible_v<Shape, Capsule> ||
    std::is_convertible_v<Shape, Box3> || std::is_convertible_v<Shape, Cylinder> ||
    std::is_convertible_v<Shape, Cone> || std::is_convertible_v<Shape, Ellipsoid> ||
    std::is_convertible_v<Shape, HalfSpace> || std::is_convertible_v<Shape, Compound>;

/// Which bodies a question is about.
struct BodyQuery {
    std::uint32_t groups = ~0U; ///< bit set: bodies that belong to one of these groups
    std::function<bool(BodyId body)> filter{}; ///< bodies for which it is true; if empty, all
    Progress progress{};                       ///< its stop flag ends a question
};

/// Where a ray first meets a body.
struct BodyRayHit {
    bool meet = false; ///< if false, nothing else is set
    BodyId body;
    double t = std::numeric_limits<double>::infinity(); ///< the ray's parameter
    Vec3 point;
    /// Unit vector out of the body; of a surface, towards the ray's origin. Zero if the ray begins inside
    /// a solid, or in the plane of a triangle.
    Vec3 normal;
    std::uint32_t triangle = 0; ///< of models and deformables; else 0
    std::uint32_t piece = 0;    ///< of compounds; else 0
};

/// The first body that a moving shape meets.
struct BodySweepHit {
    bool meet = false; ///< if false, only the impact's time is set: 1
    BodyId body;
    Impact impact;           ///< as `time_of_impact` of the body, a, and the shape, b
    std::uint32_t piece = 0; ///< of compounds; else 0
};

class BodyTree;
class CollisionSchedule;
class NearPairs;
class WorldData;

/// Bodies, the pairs of bodies whose boxes overlap, and exact queries on these pairs.
///
/// A model is a surface; all other shapes are solid, but a deformable surface, which counts as it is
/// at the start of its step. Models, convex bodies and deformables share their data with the world. So
/// the caller may move a `Deformable` to another variable; if it is destroyed or replaced, the body
/// stays as it was.
///
/// A compound is one body. What a query says of it holds for the union of its pieces: a pair is listed once,
/// with its nearest or first pieces, and only contacts list all pairs of pieces.
///
/// Queries with a progress report the fraction of finished pairs, and end with Error{interrupted}
/// if its stop flag is set; the world is then as `update` leaves it. Changes of a world, `update`
/// included, cannot be stopped.
///
/// Only one thread at a time may use a world; its own work is parallel (`set_threads`). Results are
/// sorted and do not depend on the number of threads.
class World {
public:
    explicit World(WorldOptions options = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    /// Adds a body. Shapes are in the body's own frame, which the pose maps to the world.
    ///
    /// Errors      Error{bad_argument} if a value of the pose or shape is not finite or a
    ///             coordinate is beyond 1e18, a quaternion has zero length, a radius or semi-axis is
    ///             negative, a cylinder's or cone's ends are equal, a normal is zero, or a box is
    ///             empty. The message begins with the id that the body would have had:
    ///             "body 12: ".
    BodyId add(const Model& model, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Convex& convex, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Sphere& sphere, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Capsule& capsule, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Box3& box, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Cylinder& cylinder, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Cone& cone, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Ellipsoid& ellipsoid, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const HalfSpace& half_space, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Compound& compound, const Pose& pose, const BodyOptions& options = {});
    BodyId add(const Deformable& surface, const BodyOptions& options = {});
    /// Nobody could move a temporary.
    BodyId add(Deformable&& surface, const BodyOptions& options = {}) = delete;
    /// Names the shapes to a program that adds something else.
    template <typename Other>
    requires(!kIsRigidShape<Other>) BodyId
        add(const Other& other, const Pose& pose, const BodyOptions& options = {});

    /// Moves a body.
    ///
    /// Errors      as `add`, and then nothing has changed. Also Error{bad_argument} if the id is
    ///             not valid or is that of a deformable, which moves only through its own steps.
    void move(BodyId body, const Pose& pose);
    /// Tells the world that a deformable body's surface has a new step.
    ///
    /// Errors      of this function and the next four: Error{bad_argument} if the id is not valid.
    void refresh(BodyId body);
    /// Removes a body. Lists that were returned before do not change; queries skip removed bodies.
    void remove(BodyId body);
    /// Cost        the next update finds all pairs anew.
    void set_options(BodyId body, const BodyOptions& options);
    [[nodiscard]] const BodyOptions& options(BodyId body) const;
    /// Changes that member of the body's options only, at no cost.
    void set_user_data(BodyId body, std::uint64_t user_data);
    /// Tells the world that the answers of its filter have changed. Cost as `set_options`.
    void refilter();

    [[nodiscard]] bool is_valid(BodyId body) const noexcept;
    [[nodiscard]] std::size_t size() const noexcept; ///< number of bodies; a compound is one
    /// One more than the largest BodyId::index that a body has or has had: how many entries an array needs
    /// that is read by index. It is often more than `size`: each piece of a compound takes an index, and that
    /// of a removed body is used again only later. It never falls; `add` may raise it.
    [[nodiscard]] std::size_t index_end() const noexcept;
    /// Errors      of this function and the next: Error{bad_argument} if the id is not valid.
    [[nodiscard]] const Transform& world_from_body(BodyId body) const;
    /// Returns a box that encloses the body. For a model, it encloses the model's own box, rotated.
    /// That of a half-space is infinite, except on the side of its plane if that is across an axis.
    [[nodiscard]] Box3 box(BodyId body) const;

    /// Finds the pairs of bodies whose boxes overlap, and those that began and ended since the last
    /// update.
    ///
    /// Every query below, from `collide` to `time_to_collision`, first updates the world, but only
    /// if a body has been added, moved, refreshed or removed since the last update, or options or
    /// the filter have changed. So several queries of bodies that stay in place belong to one
    /// update, and leave the three lists as they are. Moving a body to where it is counts as a move.
    /// A call of this function always is an update: without a change, no pair begins or ends.
    void update();
    /// Pairs whose boxes overlapped at the last update, sorted. What has changed since then shows
    /// after the next update or query.
    [[nodiscard]] std::vector<BodyPair> pairs() const;
    /// Those of `pairs` that were none at the update before the last one.
    [[nodiscard]] std::vector<BodyPair> begun() const;
    /// Pairs at the update before the last one that were none at the last one, sorted. Includes
    /// pairs of removed bodies.
    [[nodiscard]] std::vector<BodyPair> ended() const;

    /// Finds all pairs of bodies that share a point.
    ///
    /// Accuracy    exact for two models, two convex bodies, and a model with a box or a convex
    ///             body; to rounding for all others: a gap of at most 2^-46 of the sizes of both
    ///             bodies counts as contact. `penetration`, `contact_manifolds` and `within(0)` list
    ///             the same pairs, whatever was asked before.
    std::vector<BodyPair> collide(const Progress& progress = {});
    /// This overload and the next two set a list of the caller's. Its memory is used again, so that a step
    /// in which no body moves, and no more of them touch than before, allocates nothing.
    void collide(std::vector<BodyPair>& pairs, const Progress& progress = {});
    /// As `collide`, with penetration depths and witness points.
    ///
    /// Accuracy    whether bodies meet: as `collide`. The depth is correct to rounding for convex
    ///             bodies, spheres, capsules and boxes, and for a model with a sphere. For two
    ///             models, and for a model with a box or a convex body, it is that of `penetration`
    ///             (bound_only). For a closed model and a capsule, it is the radius and the distance
    ///             from the surface of the point of the axis that lies deepest inside; where the
    ///             capsule's surface has no point so deep, and where the axis crosses an open
    ///             surface, the depth in one of the triangles that it crosses (bound_only). For
    ///             cylinders, cones and ellipsoids it is correct
    ///             to 1e-12 of the size of both bodies, unless nearly equal motions along very many
    ///             directions separate them (bound_only). With a model, it is a motion across a face
    ///             that parts them from all triangles that they meet, where one is found; else the
    ///             depth in one of these (bound_only). The same holds for a box or a convex body and
    ///             an open surface. For a half-space it is correct to rounding. Two
    ///             half-spaces that meet are infinitely deep in each other, unless their normals are
    ///             opposite.
    std::vector<BodyGap> penetration(const Progress& progress = {});
    void penetration(std::vector<BodyGap>& gaps, const Progress& progress = {});
    /// Finds all pairs of bodies that are at most `distance` apart, and their signed distances
    /// (BodyGap).
    ///
    /// Accuracy    bodies that share no point: as exact as `distance`. Others: as `penetration`.
    /// Errors      Error{bad_argument} if the distance is negative or not finite.
    /// Cost        for models that meet, that of their depth.
    std::vector<BodyGap> within(double distance, const Progress& progress = {});

    /// Finds the contacts of all pairs of bodies that are at most `margin` apart: for each region
    /// where two bodies meet or are near, a normal and up to four points. Sorted by pair, then by
    /// region.
    ///
    /// In          margin: a simulator's contacts come in time if it is at least the largest speed of two
    ///             bodies towards each other, times the step. Bodies that are faster pass through
    ///             thin ones, unless `time_of_impact` stops them.
    /// Accuracy    for convex bodies, spheres, capsules, boxes: the normal is that of BodyGap, and
    ///             the first point has its depth; where more than four corners carry and those of the
    ///             last query stay, to 2^-14 of their extent. A box, a convex body or a closed convex
    ///             model with a model or deformable: depths along the normal. Other models and
    ///             deformables with each other: as `contact_manifolds` of models. A body in a closed
    ///             model, clear of its surface, is apart. A half-space with a body that has corners: up to
    ///             four of these. A model or deformable with a capsule: the capsule's ends, and
    ///             the point of `penetration` if that is deeper, or a place between the ends that
    ///             carries it. A cylinder, cone or ellipsoid with a convex body: as convex bodies, a disc
    ///             as a polygon of 16 corners. With a model or deformable: the depth below each
    ///             face, edge or vertex that it touches, to rounding; that of `penetration` if its
    ///             centre is behind the nearest face. For all others the point of `penetration`.
    /// Errors      Error{bad_argument} if the margin is negative or not finite.
    /// Cost        with a margin, a second broad phase, which is kept from step to step. Contacts
    ///             of a model or deformable are kept while both bodies stay in place.
    std::vector<ContactManifold> contact_manifolds(double margin = 0,
                                                   const Progress& progress = {});
    void contact_manifolds(std::vector<ContactManifold>& manifolds, double margin = 0,
                           const Progress& progress = {});

    /// Finds when bodies that move in this step first meet. Each pair is listed once; the list is
    /// sorted. Deformables move as their steps define, with the same t from 0 to 1 as the motions.
    /// Other bodies stay at rest, and two at rest are not tested. A pair that shares a point at
    /// t = 0 has time 0 and a zero normal; both points are one point of both bodies, to rounding. Two
    /// convex bodies that only touch there, and part or slide in the whole step, do not meet.
    ///
    /// Accuracy    as `time_of_impact`: no time is later than the first contact, and no contact is
    ///             missed. By default absolute_error is a millionth of the extent of the smaller
    ///             body at the start: of two models of its box's diagonal, of others of half of that.
    ///             A deformable meets a cylinder, cone or ellipsoid when it meets a polyhedron around
    ///             it, whose radii are at most 0.5 % larger (bound_only). For two deformables it is
    ///             exact; `contact_time` is less than 1e-9 after the first contact.
    /// Errors      Error{bad_argument} as `time_of_impact`, naming the body; also if an id is not
    ///             valid, occurs twice, or is that of a deformable, and if a motion does not start where
    ///             the body is.
    /// Cost        for a deformable and another body, that of the triangles near the other's path.
    ///             For two deformables, that of `time_of_impact`, and of rebuilding one of them if
    ///             their schemes differ.
    std::vector<BodyImpact> time_of_impact(const std::vector<BodyMotion>& motions,
                                           const ImpactOptions& options = {});

    /// Finds the first body that a ray meets: of several at the same t, the one of lowest index. Solids
    /// include their inside; models and deformables are surfaces.
    ///
    /// Accuracy    of surfaces as `first_hit` of a model: exact. Of solids to rounding.
    /// Errors      of this function and the next three: Error{bad_argument} as `first_hit` of a model, and
    ///             as `time_of_impact`; Error{interrupted} if the stop flag is set.
    /// Cost        of these four, the first one after a change builds a tree of all bodies. Then that of
    ///             the bodies whose boxes are met.
    BodyRayHit first_hit(const Ray& ray, const BodyQuery& query = {});
    /// Finds the first point of each body that a ray meets, sorted by t, then by body.
    std::vector<BodyRayHit> all_hits(const Ray& ray, const BodyQuery& query = {});
    /// Finds the bodies that share a point with a shape, sorted. As `collide` would tell it.
    std::vector<BodyId> overlaps(const RigidShape& shape, const Pose& pose,
                                 const BodyQuery& query = {});
    /// Finds the first body that a moving shape meets, where the bodies stay: of several at the same time,
    /// the one of lowest index. A deformable stays as it is at the start of its step. Accuracy as `time_of_impact`.
    BodySweepHit sweep(const RigidShape& shape, const Motion& motion, const BodyQuery& query = {},
                       const ImpactOptions& options = {});

    /// Sets bounds on the body's motion from its current place and the time of the last `advance`.
    /// Call it before `move`. A body without bounds is assumed to be at rest. The schedule tests a
    /// body anew if it moves or turns otherwise, or if its new bounds do not follow from the old
    /// ones. Repeating bounds that still hold costs nothing. A deformable needs no bounds: it is
    /// assumed to be at rest, and tested anew after each `refresh`.
    ///
    /// Errors      Error{bad_argument} if the id is not valid, a value is not finite, or a bound is
    ///             negative.
    void set_speed(BodyId body, const SpeedBounds& bounds);
    /// Lets time pass, to the current places of the bodies, and returns all pairs that share a
    /// point there, sorted. Only pairs that may have met by then are tested.
    ///
    /// Accuracy    as `collide`.
    /// Errors      Error{bad_argument} if the time is negative or not finite. Error{interrupted} if
    ///             the stop flag is set: the time has passed, and `advance(0)` then returns the
    ///             answer.
    /// Cost        that of `update`; constant for each body; for each pair that is due, the first of
    ///             four bounds that proves it apart: balls, boxes, a plane, a coarse distance. From
    ///             time to time, a broad phase over boxes that enclose the bodies' possible places.
    /// Source      a heap of pairs by a lower bound of their time to collision,
    ///             t = (sqrt(v^2 + 2 a d) - v) / a
    ///             [Lin 1993; Cohen, Lin, Manocha, Ponamgi 1995]. Differs: the speed v is that along
    ///             the direction in which the bodies are apart, if a plane or boxes prove it.
    std::vector<BodyPair> advance(double time, const Progress& progress = {});
    /// Returns a time from the last `advance`. Before it has passed, no pair that does not touch
    /// now can begin to touch, as long as the bodies keep to their bounds. It does not exceed the
    /// time up to which the schedule looks ahead, in which a body moves by about its size. Call it
    /// before the bodies are moved.
    ///
    /// Accuracy    never later than the next contact; near it if the motions are prescribed.
    /// Cost        an exact distance for each pair that could be the next; a time of impact if their
    ///             motions are prescribed.
    [[nodiscard]] double next_event();
    /// As `next_event`, however far ahead, but at most `limit`. Infinite if the bounds prove that no
    /// bodies ever meet. Where they prove it for a very long time only, it is that time.
    ///
    /// Errors      Error{bad_argument} if the limit is negative or NaN. Error{interrupted} if the
    ///             stop flag is set.
    /// Cost        as `next_event`, and a few broad phases over boxes of growing size.
    [[nodiscard]] double time_to_collision(double limit = std::numeric_limits<double>::infinity(),
                                           const Progress& progress = {});
    /// Returns a time from the last `advance`. Before it has passed, the two bodies cannot begin to
    /// touch, as long as they keep to their bounds: 0 if they touch, infinite if they can never
    /// meet or options and filter keep them apart.
    ///
    /// Errors      Error{bad_argument} if an id is not valid or the two are the same.
    /// Cost        an exact distance, unless cheaper bounds prove that they never meet.
    [[nodiscard]] double time_to_collision(BodyId a, BodyId b);
    [[nodiscard]] const ScheduleCounters& schedule_counters() const noexcept;

private:
    const BodyTree& tree();

    std::unique_ptr<WorldData> data_;
    std::unique_ptr<BodyTree> tree_; ///< null before the first question
    std::unique_ptr<CollisionSchedule> schedule_;
    std::unique_ptr<NearPairs> near_pairs_;
};

template <typename Other>
requires(!kIsRigidShape<Other>) BodyId World::add(const Other& /*other*/, const Pose& /*pose*/,
                                                  const BodyOptions& /*options*/) {
    static_assert(
        kIsRigidShape<Other>,
        "World::add takes a Model, Convex, Sphere, Capsule, Box3, Cylinder, Cone, Ellipsoid, "
        "HalfSpace or Compound with a pose, or a Deformable without one. A Mesh goes into one of "
        "these first.");
    return {};
}

} // namespace abut
