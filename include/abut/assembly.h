#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/robot_description.h>
#include <abut/scene.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Assemblies in motion: parts that hang on each other by joints, with a prescribed motion, and the
/// clashes between them over time. docs/motion-of-assemblies.md explains the files and the
/// guarantees.
///
/// Lengths are metres, angles radians, times seconds. All points and axes are those *at rest*: where
/// every joint has the value 0, in the frame of the assembly.
namespace abut {

enum class AssemblyJointType : std::uint8_t {
    fixed,
    revolute,  ///< turns about the axis through the origin
    prismatic, ///< slides along the axis
    free,      ///< moves from pose to pose
};
inline constexpr std::array kAssemblyJointTypes{
    AssemblyJointType::fixed, AssemblyJointType::revolute, AssemblyJointType::prismatic,
    AssemblyJointType::free};
/// "fixed", "revolute", "prismatic", "free".
const char* to_string(AssemblyJointType type);

/// The value of a joint over time. Between two keys it changes at a constant rate. Before the first
/// and after the last key it stands still.
struct JointKeys {
    std::vector<double> times;  ///< ascending; empty: the value is always 0
    std::vector<double> values; ///< of a revolute or prismatic joint: one for each time
    /// Of a free joint: one for each time. A pose maps the part at rest to its place on its parent.
    /// Between two poses the joint's origin moves in a straight line, and the part turns about it
    /// along the shortest arc, both at constant rates (Motion::between).
    std::vector<Pose> poses;
};

/// The value of a joint follows that of another one: value = ratio * value of `part` + offset.
struct JointFollow {
    std::uint32_t part = 0; ///< whose joint is revolute or prismatic, has keys, and follows none
    double ratio = 1, offset = 0;
};

/// How a part moves on the part that it hangs on.
struct AssemblyJoint {
    AssemblyJointType type = AssemblyJointType::fixed;
    Vec3 origin;        ///< a point of the axis; of a free joint, the point that moves straight
    Vec3 axis{0, 0, 1}; ///< any length but 0
    JointLimits limits; ///< of a revolute or prismatic joint
    JointKeys keys{};
    std::optional<JointFollow> follow{};
};

struct AssemblyPart {
    std::string name; ///< unique
    std::string file; ///< of its model; may be empty
    Model model;
    Transform place; ///< maps the model to its place at rest; rigid
    /// Index of the part that it hangs on. None: it hangs on the world.
    std::optional<std::uint32_t> on{};
    AssemblyJoint joint{};
};

/// A closed chain: the coupler (a connecting rod) and the closer (a piston, a rocker) are joined by a
/// pin, whose axis is parallel to that of the coupler's joint. The loop determines the values of both
/// joints: they have no keys.
///
/// The coupler hangs on a crank by a revolute joint. The closer has a prismatic joint normal to the
/// pin's axis (a slider-crank), or a revolute joint parallel to it (a four-bar linkage). The loop
/// stays on the side on which it is at rest.
struct AssemblyLoop {
    std::uint32_t coupler = 0, closer = 0; ///< indices of parts
    Vec3 pin;                              ///< a point of the pin's axis at rest
};

struct Assembly {
    std::string file; ///< path as given; may be empty
    std::vector<AssemblyPart> parts;
    std::vector<AssemblyLoop> loops{};
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ignored{}; ///< pairs that are not tested
    UpAxis up = UpAxis::z;
};

/// Reads an assembly from a TOML or JSON file (docs/motion-of-assemblies.md). Models lie beside the
/// file; those outside its folder are read only if `allow_outside_files` is set.
///
/// Errors      Error, naming the file and the element at fault: file_not_found, unreadable,
///             malformed (also a cycle, an unknown part, a value that is not finite, an axis of
///             length 0, times that do not ascend, a value beyond its joint's limits, a table
///             without rows or with a wrong column); those of a model.
Assembly read_assembly(const std::string& path, const ReadOptions& options = {});

/// Returns the place of each part at a time: world_from_model. They define the motion: all queries
/// refer to them.
///
/// Errors      Error{bad_argument} if the assembly is not valid, the time is not finite, or a loop
///             cannot close at that time.
std::vector<Transform> part_transforms(const Assembly& assembly, double time);

/// The first and the last time of all keys. Errors as `part_transforms`, also if there are no keys.
std::pair<double, double> time_range(const Assembly& assembly);

struct MotionClashOptions {
    /// Also finds the pairs that come at most this near. 0: contacts only.
    double clearance = 0;
    /// Parts that are at most this far apart count as in contact.
    double tolerance = 1e-5;
    /// Seconds: contacts and separations of this length or shorter may be counted as one with their
    /// neighbours. 0: a thousandth of the duration.
    double step = 0;
    /// Also tests the pairs that a joint or a loop connects.
    bool joined = false;
    /// Maximum number of measurements of a pair. Further ones are coarse, see MotionClash::status.
    std::uint64_t max_steps = 20'000;
    Progress progress{};
};

/// A span of time in which a pair is in contact, or near.
struct MotionInterval {
    /// Never later than the first contact of the interval. The pair was free before.
    double start = 0;
    double end = 0; ///< never earlier than the last contact; the pair is free after it
    /// A time at which the surfaces share a point, or one part is inside the other. Infinite if
    /// none was found: the parts came within the tolerance. Of an approach: that of its least gap.
    double seen = std::numeric_limits<double>::infinity();
};

/// The gap of a pair at a time.
struct MotionSample {
    double time = 0;
    double gap = 0; ///< 0 in contact; infinite where it exceeds the clearance
};

enum class MotionClashKind : std::uint8_t { contact, clearance };
/// "contact", "clearance".
const char* to_string(MotionClashKind kind);

/// What happens between two parts over time.
struct MotionClash {
    std::uint32_t a = 0, b = 0; ///< indices of parts, a < b
    MotionClashKind kind = MotionClashKind::contact;
    std::vector<MotionInterval> contacts;   ///< in order
    std::vector<MotionInterval> approaches; ///< within the clearance, in order; none if it is 0
    /// The least gap that was measured, and a proven lower bound of it over all times, which is
    /// within 1 % or the tolerance unless the search took too long. 0 in contact.
    double gap = 0, gap_at_least = 0;
    double gap_time = 0;   ///< of `gap`; in contact, the start of the first contact
    Vec3 point_a, point_b; ///< nearest points at that time
    /// The largest depth that was measured (see abut/penetration.h), and an upper bound of it over
    /// all times; infinite if neither part is a solid.
    double depth = 0, depth_at_most = 0;
    double depth_time = 0;             ///< of `depth`
    Vec3 depth_point;                  ///< on b at that time
    std::vector<MotionSample> samples; ///< ascending times, for charts
    /// exact: every contact was seen. bound_only: some `seen` is infinite; whether the parts touch or
    /// pass each other was not decided, and the contact is reported to be safe.
    Status status = Status::exact;
    std::uint64_t steps = 0; ///< measurements
};

struct MotionReport {
    double start = 0, end = 0;
    double clearance = 0, tolerance = 0;
    /// Contacts first, by their first time; then by the least gap.
    std::vector<MotionClash> clashes;
    std::uint64_t pairs = 0;   ///< all pairs of parts
    std::uint64_t still = 0;   ///< of them: no joint moves one relative to the other
    std::uint64_t joined = 0;  ///< of them: left out because a joint or a loop connects them
    std::uint64_t ignored = 0; ///< of them: left out on request
    std::uint64_t near = 0;    ///< of them: measured, because their swept boxes overlap
    std::uint64_t slices = 0;  ///< of time, in which the boxes were swept
    std::uint64_t steps = 0;   ///< measurements
};

/// Finds every clash between the parts of an assembly while it moves.
///
/// In/out      the motion is that of `part_transforms`. Parts that bound a solid are solid: a part
///             inside another one meets it. Pairs that do not move relative to each other are left
///             out: `find_clashes` tests them.
/// Accuracy    no contact is missed, however short, and no start is late: between two measurements a
///             bound of the relative speed proves that the pair is free. Contacts include gaps up to
///             `tolerance`. Times are those of positions in double precision.
/// Errors      as `part_transforms`; Error{bad_argument} if an option is negative or not finite, or
///             the tolerance is below the rounding of the coordinates; Error{interrupted}.
/// Cost        parallel over pairs; the result is the same for any number of threads.
/// Source      conservative advancement [Mirtich 1996] with bounds of the motion along the chain of
///             joints [Schwarzer, Saha, Latombe 2005]. Differs: bounds hold in a slice of time and
///             use the distances from the axes in it; the least gap and the largest depth are found
///             by best-first search with the same bounds [Piyavskii 1972].
MotionReport find_motion_clashes(const Assembly& assembly, const MotionClashOptions& options = {});

/// Writes one row for each contact and each approach, as CSV.
///
/// Errors      Error{cannot_write}, naming the file; Error{bad_argument} if the report names a part
///             that the assembly lacks.
void write_motion_csv(const MotionReport& report, const Assembly& assembly,
                      const std::string& path);

/// Writes one HTML page, without scripts, with a chart over time, a table of clashes and a table of
/// parts. Errors as `write_motion_csv`.
void write_motion_html(const MotionReport& report, const Assembly& assembly,
                       const std::string& path);

} // namespace abut
