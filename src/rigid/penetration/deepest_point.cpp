#include "rigid/penetration/deepest_point.h"

#include "rigid/penetration/face_bounds.h"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <deque>
#include <limits>
#include <queue>

namespace abut {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A factor that outweighs the rounding of bounds, which is a few units in the last place.
constexpr double kSafe = 1 + 0x1p-40;

/// A point and its distance to the solid's surface.
struct Sample {
    Vec3 point;
    double distance = kInfinity;
    std::uint32_t slot = 0; ///< of the solid: the nearest triangle's slot
    bool inside = false;

    [[nodiscard]] bool any() const { return distance < kInfinity; }
};

/// A part of the surface that may hold its deepest point: a box of its tree, or a part of a
/// triangle.
struct Piece {
    double at_most = kInfinity; ///< upper bound of the depth of the piece's points
    NodeRef box;                ///< none, if the piece is a part of a triangle
    std::uint32_t slot = 0;     ///< of that triangle
    std::array<Vec3, FaceBounds::kMostCorners> corner;
    std::size_t corner_count = 0;
    Vec3 middle;
    double radius = 0; ///< of a ball around `middle` that holds the piece
    Sample sample;     ///< at `middle` if sampled, else that of an enclosing piece
    bool sampled = false;
    FaceBounds faces;

    [[nodiscard]] std::span<const Vec3> corners() const { return {corner.data(), corner_count}; }
};

/// Pieces by number. They stay where they are, and the numbers of those put back are used again.
class PieceStore {
public:
    [[nodiscard]] Piece& operator[](std::uint32_t number) { return pieces_[number]; }
    std::uint32_t take() {
        if (free_.empty()) {
            pieces_.emplace_back();
            return static_cast<std::uint32_t>(pieces_.size() - 1);
        }
        const std::uint32_t number = free_.back();
        free_.pop_back();
        return number;
    }
    void put_back(std::uint32_t number) { free_.push_back(number); }

private:
    std::deque<Piece> pieces_;
    std::vector<std::uint32_t> free_;
};

/// A piece that waits; the one that may be deepest comes first.
struct Waiting {
    double at_most;
    std::uint32_t piece;
    bool operator<(const Waiting& other) const { return at_most < other.at_most; }
};

class Search {
public:
    Search(const PlacedModel& surface, const WorldSolid& solid, const SurfacePart& part,
           const DepthSearch& options, double deeper_than)
        : surface_(surface), solid_(solid), bounds_(solid.bounds()), part_(part),
          options_(options) {
        best_.depth = deeper_than;
    }

    DeepestPoint run(std::span<const std::uint32_t> starts) {
        for (const std::uint32_t triangle : starts)
            for (const Vec3& corner : surface_.world_triangle(triangle))
                try_point(corner, triangle, nullptr);
        if (!surface_.data().tree().empty() && bounds_.box.lower[0] <= bounds_.box.upper[0])
            add_box(NodeRef::node(0), surface_.data().tree().bounds, {}, Piece());
        while (!waiting_.empty() && !finished(waiting_.top().at_most)) {
            poll_stop();
            if (options_.steps != nullptr && !options_.steps->take())
                break;
            const std::uint32_t number = waiting_.top().piece;
            waiting_.pop();
            if (take_step(pieces_[number]))
                waiting_.push({pieces_[number].at_most, number});
            else
                pieces_.put_back(number);
        }
        best_.at_most =
            std::max({best_.depth, dropped_, waiting_.empty() ? 0 : waiting_.top().at_most});
        return best_;
    }

private:
    /// Samples or divides a piece. Returns whether the piece waits for another step.
    bool take_step(Piece& piece) {
        if (!piece.sampled)
            return sample(piece);
        if (piece.box.is_none())
            bisect(piece);
        else
            open(piece);
        return false;
    }

    using Polygon = boost::container::static_vector<Vec3, 9>;

    /// A depth that a piece must exceed to be worth another look.
    [[nodiscard]] double wanted() const { return best_.depth * (1 + options_.relative_error); }

    [[nodiscard]] bool finished(double at_most) const {
        if (at_most <= wanted())
            return true;
        const bool undecided = options_.threshold > 0 && best_.depth <= options_.threshold &&
                               at_most > options_.threshold;
        if (undecided)
            return evaluations_ > options_.threshold_budget;
        return evaluations_ > (best_.depth > 0 ? options_.accuracy_budget : options_.reach_budget);
    }

    // ---- pieces

    void open(const Piece& parent) {
        const Tree& tree = surface_.data().tree();
        if (parent.box.is_leaf()) {
            const std::uint32_t first = parent.box.first();
            for (std::uint32_t slot = first; slot < first + parent.box.count(); ++slot)
                if (part_.takes(surface_.data().triangle_at(slot)))
                    add_clipped(slot, parent);
            return;
        }
        const Node& node = tree.nodes[parent.box.index()];
        for (std::size_t i = 0; i < Node::kWidth && !node.child[i].is_none(); ++i)
            add_box(node.child[i], node.box(i), node.frame, parent);
    }

