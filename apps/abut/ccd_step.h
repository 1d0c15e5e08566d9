#pragma once

#include <abut/deformable.h>

#include "common.h"

#include <cstddef>
#include <optional>
#include <string>

namespace abut::command {

/// What became of one step of a sequence, from one frame to the next.
struct CcdStep {
    std::string from, to; ///< files
    /// The triangles are others: there is no motion between these frames.
    bool topology_changed = false;
    std::size_t vertices = 0, edges = 0, triangles = 0; ///< of the later frame
    TestCounts impacts;
    std::optional<double> first_time; ///< of the earliest impact
    DeformableCounters counters;
    double seconds_refit = 0, seconds_detect = 0;
    double seconds = 0; ///< all of it, with reading and writing
};

/// Sums over a sequence.
struct CcdTotal {
    std::size_t steps = 0, topology_changes = 0;
    TestCounts impacts;
    DeformableCounters counters;
    double seconds_refit = 0, seconds_detect = 0;

    void add(const CcdStep& step);
};

nlohmann::ordered_json describe(const CcdStep& step);
/// In          seconds of the whole run, with the first frame; memory of the surface.
nlohmann::ordered_json describe(const CcdTotal& total, double seconds, std::size_t bytes);

/// The table: its head, a line a step, a last line.
std::string table_head();
std::string table_row(const CcdStep& step);
std::string table_row(const CcdTotal& total, double seconds);

} // namespace abut::command
