#include "clash/rules/pair_precision.h"

#include "math/rounding.h"
#include "math/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Returns half the distance of neighbouring floats at a value: what rounding to single precision
/// moves a number of that size by, at most.
double half_step(double value) {
    constexpr int kDigits = 24, kSmallest = -126; // of the significand; exponent of normal floats
    if (value == 0 || !std::isfinite(value))
        return 0;
    return std::ldexp(1.0, std::max(std::ilogb(value), kSmallest) - kDigits);
}

/// Returns the largest length of (±a) + (±b) + (±c).
double longest_sum(const Vec3& a, const Vec3& b, const Vec3& c) {
    double most = 0;
    for (const Vec3& sum : {a + b + c, a + b - c, a - b + c, a - b - c})
        most = std::max(most, length(sum));
    return most;
}

} // namespace

Vec3 reach_of(const Box3& box) {
    if (!(box.lower.x <= box.upper.x))
        return {};
    const auto reach = [](double lower, double upper) {
        return std::max(std::abs(lower), std::abs(upper));
    };
    return {reach(box.lower.x, box.upper.x), reach(box.lower.y, box.upper.y),
            reach(box.lower.z, box.upper.z)};
}

double single_rounding(const ModelPrecision& precision, const Vec3& mesh_reach,
                       const Transform& world_from_mesh) {
    const std::array<double, 3> most{mesh_reach.x, mesh_reach.y, mesh_reach.z};
    const auto& m = world_from_mesh.m;
    double rounding = 0;
    if (precision.single_meshes) {
        const double step = half_step(max_abs(mesh_reach));
        std::array<Vec3, 3> moved;
        for (std::size_t axis = 0; axis < 3; ++axis)
            moved.at(axis) = step * Vec3{m[3 * axis], m[3 * axis + 1], m[3 * axis + 2]};
        rounding += longest_sum(moved[0], moved[1], moved[2]);
    }
    if (precision.single_transforms) {
        std::array<double, 3> error{};
        for (std::size_t row = 0; row < 3; ++row) {
            error.at(row) = half_step(m.at(9 + row));
            for (std::size_t axis = 0; axis < 3; ++axis)
                error.at(row) += half_step(m.at(3 * axis + row)) * most.at(axis);
        }
        rounding += std::hypot(error[0], error[1], error[2]);
    }
    return rounding;
}

double double_rounding(const Box3& a, const Box3& b) {
    // A corner of a triangle is the sum of four terms, and a length takes some fifty operations on
    // corners.
    constexpr double kRounding = 64 * kUnitRoundoff;
    double size = 0;
    for (const Box3& box : {a, b})
        if (!is_empty(box))
            size += std::max(max_abs(box.lower), max_abs(box.upper));
    return kRounding * size;
}

void PairPrecision::add(std::uint32_t model, double stated, double rounding) {
    if (runs_.empty() || runs_.back().model != model)
        runs_.push_back({roundings_.size(), model, stated, 0});
    float kept = to_float(rounding);
    if (double{kept} < rounding)
        kept = std::nextafter(kept, std::numeric_limits<float>::infinity());
    roundings_.push_back(kept);
    most_stated_ = std::max(most_stated_, stated);
    runs_.back().most_rounding = std::max(runs_.back().most_rounding, double{kept});
    most_rounding_ = std::max(most_rounding_, double{kept});
}

PairPrecision::Run PairPrecision::run_of(std::size_t part) const {
    if (part >= roundings_.size())
        return {};
    return *(std::ranges::upper_bound(runs_, part, {}, &Run::first) - 1);
}

double PairPrecision::rounding(std::size_t i, std::size_t k) const {
    return of(i) + of(k);
}

double PairPrecision::tolerance(std::size_t i, std::size_t k) const {
    return std::max({run_of(i).stated, run_of(k).stated, rounding(i, k)});
}

double PairPrecision::largest() const {
    return std::max(most_stated_, 2 * most_rounding_);
}

double PairPrecision::rounding_of_model(std::uint32_t model) const {
    const auto run = std::ranges::find(runs_, model, &Run::model);
    return run == runs_.end() ? 0 : run->most_rounding;
}

PairPrecision::Origin PairPrecision::origin(std::size_t i, std::size_t k) const {
    const Run a = run_of(i), b = run_of(k);
    if (std::max(a.stated, b.stated) >= rounding(i, k) && std::max(a.stated, b.stated) > 0)
        return {b.stated > a.stated ? b.model : a.model, true};
    return {of(k) > of(i) ? b.model : a.model, false};
}

std::uint64_t PairPrecision::bytes() const {
    return roundings_.capacity() * sizeof(float) + runs_.capacity() * sizeof(Run);
}

} // namespace abut
