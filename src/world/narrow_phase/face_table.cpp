#include "world/narrow_phase/face_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut {

namespace {

constexpr double kCoplanar = 0x1p-40;
constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();

/// A side of a face: from one vertex to another.
struct FaceSide {
    std::uint32_t from = 0, to = 0, face = 0, edge = 0;

    [[nodiscard]] std::array<std::uint32_t, 2> ends() const { return {from, to}; }
};

bool before(const FaceSide& p, const FaceSide& q) {
    return p.ends() < q.ends();
}

/// Twice the area of a polygon, times its normal.
Vec3 area_vector(const Convex& body, std::size_t face) {
    const auto loop = body.face(face);
    const Vec3& first = body.vertices()[loop[0]];
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        sum = sum + cross(body.vertices()[loop[i]] - first, body.vertices()[loop[i + 1]] - first);
    return sum;
}

/// The sides of all faces, sorted by their vertices, with the numbers of the body's edges.
std::vector<FaceSide> sides_of(const Convex& body, std::size_t count) {
    std::vector<FaceSide> sides;
    sides.reserve(2 * body.edges().size());
    for (std::size_t f = 0; f < count; ++f) {
        const auto loop = body.face(f);
        for (std::size_t i = 0; i < loop.size(); ++i)
            sides.push_back({loop[i], loop[i + 1 == loop.size() ? 0 : i + 1],
                             static_cast<std::uint32_t>(f), 0});
    }
    std::sort(sides.begin(), sides.end(), before);
    for (std::size_t e = 0; e < body.edges().size(); ++e) {
        const auto [p, q] = body.edges()[e];
        for (const FaceSide& side : {FaceSide{p, q, 0, 0}, FaceSide{q, p, 0, 0}}) {
            const auto at = std::lower_bound(sides.begin(), sides.end(), side, before);
            if (at != sides.end() && at->ends() == side.ends())
                at->edge = static_cast<std::uint32_t>(e);
        }
    }
    return sides;
}

/// Joins faces that are coplanar to rounding.
class FaceJoiner {
public:
    /// In          count: of the faces; 0 for a body that has none.
    FaceJoiner(const Convex& body, std::size_t count)
        : body_(body), sides_(sides_of(body, count)), group_(count, kNoFace) {
        for (const Vec3& vertex : body.vertices())
            error_ = std::max(error_, kCoplanar * max_abs(vertex));
    }

    /// The faces that lie in the plane of a face and are joined to it; empty if it was joined
    /// before. In: faces in an order in which those of well-known planes come first.
    std::vector<std::uint32_t> joined_to(std::uint32_t seed, const Vec3& normal) {
        std::vector<std::uint32_t> joined;
        if (group_[seed] != kNoFace)
            return joined;
        joined.push_back(seed);
        group_[seed] = seed;
        const Vec3 on = body_.vertices()[body_.face(seed)[0]];
        for (std::size_t next = 0; next < joined.size(); ++next)
            for (const std::uint32_t face : neighbours_of(joined[next]))
                if (group_[face] == kNoFace && lies_in(face, on, normal)) {
                    group_[face] = seed;
                    joined.push_back(face);
                }
        return joined;
    }

    /// The sides around joined faces, in order.
    std::vector<FaceTable::Corner> outline(const std::vector<std::uint32_t>& joined) const {
        std::vector<FaceSide> around;
        for (const std::uint32_t face : joined)
            for (const FaceSide& side : sides_around(face))
                if (group_[across(side)] != group_[face])
                    around.push_back(side);
        std::sort(around.begin(), around.end(), before);
        std::vector<FaceTable::Corner> corners;
        corners.reserve(around.size());
        std::uint32_t vertex = around.empty() ? 0 : around[0].from;
        for (std::size_t i = 0; i < around.size(); ++i) {
            const auto at =
                std::lower_bound(around.begin(), around.end(), FaceSide{vertex, 0, 0, 0}, before);
            if (at == around.end() || at->from != vertex)
                break;
            corners.push_back({vertex, at->edge});
            vertex = at->to;
            if (vertex == around[0].from)
                break;
        }
        return corners;
    }

private:
    [[nodiscard]] const FaceSide& side_between(std::uint32_t from, std::uint32_t to) const {
        return *std::lower_bound(sides_.begin(), sides_.end(), FaceSide{from, to, 0, 0}, before);
    }
    [[nodiscard]] std::uint32_t across(const FaceSide& side) const {
        return side_between(side.to, side.from).face;
    }
    [[nodiscard]] std::vector<FaceSide> sides_around(std::uint32_t face) const {
        const auto loop = body_.face(face);
        std::vector<FaceSide> sides;
        sides.reserve(loop.size());
        for (std::size_t i = 0; i < loop.size(); ++i)
            sides.push_back(side_between(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]));
        return sides;
    }
    [[nodiscard]] std::vector<std::uint32_t> neighbours_of(std::uint32_t face) const {
        std::vector<std::uint32_t> faces;
        for (const FaceSide& side : sides_around(face))
            faces.push_back(across(side));
        return faces;
    }
    [[nodiscard]] bool lies_in(std::uint32_t face, const Vec3& on, const Vec3& normal) const {
        const auto loop = body_.face(face);
        return dot(area_vector(body_, face), normal) > 0 &&
               std::all_of(loop.begin(), loop.end(), [&](std::uint32_t vertex) {
                   return std::abs(dot(body_.vertices()[vertex] - on, normal)) <= error_;
               });
    }

    const Convex& body_;
    std::vector<FaceSide> sides_;
    std::vector<std::uint32_t> group_; ///< for each face, the one that it is joined to
    double error_ = 0;
};

} // namespace

FaceTable::FaceTable(const Convex& body) {
    const std::size_t count = body.dimension() < 2 ? 0 : body.face_count();
    std::vector<Vec3> areas(count);
    std::vector<std::uint32_t> order(count);
    for (std::size_t f = 0; f < count; ++f) {
        areas[f] = area_vector(body, f);
        order[f] = static_cast<std::uint32_t>(f);
    }
    // The planes of large faces are known best.
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
        return length_sq(areas[p]) > length_sq(areas[q]);
    });
    std::vector<std::array<std::uint32_t, 2>> vertex_and_face;
    FaceJoiner joiner(body, count);
    for (const std::uint32_t f : order) {
        const Vec3 normal = normalized_or_zero(areas[f]);
        const auto joined = joiner.joined_to(f, normal);
        if (joined.empty())
            continue;
        const auto corners = joiner.outline(joined);
        corners_.insert(corners_.end(), corners.begin(), corners.end());
        begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
        for (const std::uint32_t face : joined)
            for (const std::uint32_t vertex : body.face(face))
                vertex_and_face.push_back({vertex, static_cast<std::uint32_t>(normals_.size())});
        normals_.push_back(normal);
        double offset = -HUGE_VAL;
        for (const Corner& corner : corners)
            offset = std::max(offset, dot(normal, body.vertices()[corner.vertex]));
        offsets_.push_back(offset);
    }
    std::sort(vertex_and_face.begin(), vertex_and_face.end());
    vertex_and_face.erase(std::unique(vertex_and_face.begin(), vertex_and_face.end()),
                          vertex_and_face.end());
    first_face_.assign(body.vertices().size() + 1, 0);
    faces_.reserve(vertex_and_face.size());
    for (const auto& [vertex, face] : vertex_and_face) {
        ++first_face_[vertex + 1];
        faces_.push_back(face);
    }
    std::partial_sum(first_face_.begin(), first_face_.end(), first_face_.begin());
}

} // namespace abut
