#include "convex/support/refined_gap.h"

#include "convex/support/local_core.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

/// What a few operations more than those of a farthest point may round.
constexpr double kPointRoundings = 16;

/// Which of the cores a rule belongs to.
struct Owners {
    bool a = false, b = false;
};

/// Newton's method for a direction d of length 1, a value and multipliers with
///     point(d) = value d + sum of multiplier_k (normal_k - level_k d),   normal_k . d = level_k.
class Stationary {
public:
    Stationary(const SupportPair& pair, const Vec3& outward, const LocalCore& a, const LocalCore& b)
        : pair_(pair), d_(outward), a_(a), b_(b) {
        for (std::uint32_t i = 0; i < a_.rule_count; ++i)
            add({a_.rules[i].normal, -a_.rules[i].level}, {true, false});
        for (std::uint32_t i = 0; i < b_.rule_count; ++i)
            add(b_.rules[i], {false, true});
        value_ = dot(points().at, d_);
    }

    /// A rule that no core owns.
    void stay_across(const Vec3& normal) { add({normal, 0}, {}); }

    /// Returns whether the method has converged.
    ///
    /// In          no_pivot: smaller pivots are taken for 0. So the direction stays where it is along a
    ///             curve of equally good ones, around an axis.
    bool solve(double no_pivot) {
        no_pivot_ = no_pivot;
        constexpr int kMostSteps = 12;
        constexpr double kConverged = 0x1p-48, kLargestTurn = 0x1p-4;
        // Rounding turns the direction by more where a curvature is sharp. `result` judges what comes of it.
        constexpr double kRoundingAtSharpEdge = 0x1p-24;
        const Vec3 start = d_;
        double change = 0;
        for (int step = 0; step < kMostSteps; ++step) {
            change = advance();
            if (!(length(d_ - start) <= kLargestTurn))
                return false;
            if (change <= kConverged)
                return true;
        }
        return change <= kRoundingAtSharpEdge;
    }

    /// None if a point has left its feature.
    [[nodiscard]] std::optional<RefinedGap> result() const {
        RefinedGap gap;
        gap.outward = d_, gap.points = points();
        gap.value = dot(pair_.farthest(d_).at, d_);
        Vec3 by_a, by_b;
        for (std::size_t k = 0; k < rule_count_; ++k) {
            const double share = owners_[k].a && owners_[k].b ? 0.5 : 1;
            const Vec3 by = (share * multiplier_[k]) * slope(k);
            if (owners_[k].a)
                by_a = by_a + by;
            if (owners_[k].b)
                by_b = by_b - by;
        }
        const double error = kPointRoundings * pair_.rounding();
        if (!a_.may_move(gap.points.a, by_a, error) ||
            !b_.may_move(gap.points.b - pair_.offset(), by_b, error))
            return std::nullopt;
        gap.points.a = gap.points.a + by_a, gap.points.b = gap.points.b + by_b;
        gap.points.at = gap.points.b - gap.points.a;
        if (!(length(gap.points.at - gap.value * gap.outward) <= error))
            return std::nullopt;
        return gap;
    }

private:
    static constexpr std::size_t kMostRules = 2, kMostUnknowns = 4 + kMostRules;
    using Row = std::array<double, kMostUnknowns + 1>;

    [[nodiscard]] DifferencePoint points() const {
        const Vec3 a = a_.point(-d_), b = b_.point(d_) + pair_.offset();
        return {b - a, a, b};
    }
    /// The direction in which the points may slide along the feature.
    [[nodiscard]] Vec3 slope(std::size_t k) const {
        return rules_[k].normal - rules_[k].level * d_;
    }

    /// Adds a rule that does not follow from the others. Two rules determine the direction.
    void add(const DirectionRule& rule, Owners owners) {
        constexpr double kIndependent = 1e-6;
        Vec3 rest = rule.normal - dot(rule.normal, d_) * d_;
        const double size = length(rest);
        std::size_t last = 0;
        for (std::size_t k = 0; k < rule_count_; ++k) {
            const Vec3& unit = units_[k];
            if (std::abs(dot(rest, unit)) > kIndependent * size)
                last = k;
            rest = rest - dot(rest, unit) * unit;
        }
        if (rule_count_ < kMostRules && length(rest) > kIndependent * size && size > 0) {
            rules_[rule_count_] = rule, owners_[rule_count_] = owners;
            units_[rule_count_++] = normalized_or_zero(rest);
        } else if (rule_count_ > 0) {
            owners_[last].a = owners_[last].a || owners.a;
            owners_[last].b = owners_[last].b || owners.b;
        }
    }

