#include "rigid/penetration/overlap_crossing.h"

#include "math/predicates.h"

#include <algorithm>
#include <tuple>

namespace abut {

namespace {

using Signs = std::array<int, 3>;

/// On which side of a triangle's plane the corners of another one lie.
Signs sides_of(const Triangle& plane, const Triangle& corners) {
    Signs signs{};
    for (std::size_t i = 0; i < 3; ++i)
        signs.at(i) = orient3d(plane[0], plane[1], plane[2], corners.at(i));
    return signs;
}

bool all_equal(const Signs& signs) {
    return signs[0] == signs[1] && signs[1] == signs[2];
}
bool has_zero(const Signs& signs) {
    return signs[0] == 0 || signs[1] == 0 || signs[2] == 0;
}

/// Returns where an edge meets the plane of a triangle, as a fraction of the edge. The ends of an
/// edge are taken in one order, so that both of its faces get the same point.
struct PointOnEdge {
    Vec3 point;
    double fraction = 0;
};
PointOnEdge meet(const Vec3& from, const Vec3& to, const Triangle& plane) {
    const bool forward = std::tie(from.x, from.y, from.z) < std::tie(to.x, to.y, to.z);
    const Vec3 &u = forward ? from : to, &v = forward ? to : from;
    const Vec3 normal = cross(plane[1] - plane[0], plane[2] - plane[0]);
    const double at_u = dot(normal, u - plane[0]), at_v = dot(normal, v - plane[0]);
    const double drop = at_u - at_v;
    const double t = drop != 0 ? std::clamp(at_u / drop, 0.0, 1.0) : 0.5;
    return {u + t * (v - u), forward ? t : 1 - t};
}

/// Collects the two ends of a crossing.
class CrossingEnds {
public:
    /// Adds the meeting of an edge with the other face, if it goes from side `from` to side `to`.
    void add(bool of_a, std::size_t edge, const Triangle& face, const Triangle& other, int from) {
        const PointOnEdge met = meet(face.at(edge), face.at((edge + 1) % 3), other);
        const bool enters = from > 0;
        // The boundary inside b runs along an edge of a from where the edge enters b: there the
        // segment ends. In face b, the segment runs the other way.
        const bool is_stop = of_a == enters;
        FaceCrossing::End& end = is_stop ? crossing_.stop : crossing_.start;
        ++(is_stop ? stops_ : starts_);
        end = {met.point, of_a, edge, enters, met.fraction};
    }
    [[nodiscard]] FaceCrossing take() {
        crossing_.is_there = starts_ == 1 && stops_ == 1;
        crossing_.is_degenerate = !crossing_.is_there && starts_ + stops_ > 0;
        return crossing_;
    }

private:
    FaceCrossing crossing_;
    int starts_ = 0, stops_ = 0;
};

/// Returns whether a line goes through a triangle whose plane it crosses, by the sides on which it
/// passes the edges; none if it meets an edge.
std::optional<bool> goes_through(const Signs& turns) {
    // It misses the triangle if it passes two edges on different sides.
    if (std::ranges::count(turns, 1) > 0 && std::ranges::count(turns, -1) > 0)
        return false;
    if (has_zero(turns))
        return std::nullopt;
    return true;
}

/// On which sides the edges of two faces pass each other. The sign of an edge of a and one of b
/// serves both faces, since orient3d(p, q, r, s) = orient3d(r, s, p, q).
class EdgeTurns {
public:
    EdgeTurns(const Triangle& a, const Triangle& b) : a_(a), b_(b) { turns_.fill(kUnknown); }

    int turn(std::size_t i, std::size_t j) {
        int& known = turns_.at(3 * i + j);
        if (known == kUnknown)
            known = orient3d(a_.at(i), a_.at((i + 1) % 3), b_.at(j), b_.at((j + 1) % 3));
        return known;
    }
    Signs of_edge_of_a(std::size_t i) { return {turn(i, 0), turn(i, 1), turn(i, 2)}; }
    Signs of_edge_of_b(std::size_t j) { return {turn(0, j), turn(1, j), turn(2, j)}; }

private:
    static constexpr int kUnknown = 2;
    const Triangle& a_;
    const Triangle& b_;
    std::array<int, 9> turns_{};
};

/// Returns whether an edge runs from one side of the other face's plane to the other side.
///
/// In          sides: of the face's corners, seen from the other face. None is 0. Edges within one
///             side are not tested, because parallel edges are coplanar.
bool changes_side(std::size_t edge, const Signs& sides) {
    return sides.at(edge) != sides.at((edge + 1) % 3);
}

FaceCrossing degenerate_crossing() {
    FaceCrossing crossing;
    crossing.is_degenerate = true;
    return crossing;
}

} // namespace

FaceCrossing cross_faces(const Triangle& a, const Triangle& b) {
    const Signs of_a = sides_of(b, a);
    if (all_equal(of_a) && of_a[0] != 0)
        return {};
    const Signs of_b = sides_of(a, b);
    if (all_equal(of_b) && of_b[0] != 0)
        return {};
    if (has_zero(of_a) || has_zero(of_b))
        return degenerate_crossing();
    CrossingEnds ends;
    EdgeTurns turns(a, b);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto hits_b = changes_side(i, of_a) ? goes_through(turns.of_edge_of_a(i)) : false,
                   hits_a = changes_side(i, of_b) ? goes_through(turns.of_edge_of_b(i)) : false;
        if (!hits_b || !hits_a)
            return degenerate_crossing();
        if (*hits_b)
            ends.add(true, i, a, b, of_a.at(i));
        if (*hits_a)
            ends.add(false, i, b, a, of_b.at(i));
    }
    return ends.take();
}

std::optional<int> segment_crossing(const Vec3& from, const Vec3& to, const Triangle& triangle) {
    const int before = orient3d(triangle[0], triangle[1], triangle[2], from);
    const int after = orient3d(triangle[0], triangle[1], triangle[2], to);
    if (before == after && before != 0)
        return 0;
    Signs turns{};
    for (std::size_t j = 0; j < 3; ++j)
        turns.at(j) = orient3d(from, to, triangle.at(j), triangle.at((j + 1) % 3));
    const auto through = goes_through(turns);
    if (through == false)
        return 0;
    if (!through || before == 0 || after == 0)
        return std::nullopt;
    return before > 0 ? 1 : -1;
}

} // namespace abut
