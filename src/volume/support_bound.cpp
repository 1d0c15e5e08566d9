#include "volume/support_bound.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/support_bound.cpp"
#include "simd/foreach_target.h"
#include "math/power_of_two.h"
#include "math/rounding.h"
#include "simd/simd.h"
#include "volume/aabb.h"

#include <limits>

#ifndef ABUT_SUPPORT_BOUND_ONCE
#define ABUT_SUPPORT_BOUND_ONCE
namespace abut {

/// Number of points processed at a time, a multiple of all lane counts.
inline constexpr std::size_t kPointsOfBlock = 256;
/// Coordinates of points.
using PointBatch = std::array<std::array<float, kPointsOfBlock>, 3>;

/// Extreme heights of points along the directions to the nodes of a face with the same v. The
/// lowest ones give the heights along the opposite nodes.
struct RowHeights {
    std::array<float, SupportBound::kNodes> highest, lowest;
};

/// The nodes' u or v, from -1 to 1.
inline float grid_line(std::size_t i) {
    return 2.0F / SupportBound::kCells * static_cast<float>(i) - 1;
}

} // namespace abut
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Extends the heights of the nodes (1, u_i, v) of an axis by a batch's points.
void extend_row(const PointBatch& batch, std::size_t axis, float v, RowHeights& heights) {
    const hn::CappedTag<float, 16> d;
    using V = hn::VFromD<decltype(d)>;
    const float *const forward = batch[axis].data(), *const along_u = batch[(axis + 1) % 3].data(),
                       *const along_v = batch[(axis + 2) % 3].data();
    constexpr std::size_t kNodes = SupportBound::kNodes;
    V high[kNodes], low[kNodes];
    for (std::size_t i = 0; i < kNodes; ++i) {
        high[i] = hn::Set(d, heights.highest[i]);
        low[i] = hn::Set(d, heights.lowest[i]);
    }
    for (std::size_t lane = 0; lane < kPointsOfBlock; lane += hn::Lanes(d)) {
        const V start =
            hn::MulAdd(hn::Set(d, v), hn::LoadU(d, along_v + lane), hn::LoadU(d, forward + lane));
        const V way = hn::LoadU(d, along_u + lane);
        for (std::size_t i = 0; i < kNodes; ++i) {
            const V height = hn::MulAdd(hn::Set(d, grid_line(i)), way, start);
            high[i] = hn::Max(high[i], height);
            low[i] = hn::Min(low[i], height);
        }
    }
    for (std::size_t i = 0; i < kNodes; ++i) {
        heights.highest[i] = hn::GetLane(hn::MaxOfLanes(d, high[i]));
        heights.lowest[i] = hn::GetLane(hn::MinOfLanes(d, low[i]));
    }
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(extend_row);

namespace {

/// Fills a batch with points, relative to the middle and scaled. The last point is repeated.
void fill(PointBatch& batch, std::span<const Vec3> points, const Vec3& middle,
          const PowerOfTwo& scale) {
    for (std::size_t lane = 0; lane < kPointsOfBlock; ++lane) {
        const Vec3 p = scale * (points[std::min(lane, points.size() - 1)] - middle);
        batch[0][lane] = to_float(p.x);
        batch[1][lane] = to_float(p.y);
        batch[2][lane] = to_float(p.z);
    }
}

} // namespace

SupportBound::SupportBound(std::span<const Vec3> points) {
    constexpr float kNothing = -std::numeric_limits<float>::infinity();
    heights_.fill(kNothing);
    if (points.empty())
        return;
    Box3 box;
    for (const Vec3& p : points)
        extend(box, p);
    middle_ = 0.5 * box.lower + 0.5 * box.upper;
    const Vec3 half = max(box.upper - middle_, middle_ - box.lower);
    size_ = half.x + half.y + half.z;

    std::array<RowHeights, 3 * kNodes> rows{}; // by axis, then v
    for (RowHeights& row : rows) {
        row.highest.fill(kNothing);
        row.lowest.fill(-kNothing);
    }
    // Coordinates are scaled to about 1, far from the limits of single precision.
    const int exponent = size_ > 0 ? std::ilogb(size_) : 0;
    const PowerOfTwo size(exponent), inverse(-exponent);
    PointBatch batch;
    for (std::size_t first = 0; first < points.size(); first += kPointsOfBlock) {
        fill(batch, points.subspan(first, std::min(kPointsOfBlock, points.size() - first)), middle_,
             inverse);
        for (std::size_t row = 0; row < rows.size(); ++row)
            HWY_DYNAMIC_DISPATCH(extend_row)
        (batch, row / kNodes, grid_line(row % kNodes), rows[row]);
    }
    // Covers five roundings in single precision of values of at most size().
    const double rounding = 0x1p-21 * size_;
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t i = 0; i < kNodes; ++i) {
            const std::size_t axis = row / kNodes, j = row % kNodes;
            const auto node = [&](std::size_t face, std::size_t v, std::size_t u) -> float& {
                return heights_[((2 * axis + face) * kNodes + v) * kNodes + u];
            };
            node(0, j, i) = round_up(size * rows[row].highest[i] + rounding);
            // -(1, u, v) is (-1, -u, -v).
            node(1, kCells - j, kCells - i) = round_up(-(size * rows[row].lowest[i]) + rounding);
        }
}

} // namespace abut
#endif
