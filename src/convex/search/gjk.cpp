#include "convex/search/gjk.h"

#include "convex/hull/climb.h"
#include "geometry/point_triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace abut {

namespace {

/// The corners of a simplex in the pair's frame, and the point of their hull nearest to the origin.
class PlacedSimplex {
public:
    PlacedSimplex(const PolytopePair& pair, const DifferenceSimplex& start, double rounding)
        : pair_(&pair), rounding_(rounding) {
        for (std::uint32_t i = 0; i < start.count; ++i)
            add(start.corners[i]);
        measure();
    }

    [[nodiscard]] bool holds(const VertexPair& corner) const {
        return std::find(s_.corners.begin(), s_.corners.begin() + s_.count, corner) !=
               s_.corners.begin() + s_.count;
    }
    [[nodiscard]] bool holds_origin() const { return holds_origin_; }
    [[nodiscard]] const Vec3& gap() const { return gap_; }
    [[nodiscard]] double distance_sq() const { return length_sq(gap_); }
    [[nodiscard]] const DifferenceSimplex& simplex() const { return s_; }
    [[nodiscard]] Vec3 difference(const VertexPair& corner) const {
        return pair_->b.vertex(corner.b) - pair_->a.vertex(corner.a);
    }
    [[nodiscard]] Vec3 point_a() const {
        Vec3 p;
        for (std::uint32_t i = 0; i < s_.count; ++i)
            p = p + s_.weights[i] * pair_->a.vertex(s_.corners[i].a);
        return p;
    }
    /// Returns whether the origin lies inside four corners, whatever rounding has done to them.
    [[nodiscard]] bool surely_holds_origin() const {
        if (!holds_origin_)
            return false;
        double size_sq = 0;
        for (const Vec3& p : at_)
            size_sq = std::max(size_sq, length_sq(p));
        // A volume is a normal times a corner, where each of three corners is off by at most e. The
        // normal, from differences, is off by 8 e size, and the product by 12 e size^2. Rounding of
        // the operations adds about as much.
        const double error = 32 * (rounding_ + world_rounding(*pair_)) * size_sq;
        return size_sq > 0x1p-600 && (least_volume_ > error || most_volume_ < -error);
    }
    /// In          fewer than four corners.
    void grow(const VertexPair& corner) {
        add(corner);
        measure();
    }

private:
    void add(const VertexPair& corner) {
        at_[s_.count] = difference(corner);
        s_.corners[s_.count++] = corner;
    }

    /// Keeps the corners whose weights are positive.
    void keep(const std::array<double, 4>& weights) {
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < s_.count; ++i)
            if (weights[i] > 0) {
                s_.corners[kept] = s_.corners[i];
                at_[kept] = at_[i];
                s_.weights[kept++] = weights[i];
            }
        s_.count = kept;
    }

    void measure() {
        if (s_.count == 4) {
            measure_tetrahedron();
            return;
        }
        // Fewer corners act as a triangle of zero area.
        const std::uint32_t last = s_.count - 1;
        const Triangle t{at_[0], at_[std::min(1U, last)], at_[std::min(2U, last)]};
        const NearestOnTriangle n = nearest_on_triangle({}, t);
        gap_ = n.point;
        std::array<double, 4> weights{};
        for (std::uint32_t i = 0; i < 3; ++i)
            weights[std::min(i, last)] += n.weights[i];
        keep(weights);
    }

