#include "ccd/elementary_interval.h"

#include "ccd/difference_patch.h"
#include "ccd/rounded_patch.h"
#include "math/predicates.h"
#include "math/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace abut {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A cell halved kMostLevel times counts as one possible root. At most about kMostCells cells are
/// examined.
constexpr int kMostLevel = 12, kMostCells = 64;
/// Newton's method takes about five steps; at a double root, one step per bit.
constexpr int kMostSteps = 32;
/// A longer interval does not determine the time of impact well enough.
constexpr double kLongestImpact = 1e-9;

/// A cubic over one time cell [start, start + length], by its Bernstein coefficients.
struct CubicCell {
    std::array<double, 4> b;
    double start, length;
    int level; ///< how often [0, 1] was halved
};

/// corner . (side_x x side_y): zero when the origin lies in the patch's plane.
struct Coplanarity {
    std::array<double, 4> b{};
    double size;  ///< magnitude of the largest coefficient
    double error; ///< bound for each coefficient

    explicit Coplanarity(const RoundedPatch& p) {
        const Vec3 area_0 = cross(p.side_x.start, p.side_y.start),
                   area_1 = cross(p.side_x.start, p.side_y.end) +
                            cross(p.side_x.end, p.side_y.start), // twice the middle coefficient
            area_2 = cross(p.side_x.end, p.side_y.end);
        b = {dot(p.corner.start, area_0),
             (dot(p.corner.start, area_1) + dot(p.corner.end, area_0)) / 3,
             (dot(p.corner.end, area_1) + dot(p.corner.start, area_2)) / 3,
             dot(p.corner.end, area_2)};
        size = std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2]), std::abs(b[3])});
        // Each coefficient has six products of one coordinate each, with at most 12 roundings: 6 *
        // 12 eps of their size. The last term covers underflow. Near overflow, nothing is certain.
        const double product = p.side_x.size * p.side_y.size * p.corner.size;
        error = product < 0x1p1000 && p.side_x.size * p.side_y.size < 0x1p1000
                    ? 80 * kUnitRoundoff * product + 0x1p-1000 * (1 + p.corner.size)
                    : kInfinity;
    }

    /// Bound on the error of a cell's polynomial, evaluated or not, made monotone or not. Each
    /// halving takes three means of means, an evaluation the same with rounded weights, and a
    /// coefficient is raised by at most three slacks.
    [[nodiscard]] double error_at(int level) const {
        return error + (8 * level + 16) * kUnitRoundoff * size + 3 * slack();
    }
    /// A coefficient that decreases by less than this counts as not decreasing.
    [[nodiscard]] double slack() const { return 8 * kUnitRoundoff * size; }
};

/// Value of the cell's polynomial at u in [0, 1].
double value(const std::array<double, 4>& b, double u) {
    const double v = 1 - u;
    const double b01 = v * b[0] + u * b[1], b12 = v * b[1] + u * b[2], b23 = v * b[2] + u * b[3];
    return v * (v * b01 + u * b12) + u * (v * b12 + u * b23);
}

/// A time interval, and what is known of the coplanarity in it.
struct RootInterval {
    double start, end;
    std::optional<int> sign_start, sign_end; ///< signs at both ends; empty where not certain
    bool monotone;                           ///< certainly monotone

    [[nodiscard]] bool has_root() const {
        return sign_start && sign_end && *sign_start * *sign_end <= 0;
    }
    [[nodiscard]] bool has_none() const {
        return monotone && sign_start && sign_end && *sign_start * *sign_end > 0;
    }
};

/// The approximate u at which f(u) = b0 + u (c1 + u (c2 + u c3)) equals `level`, by Newton's method
/// kept between points of known sign. In: f increases from below the level to above it.
struct PointOfLevel {
    double u, slope = 0;

