#include "peers/peer_curved.h"

#ifdef ABUT_BENCH_FCL
#include "peers/fcl_model.h"

#include <cmath>
#include <fmt/format.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

std::shared_ptr<fcl::CollisionGeometryd> fcl_shape(const CurvedShapeOfPeer& shape) {
    const auto height = [](const Vec3& from, const Vec3& to) { return std::abs(to.z - from.z); };
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
        return std::make_shared<fcl::Cylinderd>(cylinder->radius,
                                                height(cylinder->axis.a, cylinder->axis.b));
    if (const auto* cone = std::get_if<Cone>(&shape))
        return std::make_shared<fcl::Coned>(cone->radius, height(cone->apex, cone->base));
    const Vec3& axes = std::get<Ellipsoid>(shape).semi_axes;
    return std::make_shared<fcl::Ellipsoidd>(axes.x, axes.y, axes.z);
}

class FclCurvedPeer final : public CurvedPeer {
public:
    explicit FclCurvedPeer(const std::vector<CurvedShapeOfPeer>& shapes) {
        for (const CurvedShapeOfPeer& shape : shapes)
            shapes_.push_back(fcl_shape(shape));
    }

    [[nodiscard]] std::string name() const override {
        return fmt::format("FCL {}, libccd", FCL_VERSION);
    }
    void set_poses(const std::vector<Pose>& poses) override {
        poses_.clear();
        for (const Pose& pose : poses)
            poses_.push_back(fcl_transform(pose));
    }
    bool collide(std::size_t a, std::size_t b) override {
        fcl::CollisionResultd result;
        return fcl::collide(shapes_[a].get(), poses_[a], shapes_[b].get(), poses_[b],
                            fcl::CollisionRequestd(), result) > 0;
    }
    double signed_distance(std::size_t a, std::size_t b) override {
        fcl::DistanceResultd result;
        fcl::distance(shapes_[a].get(), poses_[a], shapes_[b].get(), poses_[b],
                      fcl::DistanceRequestd(true, true), result);
        return result.min_distance;
    }

private:
    std::vector<std::shared_ptr<fcl::CollisionGeometryd>> shapes_;
    std::vector<fcl::Transform3d> poses_;
};

} // namespace

std::unique_ptr<CurvedPeer> make_fcl_curved(const std::vector<CurvedShapeOfPeer>& shapes) {
    return std::make_unique<FclCurvedPeer>(shapes);
}

#else

std::unique_ptr<CurvedPeer> make_fcl_curved(const std::vector<CurvedShapeOfPeer>& /*shapes*/) {
    return {};
}

#endif

} // namespace abut::bench
