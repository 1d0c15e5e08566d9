#include "pieces/hull_tree.h"

#include "convex/exact_hull.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

/// Below so many vertices a climb from any is as fast as a table's answer.
constexpr std::size_t kNoTable = 8;
/// Children of a node, at most.
constexpr std::size_t kWidth = 4;

/// Some roundings of a coordinate of 1.
constexpr double kRounding = 0x1p-46;

/// A hull, and which of the points given its vertices are.
struct SourcedHull {
    Polytope polytope;
    std::vector<std::uint32_t> source;
};

/// Finds vertices of a hull that the hull of the others holds to rounding. The surface around such a
/// vertex is flat, or bends along an edge, by so little that no walk can tell which way.
class SuperfluousVertices {
public:
    SuperfluousVertices(std::span<const Vec3> points, const HullSurface& hull, double rounding)
        : points_(points), hull_(hull), rounding_(rounding), dropped_(points.size()),
          kept_(points.size()) {}

    /// Each but those that another one needs; none if there are no such.
    std::vector<bool> find() && {
        for (const IndexTriangle& t : hull_.triangles)
            drop_from_segment(t);
        if (!any_ && hull_.dimension == 3)
            drop_from_faces();
        if (!any_)
            dropped_.clear();
        return std::move(dropped_);
    }

private:
    /// A corner that lies on the segment between the others.
    void drop_from_segment(const IndexTriangle& t) {
        std::size_t k = 0; // the longest side runs from corner k
        const auto side = [&](std::size_t i) { return points_[t[(i + 1) % 3]] - points_[t[i]]; };
        for (std::size_t i = 1; i < 3; ++i)
            if (length_sq(side(i)) > length_sq(side(k)))
                k = i;
        const std::uint32_t middle = t[(k + 2) % 3];
        const double area = length(cross(side(k), points_[middle] - points_[t[k]]));
        if (area <= rounding_ * length(side(k)))
            drop(middle, std::array{t[k], t[(k + 1) % 3]});
    }

    /// A vertex in the middle of triangles that lie in one plane, and face one way.
    void drop_from_faces() {
        std::vector<std::vector<std::uint32_t>> triangles_at(points_.size());
        for (std::uint32_t i = 0; i < hull_.triangles.size(); ++i)
            for (const std::uint32_t v : hull_.triangles[i])
                triangles_at[v].push_back(i);
        for (std::uint32_t v = 0; v < points_.size(); ++v)
            if (!triangles_at[v].empty() && is_in_face(v, triangles_at[v])) {
                std::vector<std::uint32_t> ring;
                for (const std::uint32_t i : triangles_at[v])
                    for (const std::uint32_t w : hull_.triangles[i])
                        if (w != v)
                            ring.push_back(w);
                drop(v, ring);
            }
    }

    [[nodiscard]] Vec3 area_of(std::uint32_t triangle) const {
        const IndexTriangle& t = hull_.triangles[triangle];
        return cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]);
    }

    [[nodiscard]] bool is_in_face(std::uint32_t v, std::span<const std::uint32_t> around) const {
        Vec3 largest;
        for (const std::uint32_t i : around)
            if (const Vec3 area = area_of(i); length_sq(area) > length_sq(largest))
                largest = area;
        const Vec3 normal = normalized_or_zero(largest);
        return std::all_of(around.begin(), around.end(), [&](std::uint32_t i) {
            const IndexTriangle& t = hull_.triangles[i];
            return dot(area_of(i), normal) > 0 &&
                   std::all_of(t.begin(), t.end(), [&](std::uint32_t w) {
                       return std::abs(dot(points_[w] - points_[v], normal)) <= rounding_;
                   });
        });
    }

    void drop(std::uint32_t v, std::span<const std::uint32_t> needed) {
        const auto is_gone = [&](std::uint32_t w) { return dropped_[w]; };
        if (kept_[v] || dropped_[v] || std::any_of(needed.begin(), needed.end(), is_gone))
            return;
        any_ = dropped_[v] = true;
        for (const std::uint32_t w : needed)
            kept_[w] = true;
    }

    std::span<const Vec3> points_;
    const HullSurface& hull_;
    double rounding_;
    std::vector<bool> dropped_, kept_;
    bool any_ = false;
};

SourcedHull hull_of(std::span<const Vec3> positions, std::vector<std::uint32_t> numbers) {
    std::vector<Vec3> points;
    HullSurface hull;
    double largest = 0;
    for (const std::uint32_t v : numbers)
        largest = std::max(largest, max_abs(positions[v]));
    for (;;) {
        points.clear();
        for (const std::uint32_t v : numbers)
            points.push_back(positions[v]);
        hull = exact_hull(points);
        const std::vector<bool> dropped =
            SuperfluousVertices(points, hull, kRounding * largest).find();
        if (dropped.empty())
            break;
        std::size_t n = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (!dropped[i])
                numbers[n++] = numbers[i];
        numbers.resize(n);
    }
    std::vector<std::uint32_t> number(points.size());
    std::vector<Vec3> corners;
    SourcedHull result;
    for (const std::uint32_t p : hull.vertices) {
        number[p] = static_cast<std::uint32_t>(corners.size());
        corners.push_back(points[p]);
        result.source.push_back(numbers[p]);
    }
    for (IndexTriangle& t : hull.triangles)
        for (std::uint32_t& v : t)
            v = number[v];
    result.polytope = make_polytope(corners, hull.triangles);
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
    node.radius *= 1 + 0x1p-48;
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
        tree_.nodes.emplace_back();
        tree_.leaf_of.resize(pieces.size());
        tree_.sources.resize(pieces.size());
        find_leaves(build(0, pieces));
        return std::move(tree_);
    }

private:
    /// Returns the numbers of the positions that are vertices of the node's hull.
    std::vector<std::uint32_t> build(std::uint32_t node, std::span<std::uint32_t> pieces) {
        SourcedHull hull;
        std::uint32_t child = HullNode::kLeaf, children = 0;
        if (pieces.size() == 1) {
            hull = hull_of(positions_, vertices_[pieces[0]]);
            tree_.nodes[node].piece = pieces[0];
            tree_.leaf_of[pieces[0]] = node;
            tree_.sources[pieces[0]] = hull.source;
        } else {
            const std::vector<std::span<std::uint32_t>> groups = groups_of(pieces);
            child = static_cast<std::uint32_t>(tree_.nodes.size());
            children = static_cast<std::uint32_t>(groups.size());
            tree_.nodes.resize(tree_.nodes.size() + groups.size());
            std::vector<std::uint32_t> all;
            for (std::uint32_t i = 0; i < children; ++i) {
                const std::vector<std::uint32_t> more = build(child + i, groups[i]);
                all.insert(all.end(), more.begin(), more.end());
            }
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
            hull = hull_of(positions_, std::move(all));
        }
        HullNode& n = tree_.nodes[node];
        n.child = child, n.children = children;
        n.hull = std::move(hull.polytope);
        set_sphere(n);
        return std::move(hull.source);
    }

    /// Parts the pieces, and then the groups that are largest, until there are as many as a node has
    /// children.
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

    /// Orders the pieces so that the boxes of the first and of the others have the least area, times
    /// the number of pieces in them; returns how many are first.
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
        // Depth stays logarithmic, whatever the pieces are.
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
        sum += n.hull.vertices.capacity() * sizeof(HullVertex) +
               n.hull.edges.capacity() * sizeof(HullEdge) +
               n.hull.starts.vertices().capacity() * sizeof(std::uint32_t);
    for (const auto& s : sources)
        sum += s.capacity() * sizeof(std::uint32_t);
    return sum;
}

} // namespace abut
