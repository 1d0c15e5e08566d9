#include "measure.h"
#include "peers/peer_rigid.h"

#ifdef ABUT_BENCH_FCL
#include "peers/fcl_model.h"

#include <fmt/format.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

class FclPeer final : public RigidPeer {
public:
    using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

    FclPeer(const std::string& volume, Geometry a, Geometry b)
        : name_(fmt::format("FCL {}, {}", FCL_VERSION, volume)), measures_(volume != "OBB"),
          a_(std::move(a)), b_(std::move(b)) {}

    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] bool answers(RigidQuery query) const override {
        // FCL has no distance between OBB hierarchies.
        return measures_ || query == RigidQuery::first_contact || query == RigidQuery::all_contacts;
    }
    void place(const PosedPair& poses) override {
        world_from_a_ = fcl_transform(poses.a), world_from_b_ = fcl_transform(poses.b);
    }
    double run(RigidQuery query, const PosedPair& /*poses*/, double tolerance) override {
        if (query == RigidQuery::first_contact || query == RigidQuery::all_contacts) {
            const bool all = query == RigidQuery::all_contacts;
            const fcl::CollisionRequestd request(all ? std::size_t{1} << 30 : 1, false);
            fcl::CollisionResultd result;
            fcl::collide(a_.get(), world_from_a_, b_.get(), world_from_b_, request, result);
            return static_cast<double>(result.numContacts());
        }
        const fcl::DistanceRequestd request(false);
        // A search that starts at the tolerance skips everything farther away.
        fcl::DistanceResultd result(
            query == RigidQuery::within ? tolerance : std::numeric_limits<double>::max());
        fcl::distance(a_.get(), world_from_a_, b_.get(), world_from_b_, request, result);
        return query == RigidQuery::distance     ? std::max(0.0, result.min_distance)
               : result.min_distance < tolerance ? 1
                                                 : 0;
    }

private:
    std::string name_;
    bool measures_;
    Geometry a_, b_;
    fcl::Transform3d world_from_a_, world_from_b_;
};

template <class BoundingVolume>
std::unique_ptr<RigidPeer> make_peer(const std::string& volume, const Mesh& a, const Mesh& b) {
    return std::make_unique<FclPeer>(volume, fcl_model<BoundingVolume>(a),
                                     fcl_model<BoundingVolume>(b));
}

} // namespace

std::vector<std::unique_ptr<RigidPeer>> make_fcl_peers(const Mesh& a, const Mesh& b) {
    std::vector<std::unique_ptr<RigidPeer>> peers;
    peers.push_back(make_peer<fcl::OBBRSSd>("OBBRSS", a, b));
    peers.push_back(make_peer<fcl::RSSd>("RSS", a, b));
    peers.push_back(make_peer<fcl::kIOSd>("kIOS", a, b));
    peers.push_back(make_peer<fcl::OBBd>("OBB", a, b));
    return peers;
}

std::optional<FclBuild> fcl_build(const Mesh& mesh) {
    const double start = thread_seconds();
    const auto model = fcl_model<fcl::OBBRSSd>(mesh);
    const double seconds = thread_seconds() - start;
    return FclBuild{seconds, static_cast<double>(model->memUsage(0))};
}

#else

std::vector<std::unique_ptr<RigidPeer>> make_fcl_peers(const Mesh& /*a*/, const Mesh& /*b*/) {
    return {};
}
std::optional<FclBuild> fcl_build(const Mesh& /*mesh*/) {
    return {};
}

#endif

} // namespace abut::bench
