#pragma once

#include <abut/deformable.h>
#include <abut/motion.h>

namespace abut {

/// The first impact of two deformable surfaces that do not touch at the start, in the form used for
/// two bodies.
///
/// Accuracy    as `time_of_impact`. `contact_time` is less than 1e-9 after the first contact.
Impact surface_impact(const Deformable& a, const Deformable& b);

} // namespace abut
