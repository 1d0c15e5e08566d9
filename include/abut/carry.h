#pragma once

#include <abut/maintenance_path.h>
#include <abut/walk.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// Moves a part by hand through the others. docs/walking.md explains it.
namespace abut {

enum class CarryMode : std::uint8_t {
    through, ///< goes where it is sent, through all parts
    stop,    ///< stops at the first contact
    slide,   ///< goes on along what it meets
};

struct CarryOptions {
    CarryMode mode = CarryMode::stop;
    double clearance = 0.1; ///< parts within this distance are reported
    bool depths = true;     ///< whether depths are computed where parts overlap
    /// Most steps of all depths together, see WalkQuery::max_steps; none given: no limit. In deep
    /// overlaps a depth takes many; with 2,000 a step of a carried part stays below 16 ms.
    std::optional<std::uint64_t> depth_steps{};
    double skin = 1e-3; ///< gap that is kept to parts, as a length of way
    /// skip: parts that are not in memory stop the part that is carried, and are left out of the
    /// lists.
    MissingParts missing = MissingParts::wait;
    Progress progress{};
};

/// Where a carried part has got to, and what is around it.
struct CarryStep {
    Pose pose;
    bool blocked = false; ///< a part kept it from the pose that was asked for
    bool waits = false;   ///< parts that are not in memory did
    bool complete = true; ///< false: parts that are not in memory are missing in the lists
    std::vector<PartImpact> contacts; ///< what blocked it, in order
    /// The parts that it overlaps or touches. With depths: `distance` is minus the depth, and
    /// moving the carried part by the depth along `normal` is the way out.
    std::vector<WalkGap> touched;
    std::vector<WalkGap> near; ///< the others within the clearance
};

class CarryData;

/// A part of a walk in the hand.
///
/// Parts that touch it when it is taken, for example those that it stands on, do not hold it until
/// it has left them. The part is moved in the walk (Walk::move) with each step.
class Carry {
public:
    /// In          walk: must outlive this.
    /// Errors      as Walk::model.
    Carry(Walk& walk, WalkPart part);
    ~Carry();
    Carry(Carry&&) noexcept;
    Carry& operator=(Carry&&) noexcept;

    /// Moves the part towards a pose: the middle of its box in a straight line, turning about it by
    /// the shortest arc. Contacts are found continuously, none is missed.
    ///
    /// Errors      Error{bad_argument} if a value is not finite, a length is negative, or the part
    ///             was removed; those of the walk.
    const CarryStep& move_to(const Pose& pose, const CarryOptions& options = {});

    [[nodiscard]] WalkPart part() const;
    [[nodiscard]] const CarriedPart& carried() const;
    [[nodiscard]] const Probe& probe() const; ///< in the frame that the pose places
    [[nodiscard]] const CarryStep& state() const;

private:
    std::unique_ptr<CarryData> data_;
};

} // namespace abut
