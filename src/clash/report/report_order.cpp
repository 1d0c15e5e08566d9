#include "clash/report/report_order.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace abut {

namespace {

ClashReport::Matrix matrix_of(const ClashReport& report, const ClashOptions& options) {
    ClashReport::Matrix matrix;
    for (const ClashMatrix::Group& group : options.matrix.groups)
        matrix.groups.push_back(group.name);
    std::unordered_map<std::string_view, std::size_t> by_name;
    for (const ClashMatrix::Cell& cell : options.matrix.cells) {
        by_name.emplace(cell.terms.name, matrix.cells.size());
        matrix.cells.push_back({cell.a,
                                cell.b,
                                cell.examined,
                                cell.terms.clearance.value_or(options.clearance),
                                cell.terms.severity,
                                {}});
    }
    // A rule may have the name of a cell; rules decide first.
    for (const ClashRule& rule : options.rules)
        by_name.erase(rule.name);
    for (const Clash& clash : report.clashes)
        if (const auto at = by_name.find(clash.rule); at != by_name.end())
            ++matrix.cells[at->second].counts.at(static_cast<std::size_t>(clash.kind));
    return matrix;
}

/// The worst clashes come first.
auto rank_of(const Clash& clash) {
    constexpr std::array kOrder{0, 4, 2, 3, 5, 1}; // by ClashKind
    return std::tuple(kOrder.at(static_cast<std::size_t>(clash.kind)), -clash.volume,
                      clash.distance);
}

} // namespace

std::vector<std::uint32_t> ranked_clashes(const ClashReport& report) {
    std::vector<std::uint32_t> order(report.clashes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {},
                             [&](std::uint32_t i) { return rank_of(report.clashes[i]); });
    return order;
}

void sum_up(ClashReport& report, const ClashOptions& options) {
    for (const Clash& clash : report.clashes) {
        ++report.counts.at(static_cast<std::size_t>(clash.kind));
        if (clash.neighbours)
            ++report.neighbours.at(static_cast<std::size_t>(*clash.neighbours));
    }
    if (!options.matrix.groups.empty())
        report.matrix = matrix_of(report, options);
    if (options.order == ClashOrder::part)
        return;
    std::vector<Clash> sorted;
    sorted.reserve(report.clashes.size());
    for (const std::uint32_t i : ranked_clashes(report))
        sorted.push_back(std::move(report.clashes[i]));
    report.clashes = std::move(sorted);
}

} // namespace abut