    /// One step. Returns the change of the direction; infinite if the equations have no solution.
    double advance() {
        const std::size_t n = 4 + rule_count_;
        std::array<Row, kMostUnknowns> rows{};
        const std::array<Vec3, 3> unit{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        std::array<Vec3, kMostUnknowns> column{};
        for (std::size_t k = 0; k < 3; ++k)
            // The point of a is farthest along -d, so its derivative has the sign of that of b.
            column[k] = a_.derivative(-d_, unit[k]) + b_.derivative(d_, unit[k]) - value_ * unit[k];
        column[3] = -d_;
        for (std::size_t k = 0; k < rule_count_; ++k)
            column[4 + k] = -slope(k);
        const Vec3 right = -(points().at);
        for (std::size_t k = 0; k < n; ++k)
            for (int i = 0; i < 3; ++i)
                rows[static_cast<std::size_t>(i)][k] = component(column[k], i);
        for (int i = 0; i < 3; ++i) {
            const auto row = static_cast<std::size_t>(i);
            rows[row][n] = component(right, i);
            rows[3][row] = component(d_, i);
            for (std::size_t k = 0; k < rule_count_; ++k)
                rows[4 + k][row] = component(rules_[k].normal, i);
        }
        rows[3][n] = 0.5 * (1 - dot(d_, d_));
        for (std::size_t k = 0; k < rule_count_; ++k)
            rows[4 + k][n] = rules_[k].level - dot(rules_[k].normal, d_);
        if (!eliminate(rows, n, no_pivot_))
            return HUGE_VAL;
        const Vec3 change{rows[0][n], rows[1][n], rows[2][n]};
        d_ = normalized_or_zero(d_ + change), value_ = rows[3][n];
        for (std::size_t k = 0; k < rule_count_; ++k)
            multiplier_[k] = rows[4 + k][n];
        return length(change);
    }

    /// Gaussian elimination with pivots from all rows and columns. The last column becomes the
    /// solution. Returns false if an equation has no solution. Unknowns that the equations do not
    /// determine become 0.
    [[nodiscard]] static bool eliminate(std::array<Row, kMostUnknowns>& rows, std::size_t n,
                                        double no_pivot) {
        std::array<std::size_t, kMostUnknowns> unknown{0, 1, 2, 3, 4, 5};
        std::size_t rank = 0;
        for (; rank < n; ++rank) {
            std::size_t row = rank, column = rank;
            for (std::size_t i = rank; i < n; ++i)
                for (std::size_t k = rank; k < n; ++k)
                    if (std::abs(rows[i][k]) > std::abs(rows[row][column]))
                        row = i, column = k;
            if (!(std::abs(rows[row][column]) > no_pivot))
                break;
            std::swap(rows[rank], rows[row]), std::swap(unknown[rank], unknown[column]);
            for (Row& each : rows)
                std::swap(each[rank], each[column]);
            for (std::size_t i = 0; i < n; ++i) {
                const double factor = i == rank ? 0 : rows[i][rank] / rows[rank][rank];
                for (std::size_t k = rank; factor != 0 && k <= n; ++k)
                    rows[i][k] -= factor * rows[rank][k];
            }
        }
        std::array<double, kMostUnknowns> solution{};
        for (std::size_t k = 0; k < n; ++k)
            if (k < rank)
                solution[unknown[k]] = rows[k][n] / rows[k][k];
            else if (!(std::abs(rows[k][n]) <= no_pivot))
                return false;
        for (std::size_t k = 0; k < n; ++k)
            rows[k][n] = solution[k];
        return true;
    }

    const SupportPair& pair_;
    Vec3 d_;
    LocalCore a_, b_;
    double value_ = 0, no_pivot_ = 0;
    std::array<DirectionRule, kMostRules> rules_{};
    std::array<Owners, kMostRules> owners_{};
    std::array<Vec3, kMostRules> units_{};
    std::array<double, kMostRules> multiplier_{};
    std::size_t rule_count_ = 0;
};

} // namespace

std::optional<RefinedGap> refined(const SupportPair& pair, const Vec3& outward,
                                  const SupportSimplex& nearest, double at_most,
                                  const Vec3& across) {
    constexpr double kNoPivot = 0x1p-44, kNoCurvature = 0x1p-20;
    const LocalCores cores_a = local_cores(pair, PairSide::a, nearest, -outward),
                     cores_b = local_cores(pair, PairSide::b, nearest, outward);
    for (const LocalCore& a : cores_a)
        for (const LocalCore& b : cores_b)
            for (const double no_pivot : {kNoPivot, kNoCurvature}) {
                Stationary stationary(pair, outward, a, b);
                if (across != Vec3{})
                    stationary.stay_across(across);
                if (!stationary.solve(no_pivot))
                    continue;
                if (const auto gap = stationary.result(); gap && gap->value <= at_most)
                    return gap;
            }
    return std::nullopt;
}

} // namespace abut
