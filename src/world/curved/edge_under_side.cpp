#include "world/curved/edge_under_side.h"

#include <cmath>

namespace abut {

namespace {

double cross_of(double ax, double ay, double bx, double by) {
    return ax * by - ay * bx;
}

/// The place of an edge under a line of the solid; both ends of a part if they are parallel.
std::optional<EdgePart> part_on_line(const Vec3& p, const Vec3& q, const CurvedSide& side,
                                     const ContactFrame& frame) {
    const Vec3 a = frame.coordinates(side.corners[0].at), b = frame.coordinates(side.corners[1].at);
    const double way_x = b.x - a.x, way_y = b.y - a.y, edge_x = q.x - p.x, edge_y = q.y - p.y;
    const double turn = cross_of(way_x, way_y, edge_x, edge_y);
    const double sizes = std::hypot(way_x, way_y) * std::hypot(edge_x, edge_y);
    constexpr double kParallel = 0.01;
    if (std::abs(turn) <= kParallel * sizes)
        return std::nullopt;
    const double on_line = cross_of(p.x - a.x, p.y - a.y, edge_x, edge_y) / turn,
                 on_edge = cross_of(p.x - a.x, p.y - a.y, way_x, way_y) / turn;
    if (!(on_line >= 0 && on_line <= 1 && on_edge >= 0 && on_edge <= 1))
        return std::nullopt;
    EdgePart part;
    part.begin = part.end = on_edge;
    part.begin_edge = part.end_edge = side.corners[0].edge;
    return part;
}

} // namespace

std::optional<EdgePart> part_under(const NearEdge& edge, const CurvedSide& side,
                                   const ContactFrame& frame) {
    const Vec3 p = frame.coordinates(edge.from), q = frame.coordinates(edge.to);
    EdgePart part;
    if (side.corners.size() == 2)
        return part_on_line(p, q, side, frame);
    if (!side.is_disc())
        return std::nullopt;
    // Along the normal into the solid, the polygon runs clockwise.
    for (std::size_t i = 0; i < side.corners.size(); ++i) {
        const CurvedSide::Corner &from = side.corners[i],
                                 &to = side.corners[(i + 1) % side.corners.size()];
        const Vec3 a = frame.coordinates(from.at), b = frame.coordinates(to.at);
        const double at_p = -cross_of(b.x - a.x, b.y - a.y, p.x - a.x, p.y - a.y),
                     at_q = -cross_of(b.x - a.x, b.y - a.y, q.x - a.x, q.y - a.y);
        if (at_p < 0 && at_q < 0)
            return std::nullopt;
        if (at_p >= 0 && at_q >= 0)
            continue;
        const double t = at_p / (at_p - at_q);
        if (at_p < 0 && t > part.begin)
            part.begin = t, part.begin_edge = from.edge;
        if (at_q < 0 && t < part.end)
            part.end = t, part.end_edge = from.edge;
    }
    return part.begin <= part.end ? std::optional(part) : std::nullopt;
}

} // namespace abut
