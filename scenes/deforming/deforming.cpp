#include "scenes/deforming/deforming.h"

#include <abut/error.h>

#include "scenes/deforming/cloth.h"
#include "scenes/deforming/cloth_scenes.h"
#include "scenes/rigid_scenes.h"

#include <string>
#include <utility>
#include <vector>

namespace abut {

namespace {

constexpr std::uint64_t kFewest = 1000, kMost = 10'000'000;

/// Plays a ClothModel.
class ClothScene : public DeformingScene {
public:
    explicit ClothScene(scenes::ClothModel model)
        : cloth_(std::move(model.mesh), model.driven, model.settings),
          drive_(std::move(model.drive)), driven_to_(cloth_.mesh().positions) {}

    [[nodiscard]] const Mesh& mesh() const override { return cloth_.mesh(); }
    void step() override {
        ++frame_;
        drive_(frame_ * kFrameSeconds, driven_to_);
        cloth_.step(driven_to_);
    }

private:
    scenes::Cloth cloth_;
    std::function<void(double, std::span<Vec3>)> drive_;
    std::vector<Vec3> driven_to_;
    double frame_ = 0;
};

std::unique_ptr<DeformingScene> make(std::string_view name, const DeformingOptions& options) {
    if (name == "balls")
        return scenes::bouncing_balls(options);
    if (name == "fracture")
        return scenes::breaking_ball(options);
    const auto model = name == "cloth-ball" ? scenes::cloth_on_ball
                       : name == "dancer"   ? scenes::dancer
                       : name == "skirt"    ? scenes::skirt
                                            : scenes::twisted_tube;
    return std::make_unique<ClothScene>(model(options));
}

} // namespace

const std::array<DeformingSceneInfo, 6> kDeformingScenes{{
    {"cloth-ball", "a square of cloth falls on a ball, which then turns", 40'000, 465},
    {"dancer", "a dancing figure in seven skirts", 50'000, 352},
    {"skirt", "a wide skirt on a figure that steps and turns", 92'000, 400},
    {"balls", "rigid balls that bounce in a box", 34'000, 375},
    {"fracture", "a ball that breaks: its topology changes", 60'000, 300},
    {"twist", "a tube that is twisted until it folds over itself", 40'000, 400},
}};

std::unique_ptr<DeformingScene> make_deforming_scene(std::string_view name,
                                                     const DeformingOptions& options) {
    for (const DeformingSceneInfo& info : kDeformingScenes) {
        if (info.name != name)
            continue;
        DeformingOptions chosen = options;
        if (chosen.triangles == 0)
            chosen.triangles = info.triangles;
        if (chosen.triangles < kFewest || chosen.triangles > kMost)
            throw Error(ErrorCode::bad_argument, "triangles: not between 1,000 and 10,000,000");
        return make(name, chosen);
    }
    throw Error(ErrorCode::bad_argument, "there is no scene '" + std::string(name) + "'");
}

} // namespace abut
