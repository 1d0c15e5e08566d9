#include "peers/peer_fcl.h"

#include "measure.h"

#ifdef ABUT_BENCH_FCL
#include "peers/fcl_model.h"

#include <algorithm>
#include <fmt/format.h>
#endif

namespace abut::bench {

#ifdef ABUT_BENCH_FCL

namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

struct Volume {
    std::string name;
    Geometry tree;
};

class FclInstancesImpl final : public FclInstances {
public:
    FclInstancesImpl(const ClashScene& scene, double clearance) {
        for (const Transform& t : scene.placements)
            placements_.push_back(fcl_transform(t));
        const std::vector<Volume> volumes{{"OBBRSS", fcl_model<fcl::OBBRSSd>(scene.part)},
                                          {"RSS", fcl_model<fcl::RSSd>(scene.part)},
                                          {"kIOS", fcl_model<fcl::kIOSd>(scene.part)},
                                          {"OBB", fcl_model<fcl::OBBd>(scene.part)},
                                          {"AABB", fcl_model<fcl::AABBd>(scene.part)}};
        choose(
            scene, volumes, [&](auto a, auto b) { (void)collide(a, b); }, collider_, "collide");
        // FCL has no distance between OBB hierarchies.
        std::vector<Volume> measurable;
        std::copy_if(volumes.begin(), volumes.end(), std::back_inserter(measurable),
                     [](const Volume& v) { return v.name != "OBB"; });
        choose(
            scene, measurable, [&](auto a, auto b) { (void)distance(a, b, clearance); }, measurer_,
            "distance");
    }

    [[nodiscard]] bool collide(std::uint32_t a, std::uint32_t b) const override {
        const fcl::CollisionRequestd request(1, false);
        fcl::CollisionResultd result;
        fcl::collide(collider_.tree.get(), placements_[a], collider_.tree.get(), placements_[b],
                     request, result);
        return result.isCollision();
    }

    [[nodiscard]] double distance(std::uint32_t a, std::uint32_t b,
                                  double upper_bound) const override {
        const fcl::DistanceRequestd request(false);
        fcl::DistanceResultd result(upper_bound);
        fcl::distance(measurer_.tree.get(), placements_[a], measurer_.tree.get(), placements_[b],
                      request, result);
        return result.min_distance;
    }

    [[nodiscard]] std::string collide_name() const override { return name(collider_); }
    [[nodiscard]] std::string distance_name() const override { return name(measurer_); }
    [[nodiscard]] std::vector<std::string> choice() const override { return choice_; }

private:
    static std::string name(const Volume& volume) {
        return fmt::format("FCL {}, {}", FCL_VERSION, volume.name);
    }

    /// Measures pairs spread over all candidates.
    template <class Query>
    static double seconds_a_pair(const ClashScene& scene, std::size_t pairs, const Query& query) {
        pairs = std::min(pairs, scene.candidates.size());
        const auto pass = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto& [a, b] = scene.candidates[i * scene.candidates.size() / pairs];
                query(a, b);
            }
        };
        return take_turns(pairs, pairs, 3, pass, {}).ours /
               static_cast<double>(std::max<std::size_t>(1, pairs));
    }

    template <class Query>
    void choose(const ClashScene& scene, const std::vector<Volume>& volumes, const Query& query,
                Volume& chosen, const char* verb) {
        std::string line = fmt::format("FCL's {}, us a pair on a sample:", verb);
        double best = 0;
        Volume fastest;
        for (const Volume& volume : volumes) {
            chosen = volume;
            // A few pairs show which volumes are far slower; only the others are measured on many.
            double seconds = seconds_a_pair(scene, 10, query);
            if (fastest.name.empty() || seconds < 3 * best)
                seconds = seconds_a_pair(scene, 4000, query);
            line += fmt::format(" {} {:.3g}", volume.name, 1e6 * seconds);
            if (fastest.name.empty() || seconds < best)
                best = seconds, fastest = volume;
        }
        chosen = fastest;
        choice_.push_back(line);
    }

    std::vector<fcl::Transform3d> placements_;
    Volume collider_, measurer_;
    std::vector<std::string> choice_;
};

} // namespace

std::unique_ptr<FclInstances> make_fcl_instances(const ClashScene& scene, double clearance) {
    return std::make_unique<FclInstancesImpl>(scene, clearance);
}

#else

std::unique_ptr<FclInstances> make_fcl_instances(const ClashScene& /*scene*/,
                                                 double /*clearance*/) {
    return nullptr;
}

#endif

} // namespace abut::bench
