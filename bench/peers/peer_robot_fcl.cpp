#include "peers/peer_robot.h"

#ifdef ABUT_BENCH_FCL

#include "peers/fcl_model.h"

#include <set>
#include <vector>

namespace abut::bench {

namespace {

/// A dynamic tree of boxes over the links' shapes, as planners use FCL. The callbacks leave out the
/// pairs that are allowed.
class FclRobot : public RobotPeer {
public:
    explicit FclRobot(const Robot& robot) : pairs_(robot.pairs().begin(), robot.pairs().end()) {
        const RobotDescription& description = robot.description();
        for (std::uint32_t link = 0; link < description.links.size(); ++link)
            for (const RobotShape& shape : description.links[link].shapes) {
                objects_.push_back(std::make_unique<fcl::CollisionObjectd>(
                    fcl_model<fcl::OBBRSSd>(shape.mesh), fcl::Transform3d::Identity()));
                links_.push_back(link);
                places_.push_back(fcl_transform(shape.link_from_shape));
            }
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): as FCL's users store numbers
        for (std::size_t i = 0; i < objects_.size(); ++i)
            objects_[i]->setUserData(&links_[i]);
        for (const auto& object : objects_)
            manager_.registerObject(object.get());
        manager_.setup();
    }
    [[nodiscard]] std::string name() const override { return "FCL"; }

    bool collide(std::span<const Transform> links) override {
        move(links);
        meets_ = false;
        manager_.collide(this, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* self) {
            return static_cast<FclRobot*>(self)->collide_pair(a, b);
        });
        return meets_;
    }
    double distance(std::span<const Transform> links) override {
        move(links);
        least_ = std::numeric_limits<double>::infinity();
        manager_.distance(this, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* self,
                                   double& least) {
            return static_cast<FclRobot*>(self)->distance_pair(a, b, least);
        });
        return least_;
    }

private:
    void move(std::span<const Transform> links) {
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            objects_[i]->setTransform(fcl_transform(links[links_[i]]) * places_[i]);
            objects_[i]->computeAABB();
        }
        manager_.update();
    }
    [[nodiscard]] bool is_tested(const fcl::CollisionObjectd* a,
                                 const fcl::CollisionObjectd* b) const {
        const auto link = [](const fcl::CollisionObjectd* object) {
            return *static_cast<const std::uint32_t*>(object->getUserData());
        };
        return pairs_.contains(std::minmax(link(a), link(b)));
    }
    bool collide_pair(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b) {
        if (is_tested(a, b)) {
            fcl::CollisionResultd result;
            meets_ = fcl::collide(a, b, fcl::CollisionRequestd(), result) > 0;
        }
        return meets_;
    }
    bool distance_pair(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, double& least) {
        if (is_tested(a, b)) {
            fcl::DistanceResultd result;
            result.min_distance = least_;
            fcl::distance(a, b, fcl::DistanceRequestd(), result);
            least_ = std::max(0.0, std::min(least_, result.min_distance));
        }
        least = least_;
        return least_ <= 0;
    }

    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
    std::vector<std::uint32_t> links_;
    std::vector<fcl::Transform3d> places_;
    fcl::DynamicAABBTreeCollisionManagerd manager_;
    bool meets_ = false;
    double least_ = 0;
};

} // namespace

std::unique_ptr<RobotPeer> make_fcl_robot(const Robot& robot) {
    return std::make_unique<FclRobot>(robot);
}

} // namespace abut::bench

#else

namespace abut::bench {

std::unique_ptr<RobotPeer> make_fcl_robot(const Robot& /*robot*/) {
    return nullptr;
}

} // namespace abut::bench

#endif
