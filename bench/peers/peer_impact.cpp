#include "peers/peer_impact.h"

#ifdef ABUT_BENCH_FCL
#include "peers/fcl_model.h"
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

class FclImpactImpl final : public FclImpact {
public:
    FclImpactImpl(const Mesh& a, const Mesh& b)
        : a_(fcl_model<fcl::OBBRSSd>(a)), b_(fcl_model<fcl::OBBRSSd>(b)) {}

    [[nodiscard]] std::optional<double> time_of_impact(const Pose& from_a, const Pose& to_a,
                                                       const Pose& from_b,
                                                       const Pose& to_b) const override {
        const fcl::ContinuousCollisionRequestd request(
            1000, 1e-4, fcl::CCDM_LINEAR, fcl::GST_LIBCCD, fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
        fcl::ContinuousCollisionResultd result;
        fcl::continuousCollide(a_.get(), fcl_transform(from_a), fcl_transform(to_a), b_.get(),
                               fcl_transform(from_b), fcl_transform(to_b), request, result);
        return result.is_collide ? std::optional(result.time_of_contact) : std::nullopt;
    }

private:
    std::shared_ptr<const fcl::CollisionGeometryd> a_, b_;
};

} // namespace

std::unique_ptr<FclImpact> make_fcl_impact(const Mesh& a, const Mesh& b) {
    return std::make_unique<FclImpactImpl>(a, b);
}

#else

std::unique_ptr<FclImpact> make_fcl_impact(const Mesh& /*a*/, const Mesh& /*b*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
