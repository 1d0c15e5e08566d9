#include "motion/motion_summary.h"

#include "arguments/common.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace abut::command {

namespace {

/// Lists no more pairs, and no more intervals of a pair, than this.
constexpr std::size_t kMostPairs = 60;
constexpr std::size_t kMostIntervals = 4;

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json finite_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

std::string name_of(const Assembly& assembly, std::uint32_t part) {
    return shown(assembly.parts.at(part).name);
}

std::string interval_lines(const std::vector<MotionInterval>& intervals, const char* word) {
    std::string text;
    for (std::size_t i = 0; i < std::min(intervals.size(), kMostIntervals); ++i)
        text += fmt::format("    {} {} s to {} s\n", word, number_below(intervals[i].start),
                            number_above(intervals[i].end));
    if (intervals.size() > kMostIntervals)
        text += fmt::format("    … and {} more\n", grouped(intervals.size() - kMostIntervals));
    return text;
}

std::string clash_text(const MotionClash& clash, const Assembly& assembly) {
    const bool contact = clash.kind == MotionClashKind::contact;
    std::string text =
        fmt::format("{} and {}: ", name_of(assembly, clash.a), name_of(assembly, clash.b));
    if (!contact)
        text += fmt::format("come within {} at {} s, never within {}\n", metres(clash.gap),
                            number(clash.gap_time), metres_below(clash.gap_at_least));
    else if (clash.status == Status::exact)
        text +=
            fmt::format("meet, {} deep at {} s{}\n", metres(clash.depth), number(clash.depth_time),
                        std::isfinite(clash.depth_at_most)
                            ? ", never more than " + metres_above(clash.depth_at_most)
                            : std::string());
    else
        text +=
            fmt::format("come within {}; whether they touch is not decided\n", metres(clash.gap));
    return text + interval_lines(clash.contacts, "contact") +
           interval_lines(clash.approaches, "near   ");
}

/// How often each part clashes.
std::string parts_text(const MotionReport& report, const Assembly& assembly) {
    struct Facts {
        std::size_t meets = 0, near = 0;
        double first = std::numeric_limits<double>::infinity();
    };
    std::map<std::uint32_t, Facts> parts;
    std::size_t width = 4;
    for (const MotionClash& clash : report.clashes)
        for (const std::uint32_t part : {clash.a, clash.b}) {
            Facts& facts = parts[part];
            const bool contact = clash.kind == MotionClashKind::contact;
            ++(contact ? facts.meets : facts.near);
            if (contact)
                facts.first = std::min(facts.first, clash.contacts.front().start);
            width = std::max(width, name_of(assembly, part).size());
        }
    std::string text = fmt::format("{:<{}}  meets  near  first contact\n", "part", width);
    std::size_t rows = 0;
    for (const auto& [part, facts] : parts) {
        if (rows++ == kMostPairs) {
            text += fmt::format("… and {} more\n", grouped(parts.size() - kMostPairs));
            break;
        }
        text +=
            fmt::format("{:<{}}  {:>5}  {:>4}  {}\n", name_of(assembly, part), width, facts.meets,
                        facts.near, facts.meets > 0 ? number_below(facts.first) + " s" : "-");
    }
    return text;
}

Json intervals_json(const std::vector<MotionInterval>& intervals) {
    Json list = Json::array();
    for (const MotionInterval& interval : intervals)
        list.push_back({{"start", interval.start},
                        {"end", interval.end},
                        {"seen", finite_or_null(interval.seen)}});
    return list;
}

Json clash_json(const MotionClash& clash, const Assembly& assembly) {
    Json samples = Json::array();
    for (const MotionSample& sample : clash.samples)
        samples.push_back({sample.time, sample.gap});
    return {{"a", assembly.parts.at(clash.a).name},
            {"b", assembly.parts.at(clash.b).name},
            {"kind", abut::to_string(clash.kind)},
            {"contacts", intervals_json(clash.contacts)},
            {"approaches", intervals_json(clash.approaches)},
            {"gap", clash.gap},
            {"gap_at_least", clash.gap_at_least},
            {"gap_time", clash.gap_time},
            {"point_a", to_json(clash.point_a)},
            {"point_b", to_json(clash.point_b)},
            {"depth", clash.depth},
            {"depth_at_most", finite_or_null(clash.depth_at_most)},
            {"depth_time", clash.depth_time},
            {"depth_point", to_json(clash.depth_point)},
            {"samples", std::move(samples)},
            {"status", to_string(clash.status)},
            {"steps", clash.steps}};
}

} // namespace

std::string motion_text(const MotionReport& report, const Assembly& assembly) {
    std::string text;
    for (std::size_t i = 0; i < std::min(report.clashes.size(), kMostPairs); ++i)
        text += clash_text(report.clashes[i], assembly);
    if (report.clashes.size() > kMostPairs)
        text += fmt::format("… and {} more pairs\n", grouped(report.clashes.size() - kMostPairs));
    if (!report.clashes.empty())
        text += "\n" + parts_text(report, assembly) + "\n";
    const auto contacts =
        std::ranges::count(report.clashes, MotionClashKind::contact, &MotionClash::kind);
    text += fmt::format("{} s to {} s: {} {}", number(report.start), number(report.end),
                        grouped(static_cast<std::uint64_t>(contacts)),
                        contacts == 1 ? "pair meets" : "pairs meet");
    if (report.clearance > 0)
        text += fmt::format(", {} more within {}",
                            grouped(report.clashes.size() - static_cast<std::uint64_t>(contacts)),
                            metres(report.clearance));
    text +=
        fmt::format("\n{} parts, {} pairs: {} without relative motion, {} joined, {} ignored, "
                    "{} measured\n",
                    grouped(assembly.parts.size()), grouped(report.pairs), grouped(report.still),
                    grouped(report.joined), grouped(report.ignored), grouped(report.near));
    return text;
}

nlohmann::ordered_json motion_json(const MotionReport& report, const Assembly& assembly) {
    Json clashes = Json::array();
    for (const MotionClash& clash : report.clashes)
        clashes.push_back(clash_json(clash, assembly));
    return {{"assembly", assembly.file},
            {"frame", describe_frame(assembly.up, assembly.file)},
            {"start", report.start},
            {"end", report.end},
            {"clearance", report.clearance},
            {"tolerance", report.tolerance},
            {"clashes", std::move(clashes)},
            {"parts", assembly.parts.size()},
            {"pairs",
             {{"all", report.pairs},
              {"still", report.still},
              {"joined", report.joined},
              {"ignored", report.ignored},
              {"measured", report.near}}},
            {"slices", report.slices},
            {"steps", report.steps}};
}

} // namespace abut::command
