#include "convex/proof/exact_depth.h"

namespace abut {

namespace {

template <class Int>
class ExactPolytope {
public:
    using Vector = IntVec3<Int>;

    ExactPolytope(const PlacedPoints& points, const IntegerGrid& grid)
        : difference_(points, grid) {}

    NearestBoundary run(const DifferenceSimplex& start) {
        for (std::uint32_t i = 0; i < start.count; ++i)
            add_corner(start.corners[i]);
        NearestBoundary nearest;
        if (!complete(nearest))
            return nearest;
        begin();
        for (;;) {
            const std::uint32_t f = nearest_face();
            const VertexPair next = difference_.farthest(faces_[f].normal);
            const Vector at = difference_.at(next);
            if (dot(faces_[f].normal, at) == faces_[f].height) {
                finish(faces_[f], nearest);
                return nearest;
            }
            ++nearest.steps;
            grow(next, f);
        }
    }

private:
    struct Side {
        std::uint32_t face = 0, edge = 0;
    };
    struct Face {
        std::array<std::uint32_t, 3> corners{};
        std::array<Side, 3> across{}; ///< across[k]: the side beyond the edge from corner k
        Vector normal;
        Int height{};      ///< of the plane: normal . p for each of its points p
        double offset = 0; ///< the plane's distance, to 2^-49 of itself
        bool alive = true;
    };

    void add_corner(const VertexPair& vertices) {
        vertices_.push_back(vertices);
        at_.push_back(difference_.at(vertices));
        cone_.push_back(0);
    }

    /// Adds the farthest corner along or against a direction, if it lies outside the hull of the
    /// corners so far. Returns whether it did. In: the direction is perpendicular to that hull.
    bool add_beyond(const Vector& direction) {
        if (is_zero(direction))
            return false;
        for (const Vector& d : {direction, -direction}) {
            const VertexPair next = difference_.farthest(d);
            if (dot(d, difference_.at(next) - at_[0]) != 0) {
                add_corner(next);
                return true;
            }
        }
        return false;
    }

    /// Completes the corners to four that span a volume. False if the difference is flat: its plane
    /// holds the origin, and is the answer.
    bool complete(NearestBoundary& flat) {
        const Vector axes[3] = {
            {Int(1), Int(0), Int(0)}, {Int(0), Int(1), Int(0)}, {Int(0), Int(0), Int(1)}};
        if (at_.size() == 1 && !(add_beyond(axes[0]) || add_beyond(axes[1]) || add_beyond(axes[2])))
            return set_flat({1, 0, 0}, flat);
        if (at_.size() == 2) {
            const Vector e = at_[1] - at_[0];
            if (!(add_beyond(cross(e, axes[0])) || add_beyond(cross(e, axes[1])) ||
                  add_beyond(cross(e, axes[2]))))
                return set_flat(perpendicular(direction_of(e)), flat);
        }
        if (at_.size() == 3) {
            const Vector n = cross(at_[1] - at_[0], at_[2] - at_[0]);
            if (!add_beyond(n))
                return set_flat(normalized_or_zero(direction_of(n)), flat);
        }
        return true;
    }

    bool set_flat(const Vec3& normal, NearestBoundary& flat) const {
        flat.normal = normal;
        flat.corners.fill(vertices_[0]);
        flat.weights = {1, 0, 0};
        return false;
    }

    void begin() {
        const Vector n = cross(at_[1] - at_[0], at_[2] - at_[0]);
        const bool turned = dot(n, at_[3] - at_[0]) > 0;
        const std::uint32_t one = turned ? 2 : 1, two = turned ? 1 : 2;
        add_face(0, one, two), add_face(0, two, 3), add_face(two, one, 3), add_face(one, 0, 3);
        join({0, 0}, {3, 0}), join({0, 1}, {2, 0}), join({0, 2}, {1, 0});
        join({1, 1}, {2, 2}), join({1, 2}, {3, 1}), join({2, 1}, {3, 2});
    }

    void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        Face& face = faces_.emplace_back();
        face.corners = {a, b, c};
        face.normal = cross(at_[b] - at_[a], at_[c] - at_[a]);
        face.height = dot(face.normal, at_[a]);
        face.offset = offset_of(face);
    }
    void join(const Side& one, const Side& other) {
        faces_[one.face].across[one.edge] = other;
        faces_[other.face].across[other.edge] = one;
    }