    void add_box(NodeRef ref, const Aabb& box, const NodeFrame& frame, const Piece& parent) {
        Vec3 lower{box.lower[0], box.lower[1], box.lower[2]},
            upper{box.upper[0], box.upper[1], box.upper[2]};
        // The frame's axes are perpendicular to a few parts in 2^24.
        const double off = 0x1p-20 * (length(lower) + length(upper));
        lower = lower - Vec3{off, off, off}, upper = upper + Vec3{off, off, off};
        const Vec3 middle = 0.5 * lower + 0.5 * upper;
        const auto to_world = [&](const Vec3& p) {
            return apply(surface_.world_from_tree(), frame.point_to_tree(p));
        };
        const std::uint32_t number = pieces_.take();
        Piece& piece = pieces_[number];
        piece.box = ref;
        piece.radius = surface_.most_stretch() * length(upper - middle) * (1 + 0x1p-20);
        piece.middle = to_world(middle);
        piece.corner_count = 8;
        for (unsigned i = 0; i < 8; ++i)
            piece.corner[i] = to_world({i & 1U ? upper.x : lower.x, i & 2U ? upper.y : lower.y,
                                        i & 4U ? upper.z : lower.z});
        piece.faces.begin(parent.faces, 8);
        inherit(number, parent);
    }

    /// Adds the part of a triangle in the solid's box; the rest cannot lie inside the solid.
    void add_clipped(std::uint32_t slot, const Piece& parent) {
        Polygon polygon;
        for (const Vec3& p : surface_.world_slot(slot))
            polygon.push_back(apply(bounds_.frame_from_world, p));
        clip(polygon, bounds_.box);
        for (std::size_t i = 2; i < polygon.size(); ++i)
            add_triangle({apply(bounds_.world_from_frame, polygon[0]),
                          apply(bounds_.world_from_frame, polygon[i - 1]),
                          apply(bounds_.world_from_frame, polygon[i])},
                         slot, parent);
    }

    /// Clips a convex polygon to a box. Source: [Sutherland, Hodgman 1974].
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
        const auto& t = parent.corner;
        std::size_t longest = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (length_sq(t[(i + 1) % 3] - t[i]) > length_sq(t[(longest + 1) % 3] - t[longest]))
                longest = i;
        const std::size_t p = longest, q = (longest + 1) % 3, r = (longest + 2) % 3;
        const Vec3 m = 0.5 * (t[p] + t[q]);
        const std::uint32_t half = take_triangle({t[p], m, t[r]}, parent.slot, parent),
                            other = take_triangle({m, t[q], t[r]}, parent.slot, parent);
        FaceBounds &of_half = pieces_[half].faces, &of_other = pieces_[other].faces;
        of_half.take_corner(0, parent.faces, p), of_half.take_corner(2, parent.faces, r);
        inherit(half, parent);
        of_other.take_corner(0, of_half, 1);
        of_other.take_corner(1, parent.faces, q), of_other.take_corner(2, parent.faces, r);
        inherit(other, parent);
    }

    void add_triangle(const Triangle& t, std::uint32_t slot, const Piece& parent) {
        const std::uint32_t number = take_triangle(t, slot, parent);
        inherit(number, parent);
    }

    /// Takes a piece of a triangle, with the faces of its parent.
    std::uint32_t take_triangle(const Triangle& t, std::uint32_t slot, const Piece& parent) {
        const std::uint32_t number = pieces_.take();
        Piece& piece = pieces_[number];
        piece.box = {};
        piece.slot = slot;
        piece.corner_count = 3;
        std::copy(t.begin(), t.end(), piece.corner.begin());
        piece.middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
        piece.radius = 0;
        for (const Vec3& corner : t)
            piece.radius = std::max(piece.radius, length(corner - piece.middle));
        piece.radius *= kSafe;
        piece.faces.begin(parent.faces, 3);
        return number;
    }

    /// Lets a piece wait, unless its parent's sample rules it out.
    void inherit(std::uint32_t number, const Piece& parent) {
        Piece& piece = pieces_[number];
        piece.sample = parent.sample;
        piece.sampled = false;
        piece.at_most = bound(piece);
        if (worth_keeping(piece.at_most) && part_.may_hold(piece.middle, piece.radius))
            waiting_.push({piece.at_most, number});
        else
            pieces_.put_back(number);
    }

    bool worth_keeping(double at_most) {
        if (at_most <= best_.depth)
            return false;
        if (at_most > wanted())
            return true;
        dropped_ = std::max(dropped_, at_most);
        return false;
    }

    /// Bounds the depth of a piece by its sample, which is at the piece's middle or farther off.
    [[nodiscard]] double bound(Piece& piece) const {
        const Sample& s = piece.sample;
        if (!s.any())
            return kInfinity;
        const double reach = (length(piece.middle - s.point) + piece.radius) * kSafe;
        // From a sample outside, the way to a point inside first takes its distance to the surface.
        const double across = s.inside ? kInfinity : reach - s.distance / kSafe;
        if (across <= 0)
            return 0;
        const double limit = std::min(across, s.distance + reach);
        if (limit <= wanted())
            return limit;
        return std::min(limit, piece.faces.least(solid_, piece.corners(), wanted()) * kSafe);
    }

