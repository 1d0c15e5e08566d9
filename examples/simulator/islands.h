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
    /// Wakes the bodies that are connected to one that is awake.
    void wake(std::span<Body> bodies);
    /// Lets groups fall asleep whose bodies have all been slow for long enough.
    void sleep(std::span<Body> bodies, const Settings& settings, double seconds);

private:
    BodyNumber root(BodyNumber body);
    void join(std::span<const Body> bodies, BodyNumber a, BodyNumber b);

    std::vector<BodyNumber> parent_; ///< union-find
};

} // namespace simulation
