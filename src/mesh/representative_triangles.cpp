#include "mesh/representative_triangles.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace abut {

namespace {

/// Which vertices and edges already have a representative.
class Claims {
public:
    explicit Claims(const SurfaceView& surface)
        : surface_(surface), vertices_(surface.vertices), edges_(surface.features.edges.size()) {}

    void mark(std::size_t triangle, Represented bits) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (represents_vertex(bits, k))
                vertices_[surface_.triangles[triangle][k]] = true;
            if (represents_edge(bits, k))
                edges_[surface_.features.edges_of[triangle][k]] = true;
        }
    }
    /// The features that a triangle could still represent.
    [[nodiscard]] Represented unclaimed(std::size_t triangle) const {
        const IndexTriangle& v = surface_.triangles[triangle];
        const IndexTriangle& e = surface_.features.edges_of[triangle];
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            // A triangle with a repeated index has that vertex, and maybe its edge, twice; only the
            // first counts.
            const bool repeats_vertex = std::find(v.begin(), v.begin() + k, v[k]) != v.begin() + k;
            const bool repeats_edge = std::find(e.begin(), e.begin() + k, e[k]) != e.begin() + k;
            if (!vertices_[v[k]] && !repeats_vertex)
                bits |= 1U << k;
            if (e[k] != kNoEdge && !edges_[e[k]] && !repeats_edge)
                bits |= 1U << (3 + k);
        }
        return static_cast<Represented>(bits);
    }

private:
    const SurfaceView& surface_;
    std::vector<bool> vertices_, edges_;
};

std::vector<Represented> assign_maximal(const SurfaceView& surface) {
    std::vector<Represented> represented(surface.triangles.size());
    Claims claims(surface);
    for (int least = 6; least > 0; --least)
        for (std::size_t i = 0; i < represented.size(); ++i) {
            const Represented bits = claims.unclaimed(i);
            if (std::popcount(bits) < least)
                continue;
            claims.mark(i, bits);
            represented[i] |= bits;
        }
    return represented;
}

/// One use of a vertex or an edge by a triangle, which has three of each.
struct Use {
    std::uint32_t triangle;
    std::uint8_t corner;
};

/// The uses of each feature, in the order of the triangles.
class Incidence {
public:
    /// In: the three features of each triangle, each below `count` or kNoEdge.
    Incidence(std::size_t count, std::span<const IndexTriangle> features) : begin_(count + 1) {
        const auto for_each_use = [&](const auto& visit) {
            for (std::uint32_t i = 0; i < features.size(); ++i)
                for (std::uint8_t k = 0; k < 3; ++k)
                    if (features[i][k] != kNoEdge)
                        visit(features[i][k], Use{i, k});
        };
        for_each_use([&](std::uint32_t feature, Use) { ++begin_[feature + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        uses_.resize(begin_.back());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for_each_use([&](std::uint32_t feature, Use use) { uses_[next[feature]++] = use; });
    }
    [[nodiscard]] std::span<const Use> of(std::size_t feature) const {
        return std::span(uses_).subspan(begin_[feature], begin_[feature + 1] - begin_[feature]);
    }

private:
    std::vector<std::uint32_t> begin_;
    std::vector<Use> uses_;
};

constexpr unsigned kVertexBits = 0, kEdgeBits = 3;

/// Assigns each feature to the one of its triangles that represents the fewest features. Only the
/// features in the mask `counted` count.
void assign_to_least(const Incidence& incidence, std::size_t count, unsigned first_bit,
                     Represented counted, std::span<Represented> represented) {
    for (std::size_t feature = 0; feature < count; ++feature) {
        const auto uses = incidence.of(feature);
        const auto load = [&](const Use& use) {
            return std::popcount(static_cast<unsigned>(represented[use.triangle] & counted));
        };
        const auto least =
            std::min_element(uses.begin(), uses.end(),
                             [&](const Use& a, const Use& b) { return load(a) < load(b); });
        if (least != uses.end())
            represented[least->triangle] |=
                static_cast<Represented>(1U << (first_bit + least->corner));
    }
}

std::vector<Represented> assign_uniform(const SurfaceView& surface, bool vertices_with_edges) {
    constexpr Represented kVertices = 0b000111, kEdges = 0b111000;
    std::vector<Represented> represented(surface.triangles.size());
    const std::size_t edges = surface.features.edges.size();
    assign_to_least(Incidence(edges, surface.features.edges_of), edges, kEdgeBits, kEdges,
                    represented);
    assign_to_least(Incidence(surface.vertices, surface.triangles), surface.vertices, kVertexBits,
                    vertices_with_edges ? kVertices | kEdges : kVertices, represented);
    return represented;
}

void move_off(const Incidence& incidence, std::size_t count, unsigned first_bit,
              const std::vector<bool>& marked, std::span<Represented> represented) {
    for (std::size_t feature = 0; feature < count; ++feature) {
        const auto uses = incidence.of(feature);
        const auto bit = [&](const Use& use) { return 1U << (first_bit + use.corner); };
        const auto owner = std::find_if(uses.begin(), uses.end(), [&](const Use& use) {
            return (represented[use.triangle] & bit(use)) != 0;
        });
        if (owner == uses.end() || !marked[owner->triangle])
            continue;
        const auto free = std::find_if(uses.begin(), uses.end(),
                                       [&](const Use& use) { return !marked[use.triangle]; });
        if (free == uses.end())
            continue;
        represented[owner->triangle] &= static_cast<Represented>(~bit(*owner));
        represented[free->triangle] |= static_cast<Represented>(bit(*free));
    }
}

} // namespace

std::vector<Represented> assign_features(const SurfaceView& surface, Assignment assignment) {
    switch (assignment) {
    case Assignment::maximal:
        return assign_maximal(surface);
    case Assignment::uniform_vertex_edge:
        return assign_uniform(surface, true);
    case Assignment::uniform_edge_edge:
        return assign_uniform(surface, false);
    case Assignment::greedy:
    case Assignment::adaptive:
        break;
    }
    std::vector<Represented> represented(surface.triangles.size());
    complete_assignment(surface, represented);
    return represented;
}

void complete_assignment(const SurfaceView& surface, std::span<Represented> represented) {
    Claims claims(surface);
    for (std::size_t i = 0; i < represented.size(); ++i)
        claims.mark(i, represented[i]);
    for (std::size_t i = 0; i < represented.size(); ++i) {
        const Represented bits = claims.unclaimed(i);
        claims.mark(i, bits);
        represented[i] |= bits;
    }
}

void move_features_off(const SurfaceView& surface, const std::vector<bool>& marked,
                       std::span<Represented> represented) {
    const std::size_t edges = surface.features.edges.size();
    move_off(Incidence(surface.vertices, surface.triangles), surface.vertices, kVertexBits, marked,
             represented);
    move_off(Incidence(edges, surface.features.edges_of), edges, kEdgeBits, marked, represented);
}

} // namespace abut