    // ---- points

    /// Samples a piece at its middle. Returns whether the piece is worth being divided.
    bool sample(Piece& piece) {
        ++evaluations_;
        const Sample known = piece.sample;
        // The search for the nearest ends at any triangle that is near enough to rule the piece
        // out.
        const WorldSolid::NearestSearch search{.enough = wanted() - piece.radius,
                                               .seed = known.any() ? &known.slot : nullptr};
        const WorldSolid::Nearest nearest = solid_.nearest(piece.middle, search);
        if (nearest.distance <= search.enough) {
            // No point of the piece is deeper than this.
            (void)worth_keeping((nearest.distance + piece.radius) * kSafe);
            return false;
        }
        piece.sampled = true;
        // Assume inside first: the test is made only if its result matters.
        piece.sample = {piece.middle, nearest.distance, nearest.slot, true};
        piece.faces.remember(nearest.slot);
        piece.at_most = std::min(piece.at_most, bound(piece));
        if (piece.at_most > wanted()) {
            piece.sample.inside = is_inside(piece.sample, known);
            piece.at_most = std::min(piece.at_most, bound(piece));
        }
        if (!worth_keeping(piece.at_most))
            return false;
        if (piece.sample.inside && piece.box.is_none())
            try_points(piece, nearest);
        else if (piece.sample.inside)
            try_any_point(piece.box, nearest.slot);
        return true;
    }

    [[nodiscard]] bool is_inside(const Sample& s, const Sample& known) const {
        if (!(s.distance > 0))
            return false;
        // Two points that are nearer to each other than to the surface are both inside or both
        // outside.
        if (known.any() && length(s.point - known.point) * kSafe * kSafe < known.distance)
            return known.inside;
        return known.any() && known.distance > 0
                   ? solid_.contains_off_surface(s.point, known.point, known.inside)
                   : solid_.contains_off_surface(s.point);
    }

    // ---- points of the surface at which a depth is reached

    /// Takes the sample of a part of a triangle if it is deeper than the best; then tries the
    /// corners.
    void try_points(const Piece& piece, const WorldSolid::Nearest& nearest) {
        const std::uint32_t triangle = surface_.data().triangle_at(piece.slot);
        if (!(nearest.distance > beyond(piece.middle) && belongs(piece.middle, triangle)))
            return;
        take(piece.middle, triangle, nearest);
        for (const Vec3& corner : piece.corners()) // depth is often greatest at a corner
            try_point(corner, triangle, &nearest.slot);
    }

    /// Tries a vertex of a triangle in a box.
    void try_any_point(NodeRef box, std::uint32_t seed) {
        while (!box.is_leaf())
            box = surface_.data().tree().nodes[box.index()].child[0];
        try_point(surface_.world_slot(box.first())[0], surface_.data().triangle_at(box.first()),
                  &seed);
    }

    /// `seed`: a slot of the solid that is probably near, or null.
    void try_point(const Vec3& point, std::uint32_t triangle, const std::uint32_t* seed) {
        if (!belongs(point, triangle))
            return;
        const double least = beyond(point);
        const WorldSolid::Nearest nearest = solid_.nearest(point, {.enough = least, .seed = seed});
        if (nearest.distance > least && solid_.contains_off_surface(point))
            take(point, triangle, nearest);
    }

    /// The depth that a point must exceed. At least its rounding: that decides whether a point on
    /// the surface counts as inside.
    [[nodiscard]] double beyond(const Vec3& point) const {
        return std::max(best_.depth,
                        16 * 0x1p-53 * (std::abs(point.x) + std::abs(point.y) + std::abs(point.z)));
    }
    [[nodiscard]] bool belongs(const Vec3& point, std::uint32_t triangle) const {
        return part_.takes(triangle) && part_.may_hold(point, 0);
    }
    void take(const Vec3& point, std::uint32_t triangle, const WorldSolid::Nearest& nearest) {
        best_.depth = nearest.distance;
        best_.on_surface = point, best_.on_solid = nearest.point;
        best_.surface_triangle = triangle;
        best_.solid_triangle = solid_.triangle_at(nearest.slot);
    }

    const PlacedModel& surface_;
    const WorldSolid& solid_;
    const WorldSolid::Bounds bounds_;
    const SurfacePart& part_;
    const DepthSearch& options_;
    DeepestPoint best_;
    double dropped_ = 0; ///< largest bound of a dropped piece, if above the depth
    PieceStore pieces_;
    std::priority_queue<Waiting> waiting_;
    int evaluations_ = 0;
};

} // namespace

DeepestPoint find_deepest_point(const PlacedModel& surface, const WorldSolid& solid,
                                std::span<const std::uint32_t> starts, const SurfacePart& part,
                                const DepthSearch& options, double deeper_than) {
    return Search(surface, solid, part, options, deeper_than).run(starts);
}

} // namespace abut
