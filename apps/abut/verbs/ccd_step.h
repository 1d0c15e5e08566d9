#pragma once

#include <abut/deformable.h>

#include "arguments/common.h"

#include <cstddef>
#include <optional>
#include <string>

namespace abut::command {

/// The result of one step of a sequence, from one keyframe to the next.
struct CcdStep {
    std::string from, to; ///< files of the two keyframes
    /// True if the triangles differ, so that there is no motion between these keyframes.
    bool topology_changed = false;
    std::size_t vertices = 0, edges = 0, triangles = 0; ///< of the later keyframe
    TestCounts impacts;
    std::optional<double> first_time; ///< of the earliest impact
    DeformableCounters counters;
    double seconds_refit = 0, seconds_detect = 0;
    double seconds = 0; ///< total, with reading and writing
};

/// Sums over a sequence.
struct CcdTotal {
    std::size_t steps = 0, topology_changes = 0;
    TestCounts impacts;
    DeformableCounters counters;
    double seconds_refit = 0, seconds_detect = 0;

    void add(const CcdStep& step);
};

/// How many edges of a keyframe share a point with a face, by how they meet.
struct CcdFrame {
    std::string file;
    std::size_t crossing = 0, touching = 0, coplanar = 0;
    double seconds = 0;

    /// The surface at the end of its step, which is the keyframe `file`.
    CcdFrame(const Deformable& surface, std::string file);
    [[nodiscard]] std::size_t all() const { return crossing + touching + coplanar; }
};

nlohmann::ordered_json describe(const CcdFrame& frame);
nlohmann::ordered_json describe(const CcdStep& step);
/// In          seconds: of the whole run, reading the first keyframe included; bytes: of the
///             surface.
nlohmann::ordered_json describe(const CcdTotal& total, double seconds, std::size_t bytes);

/// The table of steps: its head, one line per step, and the line of totals.
std::string table_head();
std::string table_row(const CcdStep& step);
std::string table_row(const CcdFrame& frame);
std::string table_row(const CcdTotal& total, double seconds);

} // namespace abut::command
