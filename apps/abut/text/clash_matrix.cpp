#include "text/clash_matrix.h"

#include "arguments/common.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <numeric>
#include <utility>
#include <vector>

namespace abut::command {

namespace {

constexpr std::size_t kLongestName = 24;

/// Returns a name shortened to a column, and how many characters it has.
std::pair<std::string, std::size_t> column_name(const std::string& name) {
    std::string text = shown(name);
    const auto is_first = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    std::size_t characters = 0, at = 0;
    for (; at < text.size(); ++at)
        if (is_first(text[at]) && characters++ == kLongestName)
            break;
    if (at < text.size())
        return {text.substr(0, at) + "…", kLongestName + 1};
    return {text, characters};
}

std::string padded(const std::pair<std::string, std::size_t>& text, std::size_t width,
                   bool to_the_right) {
    const std::string spaces(width - std::min(width, text.second), ' ');
    return to_the_right ? spaces + text.first : text.first + spaces;
}

} // namespace

std::string drawn(const ClashReport::Matrix& matrix) {
    const std::size_t groups = matrix.groups.size();
    std::vector<std::pair<std::string, std::size_t>> names;
    std::size_t widest = 0;
    for (const std::string& name : matrix.groups) {
        names.push_back(column_name(name));
        widest = std::max(widest, names.back().second);
    }
    std::vector<std::string> cells(groups * groups, "-");
    for (const ClashReport::Matrix::Cell& cell : matrix.cells) {
        const auto sum = std::accumulate(cell.counts.begin(), cell.counts.end(), std::uint64_t{0});
        const std::string text = cell.examined ? grouped(sum) : "off";
        cells.at(cell.a * groups + cell.b) = cells.at(cell.b * groups + cell.a) = text;
    }
    std::string text = "\nclash matrix\n  " + std::string(widest, ' ');
    for (const auto& name : names)
        text += "  " + padded(name, 9, true);
    text += '\n';
    for (std::size_t row = 0; row < groups; ++row) {
        text += "  " + padded(names[row], widest, false);
        for (std::size_t column = 0; column < groups; ++column) {
            const std::string& cell = cells[row * groups + column];
            const std::size_t width = std::max<std::size_t>(9, names[column].second);
            text += "  " + padded({cell, cell.size()}, width, true);
        }
        text += '\n';
    }
    return text;
}

std::string left_out_text(const ClashReport& report) {
    constexpr std::array<const char*, kLeftOut.size()> kTexts{
        "pairs that no rule or condition selects",
        "pairs that a rule ignores",
        "pairs whose cell of the matrix is off",
        "pairs of which one fills an opening of the other",
        "pairs that are connected",
        "pairs of which one covers the other",
        "pairs of one assembly",
        "contacts no deeper than tolerated",
        "clashes of kinds that are not asked for"};
    std::string text;
    for (const LeftOut reason : kLeftOut) {
        const auto index = static_cast<std::size_t>(reason);
        if (report.left_out.at(index) > 0)
            text +=
                fmt::format("  {:>20}  {}\n", grouped(report.left_out.at(index)), kTexts.at(index));
    }
    if (!text.empty())
        text = "left out\n" + text;
    std::string known;
    for (const Neighbours neighbours : kNeighbours)
        if (const auto count = report.neighbours.at(static_cast<std::size_t>(neighbours)))
            known += fmt::format("{}{} {}", known.empty() ? "" : ", ", abut::to_string(neighbours),
                                 grouped(count));
    return text + (known.empty() ? "" : fmt::format("neighbours  {} (in the report)\n", known));
}

} // namespace abut::command
