#include "world/solids/box_region.h"

#include "world/solids/box_face.h"
#include "world/solids/contact_candidate.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace abut {

namespace {

/// A point over the reference side: its place there, and its height along the normal.
struct PlaceOver {
    double u, v, height;
};
PlaceOver operator+(const PlaceOver& p, const PlaceOver& q) {
    return {p.u + q.u, p.v + q.v, p.height + q.height};
}
PlaceOver operator-(const PlaceOver& p, const PlaceOver& q) {
    return {p.u - q.u, p.v - q.v, p.height - q.height};
}

/// The two sides, seen from the reference box. Corners of a side are numbered counter-clockwise from where
/// both coordinates are positive; edge i goes from corner i to the next.
struct FacingSides {
    BoxFace reference, incident;
    double half_u = 0, half_v = 0;          ///< of the reference side
    PlaceOver middle{}, edge_u{}, edge_v{}; ///< of the incident side; half of the edges

    FacingSides(const RoundedBox& a, const RoundedBox& b, const BoxAxes& axes,
                const LeastOverlap& least, bool reference_is_a)
        : reference(reference_is_a ? BoxFace(a, least.normal) : BoxFace(b, -least.normal)),
          incident(reference_is_a ? BoxFace(b, -least.normal) : BoxFace(a, least.normal)) {
        const RoundedBox &from = reference_is_a ? a : b, &to = reference_is_a ? b : a;
        half_u = from.half[reference.u], half_v = from.half[reference.v];
        // Scalar products of an axis of the reference box and one of the incident box.
        const std::size_t row = reference_is_a ? 3 : 1, column = 4 - row;
        const auto turn = [&, products = &axes.turn[0][0]](std::size_t i, std::size_t k) {
            return products[row * i + column * k];
        };
        const auto way = [sign = reference_is_a ? 1.0 : -1.0,
                          along = reference_is_a ? axes.way : axes.way + 3](std::size_t i) {
            return sign * along[i];
        };
        const std::size_t u = reference.u, v = reference.v, k = reference.k;
        const double outward = reference.positive ? 1 : -1,
                     steep = outward / std::abs(reference.along[k]);
        // Moves a vector along the normal into the plane of the side.
        const auto over = [&](double along_u, double along_v, double along_k) -> PlaceOver {
            const double height = along_k * steep;
            return {along_u - height * reference.along[u], along_v - height * reference.along[v],
                    height};
        };
        const auto half_edge = [&](std::size_t axis) {
            const double half = to.half[axis];
            return over(half * turn(u, axis), half * turn(v, axis), half * turn(k, axis));
        };
        const std::size_t n = incident.k;
        const double half = incident.positive ? to.half[n] : -to.half[n];
        middle = over(way(u) + half * turn(u, n), way(v) + half * turn(v, n),
                      (way(k) + half * turn(k, n)) - outward * from.half[k]);
        edge_u = half_edge(incident.u), edge_v = half_edge(incident.v);
    }
};

/// A corner of the incident side while it is cut, and the edge from it to the next: one of the incident side,
/// or one of the reference with kOfReference added. All members are set when a corner is added.
struct CutCorner {
    double u, v, height;
    std::uint32_t edge;
};
constexpr std::uint32_t kOfReference = 4;

/// The incident side inside of the reference. It begins as a quadrilateral; each edge adds a corner at most.
class CutSide {
public:
    explicit CutSide(const FacingSides& sides) : half_u_(sides.half_u), half_v_(sides.half_v) {
        const PlaceOver front = sides.middle + sides.edge_u, back = sides.middle - sides.edge_u;
        const PlaceOver corners[] = {front + sides.edge_v, back + sides.edge_v, back - sides.edge_v,
                                     front - sides.edge_v};
        double low_u = HUGE_VAL, low_v = HUGE_VAL, high_u = -HUGE_VAL, high_v = -HUGE_VAL;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const PlaceOver& at = corners[i];
            now_[i] = {at.u, at.v, at.height, i};
            low_u = std::min(low_u, at.u), high_u = std::max(high_u, at.u);
            low_v = std::min(low_v, at.v), high_v = std::max(high_v, at.v);
        }
        if (high_v > half_v_)
            cut(0, [&](const CutCorner& c) { return half_v_ - c.v; });
        if (low_u < -half_u_)
            cut(1, [&](const CutCorner& c) { return half_u_ + c.u; });
        if (low_v < -half_v_)
            cut(2, [&](const CutCorner& c) { return half_v_ + c.v; });
        if (high_u > half_u_)
            cut(3, [&](const CutCorner& c) { return half_u_ - c.u; });
    }
    [[nodiscard]] std::span<const CutCorner> corners() const { return {now_, count_}; }

private:
    /// Keeps the part where `inside` is not negative.
    template <typename Inside>
    void cut(std::uint32_t edge, const Inside& inside) {
        if (count_ == 0)
            return;
        std::size_t kept = 0;
        const double first = inside(now_[0]);
        double here = first;
        for (std::size_t i = 0; i < count_; ++i) {
            const bool is_last = i + 1 == count_;
            const CutCorner &from = now_[i], &to = now_[is_last ? 0 : i + 1];
            const double next = is_last ? first : inside(to);
            if (here >= 0)
                next_[kept++] = from;
            if ((here >= 0) != (next >= 0)) {
                const double t = here / (here - next);
                next_[kept++] = {from.u + t * (to.u - from.u), from.v + t * (to.v - from.v),
                                 from.height + t * (to.height - from.height),
                                 here >= 0 ? kOfReference + edge : from.edge};
            }
            here = next;
        }
        count_ = kept;
        std::swap(now_, next_);
    }

