// A placed polytope in SIMD form, for many vertices and directions.

// Included once for each target.
#if defined(ABUT_CONVEX_PLACED_XYZ_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_CONVEX_PLACED_XYZ_INL_H
#undef ABUT_CONVEX_PLACED_XYZ_INL_H
#else
#define ABUT_CONVEX_PLACED_XYZ_INL_H
#endif

#include "convex/hull/placed_polytope.h"
#include "math/xyz-inl.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Gives the same values as PlacedPolytope, bit by bit.
class PlacedXyz {
public:
    HWY_INLINE explicit PlacedXyz(const PlacedPolytope& placed)
        : polytope_(placed.polytope), linear_(placed.linear), offset_(to_xyz(placed.offset)) {
        const double* const m = linear_->m.data();
        for (std::size_t i = 0; i < 3; ++i) {
            column_[i] = load_xyz(m + 3 * i);
            row_[i] = to_xyz({m[i], m[3 + i], m[6 + i]});
        }
    }

    [[nodiscard]] HWY_INLINE const Polytope& polytope() const { return *polytope_; }
    [[nodiscard]] HWY_INLINE Xyz place(const Vec3& v) const {
        return v.x * column_[0] + v.y * column_[1] + v.z * column_[2] + offset_;
    }
    [[nodiscard]] HWY_INLINE Xyz vertex(std::uint32_t v) const {
        return place(polytope_->vertices[v].at);
    }
    [[nodiscard]] HWY_INLINE Xyz pulled_back(const Xyz& n) const {
        return n.x() * row_[0] + n.y() * row_[1] + n.z() * row_[2];
    }
    /// The same, of coordinates that lie in memory one by one.
    [[nodiscard]] HWY_INLINE Vec3 pulled_back(const Vec3& n) const {
        return pull_back(*linear_, n);
    }

private:
    const Polytope* polytope_;
    const Transform* linear_;
    Xyz column_[3], row_[3], offset_;
};

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