    [[nodiscard]] double offset_of(const Face& face) const {
        const ScaledDouble height = scaled_double(face.height),
                           nn = scaled_double(dot(face.normal, face.normal));
        const double odd = nn.exponent % 2 != 0 ? 2 : 1;
        const int exponent = nn.exponent - (nn.exponent % 2 == 0 ? 0 : 1);
        return std::ldexp(height.mantissa / std::sqrt(odd * nn.mantissa),
                          height.exponent - exponent / 2 + difference_.exponent());
    }

    [[nodiscard]] std::uint32_t nearest_face() const {
        std::uint32_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].alive && faces_[f].offset < least)
                least = faces_[f].offset, nearest = f;
        return nearest;
    }

    static constexpr std::uint32_t next(std::uint32_t k) { return k == 2 ? 0 : k + 1; }

    /// Replaces the faces that see the corner, or have it in their planes, by a cone.
    void grow(const VertexPair& vertices, std::uint32_t seen_by) {
        const auto point = static_cast<std::uint32_t>(at_.size());
        add_corner(vertices);
        std::vector<std::uint32_t> visible{seen_by};
        std::vector<Side> horizon;
        faces_[seen_by].alive = false;
        for (std::size_t i = 0; i < visible.size(); ++i)
            for (const Side& side : std::array(faces_[visible[i]].across)) {
                Face& beyond = faces_[side.face];
                if (!beyond.alive)
                    continue;
                if (dot(beyond.normal, at_[point]) >= beyond.height) {
                    beyond.alive = false;
                    visible.push_back(side.face);
                } else {
                    horizon.push_back(side);
                }
            }
        const auto first = static_cast<std::uint32_t>(faces_.size());
        for (const Side& side : horizon) {
            const std::uint32_t from = faces_[side.face].corners[next(side.edge)],
                                to = faces_[side.face].corners[side.edge];
            const auto face = static_cast<std::uint32_t>(faces_.size());
            cone_[from] = face;
            add_face(from, to, point);
            join({face, 0}, side);
        }
        for (std::uint32_t f = first; f < faces_.size(); ++f)
            join({f, 1}, {cone_[faces_[f].corners[1]], 2});
    }

    /// Writes the foot of the origin on the face's plane, which lies in this face or in a coplanar
    /// one.
    void finish(const Face& face, NearestBoundary& nearest) const {
        nearest.normal = normalized_or_zero(direction_of(face.normal));
        nearest.depth = face.offset;
        nearest.at_least =
            std::max(0.0, face.offset * (1 - 0x1p-48) - std::numeric_limits<double>::denorm_min());
        for (const Face& f : faces_)
            if (f.alive && holds_foot(f, face, nearest))
                return;
    }

    bool holds_foot(const Face& f, const Face& face, NearestBoundary& nearest) const {
        for (const std::uint32_t c : f.corners)
            if (dot(face.normal, at_[c]) != face.height)
                return false;
        const Vector &p = at_[f.corners[0]], &q = at_[f.corners[1]], &r = at_[f.corners[2]];
        const Int weights[3] = {dot(cross(q, r), f.normal), dot(cross(r, p), f.normal),
                                dot(cross(p, q), f.normal)};
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (weights[k] < 0)
                return false;
            const ScaledDouble w = scaled_double(weights[k]),
                               all = scaled_double(weights[0] + weights[1] + weights[2]);
            nearest.weights[k] =
                w.mantissa == 0
                    ? 0
                    : std::ldexp(w.mantissa, std::max(w.exponent - all.exponent, -1000));
            sum += nearest.weights[k];
            nearest.corners[k] = vertices_[f.corners[k]];
        }
        for (double& w : nearest.weights)
            w /= sum;
        return true;
    }

    IntegerDifference<Int> difference_;
    std::vector<VertexPair> vertices_;
    std::vector<Vector> at_;
    std::vector<std::uint32_t> cone_; ///< by corner: the face of the cone that begins there
    std::vector<Face> faces_;
};

} // namespace

NearestBoundary exact_depth(const PlacedPoints& points, const IntegerGrid& grid,
                            const DifferenceSimplex& start) {
    return with_integers(grid,
                         [&]<class Int>() { return ExactPolytope<Int>(points, grid).run(start); });
}

} // namespace abut
