#include "volume/lower_bound.h"

#include <cmath>
#include <variant>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volume/lower_bound.cpp"
#include "simd/foreach_target.h"
#include "volume/lower_bound-inl.h"

#ifndef ABUT_VOLUME_LOWER_BOUND_ONCE
#define ABUT_VOLUME_LOWER_BOUND_ONCE
namespace abut {

template <typename V>
struct OneToMany {
    const VolumeBatch<V>* batch;
    const typename V::Image* one;
};

/// Run-time dispatch takes functions, not templates. One function handles all kinds of volume.
using AnyOneToMany = std::variant<OneToMany<BoundingSphere>, OneToMany<Pss>, OneToMany<Lss>,
                                  OneToMany<Rss>, OneToMany<Ssv>, OneToMany<Obb>, OneToMany<Kdop14>,
                                  OneToMany<Kdop18>, OneToMany<Kdop26>>;

} // namespace abut
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

template <std::size_t lanes>
HWY_INLINE void bound_any(const AnyOneToMany& pair, VolumeBounds& bounds) {
    std::visit(
        [&](const auto& p) HWY_ATTR {
            volumes::bound_all<true>(hwy::HWY_NAMESPACE::CappedTag<float, lanes>(), *p.batch,
                                     *p.one, bounds);
        },
        pair);
}
void bound_distances_simd(const AnyOneToMany& pair, VolumeBounds& bounds) {
    bound_any<VolumeBounds::kLanes>(pair, bounds);
}
void bound_distances_one(const AnyOneToMany& pair, VolumeBounds& bounds) {
    bound_any<1>(pair, bounds);
}

} // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(bound_distances_simd);

template <typename V>
void bound_distances(const VolumeBatch<V>& batch, const typename V::Image& one,
                     VolumeBounds& bounds) {
    HWY_DYNAMIC_DISPATCH(bound_distances_simd)(OneToMany<V>{&batch, &one}, bounds);
}

template <typename V>
void bound_distances_reference(const VolumeBatch<V>& batch, const typename V::Image& one,
                               VolumeBounds& bounds) {
    HWY_STATIC_DISPATCH(bound_distances_one)(OneToMany<V>{&batch, &one}, bounds);
}

template <typename V>
float distance_lower_bound(const V& a, const V& b, const typename V::Map& map) {
    VolumeBatch<V> batch;
    batch.set(0, a);
    VolumeBounds bounds{};
    // Only one lane is needed, but eight take no longer.
    bound_distances(batch, image_of(b, map), bounds);
    return std::sqrt(bounds.lower_sq[0]);
}

#define ABUT_INSTANTIATE_BOUNDS(V)                                                                 \
    template void bound_distances(const VolumeBatch<V>&, const V::Image&, VolumeBounds&);          \
    template void bound_distances_reference(const VolumeBatch<V>&, const V::Image&,                \
                                            VolumeBounds&);                                        \
    template float distance_lower_bound(const V&, const V&, const V::Map&)

ABUT_INSTANTIATE_BOUNDS(BoundingSphere);
ABUT_INSTANTIATE_BOUNDS(Pss);
ABUT_INSTANTIATE_BOUNDS(Lss);
ABUT_INSTANTIATE_BOUNDS(Rss);
ABUT_INSTANTIATE_BOUNDS(Ssv);
ABUT_INSTANTIATE_BOUNDS(Obb);
ABUT_INSTANTIATE_BOUNDS(Kdop14);
ABUT_INSTANTIATE_BOUNDS(Kdop18);
ABUT_INSTANTIATE_BOUNDS(Kdop26);

} // namespace abut
#endif
