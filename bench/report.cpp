#include "report.h"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

namespace abut::bench {

namespace {

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "unknown processor";
}

/// The widest instruction set that the kernels can use here. They select it at run time.
const char* instruction_set() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512bw"))
        return "AVX-512";
    if (__builtin_cpu_supports("avx2"))
        return "AVX2";
    return "SSE";
#elif defined(__aarch64__)
    return "NEON";
#else
    return "unknown instruction set";
#endif
}

std::string optional_number(const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : "-";
}

nlohmann::ordered_json optional_json(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

} // namespace

std::string machine() {
    return fmt::format("{}, {} cores, {}, g++ {}", processor(), std::thread::hardware_concurrency(),
                       instruction_set(), __VERSION__);
}

void print_table(const Report& report) {
    fmt::print("abut-bench {}: {}\n", report.suite, machine());
    fmt::print("{:<28} {:>10} {:>10} {:>7}  {:<8} {:>7}  {}\n", "case", "ours", "theirs", "ratio",
               "unit", "threads", "peer");
    for (const Row& row : report.rows) {
        fmt::print("{:<28} {:>10.4g} {:>10} {:>7}  {:<8} {:>7}  {}\n", row.name, row.ours,
                   optional_number(row.theirs),
                   row.ratio() ? fmt::format("{:.2f}", *row.ratio()) : "-", row.unit, row.threads,
                   row.peer.empty() ? "-" : row.peer);
        for (const auto& [name, value] : row.counters)
            fmt::print("    {:<40} {:.10g}\n", name, value);
    }
    for (const std::string& note : report.notes)
        fmt::print("{}\n", note);
}

void print_json(const Report& report) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Row& row : report.rows)
        rows.push_back({{"case", row.name},
                        {"ours", row.ours},
                        {"peer", row.peer.empty() ? nlohmann::ordered_json(nullptr)
                                                  : nlohmann::ordered_json(row.peer)},
                        {"theirs", optional_json(row.theirs)},
                        {"ratio", optional_json(row.ratio())},
                        {"unit", row.unit},
                        {"threads", row.threads},
                        {"counters", row.counters}});
    const nlohmann::ordered_json json{
        {"suite", report.suite}, {"machine", machine()}, {"rows", rows}};
    fmt::print("{}\n", json.dump(2));
}

} // namespace abut::bench
