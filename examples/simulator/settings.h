#pragma once

#include "simulator/rotation.h"

namespace simulation {

/// Lengths are in metres, and suit bodies from a decimetre to a few metres.
struct Settings {
    Vec3 gravity{0, 0, -9.81};
    int substeps = 12;
    /// Bodies get contact points before they touch, at this gap. A body that moves more than half
    /// of it in a step is tested for impacts on its way.
    double margin = 0.01;
    /// Contacts are springs with this frequency and damping ratio. Against static bodies the
    /// frequency is twice as high. It is at most an eighth of the frequency of the sub-steps:
    /// stiffer springs add energy to tall stacks (docs/decisions/0038-sub-steps.md).
    double contact_hertz = 120, contact_damping = 10;
    double push_speed = 3; ///< bodies that penetrate separate at most this fast
    /// Joints are springs too, at most a quarter as fast as the sub-steps.
    double joint_hertz = 120, joint_damping = 2;
    int joint_passes = 4;      ///< over all joints, in each sub-step
    double bounce_speed = 0.5; ///< slower impacts do not bounce
    bool sleep = true;
    /// Bodies that touch each other fall asleep together, after all of them have been slower than
    /// `sleep_speed` for `sleep_after` seconds.
    double sleep_speed = 0.01, sleep_after = 0.5;
};

} // namespace simulation
