#include "plot.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>

namespace abut::bench {

namespace {

constexpr double kLeft = 16, kWidth = 300, kHead = 68, kRow = 58, kWhole = 640;

constexpr const char* kStyle =
    "text { fill: #1c2733; font: 13px system-ui, 'Segoe UI', 'Liberation Sans', sans-serif; }\n"
    ".title { font-weight: 600; font-size: 15px; } .case { font-weight: 600; }\n"
    ".small { fill: #5b6875; font-size: 12px; } .ours { fill: #1f66ad; } .theirs { fill: #b9c2cc; "
    "}\n"
    ".slower { fill: #b8500f; } .ratio { font-weight: 600; font-size: 15px; text-anchor: end; }\n"
    "@media (prefers-color-scheme: dark) {\n"
    "text { fill: #e4e9ee; } .small { fill: #9aa7b4; } .ours { fill: #79b4f2; }\n"
    ".theirs { fill: #566372; } .slower { fill: #f2a05e; } .paper { fill: #14191f; }\n"
    "}\n";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        default:
            result += c;
        }
    return result;
}

std::string bar(double y, double fraction, const char* kind) {
    return fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{:.1f}\" height=\"12\" rx=\"1.5\" class=\"{}\"/>\n", kLeft,
        y, std::max(1.0, kWidth * fraction), kind);
}

std::string words(double x, double y, const char* kind, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, kind,
                       escaped(text));
}

std::string drawn(const Row& row, double y) {
    const double theirs = row.theirs.value_or(0), longest = std::max({row.ours, theirs, 1e-300});
    const double ratio = row.ratio().value_or(0), beside = kLeft + kWidth + 10;
    return words(kLeft, y, "case", row.name) +
           bar(y + 8, row.ours / longest, ratio < 1 ? "slower" : "ours") +
           words(beside, y + 18, "small", fmt::format("ours {:.4g} {}", row.ours, row.unit)) +
           bar(y + 24, theirs / longest, "theirs") +
           words(beside, y + 34, "small", fmt::format("{} {:.4g} {}", row.peer, theirs, row.unit)) +
           words(kWhole - kLeft, y, "ratio", fmt::format("{:.2f} x", ratio));
}

} // namespace

std::string plot(const Report& report) {
    std::string body;
    double y = kHead;
    for (const Row& row : report.rows)
        if (row.ratio()) {
            body += drawn(row, y);
            y += kRow;
        }
    const std::string title = "abut-bench " + report.suite + ": time beside its peers";
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
               "height=\"{1}\" role=\"img\" aria-label=\"{2}\">\n<style>\n{3}</style>\n"
               "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\" class=\"paper\"/>\n",
               kWhole, y, escaped(title), kStyle) +
           words(kLeft, 22, "title", title) + words(kLeft, 38, "small", machine()) + body +
           "</svg>\n";
}

void write_plot(const Report& report, const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    file << plot(report);
    if (!file.flush())
        throw std::runtime_error(path + ": cannot be written");
}

} // namespace abut::bench
