#include "pieces/hull_tree.h"

#include "convex/hull/inner_ball.h"
#include "convex/hull/walkable_hull.h"
#include "core/parallel.h"
#include "geometry/point_triangle_distance.h"
#include "math/predicates.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

/// In hulls of at most this many vertices a climb from any vertex is as fast as a table.
constexpr std::size_t kNoTable = 8;
/// Maximal number of a node's children.
constexpr std::size_t kWidth = 4;

/// A hull, with the numbers of the positions of its vertices.
struct SourcedHull {
    Polytope polytope;
    std::vector<std::uint32_t> source;
    double inner_radius = 0, loss = 0;
    bool is_flat = false;
};

/// For more pairs of a point and a triangle than this, the loss is not measured.
constexpr std::size_t kMostForLoss = 1 << 20;

/// How far points lie outside the hull that was made of them.
///
/// In          `is_vertex`: by point. `known`: a bound, returned if measuring takes too long.
double loss_of(std::span<const Vec3> points, const std::vector<bool>& is_vertex,
               const HullSurface& hull, double known) {
    if (hull.vertices.size() == points.size())
        return 0;
    if (hull.dimension < 3 || points.size() * hull.triangles.size() > kMostForLoss)
        return known;
    double largest = 0;
    for (const Vec3& p : points)
        largest = std::max(largest, max_abs(p));
    double loss = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_vertex[i])
            continue;
        bool outside = false;
        double nearest_sq = std::numeric_limits<double>::infinity();
        for (const IndexTriangle& t : hull.triangles) {
            const Triangle corners{points[t[0]], points[t[1]], points[t[2]]};
            outside = outside || orient3d(corners[0], corners[1], corners[2], points[i]) > 0;
            nearest_sq =
                std::min(nearest_sq, point_triangle_distance(points[i], corners).distance_sq);
        }
        if (outside)
            loss = std::max(loss, std::sqrt(nearest_sq) * (1 + 0x1p-40) + 0x1p-50 * largest);
    }
    return loss;
}

SourcedHull hull_of(std::span<const Vec3> positions, std::span<const std::uint32_t> numbers,
                    bool is_piece) {
    std::vector<Vec3> points;
    for (const std::uint32_t v : numbers)
        points.push_back(positions[v]);
    LeftOutVertices left_out;
    HullSurface hull = walkable_hull(points, &left_out);
    std::vector<std::uint32_t> number(points.size());
    std::vector<bool> is_vertex(points.size());
    std::vector<Vec3> corners;
    SourcedHull result;
    for (const std::uint32_t p : hull.vertices) {
        is_vertex[p] = true;
        number[p] = static_cast<std::uint32_t>(corners.size());
        corners.push_back(points[p]);
        result.source.push_back(numbers[p]);
    }
    result.is_flat = hull.dimension == 2;
    result.loss = is_piece ? loss_of(points, is_vertex, hull, left_out.outside) : left_out.outside;
    for (IndexTriangle& t : hull.triangles)
        for (std::uint32_t& v : t)
            v = number[v];
    result.polytope = make_polytope(corners, hull.triangles);
    if (is_piece && hull.dimension == 3)
        result.inner_radius = inner_ball(corners, hull.triangles).radius;
    if (corners.size() > kNoTable) {
        const double resolution = std::round(2 * std::sqrt(static_cast<double>(corners.size())));
        result.polytope.starts =
            NormalTable(result.polytope, static_cast<std::uint32_t>(resolution));
    }
    return result;
}

void set_sphere(HullNode& node) {
    Box3 box;
    for (const HullVertex& v : node.hull.vertices)
        extend(box, v.at);
    node.middle = box.lower + 0.5 * (box.upper - box.lower);
    for (const HullVertex& v : node.hull.vertices)
        node.radius = std::max(node.radius, length(v.at - node.middle));
    node.radius = node.radius * (1 + 0x1p-48) + node.loss;
}

