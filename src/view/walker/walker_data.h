#pragma once

#include "view/walker/person.h"

namespace abut {

/// The state of a person and its rules of motion.
class WalkerData {
public:
    WalkerData(Walk& walk, const Vec3& feet, const WalkerOptions& options);

    void step(const Vec3& wish, double seconds, bool duck, bool jump);
    void move_to(const Vec3& feet);
    void set_mode(WalkerMode mode);
    [[nodiscard]] WalkerMode mode() const { return mode_; }
    [[nodiscard]] const WalkerState& state() const { return state_; }
    [[nodiscard]] Person& person() { return person_; }
    [[nodiscard]] Capsule capsule() const;

private:
    [[nodiscard]] const Probe& body() const { return person_.body(state_.ducked); }
    Advance advance(const Vec3& way);
    void arrive(const Vec3& feet); ///< the end of a straight piece of the way
    void set_duck(bool duck);
    /// Frees the body from parts that it overlaps: pushes it out, or makes it thinner.
    void settle();
    bool push_out();
    bool step_aside();
    bool is_free_way(const Vec3& feet); ///< of the body's middle, straight from where it is
    void choose_thin_body();

    /// Moves of one part of a step.
    void fly(const Probe& body, Vec3 way);
    void walk(const Vec3& way);
    void fall(const Vec3& way, double seconds);
    /// Follows the ground down to the step height. Returns false if there is none.
    bool stand();
    /// Climbs a step that is in the way. Returns false, and does nothing, if it is no step.
    bool climb(const Vec3& way, double& share);
    [[nodiscard]] bool is_ground_below();

    Person person_;
    WalkerMode mode_;
    WalkerState state_;
    Vec3 ground_normal_;       ///< while on the ground
    double ground_height_ = 0; ///< of the point that the person stands on
    double rising_ = 0;        ///< upward speed in the air
    bool must_settle_ = true;  ///< the body overlaps a part
    std::size_t thin_ = 0;     ///< the thin body while squeezed
};

} // namespace abut
