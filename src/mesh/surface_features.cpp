#include "mesh/surface_features.h"

#include <algorithm>
#include <numeric>

namespace abut {

SurfaceFeatures make_surface_features(std::size_t vertices,
                                      std::span<const IndexTriangle> triangles) {
    struct Side {
        std::uint32_t lower;
        std::uint32_t side; ///< 3 * triangle + k
    };
    const auto for_each_side = [&](const auto& visit) {
        for (std::size_t i = 0; i < triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = triangles[i][k], w = triangles[i][(k + 1) % 3];
                if (v != w)
                    visit(std::min(v, w), std::max(v, w), static_cast<std::uint32_t>(3 * i + k));
            }
    };

    // Groups the triangles' sides by their higher vertex (counting sort).
    std::vector<std::uint32_t> begin(vertices + 1);
    for_each_side([&](std::uint32_t, std::uint32_t higher, std::uint32_t) { ++begin[higher + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Side> sides(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for_each_side([&](std::uint32_t lower, std::uint32_t higher, std::uint32_t side) {
        sides[next[higher]++] = {lower, side};
    });

    // Sorts each group, so that sides with the same lower vertex are adjacent.
    const auto is_new = [](const Side* first, const Side* side) {
        return side == first || side->lower != (side - 1)->lower;
    };
    std::size_t edges = 0;
    for (std::size_t higher = 0; higher < vertices; ++higher) {
        Side *const first = sides.data() + begin[higher], *const last =
                                                              sides.data() + begin[higher + 1];
        std::sort(first, last, [](const Side& a, const Side& b) { return a.lower < b.lower; });
        for (const Side* side = first; side != last; ++side)
            edges += is_new(first, side) ? 1 : 0;
    }

    SurfaceFeatures features;
    features.edges.reserve(edges);
    features.edges_of.assign(triangles.size(), {kNoEdge, kNoEdge, kNoEdge});
    for (std::uint32_t higher = 0; higher < vertices; ++higher) {
        const Side *const first = sides.data() + begin[higher], *const last = sides.data() +
                                                                              begin[higher + 1];
        for (const Side* side = first; side != last; ++side) {
            if (is_new(first, side))
                features.edges.push_back({side->lower, higher});
            features.edges_of[side->side / 3][side->side % 3] =
                static_cast<std::uint32_t>(features.edges.size() - 1);
        }
    }
    return features;
}

} // namespace abut
