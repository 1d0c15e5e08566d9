#include "ccd/feature_distance.h"

#include "ccd/scaled_patch.h"
#include "math/dyadic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Decides exactly whether two features are within a distance. The closest points of two features
/// are two vertices, or a vertex and its foot inside an edge or the face, or the feet of two lines'
/// common perpendicular inside both edges. Each such pair consists of points of the features, so
/// the features are within the distance if and only if one of these pairs is.
class ExactWithin {
public:
    ExactWithin(const std::array<Vec3, 4>& points, double distance)
        : points_{DyadicVec3(points[0]), DyadicVec3(points[1]), DyadicVec3(points[2]),
                  DyadicVec3(points[3])},
          distance_sq_(Dyadic(distance) * Dyadic(distance)) {}

    [[nodiscard]] bool edge_edge() const {
        for (std::size_t i = 0; i < 2; ++i)
            if (vertex_edge(i, 2, 3) || vertex_edge(i + 2, 0, 1))
                return true;
        return inner_lines();
    }
    [[nodiscard]] bool vertex_face() const {
        return vertex_edge(0, 1, 2) || vertex_edge(0, 2, 3) || vertex_edge(0, 3, 1) || inner_face();
    }

private:
    static bool at_most(const Dyadic& a, const Dyadic& b) { return (b - a).sign() >= 0; }

    [[nodiscard]] bool vertices(std::size_t i, std::size_t j) const {
        const DyadicVec3 w = points_[i] - points_[j];
        return at_most(dot(w, w), distance_sq_);
    }
    /// Tests the vertex against the edge's ends, and against its foot if that lies between them.
    [[nodiscard]] bool vertex_edge(std::size_t vertex, std::size_t from, std::size_t to) const {
        if (vertices(vertex, from) || vertices(vertex, to))
            return true;
        const DyadicVec3 e = points_[to] - points_[from], w = points_[vertex] - points_[from];
        const Dyadic ee = dot(e, e), along = dot(w, e);
        if (along.sign() <= 0 || !at_most(along, ee))
            return false;
        const DyadicVec3 across = cross(w, e);
        return at_most(dot(across, across), distance_sq_ * ee);
    }
    /// Returns whether x / n is in [0, 1].
    static bool in_unit(const Dyadic& x, const Dyadic& n) { return x.sign() >= 0 && at_most(x, n); }
    [[nodiscard]] bool inner_face() const {
        const DyadicVec3 u = points_[2] - points_[1], v = points_[3] - points_[1],
                         w = points_[0] - points_[1], n = cross(u, v);
        const Dyadic nn = dot(n, n), h = dot(cross(u, w), n), g = dot(cross(w, v), n),
                     height = dot(w, n);
        return nn.sign() > 0 && in_unit(h, nn) && in_unit(g, nn) && in_unit(g + h, nn) &&
               at_most(height * height, distance_sq_ * nn);
    }
    [[nodiscard]] bool inner_lines() const {
        const DyadicVec3 u = points_[1] - points_[0], v = points_[3] - points_[2],
                         r = points_[2] - points_[0], n = cross(u, v);
        const Dyadic nn = dot(n, n), height = dot(r, n);
        return nn.sign() > 0 && in_unit(dot(cross(r, v), n), nn) &&
               in_unit(dot(cross(r, u), n), nn) && at_most(height * height, distance_sq_ * nn);
    }

    std::array<DyadicVec3, 4> points_;
    Dyadic distance_sq_;
};

} // namespace

FeatureDistance feature_distance(ElementaryKind kind, const std::array<Vec3, 4>& points) {
    const ScaledPatch patch(kind, points);
    const NearestOnPatch nearest = nearest_on_patch(patch.start);
    // Unscaling rounds where the result is denormal.
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    FeatureDistance result;
    result.distance = patch.unscaled(nearest.distance);
    result.distance_sq = result.distance * result.distance;
    result.lower = std::max(0.0, patch.unscaled(nearest.lower) - kLeast);
    result.upper = patch.unscaled(nearest.upper) + kLeast;
    result.barycentric = patch_barycentric(kind, nearest.x, nearest.y);
    if (result.lower > 0)
        result.direction = nearest.direction;
    return result;
}

Vec3 common_normal(ElementaryKind kind, const std::array<Vec3, 4>& points) {
    FlatPatch patch = ScaledPatch(kind, points).start;
    const double size_x = max_abs(patch.side_x), size_y = max_abs(patch.side_y);
    // Short sides are scaled up, so that their squares do not underflow.
    const auto scaled_up = [](const Vec3& side, double size) {
        int exponent = 0;
        std::frexp(size, &exponent);
        return size > 0 ? PowerOfTwo(-exponent) * side : side;
    };
    patch.side_x = scaled_up(patch.side_x, size_x);
    patch.side_y = scaled_up(patch.side_y, size_y);
    const Vec3 n = normalized_or_zero(normal_of_patch(patch));
    if (n != Vec3{}) // a parallelogram's first side runs against the first edge
        return kind == ElementaryKind::edge_edge ? -n : n;
    const Vec3 beside = perpendicular(size_x > 0 ? patch.side_x : patch.side_y);
    return beside != Vec3{} ? beside : Vec3{1, 0, 0};
}

bool are_within(ElementaryKind kind, const std::array<Vec3, 4>& points,
                const FeatureDistance& known, double distance) {
    if (known.upper <= distance)
        return true;
    if (known.lower > distance)
        return false;
    const ExactWithin exact(points, distance);
    return kind == ElementaryKind::edge_edge ? exact.edge_edge() : exact.vertex_face();
}

} // namespace abut