    PointOfLevel(const std::array<double, 4>& b, double level, double error)
        : u((b[0] - level) / (b[0] - b[3])) {
        const double c0 = b[0] - level, c1 = 3 * (b[1] - b[0]), c2 = 3 * (b[2] - 2 * b[1] + b[0]),
                     c3 = b[3] - b[0] + 3 * (b[1] - b[2]);
        double low = 0, high = 1;
        for (int i = 0; i < kMostSteps; ++i) {
            const double f = c0 + u * (c1 + u * (c2 + u * c3));
            slope = c1 + u * (2 * c2 + u * (3 * c3));
            (f < 0 ? low : high) = u;
            double next = u - f / slope;
            if (!(next >= low && next <= high))
                next = 0.5 * (low + high);
            const double step = std::abs(next - u);
            u = next;
            if (step <= 0x1p-40 * u || step * slope <= error)
                break;
        }
    }
};

/// Encloses the zeros of a cubic. In: the coefficients do not decrease.
RootInterval enclose_increasing(const CubicCell& cell, double error) {
    const auto& b = cell.b;
    const bool below = b[0]<-error, above = b[3]> error;
    double start = 0, end = 1;
    if (below || above) {
        // If a zero may lie at an end, its neighbourhood extends until the sign becomes certain.
        const double level = below && above ? 0 : below ? -2 * error : 2 * error;
        const PointOfLevel point(b, level, error);
        const double step = 2 * error / std::abs(point.slope) + 4 * kUnitRoundoff;
        for (double width = step; below && start == 0 && width < point.u; width *= 8)
            if (value(b, point.u - width) < -error)
                start = point.u - width;
        for (double width = step; above && end == 1 && width < 1 - point.u; width *= 8)
            if (value(b, point.u + width) > error)
                end = point.u + width;
    }
    const auto time = [&](double u) { return cell.start + u * cell.length; };
    const double least = 2 * error;
    return {std::max(0.0, time(start) - 3 * kUnitRoundoff),
            std::min(1.0, time(end) + 3 * kUnitRoundoff), below ? std::optional(-1) : std::nullopt,
            above ? std::optional(1) : std::nullopt,
            b[1] - b[0] > least && b[2] - b[1] > least && b[3] - b[2] > least};
}

/// Encloses the zeros of a cubic. In: up to a slack, the coefficients do not increase, or do not
/// decrease.
RootInterval enclose_monotone(CubicCell cell, double error) {
    auto& b = cell.b;
    const bool increases = b[0] <= b[3];
    if (!increases)
        for (double& each : b)
            each = -each;
    for (std::size_t i = 1; i < 4; ++i)
        b[i] = std::max(b[i], b[i - 1]);
    RootInterval interval = enclose_increasing(cell, error);
    for (auto* sign : {&interval.sign_start, &interval.sign_end})
        if (*sign && !increases)
            *sign = -**sign;
    return interval;
}

bool is_monotone(const std::array<double, 4>& b, double slack) {
    return (b[0] <= b[1] + slack && b[1] <= b[2] + slack && b[2] <= b[3] + slack) ||
           (b[0] >= b[1] - slack && b[1] >= b[2] - slack && b[2] >= b[3] - slack);
}

bool has_certain_sign(const std::array<double, 4>& b, double error) {
    return (b[0] > error && b[1] > error && b[2] > error && b[3] > error) ||
           (b[0] < -error && b[1] < -error && b[2] < -error && b[3] < -error);
}

std::array<CubicCell, 2> halves(const CubicCell& cell) {
    const auto& b = cell.b;
    const double b01 = 0.5 * (b[0] + b[1]), b12 = 0.5 * (b[1] + b[2]), b23 = 0.5 * (b[2] + b[3]);
    const double b012 = 0.5 * (b01 + b12), b123 = 0.5 * (b12 + b23);
    const double middle = 0.5 * (b012 + b123), length = 0.5 * cell.length;
    return {CubicCell{{b[0], b01, b012, middle}, cell.start, length, cell.level + 1},
            CubicCell{{middle, b123, b23, b[3]}, cell.start + length, length, cell.level + 1}};
}

/// Whether the features share a point in a time interval.
enum class Meeting { apart, meet, unknown };

