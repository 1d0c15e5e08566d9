#pragma once

#include <abut/progress.h>
#include <abut/walk.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Checks the way on which a part is carried out of a plant: is there room for it?
namespace abut {

/// A part as it is carried. Its model has the world's axes, with the origin of the part's own
/// frame, so that a pose without rotation is where the part stands.
struct CarriedPart {
    Model model;
    Pose pose;        ///< where the part is now: a translation
    Transform linear; ///< the part's own rotation and scale: model = linear * mesh of the part

    /// Where a pose puts the part, as Walk::move takes it.
    [[nodiscard]] Transform world_from_part(const Pose& at) const;
};
/// Errors      as `Walk::model`.
CarriedPart carried_part(Walk& walk, WalkPart part);

struct PathOptions {
    /// A part that is not in the way, for example the one that is carried. 0: none.
    WalkPart except{};
    /// Clearances above this are not measured.
    double largest_clearance = 1;
    /// Length by which the reported clearance may exceed the least one.
    double clearance_error = 1e-3;
    /// Maximum number of distance queries for the clearance. Beyond it, PathClearance::at_least is
    /// still proven.
    std::uint64_t max_queries = 20'000;
    std::optional<double> absolute_error{}; ///< of contacts; see ImpactOptions
    Progress progress{};
};

/// A part that is met on a path.
struct PathContact {
    /// Time in poses: 3.25 is a quarter of the way from pose 3 to pose 4. The path is proven to be
    /// free of this part before.
    double time = 0;
    PartImpact impact; ///< its times count within the way between two poses
};

/// The least distance from the parts along a path.
struct PathClearance {
    /// Whether a part comes nearer than the largest clearance; if not, only `at_least` is set.
    bool found = false;
    double distance = 0; ///< attained at `time`; 0 if a part is met
    double at_least = 0; ///< a proven lower bound of the least distance
    double time = 0;     ///< in poses
    WalkPart part;
    Vec3 point_part, point_probe;
};

struct PathReport {
    std::size_t poses = 0;
    double length = 0; ///< of the way of the middle of the probe's box
    /// Parts that touch the probe at the first pose, sorted: what it stands on, or is bolted to.
    /// Such a part is met only if it touches again after a pose at which it did not.
    std::vector<WalkPart> touched_at_start;
    std::vector<PathContact> contacts; ///< the first one with each part; sorted by time
    PathClearance clearance;           ///< from all parts but those touched at the start
    [[nodiscard]] bool is_free() const { return contacts.empty(); }
};

/// Checks a path. Between two poses, the middle of the probe's box moves in a straight line and the
/// probe turns about it by the shortest arc (Motion::between).
///
/// Accuracy    contacts: continuous, as Walk::time_of_impact; none is missed between the poses. The
///             clearance is a bound for the whole path, too.
/// Errors      Error{bad_argument} if there is no pose, if a value is not finite, or if an option
///             is negative or NaN; Error{interrupted}; those of the walk.
/// Cost        that of `parts_in_way` for each pair of poses; for the clearance, some ten distance
///             queries for each length of way that equals it.
PathReport check_path(Walk& walk, const Probe& probe, std::span<const Pose> poses,
                      const PathOptions& options = {});
/// Checks the path of a part of the walk, as `carried_part` describes it.
PathReport check_path(Walk& walk, WalkPart part, std::span<const Pose> poses,
                      PathOptions options = {});

/// The report as one JSON object, with the names of the parts.
std::string to_json(const PathReport& report, Walk& walk);

} // namespace abut
