#pragma once

#include "simulator/contacts.h"
#include "simulator/joints.h"

#include <span>
#include <vector>

namespace simulation {

/// Groups of bodies that touch or are joined. A group falls asleep and wakes as a whole. Static
/// bodies belong to no group: bodies on one floor are not connected by it.
class Islands {
public:
    void build(std::span<const Body> bodies, const Contacts& contacts,
               std::span<const Joint> joints, const Settings& settings, double seconds);
    /// Makes one group of those of two bodies that have met.
    void join(std::span<const Body> bodies, BodyNumber a, BodyNumber b);
    /// Returns the body that stands for a group.
    BodyNumber root(BodyNumber body);
    /// Returns whether a static body touches the body or is joined to it.
    [[nodiscard]] bool is_held(BodyNumber body) const { return is_held_[body]; }
    /// Wakes the bodies that are connected to one that is awake.
    void wake(std::span<Body> bodies);
    /// Lets groups fall asleep whose bodies have all been slow for long enough.
    void sleep(std::span<Body> bodies, const Settings& settings, double seconds);

private:
    std::vector<BodyNumber> parent_; ///< union-find
    std::vector<bool> is_held_;
};

} // namespace simulation