    double half_u_, half_v_;
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): written before they are read
    CutCorner memory_[2][8];
    CutCorner *now_ = memory_[0], *next_ = memory_[1];
    std::size_t count_ = 4;
};

/// A place seen along the normal.
struct Seen {
    double x, y;
};
Seen operator+(const Seen& p, const Seen& q) {
    return {p.x + q.x, p.y + q.y};
}
Seen operator-(const Seen& p, const Seen& q) {
    return {p.x - q.x, p.y - q.y};
}
/// The rectangle around the corners of a region, seen along the normal.
struct SeenRectangle {
    double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;

    void extend(const Seen& p) {
        low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
        low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
    }
};

/// A corner of a side, and the square of its distance from a place.
struct CornerAt {
    std::uint32_t corner;
    double distance_sq;
};

/// A side, seen along the normal.
class SeenSide {
public:
    SeenSide(const Seen& middle, const Seen& half_u, const Seen& half_v)
        : corners_{middle + half_u + half_v, middle - half_u + half_v, middle - half_u - half_v,
                   middle + half_u - half_v} {}

    /// Finds the corners that may take part in names: those near the region.
    void find_near(const SeenRectangle& around) {
        // At least the distance within which a vertex takes part: see name_reach_sq.
        const double reach =
            kNamedShare * ((around.high_x - around.low_x) + (around.high_y - around.low_y));
        const double low_x = around.low_x - reach, high_x = around.high_x + reach,
                     low_y = around.low_y - reach, high_y = around.high_y + reach;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const Seen& p = corners_[i];
            near_[near_count_] = i;
            near_count_ += static_cast<std::uint32_t>(p.x >= low_x) &
                           static_cast<std::uint32_t>(p.x <= high_x) &
                           static_cast<std::uint32_t>(p.y >= low_y) &
                           static_cast<std::uint32_t>(p.y <= high_y);
        }
    }
    /// The corner of those near the region that is nearest to a place.
    [[nodiscard]] CornerAt nearest_near(const Seen& p) const {
        CornerAt best{0, HUGE_VAL};
        for (std::uint32_t i = 0; i < near_count_; ++i)
            take_nearer(near_[i], p, best);
        return best;
    }
    /// The corner that is nearest to a place.
    [[nodiscard]] CornerAt nearest(const Seen& p) const {
        CornerAt best{0, HUGE_VAL};
        for (std::uint32_t i = 0; i < 4; ++i)
            take_nearer(i, p, best);
        return best;
    }

private:
    void take_nearer(std::uint32_t i, const Seen& p, CornerAt& best) const {
        // Values are chosen: a branch would be taken at random.
        const double dx = corners_[i].x - p.x, dy = corners_[i].y - p.y, sq = dx * dx + dy * dy;
        best.corner = sq < best.distance_sq ? i : best.corner;
        best.distance_sq = std::min(sq, best.distance_sq);
    }

    Seen corners_[4];
    std::uint32_t near_[5]{}; ///< the last place is written but not kept
    std::uint32_t near_count_ = 0;
};

/// The number of a side's corner as a vertex of its box, and of its edge.
std::uint32_t vertex_of(const BoxFace& face, std::uint32_t corner) {
    return face.side | (corner == 0 || corner == 3 ? face.bit_u() : 0U) |
           (corner < 2 ? face.bit_v() : 0U);
}
std::uint32_t edge_of(const BoxFace& face, std::uint32_t edge) {
    switch (edge) {
    case 0:
        return BoxFace::edge(face.u, face.side | face.bit_v());
    case 1:
        return BoxFace::edge(face.v, face.side);
    case 2:
        return BoxFace::edge(face.u, face.side);
    default:
        return BoxFace::edge(face.v, face.side | face.bit_u());
    }
}

/// Names the corners of a region as CornerNames of polygon_overlap.cpp does.
class RegionNames {
public:
    RegionNames(const FacingSides& sides, std::span<const CutCorner> cut, bool reference_is_a,
                const SeenSide& reference, const SeenSide& incident, const SeenRectangle& around)
        : sides_(sides), cut_(cut), reference_is_a_(reference_is_a), reference_(reference),
          incident_(incident),
          reach_sq_(name_reach_sq(around.low_x, around.low_y, around.high_x, around.high_y)) {}

