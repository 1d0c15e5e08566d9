#pragma once

#include <abut/picture.h>

#include "render/picture/geometry_stream.h"
#include "render/picture/picture_model.h"

#include <memory>
#include <vector>

namespace abut {

/// The colours of both sides of a clash, in pictures and in BCF.
inline constexpr Colour kSideA{222, 62, 48}, kSideB{52, 110, 214};

/// What a picture shows, once its aim is known.
struct PictureScene {
    Camera camera;
    RenderStyle style;
    std::vector<Mark> marks;
};

/// The state that the pictures of one model share: the context, its compiled shaders and its
/// buffers.
struct PictureStudio {
    explicit PictureStudio(std::unique_ptr<PictureModel> shown);
    /// Frees the renderer's objects in its own context: another one may be current.
    ~PictureStudio();
    PictureStudio(const PictureStudio&) = delete;
    PictureStudio& operator=(const PictureStudio&) = delete;

    std::unique_ptr<PictureModel> model;
    OffscreenContext context;
    Renderer renderer;
    GeometryStream stream;
};

/// Makes one picture off screen.
class PictureJob {
public:
    PictureJob(PictureStudio& studio, const PictureOptions& options);

    Picture run();

private:
    [[nodiscard]] PictureScene aimed();
    PictureScene aimed(NamedView view);
    PictureScene aimed(const Camera& camera);
    PictureScene aimed(const PartAim& aim);
    PictureScene aimed(const PairAim& aim);
    PictureScene aimed(const SidesAim& aim);

    [[nodiscard]] RenderStyle style(bool with_ground) const;
    [[nodiscard]] Camera lens() const;
    void ghost_all_but(std::span<const std::uint32_t> parts);

    /// Draws the parts that are not ghosts, and then the ghosts.
    void draw(const PictureScene& scene);

    const PictureModel& model_;
    const PictureOptions& options_;
    Renderer& renderer_;
    GeometryStream& stream_;
    std::vector<bool> opaque_; ///< by part
    std::vector<bool> ghosts_; ///< by part; empty: all that are not opaque
};

} // namespace abut
