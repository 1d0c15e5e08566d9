#include "rigid/penetration.h"

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "rigid/escape.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <queue>

namespace abut {

namespace {

/// A part of a surface that may hold its deepest point: a box of its tree, or a piece of a
/// triangle.
struct Piece {
    double at_most; ///< no point of the piece is deeper
    NodeRef box;    ///< none: the piece is a triangle
    Triangle corners;
    Vec3 middle;            ///< of the triangle
    double middle_distance; ///< of the middle to the solid's surface
    bool middle_inside;
    bool operator<(const Piece& other) const { return at_most < other.at_most; }
};

/// Searches the point of one surface that lies deepest in a solid, deeper than `depth` to begin
/// with.
class DeepestPoint {
public:
    DeepestPoint(const PlacedSolid& surface, const PlacedSolid& solid, double deeper_than)
        : depth(deeper_than), surface_(surface), solid_(solid) {}

    void search(std::span<const std::uint32_t> starts, const PenetrationOptions& options) {
        for (const std::uint32_t vertex : starts)
            try_point(surface_.world_vertex(vertex));
        evaluate_box(NodeRef::node(0), surface_.model().tree().bounds, {});
        while (!pieces_.empty()) {
            const Piece piece = pieces_.top();
            if (piece.at_most <= depth * (1 + options.relative_accuracy))
                break;
            const bool undecided = options.threshold > 0 && depth <= options.threshold &&
                                   piece.at_most > options.threshold;
            if (evaluations_ > (undecided ? options.threshold_budget : options.accuracy_budget))
                break;
            pieces_.pop();
            if (!piece.box.is_none())
                open(piece.box);
            else
                bisect(piece);
        }
        at_most = std::max(depth, pieces_.empty() ? 0 : pieces_.top().at_most);
    }

    double depth, at_most = 0;
    Vec3 on_surface, on_solid; ///< where the depth is reached; not set if nothing is deeper

private:
    using Polygon = boost::container::static_vector<Vec3, 9>;

    void open(NodeRef ref) {
        const Tree& tree = surface_.model().tree();
        if (ref.is_leaf()) {
            for (std::uint32_t slot = ref.first(); slot < ref.first() + ref.count(); ++slot)
                evaluate_clipped(surface_.world_slot(slot));
            return;
        }
        const Node& node = tree.nodes[ref.index()];
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i)
            evaluate_box(node.child[i], node.box(i), node.frame);
    }

    /// Depth changes no faster than the point moves: what holds in the middle bounds the whole box.
    void evaluate_box(NodeRef ref, const Aabb& box, const NodeFrame& frame) {
        ++evaluations_;
        Vec3 middle{0.5 * box.lower[0] + 0.5 * box.upper[0],
                    0.5 * box.lower[1] + 0.5 * box.upper[1],
                    0.5 * box.lower[2] + 0.5 * box.upper[2]};
        const Vec3 corner = Vec3{box.upper[0], box.upper[1], box.upper[2]} - middle;
        // The frame's axes are at right angles to a few parts in 2^24.
        const double radius = surface_.most_stretch() *
                              (length(corner) + 0x1p-20 * (length(corner) + length(middle)));
        middle = apply(surface_.world_from_tree(), frame.point_to_tree(middle));
        PlacedSolid::Nearest nearest = solid_.nearest(middle, radius);
        const bool inside = solid_.contains_off_surface(middle);
        if (!inside && nearest.distance >= radius)
            return;
        if (nearest.distance >= radius)
            nearest = solid_.nearest(middle, std::numeric_limits<double>::infinity());
        const double limit = inside ? radius + nearest.distance : radius - nearest.distance;
        if (limit > depth)
            pieces_.push({limit, ref, {}, {}, 0, false});
    }

    /// Only what lies in the solid's box can lie inside it.
    void evaluate_clipped(const Triangle& t) {
        Polygon polygon;
        for (const Vec3& p : t)
            polygon.push_back(apply(solid_.tree_from_world(), p));
        clip(polygon, solid_.model().tree().bounds);
        for (std::size_t i = 2; i < polygon.size(); ++i)
            evaluate({apply(solid_.world_from_tree(), polygon[0]),
                      apply(solid_.world_from_tree(), polygon[i - 1]),
                      apply(solid_.world_from_tree(), polygon[i])},
                     nullptr);
    }

    /// Source: [Sutherland, Hodgman 1974].
    static void clip(Polygon& polygon, const Aabb& box) {
        for (int plane = 0; plane < 6 && !polygon.empty(); ++plane) {
            const int axis = plane / 2;
            const double sign = plane % 2 == 0 ? 1 : -1;
            const double limit =
                sign * (plane % 2 == 0 ? box.upper : box.lower)[static_cast<std::size_t>(axis)];
            const auto over = [&](const Vec3& p) { return sign * component(p, axis) - limit; };
            Polygon kept;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
                const double op = over(p), oq = over(q);
                if (op <= 0)
                    kept.push_back(p);
                if ((op < 0 && oq > 0) || (op > 0 && oq < 0))
                    kept.push_back(p + (op / (op - oq)) * (q - p));
            }
            polygon = kept;
        }
    }

    void bisect(const Piece& piece) {
        const Triangle& t = piece.corners;
        std::size_t longest = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (length_sq(t[(i + 1) % 3] - t[i]) > length_sq(t[(longest + 1) % 3] - t[longest]))
                longest = i;
        const Vec3 &p = t[longest], &q = t[(longest + 1) % 3], &r = t[(longest + 2) % 3];
        const Vec3 m = 0.5 * (p + q);
        evaluate({p, m, r}, &piece);
        evaluate({m, q, r}, &piece);
    }

