#include "rigid/penetration/face_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// The largest value of min(f, g) for two functions that are linear in the weights of the corners,
/// if it is less than `limit`; else a value that is not. It is taken at a corner, or between two
/// corners where f = g.
double largest_of_smaller(std::span<const double> f, std::span<const double> g, double limit) {
    double largest = 0;
    for (std::size_t i = 0; i < f.size(); ++i)
        largest = std::max(largest, std::min(f[i], g[i]));
    for (std::size_t i = 0; i < f.size() && largest < limit; ++i)
        for (std::size_t j = 0; f[i] > g[i] && j < f.size(); ++j)
            if (f[j] < g[j]) {
                const double share = (f[i] - g[i]) / ((f[i] - g[i]) + (g[j] - f[j]));
                largest = std::max(largest, f[i] + share * (f[j] - f[i]));
            }
    return largest;
}

} // namespace

void FaceBounds::begin(const FaceBounds& enclosing, std::size_t corners) {
    slots_ = enclosing.slots_;
    faces_ = enclosing.faces_;
    corners_ = static_cast<std::uint8_t>(corners);
    for (std::size_t k = 0; k < faces_; ++k)
        std::fill_n(distances_[k].begin(), corners_, kUnknown);
}

void FaceBounds::take_corner(std::size_t i, const FaceBounds& other, std::size_t j) {
    for (std::size_t k = 0; k < faces_; ++k)
        distances_[k][i] = other.distances_[k][j];
}

void FaceBounds::remember(std::uint32_t slot) {
    const auto end = slots_.begin() + faces_;
    auto at = static_cast<std::size_t>(std::find(slots_.begin(), end, slot) - slots_.begin());
    CornerDistances first;
    if (at < faces_) {
        std::copy_n(distances_[at].begin(), corners_, first.begin());
    } else {
        std::fill_n(first.begin(), corners_, kUnknown);
        if (faces_ < kMostFaces)
            ++faces_;
        else
            --at;
    }
    for (; at > 0; --at) {
        slots_[at] = slots_[at - 1];
        std::copy_n(distances_[at - 1].begin(), corners_, distances_[at].begin());
    }
    slots_[0] = slot;
    std::copy_n(first.begin(), corners_, distances_[0].begin());
}

double FaceBounds::least(const WorldSolid& solid, std::span<const Vec3> corners, double wanted) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < faces_ && least > wanted; ++k) {
        const std::span<double> distances(distances_[k].data(), corners_);
        if (std::ranges::find(distances, kUnknown) != distances.end()) {
            const PreparedTriangle& face = solid.prepared_slot(slots_[k]);
            for (std::size_t i = 0; i < corners_; ++i)
                if (distances[i] == kUnknown)
                    distances[i] = std::sqrt(face.distance_sq(corners[i]));
        }
        for (std::size_t other = 0; other <= k; ++other)
            least = std::min(
                least, largest_of_smaller({distances_[other].data(), corners_}, distances, least));
    }
    return least;
}

} // namespace abut