    /// The name of the corner i, which is seen at a place.
    [[nodiscard]] std::uint64_t name(std::size_t i, const Seen& at) const {
        const std::uint32_t edge = cut_[i].edge, last = cut_[i == 0 ? cut_.size() - 1 : i - 1].edge;
        const bool of_reference = edge >= kOfReference, last_of_reference = last >= kOfReference;
        const bool crosses = of_reference != last_of_reference;
        // The cut side runs around the incident side as its corners do, and against those of the reference. So
        // between two edges of one side that follow each other is a corner of it.
        const std::uint32_t now = edge % 4, before = last % 4;
        CornerAt near_reference = !crosses && of_reference && before == (now + 1) % 4
                                      ? CornerAt{before, 0}
                                      : reference_.nearest_near(at);
        CornerAt near_incident = !crosses && !of_reference && now == (before + 1) % 4
                                     ? CornerAt{now, 0}
                                     : incident_.nearest_near(at);
        bool at_reference = near_reference.distance_sq <= reach_sq_,
             at_incident = near_incident.distance_sq <= reach_sq_;
        if (!at_reference && !at_incident) {
            if (crosses)
                return named(FeatureKind::edges,
                             edge_of(sides_.reference, of_reference ? now : before),
                             edge_of(sides_.incident, of_reference ? before : now));
            // Edges of one side that do not follow each other, to rounding: its nearest vertex names the place.
            at_reference = of_reference, at_incident = !of_reference;
            (of_reference ? near_reference : near_incident) =
                (of_reference ? reference_ : incident_).nearest(at);
        }
        const FeatureKind kind = at_reference && at_incident       ? FeatureKind::vertices
                                 : at_reference == reference_is_a_ ? FeatureKind::vertex_of_a
                                                                   : FeatureKind::vertex_of_b;
        return named(kind, at_reference ? vertex_of(sides_.reference, near_reference.corner) : 0,
                     at_incident ? vertex_of(sides_.incident, near_incident.corner) : 0);
    }

private:
    [[nodiscard]] std::uint64_t named(FeatureKind kind, std::uint32_t of_reference,
                                      std::uint32_t of_incident) const {
        return reference_is_a_ ? feature_name(kind, of_reference, of_incident)
                               : feature_name(kind, of_incident, of_reference);
    }

    const FacingSides& sides_;
    std::span<const CutCorner> cut_;
    bool reference_is_a_;
    const SeenSide &reference_, &incident_;
    double reach_sq_;
};

} // namespace

// Only the corners that there are get values: clearing all would cost as much as setting them.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
BoxRegion::BoxRegion(const RoundedBox& a, const RoundedBox& b, const BoxAxes& axes,
                     const LeastOverlap& least, double least_depth)
    : deepest(-HUGE_VAL), reference_is_a(least.kind != LeastOverlap::Kind::face_b) {
    const FacingSides sides(a, b, axes, least, reference_is_a);
    const CutSide cut_side(sides);
    const std::span<const CutCorner> cut = cut_side.corners();
    if (cut.empty())
        return;
    const RoundedBox& box = reference_is_a ? a : b;
    const BoxFace& side = sides.reference;
    edge_u = box.axis[side.u], edge_v = box.axis[side.v];
    middle = box.centre + box.half[side.k] * side.normal(box);
    const ContactFrame frame(a.centre, least.normal);
    const double ux = dot(edge_u, frame.across_x), uy = dot(edge_u, frame.across_y),
                 vx = dot(edge_v, frame.across_x), vy = dot(edge_v, frame.across_y);
    const auto seen = [&](double u, double v) { return Seen{u * ux + v * vx, u * uy + v * vy}; };
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): written before they are read
    Seen at[8];
    SeenRectangle around;
    for (std::size_t i = 0; i < cut.size(); ++i) {
        at[i] = seen(cut[i].u, cut[i].v);
        around.extend(at[i]);
    }
    SeenSide reference({0, 0}, seen(sides.half_u, 0), seen(0, sides.half_v));
    SeenSide incident(seen(sides.middle.u, sides.middle.v), seen(sides.edge_u.u, sides.edge_u.v),
                      seen(sides.edge_v.u, sides.edge_v.v));
    reference.find_near(around), incident.find_near(around);
    const RegionNames names(sides, cut, reference_is_a, reference, incident, around);
    for (std::size_t i = 0; i < cut.size(); ++i) {
        const double depth = -cut[i].height;
        if (!(depth >= least_depth))
            continue;
        deepest = std::max(deepest, depth);
        // Of corners with the same name, the deepest remains.
        const std::uint64_t name = names.name(i, at[i]);
        std::size_t place = 0;
        while (place < count && corners[place].feature != name)
            ++place;
        if (place < count && !(depth > corners[place].depth))
            continue;
        count = std::max(count, place + 1);
        RegionPoint& corner = corners[place];
        corner.x = at[i].x, corner.y = at[i].y, corner.depth = depth, corner.feature = name;
        along_u[place] = cut[i].u, along_v[place] = cut[i].v;
    }
}

} // namespace abut
