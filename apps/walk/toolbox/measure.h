#pragma once

#include "session/session.h"
#include "toolbox/measurement.h"

#include <array>
#include <string>
#include <vector>

namespace abut::viewer {

/// Exact distances between two clicks.
struct Measure {
    bool on = false;
    Measured kind = Measured::parts;
    std::vector<Pick> picks;
    std::string result;
    std::array<Vec3, 2> ends{}; ///< the witness points
    bool has_ends = false;

    void take(Session& session, const Pick& pick);
    void clear();
    /// Off, part to part, point to part, point to point, and off again.
    void next();
    /// Forgets clicks on a part that is not there any more.
    void forget_removed(const Session& session);
};

} // namespace abut::viewer