struct Contact {
    Meeting meeting = Meeting::unknown;
    double x = 0, y = 0; ///< position of the origin, approximate; meaningless if the patch is
                         ///< degenerate
    Vec3 normal;
};

/// Twice an area projected along a direction, and a bound on its error.
struct Area {
    double value, error;
};

/// Decides whether the patch holds the origin whenever the origin lies in its plane, or never does.
///
/// Projected along any fixed direction m, an origin in the plane lies in the patch only if the
/// corners run around it in one sense (weakly), and certainly if they do so strictly. So the signs
/// of m . (corner x next corner) decide, for any m. The patch's normal separates the signs best.
class OriginTest {
public:
    OriginTest(const RoundedPatch& patch, ElementaryKind kind, const RootInterval& interval)
        : kind_(kind) {
        const double middle = 0.5 * (interval.start + interval.end);
        // Covers the rounding of ends and interpolation, and the motion within the interval.
        const double part = 8 * kUnitRoundoff + 2.01 * (interval.end - interval.start);
        corner_ = patch.corner.at(middle);
        x_ = patch.side_x.at(middle);
        y_ = patch.side_y.at(middle);
        off_corner_ = part * patch.corner.size;
        off_x_ = part * patch.side_x.size;
        off_y_ = part * patch.side_y.size;
    }

    [[nodiscard]] Contact decide() const {
        const Vec3 area = cross(x_, y_);
        const double scale = max_abs(area);
        // Where products overflow or lose digits to underflow, exact arithmetic decides.
        const double sizes = (max_abs(corner_) + off_corner_) + (max_abs(x_) + max_abs(y_));
        if (!(scale > 0x1p-900 && sizes < 0x1p450))
            return {};
        Contact contact;
        contact.normal = {area.x / scale, area.y / scale, area.z / scale};
        const Area whole = seen(x_, off_x_, y_, off_y_, contact.normal),
                   at_x0 = seen(y_, off_y_, corner_, off_corner_, contact.normal),
                   at_y0 = seen(corner_, off_corner_, x_, off_x_, contact.normal);
        contact.x = at_x0.value / whole.value;
        contact.y = at_y0.value / whole.value;
        contact.meeting = kind_ == ElementaryKind::vertex_face
                              ? compare(std::array{at_x0, at_y0, rest(whole, at_x0, at_y0)})
                              : compare(std::array{at_x0, at_y0, rest(whole, at_x0, {0, 0}),
                                                   rest(whole, at_y0, {0, 0})});
        return contact;
    }

    /// Upper bound on the distance from the origin to the patch's point (x, y), x and y in [0, 1],
    /// at any time in the interval.
    [[nodiscard]] double distance_at_most(double x, double y) const {
        // Uses the largest coordinate instead of the length, whose square may underflow.
        return 1.7321 * (max_abs(corner_ + x * x_ + y * y_) + 2 * (off_corner_ + off_x_ + off_y_));
    }

private:
    /// m . (u x v), where no coordinate of m exceeds 1; u and v are off by at most `off_u` and
    /// `off_v`.
    static Area seen(const Vec3& u, double off_u, const Vec3& v, double off_v, const Vec3& m) {
        const double size_u = max_abs(u), size_v = max_abs(v);
        // Six products: each is off by its factors' errors and by 8 roundings.
        const double off =
            off_u * size_v + size_u * off_v + off_u * off_v + 8 * kUnitRoundoff * size_u * size_v;
        return {dot(m, cross(u, v)), 6.1 * off + 0x1p-900};
    }
    static Area rest(const Area& whole, const Area& a, const Area& b) {
        const double sizes = std::abs(whole.value) + std::abs(a.value) + std::abs(b.value);
        return {whole.value - (a.value + b.value),
                whole.error + a.error + b.error + 4 * kUnitRoundoff * sizes};
    }
    template <std::size_t n>
    static Meeting compare(const std::array<Area, n>& areas) {
        std::size_t above = 0, below = 0;
        for (const Area& a : areas) {
            above += a.value > a.error ? 1 : 0;
            below += a.value < -a.error ? 1 : 0;
        }
        return above > 0 && below > 0     ? Meeting::apart
               : above == n || below == n ? Meeting::meet
                                          : Meeting::unknown;
    }

