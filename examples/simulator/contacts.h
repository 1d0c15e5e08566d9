#pragma once

#include <abut/contacts.h>

#include "simulator/row.h"
#include "simulator/settings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace simulation {

/// A point where two bodies touch, or may touch in this step.
struct ContactPoint {
    std::uint64_t name = 0;  ///< ContactPoint::feature of Abut: the same from step to step
    double gap = 0;          ///< at the begin of the step; negative: penetration
    double approach = 0;     ///< speed along the normal then
    double most_push = 0;    ///< the largest impulse along the normal in this step
    Row push;                ///< along the normal, from a to b
    std::array<Row, 2> drag; ///< friction, across the normal
};

/// One region where two bodies touch.
struct Contact {
    abut::BodyPair pair;
    std::array<std::uint32_t, 2> pieces{}; ///< of compounds
    std::uint32_t region = 0;
    BodyNumber a = 0, b = 0;
    double friction = 0, bounce = 0, rolling = 0;
    Matrix roll_inertia = kZeroMatrix;  ///< the angular impulse that changes the relative spin by 1
    Vec3 roll;                          ///< angular impulse on b, accumulated over the step
    std::uint32_t first = 0, count = 0; ///< its points
    bool active = false;                ///< one of them moves, and they may touch in this step
};

/// All contacts of a step. Impulses are kept from step to step by the names of bodies, regions and
/// points.
class Contacts {
public:
    /// Replaces the contacts by those of a step. `number_of` maps the indices of ids to bodies.
    void set(std::span<const abut::ContactManifold> manifolds, std::span<const Body> bodies,
             std::span<const BodyNumber> number_of);
    /// Returns whether the bodies touch at a point, or will at their speeds within the time.
    [[nodiscard]] bool may_touch(const Contact& contact, std::span<const Body> bodies,
                                 const Settings& settings, double seconds) const;
    /// Decides which contacts take part in the step.
    void activate(std::span<const Body> bodies, const Settings& settings, double seconds);

    /// One sub-step of `h` seconds applies the impulses of the last one, then solves with the
    /// springs, and, after the bodies have moved, without them.
    void apply_known(std::span<Body> bodies) const;
    void solve(std::span<Body> bodies, const Settings& settings, double h, bool springs);
    /// Lets bodies bounce that have met in this step.
    void bounce(std::span<Body> bodies, const Settings& settings);

    [[nodiscard]] std::span<const Contact> list() const { return contacts_; }
    [[nodiscard]] std::span<const ContactPoint> points(const Contact& contact) const {
        return std::span(points_).subspan(contact.first, contact.count);
    }
    [[nodiscard]] std::size_t touching_points() const; ///< points with an impulse
    [[nodiscard]] double deepest() const;              ///< largest depth, or 0

private:
    void add(const abut::ContactManifold& manifold, BodyNumber a, BodyNumber b,
             std::span<const Body> bodies);
    void keep_impulses(std::span<const Contact> old, std::span<const ContactPoint> old_points);
    void solve_friction(const Contact& contact, Body& a, Body& b);
    void solve_rolling(Contact& contact, Body& a, Body& b) const;

    std::vector<Contact> contacts_; ///< sorted by pair and region
    std::vector<ContactPoint> points_;
};

} // namespace simulation
