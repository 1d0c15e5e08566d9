#include "text/clash_summary.h"

#include "arguments/common.h"
#include "text/clash_matrix.h"
#include "text/group_summary.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace abut::command {

namespace {

constexpr std::size_t kRows = 5;

/// Returns "name (type)" with the name shortened to the width of a column.
std::string label(const std::vector<Scene>& models, const Clash& clash, std::size_t side) {
    const Part& part = models[clash.model.at(side)].parts[clash.part.at(side)];
    constexpr std::size_t kLongest = 36;
    std::string name = shown(part.name);
    if (name.size() > kLongest) {
        std::size_t end = kLongest - 3;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80)
            --end; // does not cut a UTF-8 character
        name = name.substr(0, end) + "...";
    }
    return part.type.empty() ? name : fmt::format("{} ({})", name, shown(part.type));
}

/// Returns the word of a kind, padded to the width of its column.
std::string kind_text(ClashKind kind) {
    return fmt::format("{:<10}", abut::to_string(kind));
}

/// Returns kind_text, coloured by the severity of the kind.
std::string kind_column(ClashKind kind) {
    const bool is_bad =
        kind == ClashKind::hard || kind == ClashKind::contained || kind == ClashKind::undecided;
    return coloured(is_bad ? Colour::bad : Colour::doubtful, kind_text(kind));
}

/// Tells which parts of a report bound no solid.
class SurfaceParts {
public:
    explicit SurfaceParts(const ClashReport& report) : exact_(report.touch_tolerance == 0) {
        for (const ClashReport::Surfaces::Named& named : report.surfaces.first)
            parts_.emplace(named.model, named.id);
    }

    /// Returns whether a part is among those that the report names.
    [[nodiscard]] bool has(const std::vector<Scene>& models, const Clash& clash,
                           std::size_t side) const {
        const std::uint32_t model = clash.model.at(side);
        return clash.volume_error == 0 && // only solids have a common volume
               parts_.contains({model, models[model].parts[clash.part.at(side)].id});
    }
    /// Returns whether nothing has a depth: two surfaces cross, and no tolerance asks how far they go
    /// beyond each other.
    [[nodiscard]] bool lack_depth(const std::vector<Scene>& models, const Clash& clash) const {
        return exact_ && clash.kind == ClashKind::hard && has(models, clash, 0) &&
               has(models, clash, 1);
    }

private:
    bool exact_; ///< the job has no touch tolerance
    std::set<std::pair<std::uint32_t, std::string>> parts_;
};

constexpr std::size_t kNames = 29; ///< the column where the names begin

/// Formats the parts of a clash in one line, or in two if the terminal is narrower than the line.
std::string names(const std::vector<Scene>& models, const SurfaceParts& surfaces,
                  const Clash& clash) {
    const auto name = [&](std::size_t side) {
        return label(models, clash, side) +
               (surfaces.has(models, clash, side) ? " [no solid]" : "");
    };
    const std::string a = name(0), b = name(1);
    const auto columns = static_cast<std::size_t>(columns_of(stdout));
    const bool is_narrow = columns > 0 && columns < kNames + a.size() + 5 + b.size();
    return a + (is_narrow ? "\n" + std::string(kNames, ' ') : "  |  ") + b;
}

/// The depth or gap of a clash. Where nothing has a depth, the number in the report tells how far two
/// triangles, or the parts, must move to part.
std::string length_text(const std::vector<Scene>& models, const SurfaceParts& surfaces,
                        const Clash& clash) {
    const double distance = told_distance(clash);
    if (surfaces.lack_depth(models, clash))
        return "no inside";
    return distance == 0 ? "below rounding" : number(distance, 4) + " m";
}

std::string row(const std::vector<Scene>& models, const SurfaceParts& surfaces,
                const Clash& clash) {
    return fmt::format("  {} {:>14}  {}\n", kind_column(clash.kind),
                       length_text(models, surfaces, clash), names(models, surfaces, clash));
}

/// Lists the first few clashes of the wanted kinds in the order of `before`.
template <typename Before>
std::string extremes(const char* title, const ClashReport& report, const std::vector<Scene>& models,
                     const SurfaceParts& surfaces, bool (*wanted)(ClashKind), Before before) {
    std::vector<const Clash*> rows;
    for (const Clash& clash : report.clashes)
        if (wanted(clash.kind))
            rows.push_back(&clash);
    if (rows.empty())
        return {};
    const std::size_t count = std::min(kRows, rows.size());
    std::partial_sort(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count), rows.end(),
                      [&](const Clash* a, const Clash* b) {
                          // Clashes of equal rank keep the report's order.
                          return before(*a, *b) || (!before(*b, *a) && a < b);
                      });
    std::string text = fmt::format("\n{}\n", title);
    for (std::size_t i = 0; i < count; ++i)
        text += row(models, surfaces, *rows[i]);
    return text;
}

/// Counts the parts that bound no solid, and names some.
std::string surfaces_text(const ClashReport& report) {
    const ClashReport::Surfaces& surfaces = report.surfaces;
    if (surfaces.count == 0)
        return {};
    std::string named;
    const std::size_t count = std::min(kRows, surfaces.first.size());
    for (std::size_t i = 0; i < count; ++i)
        named +=
            (i == 0 ? "" : ", ") +
            shown(surfaces.first[i].name.empty() ? surfaces.first[i].id : surfaces.first[i].name);
    named += surfaces.count > count ? ", ..." : "";
    std::string text = fmt::format(
        "surfaces    {} {} no solid and contain{} nothing:", grouped(surfaces.count),
        surfaces.count == 1 ? "part bounds" : "parts bound", surfaces.count == 1 ? "s" : "");
    const auto columns = static_cast<std::size_t>(columns_of(stdout));
    const bool is_narrow = columns > 0 && columns < text.size() + 1 + named.size();
    return text + (is_narrow ? "\n            " : " ") + named + "\n";
}

