#include "view/simplify/deviation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

/// A bound may exceed the distance at the corners by this factor.
constexpr double kSlack = 1.1;
constexpr int kMostDepth = 24;
/// Pieces of one triangle.
constexpr int kMostCuts = 400;
constexpr std::size_t kMostPolygonCorners = 12;

/// A convex, flat polygon.
struct Polygon {
    std::array<Vec3, kMostPolygonCorners> corners;
    std::size_t count = 0;

    void add(const Vec3& p) {
        if (count < kMostPolygonCorners)
            corners.at(count++) = p;
    }
    [[nodiscard]] std::span<const Vec3> all() const { return std::span(corners).first(count); }
    [[nodiscard]] Vec3 centre() const {
        Vec3 sum;
        for (const Vec3& p : all())
            sum = sum + p;
        return (1.0 / static_cast<double>(count)) * sum;
    }
};

/// The two parts of a polygon beside a plane; a part without area is empty.
struct Halves {
    Polygon inside, outside;
};

Halves cut(const Polygon& polygon, const Vec3& normal, double offset) {
    Halves halves;
    std::array<double, kMostPolygonCorners> side{};
    for (std::size_t i = 0; i < polygon.count; ++i)
        side.at(i) = dot(normal, polygon.corners.at(i)) - offset;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const std::size_t next = (i + 1) % polygon.count;
        const Vec3 &p = polygon.corners.at(i), &q = polygon.corners.at(next);
        const double a = side.at(i), b = side.at(next);
        if (a <= 0)
            halves.inside.add(p);
        if (a >= 0)
            halves.outside.add(p);
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
            const Vec3 crossing = p + (a / (a - b)) * (q - p);
            halves.inside.add(crossing);
            halves.outside.add(crossing);
        }
    }
    for (Polygon* half : {&halves.inside, &halves.outside})
        if (half->count < 3)
            half->count = 0;
    return halves;
}

class DeviationBound {
public:
    DeviationBound(const TriangleSearch& to, double least, double most)
        : to_(to), limit_(least), most_(most) {}

    [[nodiscard]] double limit() const { return limit_; }
    [[nodiscard]] bool is_over() const { return limit_ > most_; }

    void cover(const Triangle& t) {
        cuts_ = 0;
        Polygon polygon;
        for (const Vec3& p : t)
            polygon.add(p);
        if (is_within(nearest_face(polygon)))
            return;
        for (const Vec3& p : t)
            raise(to_.nearest(p).distance_sq);
        cover(polygon, 0);
    }

private:
    struct NearFace {
        const DistanceFace* face;
        double by_face = 0, by_centre = 0; ///< two bounds
    };

    /// A distance that occurs: the bound cannot be less.
    void raise(double distance_sq) { limit_ = std::max(limit_, kSlack * std::sqrt(distance_sq)); }

    NearFace nearest_face(const Polygon& polygon) {
        const Vec3 centre = polygon.centre();
        const TriangleSearch::Found found = to_.nearest(centre);
        raise(found.distance_sq);
        NearFace near{&to_[found.triangle]};
        double radius_sq = 0, face_sq = 0;
        for (const Vec3& p : polygon.all()) {
            radius_sq = std::max(radius_sq, length_sq(p - centre));
            face_sq = std::max(face_sq, near.face->distance_sq(p));
        }
        near.by_face = std::sqrt(face_sq);
        near.by_centre = std::sqrt(found.distance_sq) + std::sqrt(radius_sq);
        return near;
    }

    [[nodiscard]] bool is_within(const NearFace& near) const {
        return near.by_face <= limit_ || near.by_centre <= limit_;
    }

    /// Makes the limit a bound of the polygon's distance.
    void cover(const Polygon& polygon, int depth) {
        const NearFace near = nearest_face(polygon);
        if (is_within(near) || is_over())
            return;
        if (depth == kMostDepth || ++cuts_ > kMostCuts ||
            (!cut_along(polygon, near.face->corners(), depth) && !halve(polygon, depth)))
            limit_ = std::max(limit_, std::min(near.by_face, near.by_centre));
    }

    /// Cuts off what lies beyond the edges of a face. Returns false if that leaves the polygon as
    /// it is.
    bool cut_along(const Polygon& polygon, const Triangle& face, int depth) {
        const Vec3 up = normalized_or_zero(cross(face[1] - face[0], face[2] - face[0]));
        Polygon inside = polygon;
        std::array<Polygon, 3> beyond;
        std::size_t parts = 0;
        for (std::size_t k = 0; k < 3 && inside.count > 0; ++k) {
            const Vec3 out = cross(face.at((k + 1) % 3) - face.at(k), up);
            // A corner would be lost beyond this number.
            if (inside.count + 1 > kMostPolygonCorners)
                return false;
            const Halves halves = cut(inside, out, dot(out, face.at(k)));
            if (halves.outside.count == 0)
                continue;
            if (halves.inside.count == 0)
                return false;
            inside = halves.inside;
            beyond.at(parts++) = halves.outside;
        }
        if (parts == 0)
            return false;
        cover(inside, depth + 1);
        for (std::size_t i = 0; i < parts; ++i)
            cover(beyond.at(i), depth + 1);
        return true;
    }

    /// Returns false if the polygon cannot be halved.
    bool halve(const Polygon& polygon, int depth) {
        Box3 box;
        for (const Vec3& p : polygon.all())
            extend(box, p);
        const Vec3 extent = box.upper - box.lower;
        Vec3 axis{1, 0, 0};
        if (extent.y >= extent.x && extent.y >= extent.z)
            axis = {0, 1, 0};
        else if (extent.z >= extent.x)
            axis = {0, 0, 1};
        if (polygon.count + 1 > kMostPolygonCorners)
            return false;
        const Halves halves = cut(polygon, axis, 0.5 * dot(axis, box.lower + box.upper));
        if (halves.inside.count == 0 || halves.outside.count == 0)
            return false;
        cover(halves.inside, depth + 1);
        cover(halves.outside, depth + 1);
        return true;
    }

    const TriangleSearch& to_;
    double limit_, most_;
    int cuts_ = 0;
};

} // namespace

double deviation_bound(std::span<const Triangle> from, const TriangleSearch& to, double least,
                       double most) {
    DeviationBound bound(to, least, most);
    for (const Triangle& t : from) {
        bound.cover(t);
        if (bound.is_over())
            break;
    }
    return bound.limit();
}

} // namespace abut
