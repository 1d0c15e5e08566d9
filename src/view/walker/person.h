#pragma once

#include <abut/walker.h>

#include "math/vector.h"

#include <vector>

namespace abut {

/// How far a body went on a way, and what stopped it.
struct Advance {
    double share = 1;      ///< of the way
    double distance = 0;   ///< along the way to what stopped it
    bool hit = false;      ///< a part stopped it: `impact`
    bool waits = false;    ///< something that is not in memory stopped it
    bool overlaps = false; ///< it overlapped a part at the start
    PartImpact impact;

    [[nodiscard]] bool is_free() const { return !hit && !waits; }
};

/// The bodies of a person, and their moves in a walk.
class Person {
public:
    Person(Walk& walk, const WalkerOptions& options);

    [[nodiscard]] const Vec3& up() const { return up_; }
    [[nodiscard]] const WalkerOptions& options() const { return options_; }
    void set_except(WalkPart part) { options_.except = part; }
    [[nodiscard]] Walk& walk() { return walk_; }
    [[nodiscard]] Capsule capsule(bool ducked) const;
    [[nodiscard]] const Probe& body(bool ducked) const { return ducked ? ducked_ : standing_; }
    /// Bodies within both capsules, each within the one before; the last is a point.
    [[nodiscard]] const std::vector<Probe>& thin_bodies() const { return thin_; }
    /// A point in all bodies, above the feet.
    [[nodiscard]] Vec3 middle(const Vec3& feet) const { return feet + middle_height_ * up_; }

    /// Moves a body from `feet` along a way, up to the first part less the skin.
    Advance advance(const Probe& body, Vec3& feet, const Vec3& way);
    /// Whether one can stand on what a body has hit: the contact is flat enough, or it is an edge
    /// and the floor behind it is.
    bool can_stand_on(const PartImpact& impact, const Vec3& feet);
    [[nodiscard]] bool is_flat(const Vec3& normal) const { return dot(normal, up_) >= flat_; }
    [[nodiscard]] Vec3 horizontal(const Vec3& v) const { return v - dot(v, up_) * up_; }
    [[nodiscard]] WalkQuery query() const;

private:
    Walk& walk_;
    WalkerOptions options_;
    Vec3 up_;
    double flat_; ///< least height of a floor's normal
    double middle_height_;
    Probe standing_, ducked_, toe_;
    std::vector<Probe> thin_;
};

} // namespace abut
