#include "peer_impact.h"

#ifdef ABUT_BENCH_FCL
#include <fcl/fcl.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<FclModel> build(const Mesh& mesh) {
    std::vector<fcl::Vector3d> vertices;
    std::vector<fcl::Triangle> triangles;
    for (const Vec3& p : mesh.positions)
        vertices.emplace_back(p.x, p.y, p.z);
    for (const auto& t : mesh.triangles)
        triangles.emplace_back(t[0], t[1], t[2]);
    auto model = std::make_shared<FclModel>();
    model->beginModel();
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
}

fcl::Transform3d to_fcl(const Pose& pose) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    const auto& q = pose.rotation;
    result.linear() = fcl::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    result.translation() =
        fcl::Vector3d(pose.translation.x, pose.translation.y, pose.translation.z);
    return result;
}

class FclImpactImpl final : public FclImpact {
public:
    FclImpactImpl(const Mesh& a, const Mesh& b) : a_(build(a)), b_(build(b)) {}

    [[nodiscard]] std::optional<double> time_of_impact(const Pose& from_a, const Pose& to_a,
                                                       const Pose& from_b,
                                                       const Pose& to_b) const override {
        const fcl::ContinuousCollisionRequestd request(
            1000, 1e-4, fcl::CCDM_LINEAR, fcl::GST_LIBCCD, fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
        fcl::ContinuousCollisionResultd result;
        fcl::continuousCollide(a_.get(), to_fcl(from_a), to_fcl(to_a), b_.get(), to_fcl(from_b),
                               to_fcl(to_b), request, result);
        return result.is_collide ? std::optional(result.time_of_contact) : std::nullopt;
    }

private:
    std::shared_ptr<FclModel> a_, b_;
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
