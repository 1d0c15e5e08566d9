#pragma once

#include <abut/contacts.h>

#include "geometry/rounded_box_distance.h"
#include "world/solids/contact_candidate.h"

#include <cstdint>
#include <span>

namespace abut {

/// What decides which candidates become contact points.
struct ContactLimits {
    double margin = 0;                     ///< candidates whose gap is larger are left out
    double rounding = 0;                   ///< error bound of a depth
    std::span<const std::uint64_t> last{}; ///< names of points of the last step
};

/// The largest depth of all candidates; minus infinity if there are none.
double deepest_of(const ContactCandidates& candidates);

/// Adds the closest or deepest points of two solids under a name, or puts them in the place of the
/// candidate that has it.
void add_witness(const SolidGap& witness, std::uint64_t name, const ContactFrame& frame,
                 ContactCandidates& candidates);

/// Writes the candidates that are within the margin, at most four as four_points chooses them, and the
/// frame's normal. The region
/// becomes 0, the status exact.
void write_points(const ContactCandidates& candidates, const ContactFrame& frame,
                  const ContactLimits& limits, ContactManifold& manifold);

} // namespace abut