    ElementaryKind kind_;
    Vec3 corner_, x_, y_;
    double off_corner_, off_x_, off_y_; ///< bound on a coordinate's error at any time in the
                                        ///< interval
};

class Search {
public:
    Search(const ElementaryPair& pair, double absolute_error)
        : pair_(pair), absolute_error_(absolute_error), patch_(pair), coplanarity_(patch_) {}

    /// Examines cells from the earliest time on. The first that may hold an impact ends the search.
    std::optional<ElementaryImpact> run() {
        if (!(coplanarity_.error < kInfinity))
            return std::nullopt;
        std::array<CubicCell, kMostLevel + 2> stack{};
        std::size_t height = 0;
        stack[height++] = {coplanarity_.b, 0, 1, 0};
        for (int cells = 0; height > 0; ++cells) {
            const CubicCell cell = stack[--height];
            const double error = coplanarity_.error_at(cell.level);
            if (has_certain_sign(cell.b, error))
                continue;
            const bool monotone = is_monotone(cell.b, coplanarity_.slack());
            if (!monotone && cell.level < kMostLevel && cells < kMostCells) {
                const auto [first, second] = halves(cell);
                stack[height++] = second;
                stack[height++] = first;
                continue;
            }
            if (!examine(monotone ? enclose_monotone(cell, error)
                                  : RootInterval{cell.start, cell.start + cell.length, std::nullopt,
                                                 std::nullopt, false}))
                return std::nullopt;
            if (impact_.meet)
                break;
        }
        impact_.decided_by = ElementaryStage::interval;
        return impact_;
    }

private:
    /// Returns false if the interval could not be decided.
    bool examine(RootInterval interval) {
        const OriginTest test(patch_, pair_.kind, interval);
        const Contact contact = test.decide();
        if (contact.meeting == Meeting::apart)
            return true;
        add_signs_of_ends(interval);
        if (interval.has_none())
            return true;
        const auto barycentric = patch_barycentric(pair_.kind, contact.x, contact.y);
        const bool certain = contact.meeting == Meeting::meet && interval.has_root() &&
                             interval.end - interval.start < kLongestImpact;
        if (!certain && !is_near(test, barycentric))
            return false;
        impact_.meet = true;
        impact_.status = certain ? Status::exact : Status::bound_only;
        impact_.time = interval.start;
        impact_.barycentric = barycentric;
        impact_.normal = impact_normal(pair_, barycentric, contact.normal, {});
        return true;
    }

    /// Features often touch at the start or at the end. An exact sign there saves most of the exact
    /// arithmetic.
    void add_signs_of_ends(RootInterval& interval) const {
        const auto sign = [](const std::array<Vec3, 4>& p) {
            return orient3d(p[0], p[1], p[2], p[3]);
        };
        if (!interval.sign_start && interval.start == 0)
            interval.sign_start = sign(pair_.start);
        if (!interval.sign_end && interval.end == 1)
            interval.sign_end = sign(pair_.end);
    }

    [[nodiscard]] bool is_near(const OriginTest& test, const std::array<double, 3>& b) const {
        const bool face = pair_.kind == ElementaryKind::vertex_face;
        return absolute_error_ > 0 &&
               test.distance_at_most(face ? b[1] : b[0], face ? b[2] : b[1]) <= absolute_error_;
    }

    const ElementaryPair& pair_;
    double absolute_error_;
    RoundedPatch patch_;
    Coplanarity coplanarity_;
    ElementaryImpact impact_;
};

} // namespace

std::optional<ElementaryImpact> elementary_impact_interval(const ElementaryPair& pair,
                                                           double absolute_error) {
    return Search(pair, absolute_error).run();
}

} // namespace abut
