#include "geometry/box_triangle_intersect.h"

#include "math/predicates.h"

#include <utility>

namespace abut {

namespace {

double& coordinate(Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// The least and the greatest corner of the box along a direction. Only the signs of the
/// direction's components matter; on an axis where a component is zero, either end serves.
struct Corners {
    Vec3 least, greatest;

    explicit Corners(const Box3& box) : least(box.lower), greatest(box.upper) {}
    void turn(int axis, double direction) {
        if (direction < 0)
            std::swap(coordinate(least, axis), coordinate(greatest, axis));
    }
};

/// Whether a plane through the edge p q, parallel to a coordinate axis, separates the box from the
/// triangle: the third vertex r lies on it or on one side, the box strictly on the other.
bool edge_separates(const Box3& box, const Vec3& p, const Vec3& q, const Vec3& r, int axis) {
    // orient2d(p, q, x) grows with x along (-(q - p)_v, (q - p)_u).
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Corners corners(box);
    corners.turn(u, component(q, v) > component(p, v) ? -1 : 1);
    corners.turn(v, component(q, u) < component(p, u) ? -1 : 1);
    if (orient2d(p, q, corners.least, axis) > 0)
        return orient2d(p, q, r, axis) <= 0;
    return orient2d(p, q, corners.greatest, axis) < 0 && orient2d(p, q, r, axis) >= 0;
}

bool plane_separates(const Box3& box, const Triangle& t) {
    Corners corners(box);
    for (int axis = 0; axis < 3; ++axis)
        corners.turn(axis, orient2d(t[0], t[1], t[2], axis)); // the sign of the normal's component
    return orient3d(t[0], t[1], t[2], corners.least) > 0 ||
           orient3d(t[0], t[1], t[2], corners.greatest) < 0;
}

} // namespace

bool box_triangle_intersect(const Box3& box, const Triangle& t) {
    Box3 bounds;
    for (const Vec3& p : t) {
        if (encloses(box, {p, p}))
            return true;
        extend(bounds, p);
    }
    if (!overlap(box, bounds) || plane_separates(box, t))
        return false;
    for (std::size_t i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (edge_separates(box, t[i], t[(i + 1) % 3], t[(i + 2) % 3], axis))
                return false;
    return true;
}

} // namespace abut
