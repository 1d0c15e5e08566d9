#include <abut/assembly.h>

#include "assembly/part_names.h"
#include "clash/report/clash_text.h"
#include "core/atomic_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <string>
#include <string_view>

/// The page has no scripts: the chart is SVG, and its marks have titles that a browser shows under
/// the pointer. Names are untrusted text.
namespace abut {

namespace {

constexpr std::string_view kStyle = R"(
:root { --paper: #fff; --ink: #171c22; --soft: #56606c; --line: #dde1e6; --lane: #f5f6f8;
  --contact: #c3262b; --near: #d9a43b; color-scheme: light dark;
  font: 14px/1.45 system-ui, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif; }
@media (prefers-color-scheme: dark) { :root { --paper: #14171b; --ink: #e4e8ed; --soft: #9aa5b1;
  --line: #2a3038; --lane: #1b1f24; --contact: #ff7a75; --near: #e5a440; } }
body { background: var(--paper); color: var(--ink); margin: 24px auto; max-width: 1100px;
  padding: 0 16px; }
h1 { font-size: 20px; margin: 0 0 4px; } h2 { font-size: 15px; margin: 28px 0 8px; }
p { margin: 0 0 6px; } .soft { color: var(--soft); }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 500; color: var(--soft); font-size: 12px; }
th, td { padding: 3px 14px 3px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
.num { text-align: right; } .contact { color: var(--contact); }
.wide { overflow-x: auto; } td.name { overflow-wrap: anywhere; }
svg { width: 100%; height: auto; display: block; } svg text { fill: var(--ink); font-size: 12px; }
svg .tick { fill: var(--soft); font-size: 11px; } svg .lane { fill: var(--lane); }
svg .grid { stroke: var(--line); } svg .hit { fill: var(--contact); }
svg .near { fill: var(--near); opacity: 0.45; } svg .gap { fill: none; stroke: var(--ink); }
.key { display: inline-block; width: 10px; height: 10px; margin: 0 4px 0 12px; }
)";

constexpr double kLabel = 250; ///< width of the names, in units of the chart
constexpr double kWidth = 1100, kRow = 30, kLane = 22, kAxis = 26;
constexpr std::size_t kMostRows = 200; ///< of the chart and of the table

std::string escaped(std::string_view raw) {
    std::string text;
    for (const char c : valid_utf8(raw))
        switch (c) {
        case '&':
            text += "&amp;";
            break;
        case '<':
            text += "&lt;";
            break;
        case '>':
            text += "&gt;";
            break;
        case '"':
            text += "&quot;";
            break;
        default:
            text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    return text;
}

std::string length_text(double metres) {
    if (!std::isfinite(metres))
        return "not bounded";
    return metres < 1 ? fmt::format("{:.4g} mm", 1e3 * metres) : fmt::format("{:.5g} m", metres);
}

class MotionPage {
public:
    MotionPage(const MotionReport& report, const Assembly& assembly)
        : report_(report), assembly_(assembly), rows_(std::min(report.clashes.size(), kMostRows)) {}

    std::string text() {
        const std::string subject = escaped(assembly_.file.empty() ? "assembly" : assembly_.file);
        out_ = fmt::format("<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
                           "<meta name=\"viewport\" content=\"width=device-width\">\n"
                           "<title>Motion of {}</title>\n<style>{}</style>\n<h1>{}</h1>\n",
                           subject, kStyle, subject);
        add_summary();
        if (!report_.clashes.empty()) {
            add_chart();
            add_clashes();
            add_parts();
        }
        return std::move(out_);
    }

private:
    void add_summary() {
        const auto contacts =
            std::ranges::count(report_.clashes, MotionClashKind::contact, &MotionClash::kind);
        const auto near =
            std::ranges::count(report_.clashes, MotionClashKind::clearance, &MotionClash::kind);
        out_ += fmt::format("<p>From {:.6g} s to {:.6g} s: <b class=\"{}\">{} {}</b>",
                            report_.start, report_.end, contacts > 0 ? "contact" : "", contacts,
                            contacts == 1 ? "pair meets" : "pairs meet");
        if (report_.clearance > 0)
            out_ += fmt::format(", {} more within {}", near, length_text(report_.clearance));
        out_ += fmt::format(".</p>\n<p class=\"soft\">{} parts, {} pairs: {} without relative "
                            "motion, {} joined, {} ignored, {} measured.</p>\n",
                            assembly_.parts.size(), report_.pairs, report_.still, report_.joined,
                            report_.ignored, report_.near);
    }

    [[nodiscard]] double at(double time) const {
        const double duration = report_.end - report_.start;
        return kLabel + (kWidth - kLabel - 20) * (time - report_.start) / duration;
    }

    void add_chart() {
        const double height = kAxis + kRow * static_cast<double>(rows_);
        out_ += "<h2>Over time</h2>\n<p class=\"soft\"><span class=\"key\" style=\"background:"
                "var(--contact)\"></span>contact";
        if (report_.clearance > 0)
            out_ +=
                fmt::format("<span class=\"key\" style=\"background:var(--near)\"></span>within "
                            "{}; the line is the gap, 0 at the bottom",
                            length_text(report_.clearance));
        out_ += fmt::format("</p>\n<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Clashes "
                            "over time\">\n",
                            kWidth, height);
        add_axis(height);
        for (std::size_t i = 0; i < rows_; ++i)
            add_row(report_.clashes[i], kAxis + kRow * static_cast<double>(i));
        out_ += "</svg>\n";
        if (rows_ < report_.clashes.size())
            out_ +=
                fmt::format("<p class=\"soft\">… and {} more pairs, which the CSV file has.</p>\n",
                            report_.clashes.size() - rows_);
    }

    /// Marks times at steps of 1, 2 or 5 times a power of 10.
    void add_axis(double height) {
        const double duration = report_.end - report_.start;
        const double power = std::pow(10, std::floor(std::log10(duration / 5)));
        const double share = duration / 5 / power;
        const double step = power * (share < 2 ? 1 : share < 5 ? 2 : 5);
        const double first = std::ceil(report_.start / step);
        constexpr int kMostTicks = 16; // where rounding hides the steps, counting would not end
        for (int i = 0; i < kMostTicks; ++i) {
            const double n = first + i;
            if (!(n * step <= report_.end + 1e-9 * duration))
                break;
            out_ += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"18\" "
                                "y2=\"{1:.0f}\"/><text class=\"tick\" x=\"{0:.1f}\" y=\"13\" "
                                "text-anchor=\"middle\">{2:.6g} s</text>\n",
                                at(n * step), height, n * step);
        }
    }

    void add_mark(const char* kind, const MotionInterval& interval, double y,
                  const std::string& title) {
        const double from = at(interval.start);
        const double width = std::max(2.0, at(interval.end) - from);
        out_ += fmt::format("<rect class=\"{}\" x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" "
                            "height=\"{}\"><title>{}: {:.6g} s to {:.6g} s</title></rect>\n",
                            kind, from, y, width, kLane, title, interval.start, interval.end);
    }

    void add_row(const MotionClash& clash, double y) {
        std::string name = part_name(assembly_, clash.a) + " – " + part_name(assembly_, clash.b);
        const std::string title = escaped(name);
        constexpr std::size_t kMostLetters = 38;
        if (name.size() > kMostLetters) {
            std::size_t end = kMostLetters; // not within a letter of several bytes
            while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U)
                --end;
            name = name.substr(0, end) + "…";
        }
        out_ += fmt::format("<text x=\"0\" y=\"{:.1f}\">{}<title>{}</title></text><rect "
                            "class=\"lane\" x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\"/>\n",
                            y + 16, escaped(name), title, kLabel, y, kWidth - kLabel - 20, kLane);
        for (const MotionInterval& near : clash.approaches)
            add_mark("near", near, y, title);
        for (const MotionInterval& contact : clash.contacts)
            add_mark("hit", contact, y, title);
        add_gap_line(clash, y);
    }

    /// Draws the gap within each approach.
    void add_gap_line(const MotionClash& clash, double y) {
        for (const MotionInterval& near : clash.approaches) {
            std::string points;
            for (const MotionSample& sample : clash.samples)
                if (sample.time >= near.start && sample.time <= near.end)
                    points += fmt::format(
                        "{:.2f},{:.2f} ", at(sample.time),
                        y + kLane * (1 - std::min(1.0, sample.gap / report_.clearance)));
            out_ += fmt::format("<polyline class=\"gap\" points=\"{}\"/>\n", points);
        }
    }

    void add_clashes() {
        out_ += "<h2>Pairs</h2>\n<div class=\"wide\"><table><tr><th>pair<th>kind<th "
                "class=\"num\">times<th class=\"num\">first<th class=\"num\">until<th "
                "class=\"num\">least gap<th class=\"num\">at<th class=\"num\">depth<th "
                "class=\"num\">at most<th class=\"num\">at</tr>\n";
        for (std::size_t i = 0; i < rows_; ++i) {
            const MotionClash& clash = report_.clashes[i];
            const bool contact = clash.kind == MotionClashKind::contact;
            const auto& intervals = contact ? clash.contacts : clash.approaches;
            if (intervals.empty()) // not a result of find_motion_clashes
                continue;
            out_ += fmt::format(
                "<tr><td class=\"name\">{} – {}<td{}>{}{}", escaped(part_name(assembly_, clash.a)),
                escaped(part_name(assembly_, clash.b)), contact ? " class=\"contact\"" : "",
                to_string(clash.kind), clash.status == Status::exact ? "" : " (not decided)");
            out_ += fmt::format("<td class=\"num\">{}<td class=\"num\">{:.6g} s<td "
                                "class=\"num\">{:.6g} s<td class=\"num\">{}<td "
                                "class=\"num\">{:.6g} s",
                                intervals.size(), intervals.front().start, intervals.back().end,
                                length_text(clash.gap), clash.gap_time);
            out_ += contact ? fmt::format("<td class=\"num\">{}<td class=\"num\">{}<td "
                                          "class=\"num\">{:.6g} s</tr>\n",
                                          length_text(clash.depth),
                                          length_text(clash.depth_at_most), clash.depth_time)
                            : std::string("<td><td><td></tr>\n");
        }
        out_ += "</table></div>\n";
    }

    void add_parts() {
        struct Facts {
            std::size_t contacts = 0, near = 0;
            double first = std::numeric_limits<double>::infinity(), depth = 0;
            double gap = std::numeric_limits<double>::infinity();
        };
        std::map<std::uint32_t, Facts> parts;
        for (const MotionClash& clash : report_.clashes)
            for (const std::uint32_t part : {clash.a, clash.b}) {
                Facts& facts = parts[part];
                facts.gap = std::min(facts.gap, clash.gap);
                facts.depth = std::max(facts.depth, clash.depth);
                if (clash.kind == MotionClashKind::clearance) {
                    ++facts.near;
                    continue;
                }
                ++facts.contacts;
                if (!clash.contacts.empty())
                    facts.first = std::min(facts.first, clash.contacts.front().start);
            }
        out_ += "<h2>Parts</h2>\n<div class=\"wide\"><table><tr><th>part<th class=\"num\">meets<th "
                "class=\"num\">comes near<th class=\"num\">first contact<th class=\"num\">least "
                "gap<th class=\"num\">depth</tr>\n";
        for (const auto& [part, facts] : parts)
            out_ += fmt::format(
                "<tr><td class=\"name\">{}<td class=\"num\">{}<td class=\"num\">{}<td "
                "class=\"num\">{}<td class=\"num\">{}<td class=\"num\">{}</tr>\n",
                escaped(part_name(assembly_, part)), facts.contacts, facts.near,
                facts.contacts > 0 ? fmt::format("{:.6g} s", facts.first) : "",
                length_text(facts.gap), facts.contacts > 0 ? length_text(facts.depth) : "");
        out_ += "</table></div>\n";
    }

    const MotionReport& report_;
    const Assembly& assembly_;
    std::size_t rows_;
    std::string out_;
};

} // namespace

void write_motion_html(const MotionReport& report, const Assembly& assembly,
                       const std::string& path) {
    write_file_atomically(path, MotionPage(report, assembly).text());
}

} // namespace abut
