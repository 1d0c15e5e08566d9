#include "rigid/deepest_point.h"

#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <queue>

namespace abut {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Bounds are rounded by some units in the last place: this much outweighs that.
constexpr double kSafe = 1 + 0x1p-40;

/// What is known of the distance from a point to the solid's surface.
struct Sample {
    Vec3 point;
    double at_least = 0, at_most = kInfinity; ///< the distance
    std::uint32_t slot = 0;                   ///< of the solid: a triangle `at_most` away
    bool inside = false;
};

/// A part of the surface that may hold its deepest point: a box of its tree, or a piece of a
/// triangle.
struct Piece {
    double at_most = kInfinity; ///< no point of the piece is deeper
    NodeRef box;                ///< none: the piece is a triangle
    std::uint32_t slot = 0;     ///< of that triangle
    boost::container::static_vector<Vec3, 8> corners;
    Vec3 middle;
    double radius = 0; ///< of a ball around the middle that holds the piece
    Sample sample;     ///< at the middle if sampled, else at that of an enclosing piece
    bool sampled = false;
    bool operator<(const Piece& other) const { return at_most < other.at_most; }
};

class Search {
public:
    Search(const PlacedSolid& surface, const PlacedSolid& solid, const SurfacePart& part,
           const DepthSearch& options, double deeper_than)
        : surface_(surface), solid_(solid), part_(part), options_(options) {
        best_.depth = deeper_than;
    }

    DeepestPoint run(std::span<const std::uint32_t> starts) {
        for (const std::uint32_t triangle : starts)
            for (const Vec3& corner : surface_.world_triangle(triangle))
                try_point(corner, triangle, nullptr);
        if (!surface_.model().tree().empty() && !solid_.model().tree().empty())
            add_box(NodeRef::node(0), surface_.model().tree().bounds, {}, {});
        while (!pieces_.empty() && !finished(pieces_.top().at_most)) {
            const Piece piece = pieces_.top();
            pieces_.pop();
            if (!piece.sampled)
                sample(piece);
            else if (!piece.box.is_none())
                open(piece);
            else
                bisect(piece);
        }
        best_.at_most =
            std::max({best_.depth, dropped_, pieces_.empty() ? 0 : pieces_.top().at_most});
        return best_;
    }

private:
    using Polygon = boost::container::static_vector<Vec3, 9>;

    /// Not worth a closer look.
    [[nodiscard]] double wanted() const { return best_.depth * (1 + options_.relative_accuracy); }

    [[nodiscard]] bool finished(double at_most) const {
        if (at_most <= wanted())
            return true;
        const bool undecided = options_.threshold > 0 && best_.depth <= options_.threshold &&
                               at_most > options_.threshold;
        return evaluations_ > (undecided ? options_.threshold_budget : options_.accuracy_budget);
    }

    // ---- pieces

    void open(const Piece& parent) {
        const Tree& tree = surface_.model().tree();
        if (parent.box.is_leaf()) {
            const std::uint32_t first = parent.box.first();
            for (std::uint32_t slot = first; slot < first + parent.box.count(); ++slot)
                if (part_.takes(surface_.model().triangle_at(slot)))
                    add_clipped(slot, parent.sample);
            return;
        }
        const Node& node = tree.nodes[parent.box.index()];
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i)
            add_box(node.child[i], node.box(i), node.frame, parent.sample);
    }

    void add_box(NodeRef ref, const Aabb& box, const NodeFrame& frame, const Sample& known) {
        Vec3 lower{box.lower[0], box.lower[1], box.lower[2]},
            upper{box.upper[0], box.upper[1], box.upper[2]};
        // The frame's axes are at right angles to a few parts in 2^24.
        const double off = 0x1p-20 * (length(lower) + length(upper));
        lower = lower - Vec3{off, off, off}, upper = upper + Vec3{off, off, off};
        const Vec3 middle = 0.5 * lower + 0.5 * upper;
        const auto to_world = [&](const Vec3& p) {
            return apply(surface_.world_from_tree(), frame.point_to_tree(p));
        };
        Piece piece;
        piece.box = ref;
        piece.radius = surface_.most_stretch() * length(upper - middle) * (1 + 0x1p-20);
        piece.middle = to_world(middle);
        for (unsigned i = 0; i < 8; ++i)
            piece.corners.push_back(
                to_world({i & 1U ? upper.x : lower.x, i & 2U ? upper.y : lower.y,
                          i & 4U ? upper.z : lower.z}));
        piece.sample = known;
        add(piece);
    }