double half_area(const Box3& box) {
    const Vec3 d = box.upper - box.lower;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

class Builder {
public:
    Builder(std::span<const Vec3> positions,
            const std::vector<std::vector<std::uint32_t>>& vertices)
        : positions_(positions), vertices_(vertices), boxes_(vertices.size()) {
        for (std::size_t i = 0; i < vertices.size(); ++i)
            for (const std::uint32_t v : vertices[i])
                extend(boxes_[i], positions[v]);
    }

    HullTree run() && {
        std::vector<std::uint32_t> pieces(vertices_.size());
        std::iota(pieces.begin(), pieces.end(), 0);
        tree_.leaf_of.resize(pieces.size());
        tree_.sources.resize(pieces.size());
        tree_.nodes.emplace_back();
        levels_.push_back({0});
        part_node(0, pieces, 0);
        sources_.resize(tree_.nodes.size());
        for (auto level = levels_.rbegin(); level != levels_.rend(); ++level)
            parallel_for(level->size(), 16, [&](std::size_t i) { make_hull((*level)[i]); });
        const std::vector<std::uint32_t> of_root = sources_[0];
        for (std::size_t piece = 0; piece < pieces.size(); ++piece)
            tree_.sources[piece] = std::move(sources_[tree_.leaf_of[piece]]);
        find_leaves(of_root);
        return std::move(tree_);
    }

private:
    void part_node(std::uint32_t node, std::span<std::uint32_t> pieces, std::size_t level) {
        if (pieces.size() == 1) {
            tree_.nodes[node].piece = pieces[0];
            tree_.leaf_of[pieces[0]] = node;
            return;
        }
        const std::vector<std::span<std::uint32_t>> groups = groups_of(pieces);
        const auto child = static_cast<std::uint32_t>(tree_.nodes.size()),
                   children = static_cast<std::uint32_t>(groups.size());
        tree_.nodes[node].child = child, tree_.nodes[node].children = children;
        tree_.nodes.resize(tree_.nodes.size() + groups.size());
        levels_.resize(std::max(levels_.size(), level + 2));
        for (std::uint32_t i = 0; i < children; ++i)
            levels_[level + 1].push_back(child + i);
        for (std::uint32_t i = 0; i < children; ++i)
            part_node(child + i, groups[i], level + 1);
    }

    /// In: the children's hulls are made.
    void make_hull(std::uint32_t node) {
        HullNode& n = tree_.nodes[node];
        SourcedHull hull;
        if (n.is_leaf()) {
            hull = hull_of(positions_, vertices_[n.piece], true);
            n.inner_radius = hull.inner_radius, n.is_flat = hull.is_flat;
        } else {
            std::vector<std::uint32_t> all;
            for (std::uint32_t i = n.child; i < n.child + n.children; ++i) {
                n.loss = std::max(n.loss, tree_.nodes[i].loss);
                all.insert(all.end(), sources_[i].begin(), sources_[i].end());
                if (!tree_.nodes[i].is_leaf())
                    sources_[i] = {};
            }
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
            hull = hull_of(positions_, all, false);
        }
        n.hull = std::move(hull.polytope);
        n.loss += hull.loss;
        set_sphere(n);
        sources_[node] = std::move(hull.source);
    }

    /// Splits the pieces, and then the group with the most pieces, until there are as many groups
    /// as a node has children.
    std::vector<std::span<std::uint32_t>> groups_of(std::span<std::uint32_t> pieces) {
        std::vector<std::span<std::uint32_t>> groups{pieces};
        while (groups.size() < std::min(kWidth, pieces.size())) {
            const auto largest =
                std::max_element(groups.begin(), groups.end(),
                                 [](const auto& g, const auto& h) { return g.size() < h.size(); });
            const std::span<std::uint32_t> group = *largest;
            const std::size_t cut = part(group);
            *largest = group.first(cut);
            groups.push_back(group.subspan(cut));
        }
        return groups;
    }

    void find_leaves(const std::vector<std::uint32_t>& root_source) {
        std::vector<std::uint32_t> leaf(positions_.size());
        for (std::size_t piece = 0; piece < tree_.sources.size(); ++piece)
            for (const std::uint32_t v : tree_.sources[piece])
                leaf[v] = tree_.leaf_of[piece];
        for (const std::uint32_t v : root_source)
            tree_.leaf_at.push_back(leaf[v]);
    }

    /// Splits the pieces in two so that the sum of both boxes' areas, times their numbers of
    /// pieces, is smallest. Orders them accordingly, and returns how many belong to the first.
    std::size_t part(std::span<std::uint32_t> pieces) {
        double least = std::numeric_limits<double>::infinity();
        std::size_t cut = pieces.size() / 2;
        int best_axis = 0;
        for (int axis = 0; axis < 3; ++axis) {
            sort(pieces, axis);
            std::vector<double> area_after(pieces.size());
            Box3 box;
            for (std::size_t i = pieces.size(); i-- > 1;) {
                merge(box, pieces[i]);
                area_after[i] = half_area(box);
            }
            box = {};
            for (std::size_t i = 1; i < pieces.size(); ++i) {
                merge(box, pieces[i - 1]);
                const double cost = half_area(box) * static_cast<double>(i) +
                                    area_after[i] * static_cast<double>(pieces.size() - i);
                if (cost < least)
                    least = cost, cut = i, best_axis = axis;
            }
        }
        // Keeps the tree's depth logarithmic, whatever the pieces are.
        const std::size_t margin = pieces.size() / 16;
        sort(pieces, best_axis);
        return std::clamp(cut, std::max<std::size_t>(margin, 1),
                          pieces.size() - std::max<std::size_t>(margin, 1));
    }

    void merge(Box3& box, std::uint32_t piece) const {
        extend(box, boxes_[piece].lower);
        extend(box, boxes_[piece].upper);
    }
    void sort(std::span<std::uint32_t> pieces, int axis) const {
        const auto key = [&](std::uint32_t p) {
            return component(boxes_[p].lower, axis) + component(boxes_[p].upper, axis);
        };
        std::sort(pieces.begin(), pieces.end(), [&](std::uint32_t p, std::uint32_t q) {
            const double kp = key(p), kq = key(q);
            return kp != kq ? kp < kq : p < q;
        });
    }

    std::span<const Vec3> positions_;
    const std::vector<std::vector<std::uint32_t>>& vertices_;
    std::vector<Box3> boxes_;
    HullTree tree_;
    std::vector<std::vector<std::uint32_t>> levels_;  ///< nodes of each level, the root's first
    std::vector<std::vector<std::uint32_t>> sources_; ///< by node: the positions of its vertices
};

} // namespace

HullTree build_hull_tree(std::span<const Vec3> positions,
                         const std::vector<std::vector<std::uint32_t>>& vertices) {
    return Builder(positions, vertices).run();
}

std::size_t HullTree::bytes() const {
    std::size_t sum = sizeof(*this) + nodes.capacity() * sizeof(HullNode) +
                      (leaf_of.capacity() + leaf_at.capacity()) * sizeof(std::uint32_t) +
                      sources.capacity() * sizeof(std::vector<std::uint32_t>);
    for (const HullNode& n : nodes)
        sum += n.hull.bytes();
    for (const auto& s : sources)
        sum += s.capacity() * sizeof(std::uint32_t);
    return sum;
}

} // namespace abut