    void evaluate(const Triangle& t, const Piece* parent) {
        ++evaluations_;
        const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
        const double radius = std::sqrt(std::max(
            {length_sq(t[0] - middle), length_sq(t[1] - middle), length_sq(t[2] - middle)}));
        const double moved = parent != nullptr ? length(middle - parent->middle) : 0;
        const double bound = parent != nullptr ? (parent->middle_distance + moved) * (1 + 0x1p-20)
                                               : std::numeric_limits<double>::infinity();
        const PlacedSolid::Nearest nearest = solid_.nearest(middle, bound);
        if (nearest.distance + radius <= depth)
            return;
        // Between two points nearer to each other than to the surface, nothing changes from inside
        // to outside.
        const bool inside = parent != nullptr && moved < parent->middle_distance
                                ? parent->middle_inside
                                : nearest.distance > 0 && solid_.contains_off_surface(middle);
        if (inside && keep_deeper(middle, nearest))
            for (const Vec3& corner : t) // depth is often greatest at a corner
                try_point(corner);
        if (!inside && nearest.distance >= radius)
            return;
        const Triangle face = solid_.world_slot(nearest.slot);
        double corner_sq = 0;
        for (const Vec3& corner : t)
            corner_sq = std::max(corner_sq, point_triangle_distance(corner, face).distance_sq);
        const double limit = std::min(std::sqrt(corner_sq), inside ? nearest.distance + radius
                                                                   : radius - nearest.distance);
        if (limit > depth)
            pieces_.push({limit, NodeRef::none(), t, middle, nearest.distance, inside});
    }

    bool keep_deeper(const Vec3& point, const PlacedSolid::Nearest& nearest) {
        // A point of a face that lies in the surface is inside or outside by rounding alone.
        const double rounding =
            16 * 0x1p-53 * (std::abs(point.x) + std::abs(point.y) + std::abs(point.z));
        if (nearest.distance <= std::max(depth, rounding))
            return false;
        depth = nearest.distance;
        on_surface = point, on_solid = nearest.point;
        return true;
    }

    void try_point(const Vec3& point) {
        const auto nearest = solid_.nearest(point, std::numeric_limits<double>::infinity());
        if (nearest.distance > depth && solid_.contains_off_surface(point))
            keep_deeper(point, nearest);
    }

    const PlacedSolid& surface_;
    const PlacedSolid& solid_;
    std::priority_queue<Piece> pieces_;
    int evaluations_ = 0;
};

LocalPenetration deepest_crossing(const PlacedSolid& a, const PlacedSolid& b,
                                  std::span<const Contact> contacts) {
    LocalPenetration best;
    for (const Contact& c : contacts) {
        if (c.kind != TriangleContact::cross)
            continue;
        const Triangle ta = a.world_triangle(c.pair.a), tb = b.world_triangle(c.pair.b);
        const TriangleSeparation s = triangle_triangle_penetration(ta, tb);
        if (s.depth > best.depth) {
            const ClosestPoints common = triangle_triangle_distance(ta, tb);
            best = {s.depth, s.depth, common.a, common.b, s.direction};
        }
    }
    return best;
}

/// A few vertices of the triangles in contact: deep points are near them.
std::vector<std::uint32_t> contact_vertices(const PlacedSolid& model,
                                            std::span<const Contact> contacts,
                                            std::uint32_t TrianglePair::*side) {
    constexpr std::size_t kContacts = 8;
    std::vector<std::uint32_t> vertices;
    const std::size_t count = std::min(kContacts, contacts.size());
    for (std::size_t i = 0; i < count; ++i) {
        const TrianglePair& pair = contacts[i * contacts.size() / count].pair;
        for (const std::uint32_t v : model.model().mesh().triangles[pair.*side])
            vertices.push_back(v);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

LocalPenetration deepest_inside(const PlacedSolid& a, const PlacedSolid& b,
                                std::span<const Contact> contacts,
                                const PenetrationOptions& options) {
    LocalPenetration best;
    if (b.solid().solid) {
        DeepestPoint a_in_b(a, b, 0);
        a_in_b.search(contact_vertices(a, contacts, &TrianglePair::a), options);
        best = {a_in_b.depth, a_in_b.at_most, a_in_b.on_surface, a_in_b.on_solid,
                normalized_or_zero(a_in_b.on_surface - a_in_b.on_solid)};
    }
    if (a.solid().solid) {
        DeepestPoint b_in_a(b, a, best.depth);
        b_in_a.search(contact_vertices(b, contacts, &TrianglePair::b), options);
        if (b_in_a.depth > best.depth)
            best = {b_in_a.depth, best.at_most, b_in_a.on_solid, b_in_a.on_surface,
                    normalized_or_zero(b_in_a.on_solid - b_in_a.on_surface)};
        best.at_most = std::max(best.at_most, b_in_a.at_most);
    }
    return best;
}

} // namespace

LocalPenetration penetration_depth(const PlacedSolid& a, const PlacedSolid& b,
                                   std::span<const Contact> contacts,
                                   const PenetrationOptions& options) {
    const bool solid = a.solid().solid || b.solid().solid;
    LocalPenetration best =
        solid ? deepest_inside(a, b, contacts, options) : deepest_crossing(a, b, contacts);
    if (best.depth == 0) {
        const Escape escape = find_escape(a, b, contacts);
        const ClosestPoints common = triangle_triangle_distance(
            a.world_triangle(contacts[0].pair.a), b.world_triangle(contacts[0].pair.b));
        best = {escape.length, escape.length, common.a, common.b, escape.direction};
    }
    return best;
}

} // namespace abut
