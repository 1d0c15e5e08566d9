#include "peers/peer_convex.h"

#ifdef ABUT_BENCH_FCL
#include "peers/fcl_model.h"

#include <fmt/format.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

std::shared_ptr<fcl::Convexd> fcl_convex(const Convex& body) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const Vec3& p : body.vertices())
        vertices->emplace_back(p.x, p.y, p.z);
    // Each face is its number of vertices, followed by their indices.
    auto faces = std::make_shared<std::vector<int>>();
    for (std::size_t f = 0; f < body.face_count(); ++f) {
        faces->push_back(static_cast<int>(body.face(f).size()));
        faces->insert(faces->end(), body.face(f).begin(), body.face(f).end());
    }
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(body.face_count()), faces);
}

class FclConvexPeer final : public ConvexPeer {
public:
    FclConvexPeer(const Convex& a, const Convex& b) : a_(fcl_convex(a)), b_(fcl_convex(b)) {}

    [[nodiscard]] std::string name() const override {
        return fmt::format("FCL {}, libccd", FCL_VERSION);
    }
    void set_poses(const std::vector<PosedPair>& poses) override {
        poses_.clear();
        for (const PosedPair& p : poses)
            poses_.push_back({fcl_transform(p.a), fcl_transform(p.b)});
    }
    double distance(std::size_t pose) override {
        const auto& [a, b] = poses_[pose];
        fcl::DistanceResultd result;
        fcl::distance(a_.get(), a, b_.get(), b, fcl::DistanceRequestd(true), result);
        return std::max(0.0, result.min_distance); // -1 if they meet
    }
    double penetration(std::size_t pose) override {
        // Uses libccd's expanding polytope: fcl::collide returns a depth that is not the smallest.
        const auto& [a, b] = poses_[pose];
        fcl::DistanceResultd result;
        fcl::distance(a_.get(), a, b_.get(), b, fcl::DistanceRequestd(true, true), result);
        return -result.min_distance;
    }

private:
    struct Poses {
        fcl::Transform3d a, b;
    };
    std::shared_ptr<fcl::Convexd> a_, b_;
    std::vector<Poses> poses_;
};

} // namespace

std::unique_ptr<ConvexPeer> make_fcl_convex(const Convex& a, const Convex& b) {
    return std::make_unique<FclConvexPeer>(a, b);
}

#else

std::unique_ptr<ConvexPeer> make_fcl_convex(const Convex& /*a*/, const Convex& /*b*/) {
    return {};
}

#endif

} // namespace abut::bench