    /// Only what lies in the solid's box can lie inside it.
    void add_clipped(std::uint32_t slot, const Sample& known) {
        Polygon polygon;
        for (const Vec3& p : surface_.world_slot(slot))
            polygon.push_back(apply(solid_.tree_from_world(), p));
        clip(polygon, solid_.model().tree().bounds);
        for (std::size_t i = 2; i < polygon.size(); ++i)
            add_triangle({apply(solid_.world_from_tree(), polygon[0]),
                          apply(solid_.world_from_tree(), polygon[i - 1]),
                          apply(solid_.world_from_tree(), polygon[i])},
                         slot, known);
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

    void bisect(const Piece& parent) {
        const auto& t = parent.corners;
        std::size_t longest = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (length_sq(t[(i + 1) % 3] - t[i]) > length_sq(t[(longest + 1) % 3] - t[longest]))
                longest = i;
        const Vec3 &p = t[longest], &q = t[(longest + 1) % 3], &r = t[(longest + 2) % 3];
        const Vec3 m = 0.5 * (p + q);
        add_triangle({p, m, r}, parent.slot, parent.sample);
        add_triangle({m, q, r}, parent.slot, parent.sample);
    }

    void add_triangle(const Triangle& t, std::uint32_t slot, const Sample& known) {
        Piece piece;
        piece.slot = slot;
        piece.corners.assign(t.begin(), t.end());
        piece.middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
        for (const Vec3& corner : t)
            piece.radius = std::max(piece.radius, length(corner - piece.middle));
        piece.radius *= kSafe;
        piece.sample = known;
        add(piece);
    }

    /// Keeps a piece unless what is known already rules it out.
    void add(Piece& piece) {
        piece.at_most = bound(piece);
        if (worth_keeping(piece.at_most) && part_.may_hold(piece.middle, piece.radius))
            pieces_.push(piece);
    }

    bool worth_keeping(double at_most) {
        if (at_most <= best_.depth)
            return false;
        if (at_most > wanted())
            return true;
        dropped_ = std::max(dropped_, at_most);
        return false;
    }

    /// What the sample, at the piece's middle or farther off, says of the piece's depth.
    [[nodiscard]] double bound(const Piece& piece) const {
        const Sample& s = piece.sample;
        if (s.at_most == kInfinity)
            return kInfinity;
        const double reach = (length(piece.middle - s.point) + piece.radius) * kSafe;
        // From outside, a point is at least `at_least` away from the first one inside.
        const double across = s.inside ? kInfinity : reach - s.at_least;
        if (across <= 0)
            return 0;
        const double limit = std::min(across, s.at_most + reach);
        if (limit <= best_.depth)
            return limit;
        const Triangle face = solid_.world_slot(s.slot);
        double convex = 0;
        for (const Vec3& corner : piece.corners)
            convex = std::max(convex, point_triangle_distance(corner, face).distance_sq);
        return std::min(limit, std::sqrt(convex) * kSafe);
    }

    // ---- points

    void sample(Piece piece) {
        ++evaluations_;
        const Sample known = piece.sample;
        const double moved = length(piece.middle - known.point) * kSafe;
        // A triangle that is near enough to rule the piece out ends the search for the nearest.
        const PlacedSolid::NearestSearch search{.bound = kInfinity,
                                                .enough = wanted() - piece.radius,
                                                .slack = 0.25 * options_.relative_accuracy,
                                                .seed = known.at_most < kInfinity ? &known.slot
                                                                                  : nullptr};
        const PlacedSolid::Nearest nearest = solid_.nearest(piece.middle, search);
        if (nearest.distance <= search.enough) {
            // Nothing in the piece is deeper than that.
            (void)worth_keeping((nearest.distance + piece.radius) * kSafe);
            return;
        }
        Sample& s = piece.sample;
        s.point = piece.middle;
        s.at_most = nearest.distance;
        s.at_least = nearest.distance / (1 + search.slack) / kSafe;
        s.slot = nearest.slot;
        // Between two points nearer to each other than to the surface, nothing changes from inside
        // to outside.
        s.inside = known.at_most < kInfinity && moved < known.at_least
                       ? known.inside
                       : nearest.distance > 0 && solid_.contains_off_surface(piece.middle);
        piece.sampled = true;
        piece.at_most = std::min(piece.at_most, bound(piece));
        if (!worth_keeping(piece.at_most))
            return;
        pieces_.push(piece);
        if (s.inside)
            try_points(piece);
    }

    /// Points of the surface in the piece, for a depth that is reached.
    void try_points(const Piece& piece) {
        if (piece.box.is_none()) {
            const std::uint32_t triangle = surface_.model().triangle_at(piece.slot);
            try_point(piece.middle, triangle, &piece.sample.slot);
            for (const Vec3& corner : piece.corners) // depth is often greatest at a corner
                try_point(corner, triangle, &piece.sample.slot);
            return;
        }
        NodeRef ref = piece.box;
        while (!ref.is_leaf())
            ref = surface_.model().tree().nodes[ref.index()].child[0];
        if (const std::uint32_t triangle = surface_.model().triangle_at(ref.first());
            part_.takes(triangle))
            try_point(surface_.world_slot(ref.first())[0], triangle, &piece.sample.slot);
    }

    /// `seed`: a slot of the solid that is likely near, or null.
    void try_point(const Vec3& point, std::uint32_t triangle, const std::uint32_t* seed) {
        // A point of a face that lies in the surface is inside or outside by rounding alone.
        const double rounding =
            16 * 0x1p-53 * (std::abs(point.x) + std::abs(point.y) + std::abs(point.z));
        const double beyond = std::max(best_.depth, rounding);
        const PlacedSolid::Nearest nearest =
            solid_.nearest(point, {.enough = beyond, .seed = seed});
        if (nearest.distance <= beyond || !part_.takes(triangle) || !part_.may_hold(point, 0) ||
            !solid_.contains_off_surface(point))
            return;
        best_.depth = nearest.distance;
        best_.on_surface = point, best_.on_solid = nearest.point;
        best_.surface_triangle = triangle;
        best_.solid_triangle = solid_.model().triangle_at(nearest.slot);
    }

    const PlacedSolid& surface_;
    const PlacedSolid& solid_;
    const SurfacePart& part_;
    const DepthSearch& options_;
    DeepestPoint best_;
    double dropped_ = 0; ///< largest bound of a piece that was dropped although deeper
    std::priority_queue<Piece> pieces_;
    int evaluations_ = 0;
};

} // namespace

DeepestPoint find_deepest_point(const PlacedSolid& surface, const PlacedSolid& solid,
                                std::span<const std::uint32_t> starts, const SurfacePart& part,
                                const DepthSearch& options, double deeper_than) {
    return Search(surface, solid, part, options, deeper_than).run(starts);
}

} // namespace abut
