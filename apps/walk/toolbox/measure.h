#pragma once

#include "session/session.h"

#include <array>
#include <string>
#include <vector>

namespace abut::viewer {

enum class Measured : std::uint8_t { points, point_part, parts };

/// Exact distances between two clicks: of two parts, of a point and a part, of two points.
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

private:
    void measure_parts(Session& session, std::uint32_t a, std::uint32_t b);
};

/// "points", "point_part", "parts".
const char* to_string(Measured kind);

} // namespace abut::viewer
