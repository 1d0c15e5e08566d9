#include "massive/work/metis_partition.h"

#include <array>
#include <metis.h>
#include <new>
#include <stdexcept>

namespace abut {

static_assert(sizeof(idx_t) == sizeof(std::int32_t));

std::vector<std::int32_t> cut_graph(std::span<const std::int32_t> weights,
                                    std::span<const GraphEdge> edges, int parts) {
    auto nodes = static_cast<idx_t>(weights.size());
    std::vector<idx_t> first(weights.size() + 1), neighbours(2 * edges.size());
    for (const GraphEdge& edge : edges)
        ++first[edge.a + 1], ++first[edge.b + 1];
    for (std::size_t i = 1; i < first.size(); ++i)
        first[i] += first[i - 1];
    std::vector<idx_t> next(first.begin(), first.end() - 1);
    const auto add = [&](std::uint32_t from, std::uint32_t to) {
        neighbours[static_cast<std::size_t>(next[from]++)] = static_cast<idx_t>(to);
    };
    for (const GraphEdge& edge : edges)
        add(edge.a, edge.b), add(edge.b, edge.a);

    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;
    options[METIS_OPTION_NUMBERING] = 0;
    idx_t constraints = 1, count = parts, cut = 0;
    std::vector<idx_t> node_weights(weights.begin(), weights.end()), part(weights.size());
    const int status = METIS_PartGraphRecursive(
        &nodes, &constraints, first.data(), neighbours.data(), node_weights.data(), nullptr,
        nullptr, &count, nullptr, nullptr, options.data(), &cut, part.data());
    if (status == METIS_ERROR_MEMORY)
        throw std::bad_alloc();
    if (status != METIS_OK)
        throw std::logic_error("METIS refused a graph");
    return part;
}

} // namespace abut
