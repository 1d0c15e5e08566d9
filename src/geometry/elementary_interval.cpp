#include "geometry/elementary_interval.h"

#include "geometry/difference_patch.h"
#include "geometry/rounded_patch.h"
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
/// Halvings of [0, 1] after which a cell counts as one possible root, and cells looked at in all.
constexpr int kMostLevel = 12, kMostCells = 64;
/// Newton's method takes some five steps, and one a bit at a double root.
constexpr int kMostSteps = 32;
/// The time of an impact is not certain enough in a longer interval.
constexpr double kLongestImpact = 1e-9;

/// A cubic over one cell [start, start + length] of times, by Bernstein coefficients.
struct CubicCell {
    std::array<double, 4> b;
    double start, length;
    int level; ///< halvings of [0, 1]
};

/// corner . (side_x x side_y): zero where the origin lies in the patch's plane.
struct Coplanarity {
    std::array<double, 4> b{};
    double size;  ///< of the coefficients
    double error; ///< of each coefficient

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
        // Six products of one coordinate each, 12 roundings at most: 6 * 12 eps of their size. The
        // last term covers underflow; products near overflow leave nothing certain.
        const double product = p.side_x.size * p.side_y.size * p.corner.size;
        error = product < 0x1p1000 && p.side_x.size * p.side_y.size < 0x1p1000
                    ? 80 * kUnitRoundoff * product + 0x1p-1000 * (1 + p.corner.size)
                    : kInfinity;
    }

    /// What the polynomial of a cell's coefficients, evaluated and made monotone or not, may be off
    /// by: each halving is three means of means, an evaluation the like with rounded weights, and a
    /// coefficient is raised by three slacks at most.
    [[nodiscard]] double error_at(int level) const {
        return error + (8 * level + 16) * kUnitRoundoff * size + 3 * slack();
    }
    /// A coefficient that falls by less counts as one that does not.
    [[nodiscard]] double slack() const { return 8 * kUnitRoundoff * size; }
};

/// Value at u in [0, 1] of the cell.
double value(const std::array<double, 4>& b, double u) {
    const double v = 1 - u;
    const double b01 = v * b[0] + u * b[1], b12 = v * b[1] + u * b[2], b23 = v * b[2] + u * b[3];
    return v * (v * b01 + u * b12) + u * (v * b12 + u * b23);
}

/// A time interval, and what is known of the coplanarity in it.
struct RootInterval {
    double start, end;
    std::optional<int> sign_start, sign_end; ///< at both ends; nothing where it is not certain
    bool monotone;                           ///< for certain

    [[nodiscard]] bool has_root() const {
        return sign_start && sign_end && *sign_start * *sign_end <= 0;
    }
    [[nodiscard]] bool has_none() const {
        return monotone && sign_start && sign_end && *sign_start * *sign_end > 0;
    }
};

/// Where f(u) = b0 + u (c1 + u (c2 + u c3)) has the value `level`, about: Newton's method, kept
/// between points of known sign. In: f increases from below the level to above it.
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

/// In: the coefficients do not decrease.
RootInterval enclose_increasing(const CubicCell& cell, double error) {
    const auto& b = cell.b;
    const bool below = b[0]<-error, above = b[3]> error;
    double start = 0, end = 1;
    if (below || above) {
        // Where a zero may lie at an end, its neighbourhood ends where the sign becomes certain.
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

/// In: the coefficients do not increase, or do not decrease, but for a slack.
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

/// What happens in an interval of times.
enum class Meeting { apart, meet, unknown };

struct Contact {
    Meeting meeting = Meeting::unknown;
    double x = 0, y = 0; ///< of the origin, about; meaningless where the patch is degenerate
    Vec3 normal;
};

/// Twice an area as seen along a direction, and what it may be off by.
struct Area {
    double value, error;
};

/// Whether the patch holds the origin whenever both lie in one plane, or never does.
///
/// Seen along any fixed direction m, the origin lies in a patch in whose plane it is only if the
/// corners run around it in one sense (weakly), and if they do so strictly: so signs of
/// m . (corner x next corner) tell, for whatever m; the patch's normal tells best.
class OriginTest {
public:
    OriginTest(const RoundedPatch& patch, ElementaryKind kind, const RootInterval& interval)
        : kind_(kind) {
        const double middle = 0.5 * (interval.start + interval.end);
        // Rounding of ends and interpolation, and the way moved within the interval.
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
        // Products that lost digits to underflow, or overflowed, are left to exact arithmetic.
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

    /// At most this far from the origin is the patch's point (x, y), in [0, 1] both, at any time in
    /// the interval.
    [[nodiscard]] double distance_at_most(double x, double y) const {
        // Coordinates instead of a length: their squares may underflow.
        return 1.7321 * (max_abs(corner_ + x * x_ + y * y_) + 2 * (off_corner_ + off_x_ + off_y_));
    }

private:
    /// m . (u x v), |m| at most 1 in each coordinate, u and v off by `off_u` and `off_v` each.
    static Area seen(const Vec3& u, double off_u, const Vec3& v, double off_v, const Vec3& m) {
        const double size_u = max_abs(u), size_v = max_abs(v);
        // Six products: each off by what its factors are off by, and by 8 roundings.
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
    double off_corner_, off_x_, off_y_; ///< what coordinates may be off by at any time in it
};

class Search {
public:
    Search(const ElementaryPair& pair, double delta)
        : pair_(pair), delta_(delta), patch_(pair), coplanarity_(patch_) {}

    /// Cells of time from the earliest on; the first that may hold an impact ends the search.
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
            if (impact_.hit)
                break;
        }
        impact_.decided_by = ElementaryStage::interval;
        return impact_;
    }

private:
    /// False if it is not known what happens in the interval.
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
        impact_.hit = true;
        impact_.status = certain ? Status::exact : Status::bound_only;
        impact_.time = interval.start;
        impact_.barycentric = barycentric;
        impact_.normal = impact_normal(pair_, barycentric, contact.normal, {});
        return true;
    }

    /// Features that touch at the start or the end are common: an exact sign there spares the rest
    /// of exact arithmetic.
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
        return delta_ > 0 &&
               test.distance_at_most(face ? b[1] : b[0], face ? b[2] : b[1]) <= delta_;
    }

    const ElementaryPair& pair_;
    double delta_;
    RoundedPatch patch_;
    Coplanarity coplanarity_;
    ElementaryImpact impact_;
};

} // namespace

std::optional<ElementaryImpact> elementary_impact_interval(const ElementaryPair& pair,
                                                           double delta) {
    return Search(pair, delta).run();
}

} // namespace abut
