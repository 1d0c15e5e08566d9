#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace abut::bench {

/// One case of a suite: our time and the peer's time for the same work in the same run.
struct Row {
    std::string name;
    double ours = 0;
    std::string peer;             ///< empty if there is no peer
    std::optional<double> theirs; ///< in `unit`, as is `ours`
    std::string unit;
    int threads = 1;
    std::map<std::string, double> counters{};

    [[nodiscard]] std::optional<double> ratio() const {
        return theirs && ours > 0 ? std::optional(*theirs / ours) : std::nullopt;
    }
};

struct Report {
    std::string suite;
    std::vector<Row> rows;
    std::vector<std::string> notes{}; ///< remarks for the reader of the table; not in the JSON
};

/// Processor, cores, instruction set and compiler, in one line.
std::string machine();

void print_table(const Report& report);
/// Prints {suite, machine, rows: [{case, ours, peer, theirs, ratio, unit, threads, counters}]}.
/// Values that do not apply are null.
void print_json(const Report& report);

} // namespace abut::bench
