#include "ccd/elementary_exact.h"

#include "ccd/difference_patch.h"
#include "math/integer_polynomial.h"
#include "math/scaled_integers.h"
#include "math/unit_root.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// A root is enclosed in a cell of length 2^-44; the cell's start is the time of impact.
constexpr unsigned kTimeLevel = 44;

using PolynomialVec3 = std::array<IntegerPolynomial, 3>;

IntegerPolynomial dot(const PolynomialVec3& a, const PolynomialVec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
PolynomialVec3 cross(const PolynomialVec3& a, const PolynomialVec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
PolynomialVec3 sum(const PolynomialVec3& a, const PolynomialVec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// A pair's coordinates as integers over one common power of two. No sign depends on that power.
class IntegerPair {
public:
    explicit IntegerPair(const ElementaryPair& pair) : coordinates_(coordinates(pair)) {}

    [[nodiscard]] PolynomialVec3 difference(const VertexDifference& d) const {
        PolynomialVec3 result;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const BigInt start = get(0, d.to, axis) - get(0, d.from, axis),
                         end = get(1, d.to, axis) - get(1, d.from, axis);
            result[axis] = {{start, end - start, BigInt(0), BigInt(0)}};
        }
        return result;
    }

private:
    static std::array<double, 24> coordinates(const ElementaryPair& pair) {
        std::array<double, 24> c{};
        std::size_t i = 0;
        for (const auto* points : {&pair.start, &pair.end})
            for (const Vec3& p : *points)
                c[i] = p.x, c[i + 1] = p.y, c[i + 2] = p.z, i += 3;
        return c;
    }
    [[nodiscard]] BigInt get(std::size_t end, std::size_t vertex, std::size_t axis) const {
        return coordinates_.get<BigInt>(12 * end + 3 * vertex + axis);
    }

    Scaled<24> coordinates_;
};

/// The position of the origin in the patch.
struct PatchPoint {
    double x = 0, y = 0;
    Vec3 normal; ///< normal of the patch, of any length; zero if it is degenerate
    Vec3 line;   ///< for a degenerate patch: the direction of the line that holds it
};

class ExactPatch {
public:
    explicit ExactPatch(const ElementaryPair& pair)
        : kind_(pair.kind), corners_(patch_layout(kind_).corners) {
        const PatchLayout layout = patch_layout(kind_);
        const IntegerPair integers(pair);
        const PolynomialVec3 corner = integers.difference(layout.corner),
                             x = integers.difference(layout.side_x),
                             y = integers.difference(layout.side_y);
        corner_ = {corner, sum(corner, x), sum(corner, y), PolynomialVec3{}};
        if (corners_ == 4)
            corner_ = {corner, corner_[1], sum(corner_[1], y), corner_[2]};
        area_ = cross(x, y);
        coplanarity_ = dot(corner, area_);
    }

    [[nodiscard]] const IntegerPolynomial& coplanarity() const { return coplanarity_; }

    /// Candidate times of the first contact if the origin always lies in the patch's plane. The
    /// signs of the polynomials below decide whether the patch holds the origin, and the times of
    /// contact are a closed set. So the first contact is at time 0 or at a root of one of them. The
    /// roots are sorted, except among those in the same cell of kTimeLevel.
    [[nodiscard]] std::vector<UnitRoot> times_of_change() const {
        std::vector<UnitRoot> times;
        const auto add = [&](const PolynomialVec3& polynomials) {
            for (const IntegerPolynomial& p : polynomials)
                for (UnitRoot& root : unit_roots(p))
                    times.push_back(std::move(root));
        };
        add(area_);
        for (std::size_t i = 0; i < corners_; ++i)
            add(corner_[i]), add({moment(i, 0), moment(i, 1), moment(i, 2)});
        for (UnitRoot& time : times)
            time.refine(kTimeLevel);
        std::stable_sort(times.begin(), times.end(), [](const UnitRoot& a, const UnitRoot& b) {
            return a.lower_bound() < b.lower_bound();
        });
        return times;
    }

    /// The position of the origin in the patch, if the patch holds it. In: the coplanarity is zero
    /// at that time.
    [[nodiscard]] std::optional<PatchPoint> origin_at(UnitRoot& time) const {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (const int side = time.sign_of(area_[axis]); side != 0)
                return origin_in_plane(time, axis, side);
        return origin_in_line(time);
    }

private:
    [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 < corners_ ? i + 1 : 0; }

    /// A coordinate of the cross product of a corner and the next one.
    [[nodiscard]] IntegerPolynomial moment(std::size_t i, std::size_t axis) const {
        const auto &p = corner_[i], &q = corner_[next(i)];
        const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
        return p[y] * q[z] - p[z] * q[y];
    }

    /// Decides after projection along an axis that the patch's plane does not contain: the origin
    /// lies within the patch if and only if the corners run around it in one sense.
    [[nodiscard]] std::optional<PatchPoint> origin_in_plane(UnitRoot& time, std::size_t axis,
                                                            int side) const {
        std::array<IntegerPolynomial, 4> moments;
        for (std::size_t i = 0; i < corners_; ++i) {
            moments[i] = moment(i, axis);
            if (time.sign_of(moments[i]) == -side)
                return std::nullopt;
        }
        time.refine(kTimeLevel);
        const auto value = [&](const IntegerPolynomial& p) { return time.value_at_left(p, 2); };
        const auto area = common_scale<3>({value(area_[0]), value(area_[1]), value(area_[2])});
        // Areas of the triangles of the origin and two sides, relative to the whole area.
        const auto parts =
            common_scale<3>({value(area_[axis]), value(moments[corners_ - 1]), value(moments[0])});
        PatchPoint point;
        if (parts[0] != 0)
            point.x = parts[1] / parts[0], point.y = parts[2] / parts[0];
        point.normal = {area[0], area[1], area[2]};
        return point;
    }

    /// A patch that lies in a line is the union of its sides.
    [[nodiscard]] std::optional<PatchPoint> origin_in_line(UnitRoot& time) const {
        for (std::size_t i = 0; i < corners_; ++i) {
            bool holds = true;
            for (std::size_t axis = 0; axis < 3 && holds; ++axis)
                holds = time.sign_of(moment(i, axis)) == 0 &&
                        time.sign_of(corner_[i][axis]) * time.sign_of(corner_[next(i)][axis]) <= 0;
            if (holds)
                return point_of_side(time, i);
        }
        return std::nullopt;
    }

    [[nodiscard]] PatchPoint point_of_side(UnitRoot& time, std::size_t i) const {
        time.refine(kTimeLevel);
        std::array<BigInt, 6> ends;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ends[axis] = time.value_at_left(corner_[i][axis], 1);
            ends[3 + axis] = time.value_at_left(corner_[next(i)][axis], 1);
        }
        const auto e = common_scale(ends);
        PatchPoint point;
        point.line = {e[3] - e[0], e[4] - e[1], e[5] - e[2]};
        std::size_t longest = 0;
        for (std::size_t axis = 1; axis < 3; ++axis)
            if (std::abs(e[3 + axis] - e[axis]) > std::abs(e[3 + longest] - e[longest]))
                longest = axis;
        const double length = e[3 + longest] - e[longest];
        const double part = length != 0 ? std::clamp(-e[longest] / length, 0.0, 1.0) : 0;
        const auto corners = patch_corners(kind_);
        const auto &from = corners[i], &to = corners[next(i)];
        point.x = (1 - part) * from[0] + part * to[0];
        point.y = (1 - part) * from[1] + part * to[1];
        return point;
    }

    ElementaryKind kind_;
    std::size_t corners_;
    std::array<PolynomialVec3, 4> corner_;
    PolynomialVec3 area_; ///< cross product of the sides, not halved
    IntegerPolynomial coplanarity_;
};

ElementaryImpact impact_at(const ElementaryPair& pair, const UnitRoot& time,
                           const PatchPoint& point) {
    ElementaryImpact impact;
    impact.meet = true;
    impact.time = time.lower_bound();
    impact.barycentric = patch_barycentric(pair.kind, point.x, point.y);
    impact.normal = impact_normal(pair, impact.barycentric, point.normal, point.line);
    return impact;
}

/// The start of the kTimeLevel cell that contains a time.
double cell_begin(double time) {
    return std::ldexp(std::floor(std::ldexp(time, kTimeLevel)), -int{kTimeLevel});
}

std::vector<UnitRoot> times_to_examine(const ExactPatch& patch) {
    if (!patch.coplanarity().is_zero())
        return unit_roots(patch.coplanarity());
    std::vector<UnitRoot> times = patch.times_of_change();
    times.insert(times.begin(), UnitRoot(BigInt(0), 0));
    return times;
}

} // namespace

ElementaryImpact elementary_impact_exact(const ElementaryPair& pair) {
    const ExactPatch patch(pair);
    ElementaryImpact impact;
    for (UnitRoot& time : times_to_examine(patch))
        if (const auto point = patch.origin_at(time)) {
            time.refine(kTimeLevel);
            impact = impact_at(pair, time, *point);
            // A different time in the same cell may have been the first.
            if (patch.coplanarity().is_zero())
                impact.time = cell_begin(impact.time);
            break;
        }
    impact.decided_by = ElementaryStage::exact;
    return impact;
}

} // namespace abut
