#pragma once

#include <abut/scene.h>
#include <abut/shapes.h>
#include <abut/walk.h>

#include <cstdint>
#include <memory>
#include <vector>

/// A person who walks or flies through the parts of a walk and never passes through one.
/// docs/viewer.md explains it.
namespace abut {

enum class WalkerMode : std::uint8_t {
    walk, ///< with gravity, on floors, ramps and stairs
    fly,  ///< freely in all directions
};

/// Lengths are in the model's units (metres), angles in radians.
struct WalkerOptions {
    UpAxis up = UpAxis::z;
    WalkerMode mode = WalkerMode::walk;
    double height = 1.8, radius = 0.3; ///< of the capsule around the person
    double ducked_height = 1.0;
    double eye_height = 1.7, ducked_eye_height = 0.9; ///< above the feet
    double step_height = 0.35;                        ///< highest step that is climbed
    double steepest = 0.7853981633974483;             ///< steepest floor that can be stood on
    double gravity = 9.81;                            ///< length / second^2
    double jump_speed = 3.5;                          ///< length / second
    double skin = 0.01;                               ///< gap that is kept to parts
    /// skip: the person waits at the border of what is in memory. wait: parts are read in `step`.
    MissingParts missing = MissingParts::skip;
    WalkPart except{}; ///< a part to pass through, for example the one that is carried
};

struct WalkerState {
    Vec3 feet, eye;
    Vec3 velocity; ///< mean velocity of the last step
    /// The way of the feet in the last step, corner by corner, from where it began to `feet`.
    std::vector<Vec3> way;
    bool on_ground = false;
    bool ducked = false;
    bool blocked = false; ///< a part kept the person from going where it was sent
    bool waits = false;   ///< stopped at parts that are not in memory
    /// The person overlaps a part, for example where it was put or because a part was moved, and
    /// cannot be pushed out. Until it has room again, a thinner body moves freely, without gravity.
    bool squeezed = false;
};

class WalkerData;

/// A person, as a capsule, in a walk.
///
/// Each step consists of continuous sweeps of the capsule (Walk::sweep), so that it passes through
/// nothing at any speed and frame time. The same inputs over the same time lead to the same place,
/// to a few millimetres, however the time is divided into steps.
class Walker {
public:
    /// In          walk: must outlive the walker. feet: the lowest point of the person.
    /// Errors      Error{bad_argument} if a value is not finite, or if a length is not as its name
    ///             says; those of the walk.
    Walker(Walk& walk, const Vec3& feet, const WalkerOptions& options = {});
    ~Walker();
    Walker(Walker&&) noexcept;
    Walker& operator=(Walker&&) noexcept;

    /// Moves the person for some time, and calls Walk::move_to for its eye.
    ///
    /// In          wish: velocity that is asked for, world; only its horizontal part counts if the
    ///             person walks. duck: stays low; the person stands up again where there is room.
    ///             jump: only from the ground.
    /// Errors      Error{bad_argument} if a value is not finite, or the time is negative; those of
    ///             the walk.
    /// Cost        a few sweeps for each 25 ms of the time.
    const WalkerState& step(const Vec3& wish, double seconds, bool duck = false, bool jump = false);

    [[nodiscard]] const WalkerState& state() const;
    [[nodiscard]] Capsule capsule() const; ///< around the person now, world
    [[nodiscard]] WalkerMode mode() const;
    void set_mode(WalkerMode mode);
    void set_except(WalkPart part);
    /// Puts the person elsewhere. If that is inside a part, it is pushed out as far as its own
    /// width.
    void move_to(const Vec3& feet);

private:
    std::unique_ptr<WalkerData> data_;
};

} // namespace abut
