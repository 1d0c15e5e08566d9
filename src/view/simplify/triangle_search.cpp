#include "view/simplify/triangle_search.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace abut {

namespace {

constexpr std::uint32_t kLeafSize = 4;

double distance_sq_to_box(const Vec3& p, const Box3& box) {
    const auto gap = [](double v, double lower, double upper) {
        const double g = std::max({lower - v, v - upper, 0.0});
        return g * g;
    };
    return gap(p.x, box.lower.x, box.upper.x) + gap(p.y, box.lower.y, box.upper.y) +
           gap(p.z, box.lower.z, box.upper.z);
}

} // namespace

DistanceFace::DistanceFace(const Triangle& t, std::uint32_t number) : corners_(t), number_(number) {
    for (std::size_t k = 0; k < 3; ++k) {
        edges_.at(k) = t.at((k + 1) % 3) - t.at(k);
        const double sq = length_sq(edges_.at(k));
        inverse_length_sq_.at(k) = sq > 0 ? 1 / sq : 0;
    }
    const Vec3 &x = edges_[0], y = -edges_[2];
    const double xx = length_sq(x), xy = dot(x, y), yy = length_sq(y);
    const double determinant = xx * yy - xy * xy;
    if (determinant > 1e-12 * xx * yy) {
        weight_xx_ = yy / determinant;
        weight_xy_ = -xy / determinant;
        weight_yy_ = xx / determinant;
    }
}

double DistanceFace::distance_sq(const Vec3& p) const {
    const Vec3 gap = p - corners_[0];
    const Vec3 &x = edges_[0], y = -edges_[2];
    const double along_x = dot(gap, x), along_y = dot(gap, y);
    const double u = weight_xx_ * along_x + weight_xy_ * along_y,
                 v = weight_xy_ * along_x + weight_yy_ * along_y;
    if (u > 0 && v > 0 && u + v < 1)
        return length_sq(gap - u * x - v * y);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 from = p - corners_.at(k);
        const double at = std::clamp(dot(from, edges_.at(k)) * inverse_length_sq_.at(k), 0.0, 1.0);
        least = std::min(least, length_sq(from - at * edges_.at(k)));
    }
    return least;
}

std::array<double, 3> DistanceFace::weights(const Vec3& p) const {
    const Vec3 gap = p - corners_[0];
    const double along_x = dot(gap, edges_[0]), along_y = -dot(gap, edges_[2]);
    const double y = std::max(0.0, weight_xx_ * along_x + weight_xy_ * along_y);
    const double z = std::max(0.0, weight_xy_ * along_x + weight_yy_ * along_y);
    const double sum = std::max(1.0, y + z);
    return {1 - (y + z) / sum, y / sum, z / sum};
}

TriangleSearch::TriangleSearch(std::span<const Triangle> triangles) {
    faces_.reserve(triangles.size());
    for (const Triangle& t : triangles)
        faces_.emplace_back(t, static_cast<std::uint32_t>(faces_.size()));
    build(0, static_cast<std::uint32_t>(faces_.size()));
}

std::uint32_t TriangleSearch::build(std::uint32_t begin, std::uint32_t end) {
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    Node node;
    node.begin = begin, node.end = end;
    Box3 centres;
    for (std::uint32_t i = begin; i < end; ++i) {
        const Triangle& t = faces_[i].corners();
        for (const Vec3& p : t)
            extend(node.box, p);
        extend(centres, t[0] + t[1] + t[2]);
    }
    nodes_.push_back(node);
    if (end - begin <= kLeafSize)
        return at;
    const Vec3 extent = centres.upper - centres.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::uint32_t middle = (begin + end) / 2;
    const auto centre = [axis](const DistanceFace& face) {
        const Triangle& t = face.corners();
        return component(t[0], axis) + component(t[1], axis) + component(t[2], axis);
    };
    std::nth_element(
        faces_.begin() + begin, faces_.begin() + middle, faces_.begin() + end,
        [&](const DistanceFace& a, const DistanceFace& b) { return centre(a) < centre(b); });
    build(begin, middle);
    nodes_[at].right = build(middle, end);
    return at;
}

TriangleSearch::Found TriangleSearch::nearest(const Vec3& p) const {
    Found best{0, std::numeric_limits<double>::infinity()};
    visit(0, p, best);
    return best;
}

void TriangleSearch::visit(std::uint32_t at, const Vec3& p, Found& best) const {
    const Node& node = nodes_[at];
    if (node.right == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const double found = faces_[i].distance_sq(p);
            if (found < best.distance_sq)
                best = {i, found};
        }
        return;
    }
    std::uint32_t near = at + 1, far = node.right;
    double near_sq = distance_sq_to_box(p, nodes_[near].box),
           far_sq = distance_sq_to_box(p, nodes_[far].box);
    if (far_sq < near_sq) {
        std::swap(near, far);
        std::swap(near_sq, far_sq);
    }
    if (near_sq < best.distance_sq)
        visit(near, p, best);
    if (far_sq < best.distance_sq)
        visit(far, p, best);
}

} // namespace abut