    /// Sets the weights of the origin, by shares of the volume; returns whether they are those of a
    /// point inside.
    bool measure_inside(const std::array<double, 4>& shares) {
        const double sum = shares[0] + shares[1] + shares[2] + shares[3];
        Vec3 point;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!(shares[i] >= 0))
                return false;
            s_.weights[i] = shares[i] / sum;
            point = point + s_.weights[i] * at_[i];
        }
        // The shares of a flat tetrahedron may be rounding only: the weighted sum must be the
        // origin.
        return length_sq(point) <= kRoundings * kRoundings * rounding_ * rounding_;
    }

    /// Sets the weights by shares of the volume if the origin lies inside. Otherwise by the nearest
    /// of the faces that have the origin outside. Shares that are not sound, as those of a flat
    /// tetrahedron, do not tell which faces these are: then all four are measured.
    void measure_tetrahedron() {
        constexpr std::uint32_t kOthers[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
        const auto face = [&](std::size_t i) {
            return Triangle{at_[kOthers[i][0]], at_[kOthers[i][1]], at_[kOthers[i][2]]};
        };
        std::array<double, 4> shares{}, volumes{}, weights{};
        for (std::size_t i = 0; i < 4; ++i) {
            const Triangle t = face(i);
            const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
            const double volume = -dot(normal, t[0]);
            shares[i] = volume / dot(normal, at_[i] - t[0]);
            volumes[i] = i % 2 == 0 ? volume : -volume;
        }
        const auto [least, most] = std::minmax_element(volumes.begin(), volumes.end());
        least_volume_ = *least, most_volume_ = *most;
        holds_origin_ = measure_inside(shares);
        gap_ = {};
        if (holds_origin_)
            return;
        // This only selects faces to measure; what the search proves does not rest on the shares.
        constexpr double kSound = 1e-9;
        const bool sound = std::abs(shares[0] + shares[1] + shares[2] + shares[3] - 1) < kSound &&
                           *std::min_element(shares.begin(), shares.end()) <= 0;
        double best_sq = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 4; ++i) {
            if (sound && shares[i] > 0)
                continue;
            const NearestOnTriangle n = nearest_on_triangle({}, face(i));
            if (!(n.distance_sq < best_sq))
                continue;
            best_sq = n.distance_sq;
            gap_ = n.point;
            weights = {};
            for (std::size_t k = 0; k < 3; ++k)
                weights[kOthers[i][k]] = n.weights[k];
        }
        keep(weights);
    }

    static constexpr double kRoundings = 16;
    const PolytopePair* pair_;
    double rounding_;
    DifferenceSimplex s_;
    std::array<Vec3, 4> at_{};
    Vec3 gap_;
    bool holds_origin_ = false;
    /// Six times the volumes of the four tetrahedra of the origin and three corners. All have one
    /// sign if, and only if, the origin lies inside.
    double least_volume_ = 0, most_volume_ = 0;
};

} // namespace

void add_if_new(const VertexPair& corner, DifferenceSimplex& simplex) {
    const auto end = simplex.corners.begin() + simplex.count;
    if (std::find(simplex.corners.begin(), end, corner) == end)
        simplex.corners[simplex.count++] = corner;
}

GjkState gjk(const PolytopePair& pair, const DifferenceSimplex& start, double rounding) {
    PlacedSimplex simplex(pair, start, rounding);
    GjkState state;
    state.steps = 1;
    VertexPair last{};
    const double rounding_sq = rounding * rounding;
    while (!simplex.holds_origin() && simplex.distance_sq() > rounding_sq) {
        const Vec3 gap = simplex.gap();
        const double sq = simplex.distance_sq();
        last = farthest(pair, gap);
        state.excess = std::max(0.0, sq - dot(gap, simplex.difference(last)));
        if (state.excess * state.excess <= rounding_sq * sq || simplex.holds(last))
            break;
        const PlacedSimplex before = simplex;
        simplex.grow(last);
        ++state.steps;
        if (!simplex.holds_origin() && !(simplex.distance_sq() < sq)) {
            simplex = before;
            break;
        }
    }
    state.simplex = simplex.simplex();
    state.meeting = simplex.holds_origin() || !(simplex.distance_sq() > rounding_sq);
    state.proven = simplex.surely_holds_origin();
    state.point_a = simplex.point_a();
    state.gap = simplex.gap();
    state.distance_sq = simplex.distance_sq();
    return state;
}

} // namespace abut