/// Lists the hard clashes that have the largest volumes in common.
std::string largest(const ClashReport& report, const std::vector<Scene>& models,
                    const SurfaceParts& surfaces) {
    std::string text;
    std::size_t rows = 0;
    for (const std::uint32_t i : ranked_clashes(report)) {
        const Clash& clash = report.clashes[i];
        if (clash.kind != ClashKind::hard || clash.volume == 0 || rows++ == kRows)
            break;
        text += fmt::format("  {:>22} m3  {}\n", number(clash.volume, 4),
                            names(models, surfaces, clash));
    }
    return text.empty() ? text : "\nlargest common volumes\n" + text;
}

/// A line for each model, with its notes.
std::string models_text(const ClashReport& report) {
    std::size_t widest = 0;
    for (const auto& model : report.models)
        widest = std::max(widest, shown(model.file).size());
    std::string text;
    for (const auto& model : report.models)
        text += fmt::format("{:<{}}  {:>9} {}  {:>12} triangles  {} m a unit, {} up\n",
                            shown(model.file), widest, grouped(model.parts),
                            model.parts == 1 ? "part " : "parts", grouped(model.triangles),
                            number(model.unit), abut::to_string(model.up)) +
                in_words(model.notes, "  ");
    return text;
}

/// "0.01 mm", "up to 0.01 mm": the touch tolerance of a report.
std::string touch_text(const ClashReport& report) {
    if (report.touch_source == TouchSource::option)
        return short_length(report.touch_tolerance);
    if (report.touch_source == TouchSource::none)
        return "0 m: exact";
    return (report.least_touch_tolerance < report.touch_tolerance ? "up to " : "") +
           short_length(report.touch_tolerance);
}

/// Says where a touch tolerance comes from that the command line did not name. Empty if it did.
std::string touch_source_text(const ClashReport& report) {
    if (report.touch_source != TouchSource::precision &&
        report.touch_source != TouchSource::rounding)
        return {};
    const std::filesystem::path file(report.touch_file);
    const std::string name = shown(file.filename().string());
    std::string type = file.extension().string();
    std::ranges::transform(type, type.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr double kDefaultOfIfc = 1e-5; // metres, of a file that states none
    std::string words;
    if (report.touch_source == TouchSource::rounding)
        words = "the rounding of the coordinates of ";
    else if (type.starts_with(".ifc"))
        words = report.touch_tolerance == kDefaultOfIfc ? "IFC's default, or as stated in "
                                                        : "the precision that is stated in ";
    else
        words = "the step between the coordinates of ";
    return fmt::format("touch is    {}{}\n", words, name);
}

} // namespace

std::string touch_in_words(const std::optional<double>& touch_tolerance) {
    return touch_tolerance ? short_length(*touch_tolerance) : "of the files";
}

std::string summary(const ClashReport& report, const std::vector<Scene>& models,
                    bool rules_have_clearances) {
    std::string text = models_text(report);
    for (const std::string& warning : report.warnings)
        text += fmt::format("warning: {}\n", shown(warning));
    text += fmt::format("\nframe       metres, {} up, as {}\nclearance {}, touch {}; "
                        "{} candidate pairs\n",
                        abut::to_string(report.frame.up), shown(report.frame.of),
                        rules_have_clearances
                            ? fmt::format("of the rules (else {})", metres(report.clearance))
                            : metres(report.clearance),
                        touch_text(report), grouped(report.candidates)) +
            touch_source_text(report);
    for (const ClashKind kind : kClashKinds) {
        const std::uint64_t count = report.counts.at(static_cast<std::size_t>(kind));
        if (kind == ClashKind::undecided && count == 0)
            continue;
        const std::string column = count > 0 ? kind_column(kind) : kind_text(kind);
        text += fmt::format("  {} {:>9}\n", column, grouped(count));
    }
    text += left_out_text(report);
    text += surfaces_text(report);
    if (report.statuses) {
        std::string counts;
        for (const ClashStatus status : kClashStatuses)
            counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", abut::to_string(status),
                                  grouped(report.statuses->at(static_cast<std::size_t>(status))));
        text += fmt::format("status      {}\n", counts);
    }

    if (report.matrix)
        text += drawn(*report.matrix);
    text += group_summary(report);
    const SurfaceParts surfaces(report);
    text += largest(report, models, surfaces);
    const auto nearer = [](const Clash& a, const Clash& b) { return a.distance < b.distance; };
    // Clashes without a depth come last, whatever their number.
    const auto deeper = [&](const Clash& a, const Clash& b) {
        const bool lacks_a = surfaces.lack_depth(models, a),
                   lacks_b = surfaces.lack_depth(models, b);
        return lacks_a != lacks_b ? lacks_b : a.distance < b.distance;
    };
    text += extremes(
        "deepest", report, models, surfaces,
        [](ClashKind kind) { return kind == ClashKind::hard || kind == ClashKind::contained; },
        deeper);
    text += extremes(
        "nearest", report, models, surfaces,
        [](ClashKind kind) { return kind == ClashKind::clearance; }, nearer);

    const auto& s = report.seconds;
    text += fmt::format("\nseconds     import {:.2f}, build {:.2f}, broad {:.2f}, narrow {:.2f}, "
                        "total {:.2f}\npeak memory {:.0f} MiB\n",
                        s.import, s.build, s.broad, s.narrow, s.total, report.peak_rss_mib);
    return text;
}

} // namespace abut::command
