#include <abut/constraint_colours.h>
#include <abut/error.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

namespace abut {

namespace {

/// Colours of a round: as many as a word has bits.
constexpr std::uint32_t kColoursOfRound = 64;
constexpr std::uint32_t kMostVertex = (std::uint32_t{1} << 31) - 1;
constexpr std::uint32_t kNoColour = std::numeric_limits<std::uint32_t>::max();

template <std::size_t N>
using Constraints = std::span<const std::array<std::uint32_t, N>>;

/// One more than the largest vertex.
///
/// Errors      as colour_constraints.
template <std::size_t N>
std::size_t checked_vertices(Constraints<N> constraints, std::span<const std::uint8_t> fixed) {
    if (constraints.size() >= kNoColour)
        throw Error(ErrorCode::bad_argument, "there are 2^32 constraints or more");
    std::uint32_t largest = 0;
    for (const auto& constraint : constraints)
        largest = std::max(largest, *std::max_element(constraint.begin(), constraint.end()));
    if (largest > kMostVertex)
        throw Error(ErrorCode::bad_argument,
                    "a constraint has vertex " + std::to_string(largest) + ": 2^31 or more");
    if (!fixed.empty() && !constraints.empty() && largest >= fixed.size())
        throw Error(ErrorCode::bad_argument, "fixed: " + std::to_string(fixed.size()) +
                                                 " entries, and a constraint has vertex " +
                                                 std::to_string(largest));
    return constraints.empty() ? 0 : std::size_t{largest} + 1;
}

/// The colour of each constraint. A round gives the next 64 colours to constraints in their order,
/// and leaves those for which it has none to the next round.
template <std::size_t N>
std::vector<std::uint32_t> first_free_colours(Constraints<N> constraints,
                                              std::span<const std::uint8_t> fixed) {
    std::vector<std::uint64_t> taken(checked_vertices<N>(constraints, fixed)); // bits of a vertex
    std::vector<std::uint32_t> colours(constraints.size(), kNoColour);
    std::vector<std::uint32_t> left(constraints.size());
    std::iota(left.begin(), left.end(), 0U);
    for (std::uint32_t first = 0; !left.empty(); first += kColoursOfRound) {
        std::fill(taken.begin(), taken.end(), 0);
        std::size_t kept = 0;
        for (const std::uint32_t i : left) {
            std::uint64_t all = 0;
            for (const std::uint32_t v : constraints[i])
                all |= taken[v];
            const int colour = std::countr_one(all);
            if (colour == static_cast<int>(kColoursOfRound)) {
                left[kept++] = i;
                continue;
            }
            colours[i] = first + static_cast<std::uint32_t>(colour);
            for (const std::uint32_t v : constraints[i])
                if (fixed.empty() || fixed[v] == 0)
                    taken[v] |= std::uint64_t{1} << colour;
        }
        left.resize(kept);
    }
    return colours;
}

/// Sorts the constraints by colour, and keeps their order within a colour.
ConstraintColours grouped(std::span<const std::uint32_t> colours) {
    ConstraintColours groups;
    const std::uint32_t count =
        colours.empty() ? 0 : *std::max_element(colours.begin(), colours.end()) + 1;
    groups.begins.assign(std::size_t{count} + 1, 0);
    for (const std::uint32_t colour : colours)
        ++groups.begins[colour + 1];
    std::partial_sum(groups.begins.begin(), groups.begins.end(), groups.begins.begin());
    std::vector<std::uint32_t> next(groups.begins.begin(), groups.begins.end() - 1);
    groups.order.resize(colours.size());
    for (std::uint32_t i = 0; i < colours.size(); ++i)
        groups.order[next[colours[i]]++] = i;
    return groups;
}

/// The vertices of pairs. Those of the second surface are moved up by `offset`.
std::vector<std::array<std::uint32_t, 4>> vertices_of(std::span<const FeaturePair> pairs,
                                                      std::optional<std::uint32_t> vertices_a) {
    std::vector<std::array<std::uint32_t, 4>> list;
    list.reserve(pairs.size());
    for (const FeaturePair& pair : pairs) {
        const std::size_t first = pair.kind == ElementaryKind::edge_edge ? 2 : 1;
        std::array<std::uint32_t, 4> vertices = pair.vertices;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool is_of_b = (i < first) == pair.face_first;
            if (vertices[i] > kMostVertex || (!is_of_b && vertices_a && vertices[i] >= *vertices_a))
                throw Error(ErrorCode::bad_argument,
                            "a pair has vertex " + std::to_string(vertices[i]));
            vertices[i] += is_of_b ? vertices_a.value_or(0) : 0;
        }
        list.push_back(vertices);
    }
    return list;
}

template <std::size_t N>
ConstraintColours coloured(Constraints<N> constraints, std::span<const std::uint8_t> fixed) {
    return grouped(first_free_colours<N>(constraints, fixed));
}

} // namespace

ConstraintColours colour_constraints(std::span<const std::array<std::uint32_t, 2>> constraints,
                                     std::span<const std::uint8_t> fixed) {
    return coloured<2>(constraints, fixed);
}
ConstraintColours colour_constraints(std::span<const std::array<std::uint32_t, 3>> constraints,
                                     std::span<const std::uint8_t> fixed) {
    return coloured<3>(constraints, fixed);
}
ConstraintColours colour_constraints(std::span<const std::array<std::uint32_t, 4>> constraints,
                                     std::span<const std::uint8_t> fixed) {
    return coloured<4>(constraints, fixed);
}

ConstraintColours colour_constraints(std::span<const FeaturePair> pairs,
                                     std::span<const std::uint8_t> fixed) {
    return coloured<4>(vertices_of(pairs, std::nullopt), fixed);
}
ConstraintColours colour_constraints(std::span<const FeaturePair> pairs, std::size_t vertices_a,
                                     std::span<const std::uint8_t> fixed) {
    if (vertices_a > kMostVertex)
        throw Error(ErrorCode::bad_argument, "vertices_a: 2^31 or more");
    return coloured<4>(vertices_of(pairs, static_cast<std::uint32_t>(vertices_a)), fixed);
}

} // namespace abut
